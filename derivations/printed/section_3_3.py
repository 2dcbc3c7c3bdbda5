"""Section 3.3, transverse symmetry: every printed statement, transcribed as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import symmetry as rules
from rodproof.derivations.checks.symmetry import E, Phi, R
from rodproof.derivations.notation import Chain, Every, ForAll, Iff, W, equal, u, v
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import iota
from rodproof.derivations.theory.frames import psi, theta
from rodproof.derivations.theory.symmetry import FLIP, REFLECTION, ROTATION

SECTION = "3.3"

_ALL = sp.Tuple(u, v)
_E_TEX = r"\boldsymbol{\mathsf E}"
_R_TEX = r"\boldsymbol{\mathsf R}_\psi"
_RIGHT_TEX = r" = \Phi(\mathsf u, \mathsf v)"
_TURNED_TEX = rf"\Phi({_R_TEX} \mathsf u, {_R_TEX} \mathsf v){_RIGHT_TEX}"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (_matrices(), *_definitions(), *_claims())


def _matrices() -> Statement:
    e, r = (
        [[sp.Symbol(f"{name}{i}{j}", real=True) for j in (1, 2, 3)] for i in (1, 2, 3)]
        for name in "ER"
    )
    c, s = sp.cos(psi), sp.sin(psi)
    flip = ((1, 0, 0), (0, -1, 0), (0, 0, 1))
    turn = ((c, s, 0), (-s, c, 0), (0, 0, 1))
    return Statement(
        id="symmetry-matrices", section=SECTION, label="-", introduces=True,
        claim="The matrices by which a flip and a turn of the directors act on the strains.",
        latex=r"\boldsymbol{\mathsf E} = \begin{bmatrix} 1 & 0 & 0 \\ 0 & -1 & 0 \\ 0 & 0 & 1"
        r"\end{bmatrix}, \quad \boldsymbol{\mathsf R}_\psi = \begin{bmatrix} \cos\psi & \sin\psi"
        r" & 0 \\ -\sin\psi & \cos\psi & 0 \\ 0 & 0 & 1 \end{bmatrix}, \quad \psi \in [0, 2\pi)",
        printed=Every(
            *(equal(e[i][j], flip[i][j]) for i in range(3) for j in range(3)),
            *(equal(r[i][j], turn[i][j]) for i in range(3) for j in range(3)),
        ),
        check=rules.MATRICES,
        note="E is the half-turn about d_2 together with the reversal of the arc; the half-turn "
        "about d_1 gives diag(-1, 1, 1), which is R_pi E.",
    )  # fmt: skip


def _for_every_turn(angle: sp.Symbol) -> ForAll:
    """Invariance under R_psi, with the letter that the sentence binds."""
    return ForAll(sp.Tuple(angle), equal(Phi(R(psi) * u, R(psi) * v), Phi(u, v)))


def _reflected(on_u: sp.Expr, on_v: sp.Expr) -> Every:
    return Every(_for_every_turn(psi), equal(Phi(on_u * u, on_v * v), Phi(u, v)))


def _definitions() -> tuple[Statement, ...]:
    return (
        Statement(
            id="hemitropic-definition", section=SECTION, label="-",
            claim="A rod is transversely hemitropic if turning its directors about d_3 does not "
            "change the stored energy.",
            latex=r"\text{for all } \theta \in [0, 2\pi):\ " + _TURNED_TEX,
            printed=_for_every_turn(theta), read_as=_for_every_turn(psi),
            check=rules.Defines((ROTATION,)),
            reading="The bound variable is psi, not theta, and (u, v) ranges over the strains on "
            "which the energy is defined. With psi left free one fixed angle would do: "
            "Phi = u_1^2 is unchanged by psi = pi and not by psi = pi/2.",
        ),
        Statement(
            id="flip-definition", section=SECTION, label="-", introduces=True,
            claim="A hemitropic rod is flip-symmetric if reversing the arc, with a half-turn about "
            "d_2, does not change the stored energy.",
            latex=rf"\Phi({_E_TEX} \mathsf u, {_E_TEX} \mathsf v){_RIGHT_TEX}",
            printed=_reflected(E, E), check=rules.Defines((ROTATION, FLIP)),
            note="For all u, v on which the energy is defined. u and v change alike: the reversal "
            "of the arc changes the sign of both, and the half-turn has determinant 1.",
        ),
        Statement(
            id="isotropy-definition", section=SECTION, label="-",
            claim="A hemitropic rod is isotropic if a reflection keeps the stored energy.",
            latex=rf"\Phi({_E_TEX} \mathsf u, -{_E_TEX} \mathsf v){_RIGHT_TEX}",
            printed=_reflected(E, -E), correction=_reflected(-E, E),
            check=rules.Defines((ROTATION, REFLECTION)),
            note="The minus sign belongs to the axial u, not to the polar v. As printed v_3 would "
            "become -v_3, against v_3 > 0, and the straight rod at rest, v = (0, 0, 1), would be "
            "carried to v = (0, 0, -1).",
        ),
    )  # fmt: skip


def _energy(on_u: sp.Expr, on_v: sp.Expr, domain: sp.Basic = rules.INSIDE) -> ForAll:
    return ForAll(domain, equal(W(on_u * u, on_v * v), W(u, v)))


def _isotropic(on_u: sp.Expr, on_v: sp.Expr, domain: sp.Basic = rules.INSIDE) -> Iff:
    achiral: Chain = equal(iota, 0)
    return Iff(_energy(on_u, on_v, domain), achiral)


def _claims() -> tuple[Statement, ...]:
    return (
        Statement(
            id="hemitropic-flip-claim", section=SECTION, label="-",
            claim="The strain-limiting rod is hemitropic and flip-symmetric.",
            latex=rf"W({_R_TEX} \mathsf u, {_R_TEX} \mathsf v) = W(\mathsf u, \mathsf v), \quad "
            rf"W({_E_TEX} \mathsf u, {_E_TEX} \mathsf v) = W(\mathsf u, \mathsf v)",
            printed=Every(_energy(R(psi), R(psi), _ALL), _energy(E, E, _ALL)),
            read_as=Every(_energy(R(psi), R(psi)), _energy(E, E)),
            check=rules.HasSymmetries((ROTATION, FLIP)),
            reading="For all strains with Q < 1, which the operations carry to one another; the "
            "definitions say for all u and v, where W has no value once Q reaches 1 (for p = 2, "
            "W = gamma(1 - (1 - Q)^{1/2})). Any sign of iota.",
        ),
        Statement(
            id="isotropic-iff-iota-zero", section=SECTION, label="-",
            claim="The rod is isotropic exactly if twist and stretch are not coupled.",
            latex=r"\text{isotropic} \iff \iota = 0",
            printed=_isotropic(E, -E, rules.INSIDE), read_as=_isotropic(-E, E),
            check=rules.SymmetricExactlyIf(REFLECTION),
            reading="Isotropic in the sense of a reflection, Phi(-E u, E v) = Phi(u, v), on Q < 1. "
            "By the printed definition, Phi(E u, -E v), no rod of the model is isotropic, whatever "
            "iota: at iota = 0, eta = 2/5, gamma = 1, p = 2 the rod at rest has W = 0 and its "
            "image has W = 2/5.",
        ),
    )  # fmt: skip
