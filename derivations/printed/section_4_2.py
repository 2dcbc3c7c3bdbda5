"""Section 4.2, isolated contact forces: reduced equations and straight states, as printed.

The sheared states of the same section are in `section_4_2_sheared`.
"""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.routes import states, thrust
from rodproof.derivations.checks.thrust import domains, points
from rodproof.derivations.checks.thrust.branch import Determined, TwistedUnless, of_both_chiralities
from rodproof.derivations.checks.thrust.equations import (
    COUPLE_BALANCE,
    FLEXURE_1,
    FLEXURE_2,
    TWIST,
    Alternatives,
    LinkByLink,
    Vanish,
)
from rodproof.derivations.checks.thrust.points import d, psi0, scalar_v, tangent
from rodproof.derivations.checks.thrust.states import (  # fmt: skip
    Both,
    InAllStates,
    InEquilibrium,
    Jointly,
    NamesStretch,
)
from rodproof.derivations.notation import (
    Either,
    Every,
    Iff,
    Implies,
    LimitOf,
    Prime,
    chain,
    equal,
    m,
    n,
    positive,
    u,
    v,
)  # fmt: skip
from rodproof.derivations.printed import section_4_2_sheared
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import LOADS, beta, eta, iota, p, u1, u2, u3, v1, v2, v3, zeta
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.derivations.theory.thrust import N, s

SECTION = "4.2"

M = sp.IndexedBase("M", real=True)
_D = beta**2 * eta**2 - iota**2
_D_TEX = r"\beta^2 \eta^2 - \iota^2"
_LOADED = "N is not 0. "
_sin, _cos = sp.sin(theta), sp.cos(theta)
_balance = _sin * (v[3] - scalar_v * N * _cos)


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper, and what it does not say."""
    return (
        *_reduced_equations(),
        *_center_line(),
        *_straight_strains(),
        *_straight_configuration(),
        *_chirality_and_limits(),
        *section_4_2_sheared.statements(),
        *_extras(),
    )


def _zeros(base: sp.IndexedBase) -> Every:
    return Every(*(equal(base[i], 0) for i in (1, 2, 3)))


def _reduced_equations() -> tuple[Statement, ...]:
    F = (1 + ((N * _sin) ** 2 / zeta**2 + beta**2 / _D * (N * _cos) ** 2) ** (p / 2)) ** (-1 / p)
    written_out = N * _sin * (1 - (1 / zeta**2 - beta**2 / _D) * F * N * _cos)
    return (
        Statement(
            id="pure-force-m-zero", section=SECTION, label="-",
            claim="The contact couple vanishes in both frames at once.",
            latex=r"\boldsymbol m(s) = \boldsymbol 0 \iff M_1(s) = M_2(s) = M_3(s) = 0",
            printed=Iff(_zeros(m), _zeros(M)),
            check=Routed(Vanish(domains.COUPLES, LOADS[:3]), states.VANISH),
        ),
        Statement(
            id="pure-force-phi", section=SECTION, label="eq:TTvarphi",
            claim="Without a couple the azimuth is constant where theta is not 0 or pi.",
            latex=r"\sin\theta\, \varphi' = 0",
            printed=equal(_sin * Prime(phi), 0), check=FLEXURE_1,
            note="The flexure along e_1 is -sin theta phi'; the law makes it u M_1 = 0.",
        ),
        Statement(
            id="pure-force-theta-constant", section=SECTION, label="-",
            claim="Without a couple the polar angle is constant.",
            latex=r"\theta' = 0",
            printed=equal(Prime(theta), 0), check=FLEXURE_2,
        ),
        Statement(
            id="pure-force-psi", section=SECTION, label="-",
            claim="Rate of the third angle.",
            latex=r"\psi' + \cos\theta\, \varphi' = u_3",
            printed=equal(Prime(psi) + _cos * Prime(phi), u[3]), check=TWIST,
        ),
        Statement(
            id="pure-force-theta", section=SECTION, label="eq:TTtheta",
            claim="Balance of couples leaves one algebraic equation for theta.",
            latex=r"N \sin\theta\,(v_3 - v N \cos\theta) = 0",
            printed=equal(N * _balance, 0), check=COUPLE_BALANCE,
        ),
        Statement(
            id="theta-determined-by-N", section=SECTION, label="-",
            claim="The thrust determines theta through the algebraic equation.",
            latex=r"N \sin\theta\,(v_3 - v N \cos\theta) = 0",
            printed=equal(N * _balance, written_out),
            read_as=Implies(sp.Ne(N, 0), equal(N * _balance, written_out)),
            check=Determined(domains.PUSHED_OR_PULLED),
            reading=_LOADED + "Even then N determines theta only as one of finitely many values: "
            "0 and pi always, and one more angle if |N| is above the threshold (below pi/2 for "
            "N > 0, above it for N < 0). At N = 0 the rod is at rest and every theta solves the "
            "equation.",
        ),
    )  # fmt: skip


def _center_line() -> tuple[Statement, ...]:
    loaded = sp.Ne(N, 0)
    states = InAllStates(domains.ALL_STATES)
    link_by_link = LinkByLink((InAllStates(domains.PUSHED_OR_PULLED), states))
    parallel = equal(v[1] ** 2 + v[2] ** 2 + v[3] ** 2, tangent[3] ** 2)
    along_1 = chain(tangent[1], "=", sp.cos(phi) * _balance, "=", 0)
    along_2 = chain(tangent[2], "=", sp.sin(phi) * _balance, "=", 0)
    alternatives = Iff(
        equal(N * _balance, 0), Either(equal(_sin, 0), equal(v[3], scalar_v * N * _cos))
    )
    at_rest = _LOADED + "At N = 0 the equation says nothing: the unstressed rod satisfies it in "
    return (
        Statement(
            id="centerline-parallel-g3", section=SECTION, label="-",
            claim="The center line of every state of equilibrium under a pure force is along g_3.",
            latex=r"|\boldsymbol r'|^2 = (\boldsymbol r' \cdot \boldsymbol g_3)^2",
            printed=parallel, read_as=Implies(loaded, parallel), check=states,
            reading=at_rest + "any direction, so that r' = d_3 need not be along g_3.",
        ),
        Statement(
            id="r-dot-g1", section=SECTION, label="-",
            claim="Component of r' along g_1, and that it vanishes in equilibrium.",
            latex=r"\boldsymbol r' \cdot \boldsymbol g_1 = \sin\theta \cos\varphi"
            r"\,(v_3 - v N \cos\theta) = 0",
            printed=along_1, read_as=Implies(loaded, along_1), check=link_by_link,
            reading=at_rest + "any direction, where v_3 - v N cos theta = 1. The first equality "
            "holds for every N, theta and phi.",
        ),
        Statement(
            id="r-dot-g2", section=SECTION, label="-",
            claim="Component of r' along g_2, and that it vanishes in equilibrium.",
            latex=r"\boldsymbol r' \cdot \boldsymbol g_2 = \sin\theta \sin\varphi"
            r"\,(v_3 - v N \cos\theta) = 0",
            printed=along_2, read_as=Implies(loaded, along_2), check=link_by_link,
            reading=at_rest + "any direction, where v_3 - v N cos theta = 1. The first equality "
            "holds for every N, theta and phi.",
        ),
        Statement(
            id="theta-alternatives", section=SECTION, label="eq:TTalt",
            claim="The algebraic equation leaves two cases.",
            latex=r"\sin\theta = 0 \quad\text{or}\quad v_3 = v N \cos\theta",
            printed=alternatives, read_as=Implies(loaded, alternatives),
            check=Routed(Alternatives(COUPLE_BALANCE), thrust.ALTERNATIVES),
            reading=at_rest + "any direction, where neither alternative need hold.",
        ),
        Statement(
            id="theta-zero-directors", section=SECTION, label="-",
            claim="At theta = 0 the third director is g_3 and the force is along it.",
            latex=r"\boldsymbol d_3 = \boldsymbol g_3, \quad \boldsymbol n = N \boldsymbol d_3 = "
            r"N \boldsymbol g_3",
            printed=Every(
                equal(d[3, 1], 0), equal(d[3, 2], 0), equal(d[3, 3], 1),
                equal(n[1], 0), equal(n[2], 0), equal(n[3], N),
            ),
            check=InAllStates(domains.STRAIGHT, named=frozenset(
                (*LOADS[3:], *(sp.Symbol(f"d3{i}", real=True) for i in (1, 2, 3))))),
        ),
    )  # fmt: skip


def _factor() -> sp.Expr:
    return (1 + beta**p / _D ** (p / 2) * sp.Abs(N) ** p) ** (-1 / p)


_FACTOR_TEX = rf"\Bigl(1 + \frac{{\beta^p}}{{({_D_TEX})^{{p/2}}}} |N|^p\Bigr)^{{-1/p}}"


def _straight(*named: sp.Symbol) -> InEquilibrium:
    return InEquilibrium(domains.STRAIGHT, named=frozenset(named))


def _straight_strains() -> tuple[Statement, ...]:
    return (
        Statement(
            id="straight-u12", section=SECTION, label="-",
            claim="The straight state is not bent.",
            latex="u_1 = u_2 = 0", printed=equal(u[1], u[2], 0), check=_straight(u1, u2),
        ),
        Statement(
            id="straight-u3", section=SECTION, label="eq:TTu3",
            claim="Twist of the straight state.",
            latex=rf"u_3 = {_FACTOR_TEX} \frac{{-\iota N}}{{{_D_TEX}}}",
            printed=equal(u[3], _factor() * -iota * N / _D), check=_straight(u3),
        ),
        Statement(
            id="straight-v12", section=SECTION, label="-",
            claim="The straight state is not sheared.",
            latex="v_1 = v_2 = 0", printed=equal(v[1], v[2], 0), check=_straight(v1, v2),
        ),
        Statement(
            id="straight-v3", section=SECTION, label="-",
            claim="Dilatation of the straight state.",
            latex=rf"v_3 - 1 = {_FACTOR_TEX} \frac{{\beta^2 N}}{{{_D_TEX}}}",
            printed=equal(v[3] - 1, _factor() * beta**2 * N / _D), check=_straight(v3),
            note="In compression v_3 > 0 for all N exactly if beta^2 <= beta^2 eta^2 - iota^2; see "
            "extra-straight-orientation.",
        ),
    )  # fmt: skip


def _vector(base: sp.IndexedBase, first: tuple[int, ...], parts: tuple[sp.Expr, ...]) -> Every:
    return Every(*(equal(base[(*first, i)], part) for i, part in enumerate(parts, 1)))


def _director(index: int) -> frozenset[sp.Symbol]:
    return frozenset(sp.Symbol(f"d{index}{i}", real=True) for i in (1, 2, 3))


def _straight_configuration() -> tuple[Statement, ...]:
    angle = u[3] * s + psi0
    stretch = sp.sqrt(v[1] ** 2 + v[2] ** 2 + v[3] ** 2)
    along = Every(equal(tangent[1], 0), equal(tangent[2], 0), equal(tangent[3], stretch))
    names = frozenset(sp.Symbol(f"r'{i}", real=True) for i in (1, 2, 3))
    turn = r"u_3 s + \psi(0)"
    free_phi = (
        "At theta = 0 only phi + psi is determined, with (phi + psi)' = u_3; the formula holds "
        "whatever phi does between."
    )
    return (
        Statement(
            id="straight-rprime", section=SECTION, label="-",
            claim="Tangent of the center line of the straight state.",
            latex=r"\boldsymbol r'(s) = (v_1^2 + v_2^2 + v_3^2)^{1/2} \boldsymbol g_3",
            printed=along, read_as=Implies(positive(v[3]), along),
            check=Jointly(
                (InEquilibrium(domains.STRAIGHT, orientation=v3, named=names), NamesStretch())
            ),
            reading="v_3 > 0, which Section 2 asks of every configuration and which the stated "
            "v_3 does not always meet: in compression, if beta^2 > beta^2 eta^2 - iota^2, it fails "
            "from a finite thrust on, and r' = v_3 g_3 then points along -g_3.",
        ),
        Statement(
            id="straight-d1", section=SECTION, label="-",
            claim="First director of the straight state.",
            latex=rf"\boldsymbol d_1(s) = \cos({turn}) \boldsymbol g_1 + \sin({turn})"
            r" \boldsymbol g_2",
            printed=_vector(d, (1,), (sp.cos(angle), sp.sin(angle), sp.Integer(0))),
            check=InEquilibrium(domains.STRAIGHT, named=_director(1)), note=free_phi,
        ),
        Statement(
            id="straight-d2", section=SECTION, label="-",
            claim="Second director of the straight state.",
            latex=rf"\boldsymbol d_2(s) = -\sin({turn}) \boldsymbol g_1 + \cos({turn})"
            r" \boldsymbol g_2",
            printed=_vector(d, (2,), (-sp.sin(angle), sp.cos(angle), sp.Integer(0))),
            check=InEquilibrium(domains.STRAIGHT, named=_director(2)), note=free_phi,
        ),
        Statement(
            id="straight-d3", section=SECTION, label="-",
            claim="Third director of the straight state.",
            latex=r"\boldsymbol d_3(s) = \boldsymbol g_3",
            printed=_vector(d, (3,), (sp.Integer(0), sp.Integer(0), sp.Integer(1))),
            check=InEquilibrium(domains.STRAIGHT, named=_director(3)),
        ),
    )  # fmt: skip


def _chirality_and_limits() -> tuple[Statement, ...]:
    unsheared = equal(v[1], v[2], 0)
    states = tuple(part for m_ in domains.STRAIGHT for part in of_both_chiralities(m_))
    sense, twist = points.strand_sense, points.strand_twist
    helix = points.strand_radius**2 * points.strand_stretch * twist**5
    root = _D ** sp.Rational(-1, 2)

    def both(quantity: sp.Expr, value: sp.Expr) -> Every:
        return Every(*(equal(LimitOf(quantity, N, sign * sp.oo), sign * value) for sign in (1, -1)))

    return (
        Statement(
            id="straight-twisted-unsheared", section=SECTION, label="-",
            claim="At theta = 0 the rod is unsheared, and a chiral one is twisted by a thrust.",
            latex=r"v_1 = v_2 = 0, \quad \iota \neq 0 \implies u_3 \neq 0",
            printed=Every(unsheared, Implies(sp.Ne(iota, 0), sp.Ne(u3, 0))),
            read_as=Every(unsheared, Implies(sp.Ne(iota * N, 0), sp.Ne(u3, 0))),
            check=Both((InAllStates(domains.STRAIGHT, named=frozenset((v1, v2))), TwistedUnless())),
            reading=_LOADED + "A thrust of zero is no thrust; at N = 0 the twist is 0 for every "
            "iota. The sign: u_3 has the sign of -iota N.",
        ),
        Statement(
            id="chirality-sign", section=SECTION, label="-",
            claim="Positive iota stands for right-handed chirality, negative for left-handed, as a "
            "rope unwinds when it is stretched.",
            latex=r"\iota N u_3 < 0, \quad (\boldsymbol x' \times \boldsymbol x'') \cdot "
            r"\boldsymbol x''' = \rho^2 \lambda \tau^5",
            printed=Every(chain(iota * N * u[3], "<", 0), equal(sense, helix)),
            check=InAllStates(states, named=frozenset((sense, u3))),
            reading="A rod is right-handed if its strands are right-handed helices, that is, "
            "strands x = rho d_1 + lambda s d_3 laid with a twist tau > 0 of the sign convention "
            "d_1' = u_3 d_2; N > 0 stretches, and the end is free to turn (m_3 = 0). Then tension "
            "lowers the twist, tau + u_3 < tau, exactly if iota > 0. A strand laid with tau < 0, "
            "or compression, turns the sign round.",
        ),
        Statement(
            id="straight-limit-u3", section=SECTION, label="-",
            claim="Limit of the twist of the straight state for infinite thrust of either sign.",
            latex=rf"\lim_{{N \to \pm\infty}} u_3 = \mp \frac{{\iota}}{{\beta}}({_D_TEX})^{{-1/2}}",
            printed=both(u[3], -iota / beta * root), check=Identity(domains.FAR),
            note="It is not zero only for a chiral rod.",
        ),
        Statement(
            id="straight-limit-v3", section=SECTION, label="eq:maxv3",
            claim="Limit of v_3 - 1 of the straight state for infinite thrust of either sign.",
            latex=rf"\lim_{{N \to \pm\infty}} (v_3 - 1) = \pm\beta({_D_TEX})^{{-1/2}}",
            printed=both(v[3] - 1, beta * root), check=Identity(domains.FAR),
            note="The limit for N to -oo belongs to rods with v_3 > 0 if beta^2 <= beta^2 eta^2 - "
            "iota^2.",
        ),
    )  # fmt: skip


def _extras() -> tuple[Statement, ...]:
    b = beta**2 / _D
    last = -((b**p - b ** (p / 2)) ** (-1 / p))
    return (
        Statement(
            id="extra-straight-orientation", section=SECTION, label="-",
            claim="A compressed straight rod with b = beta^2/(beta^2 eta^2 - iota^2) > 1 keeps "
            "v_3 > 0 exactly down to the thrust -(b^p - b^{p/2})^{-1/p}.",
            latex=r"v_3 = 0 \text{ at } N = -\bigl(b^p - b^{p/2}\bigr)^{-1/p}, \quad "
            r"\frac{\partial v_3}{\partial N} > 0",
            printed=Every(
                equal(domains.v3_at_last, 0), equal(domains.last_thrust, last),
                positive(domains.v3_slope),
            ),
            check=InAllStates((domains.LAST_COMPRESSION,), named=frozenset(
                (domains.v3_at_last, domains.last_thrust, domains.v3_slope))),
            note="For b <= 1 the state exists for every N < 0.",
        ),
    )  # fmt: skip
