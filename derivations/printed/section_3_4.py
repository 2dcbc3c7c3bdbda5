"""Section 3.4, monotonicity: every printed statement, transcribed as printed (gamma = 1)."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import monotonicity as rules
from rodproof.derivations.checks.routes import constants
from rodproof.derivations.checks.tangents import UNIT_STRAINS, a, b
from rodproof.derivations.checks.units import Units
from rodproof.derivations.notation import (
    Chain,
    Every,
    FormQ,
    HessianForm,
    Implies,
    Partial,
    PositiveDefinite,
    Q,
    Summed,
    W,
    chain,
    equal,
    m,
    mu,
    n,
    nu,
    positive,
    u,
    v,
)
from rodproof.derivations.printed import section_3_4_extras as extras
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory.dimensions import length

SECTION = "3.4"

_X = Q(u, v) ** (p / 2)
_factor = (1 - _X) ** (-1 / p - 1)
_square = Q(u, v) ** (p / 2 - 1)
_twist = beta**2 * u[3] + iota * (v[3] - 1)
_stretch = iota * u[3] + eta**2 * (v[3] - 1)

_Q_TEX = r"Q(\mathsf u, \mathsf v)"
_F_TEX = rf"\Bigl(1 - {_Q_TEX}^{{p/2}}\Bigr)^{{-1/p-1}}"
_X_TEX = rf"\bigl(1 - {_Q_TEX}^{{p/2}}\bigr)"
_S_TEX = rf"{_Q_TEX}^{{p/2-1}}"
_TWIST_TEX = r"(\beta^2 u_3 + \iota(v_3 - 1))"
_STRETCH_TEX = r"(\iota u_3 + \eta^2(v_3 - 1))"

_AT_REST = (
    "At zero strain and p < 2 the printed power of Q is infinite and multiplies zero (at p = 2 it "
    "is 0^0): there the term means its limit, which is 0 for every p > 0, as it is bounded by "
    "Q^{p/2} times a product of moduli. Without this the formula has no value at rest."
)


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (
        _units(),
        _monotone(),
        *_hessian(),
        *_of_bending(),
        *_of_twist(),
        *_of_forces(),
        *_quadratic_form(),
        *extras.statements(),
    )


def _units() -> Statement:
    return Statement(
        id="nondimensionalization", section=SECTION, label="-", introduces=True,
        claim="Length and force scales of the remainder of the paper: the rod's length and gamma.",
        latex=r"L = 1, \quad \gamma = 1",
        printed=Every(equal(length, 1), equal(gamma, 1)), check=Routed(Units(), constants.UNITS),
        note="A length and a force are free to choose, and the law in these units is the law with "
        "gamma = 1; alpha, beta, iota become alpha/L, beta/L, iota/L. Six numbers are left "
        "(alpha, beta, zeta, eta, iota, p) besides the loads.",
    )  # fmt: skip


def _monotone() -> Statement:
    pairs = ((m[mu], u[mu]), (m[3], u[3]), (n[mu], v[mu]), (n[3], v[3]))
    at = rules.state

    def grows(load: str, strain: str, index: object) -> Implies:
        return Implies(
            chain(at[f"{load}^A"][index], "<", at[f"{load}^B"][index]),
            chain(at[f"{strain}^A"][index], "<", at[f"{strain}^B"][index]),
        )

    return Statement(
        id="monotonicity-reading", section=SECTION, label="-",
        claim="Each component of couple and force increases together with its own strain.",
        latex=r"m_\mu \nearrow\, \Rightarrow u_\mu \nearrow,\quad m_3 \nearrow\, \Rightarrow u_3 "
        r"\nearrow,\quad n_\mu \nearrow\, \Rightarrow v_\mu \nearrow,\quad n_3 \nearrow\, "
        r"\Rightarrow v_3 \nearrow",
        printed=Every(
            grows("m", "u", mu), grows("m", "u", 3), grows("n", "v", mu), grows("n", "v", 3)
        ),
        read_as=Every(
            *(positive(Partial(load, strain)) for load, strain in pairs),
            *(positive(Partial(strain, load)) for load, strain in pairs),
        ),
        check=rules.Monotone(),
        reading="While one component grows, something must be said of the five others: either "
        "their strains are held (diagonal of D^2 W) or their loads are (diagonal of D^2 W*); then "
        "every slope is positive. Between two states in which other components change as well the "
        "claim fails: a shear force that grows along with a bending couple uses up the strain "
        "limit and lowers the flexure. What holds for any two states is the sum over all six: "
        "(m_B - m_A).(u_B - u_A) + (n_B - n_A).(v_B - v_A) > 0.",
    )  # fmt: skip


def _hessian() -> tuple[Statement, ...]:
    strains = [*((u, k) for k in (1, 2, 3)), *((v, k) for k in (1, 2, 3))]
    loads = [*((m, k) for k in (1, 2, 3)), *((n, k) for k in (1, 2, 3))]
    blocks = Every(
        *(
            equal(Partial(Partial(W(u, v), e[i]), x[j]), Partial(load[i], x[j]))
            for (e, i), (load, _) in zip(strains, loads, strict=True)
            for x, j in strains
        )
    )
    block_tex = (
        r"D^2 W(\mathsf u, \mathsf v) = \begin{bmatrix} \frac{\partial \mathsf m}{\partial \mathsf "
        r"u}(\mathsf u, \mathsf v) & \frac{\partial \mathsf m}{\partial \mathsf v}(\mathsf u, "
        r"\mathsf v) \\ \frac{\partial \mathsf n}{\partial \mathsf u}(\mathsf u, \mathsf v) & "
        r"\frac{\partial \mathsf n}{\partial \mathsf v}(\mathsf u, \mathsf v) \end{bmatrix}"
    )
    return (
        Statement(
            id="hessian-positive-definite", section=SECTION, label="-",
            claim="For Q < 1 the Hessian of the stored energy is positive definite.",
            latex=rf"{_Q_TEX} < 1 \implies D^2 W(\mathsf u, \mathsf v)\ \text{{positive definite}}",
            printed=Implies(
                chain(Q(u, v), "<", 1),
                PositiveDefinite(HessianForm(u, v, a, b), sp.Tuple(a, b)),
            ),
            check=rules.DefiniteTangent(UNIT_STRAINS),
            note="For every p > 0, at rest too, where W has the second derivative K. It needs "
            "beta^2 eta^2 > iota^2, not the printed alpha^2 beta^2 > iota^2.",
        ),
        Statement(
            id="hessian-blocks", section=SECTION, label="-",
            claim="The blocks of the Hessian of the stored energy are derivatives of the loads.",
            latex=block_tex, printed=blocks, check=rules.BLOCKS,
        ),
    )  # fmt: skip


def _entry(
    name: str, claim: str, latex: str, printed: Chain, *, correction: Chain | None = None,
    note: str = "",
) -> Statement:  # fmt: skip
    return Statement(
        id=name, section=SECTION, label="-", claim=claim, latex=latex, printed=printed,
        check=rules.ENTRIES, correction=correction, note=note,
        reading="" if correction is not None else _AT_REST,
    )  # fmt: skip


def _of_bending() -> tuple[Statement, ...]:
    delta = sp.KroneckerDelta(mu, nu)
    return (
        _entry(
            "hess-m-u", "Derivative of the bending couples by the flexural strains.",
            rf"\frac{{\partial m_\mu}}{{\partial u_\nu}} = {_F_TEX} \times \Bigl[{_X_TEX} \alpha^2 "
            rf"\delta_{{\mu\nu}} + {_S_TEX} (\alpha^2 u_\mu)(\alpha^2 u_\nu)\Bigr]",
            equal(
                Partial(m[mu], u[nu]),
                _factor * (
                    (1 - _X) * alpha**2 * delta + _square * (alpha**2 * u[mu]) * (alpha**2 * u[nu])
                ),
            ),
        ),
        _entry(
            "hess-m-u3", "Derivative of the bending couples by the twist.",
            rf"\frac{{\partial m_\mu}}{{\partial u_3}} = \frac{{\partial m_3}}{{\partial u_\mu}} = "
            rf"{_F_TEX} {_S_TEX} \alpha^2 u_\mu {_TWIST_TEX}",
            equal(
                Partial(m[mu], u[3]), Partial(m[3], u[mu]),
                _factor * _square * alpha**2 * u[mu] * _twist,
            ),
        ),
        _entry(
            "hess-m-v", "Derivative of the bending couples by the shear strains.",
            rf"\frac{{\partial m_\mu}}{{\partial v_\nu}} = \frac{{\partial n_\nu}}{{\partial "
            rf"u_\mu}} = {_F_TEX} {_S_TEX} (\alpha^2 u_\mu)(\zeta^2 v_\nu)",
            equal(
                Partial(m[mu], v[nu]), Partial(n[nu], u[mu]),
                _factor * _square * (alpha**2 * u[mu]) * (zeta**2 * v[nu]),
            ),
        ),
        _entry(
            "hess-m-v3", "Derivative of the bending couples by the dilatation strain.",
            rf"\frac{{\partial m_\mu}}{{\partial v_3}} = \frac{{\partial n_3}}{{\partial u_\mu}} = "
            rf"{_F_TEX} {_S_TEX} \alpha^2 u_\mu {_STRETCH_TEX}",
            equal(
                Partial(m[mu], v[3]), Partial(n[3], u[mu]),
                _factor * _square * alpha**2 * u[mu] * _stretch,
            ),
        ),
    )  # fmt: skip


def _of_twist() -> tuple[Statement, ...]:
    misread = Q(u, v[3] - 1) ** (p / 2 - 1)

    def coupled(square: sp.Expr) -> Chain:
        return equal(
            Partial(m[3], v[3]), Partial(n[3], u[3]),
            _factor * ((1 - _X) * iota + square * _twist * _stretch),
        )  # fmt: skip

    return (
        _entry(
            "hess-m3-u3", "Derivative of the twisting couple by the twist.",
            rf"\frac{{\partial m_3}}{{\partial u_3}} = {_F_TEX} \times \Bigl[{_X_TEX} \beta^2 "
            rf"{_S_TEX} {_TWIST_TEX}^2\Bigr]",
            equal(Partial(m[3], u[3]), _factor * ((1 - _X) * beta**2 * _square * _twist**2)),
            correction=equal(
                Partial(m[3], u[3]), _factor * ((1 - _X) * beta**2 + _square * _twist**2)
            ),
            note="The plus sign between the two terms of the bracket is missing. At zero strain "
            "the second term of the corrected formula means its limit 0.",
        ),
        _entry(
            "hess-m3-v", "Derivative of the twisting couple by the shear strains.",
            rf"\frac{{\partial m_3}}{{\partial v_\nu}} = \frac{{\partial n_\nu}}{{\partial u_3}} = "
            rf"{_F_TEX} {_S_TEX} {_TWIST_TEX} \zeta^2 v_\nu",
            equal(
                Partial(m[3], v[nu]), Partial(n[nu], u[3]),
                _factor * _square * _twist * zeta**2 * v[nu],
            ),
        ),
        _entry(
            "hess-m3-v3", "Derivative of the twisting couple by the dilatation strain.",
            rf"\frac{{\partial m_3}}{{\partial v_3}} = \frac{{\partial n_3}}{{\partial u_3}} = "
            rf"{_F_TEX} \times \Bigl[{_X_TEX} \iota + Q(\mathsf u, v_3 - 1)^{{p/2-1}} "
            rf"{_TWIST_TEX} {_STRETCH_TEX}\Bigr]",
            coupled(misread), correction=coupled(_square),
            note="The second argument of Q is the column v, not the number v_3 - 1. The "
            "counterexample takes the number for the third component of a column; it also fails "
            "with (v_1, v_2, v_3 - 1) for the column, and with Q as a form of (u, 0, 0, v_3 - 1). "
            "At zero strain the second term means its limit 0.",
        ),
    )  # fmt: skip


def _of_forces() -> tuple[Statement, ...]:
    delta = sp.KroneckerDelta(mu, nu)
    return (
        _entry(
            "hess-n-v", "Derivative of the shear forces by the shear strains.",
            rf"\frac{{\partial n_\mu}}{{\partial v_\nu}} = {_F_TEX} \times \Bigl[{_X_TEX} \zeta^2 "
            rf"\delta_{{\mu\nu}} + {_S_TEX} (\zeta^2 v_\mu)(\zeta^2 v_\nu)\Bigr]",
            equal(
                Partial(n[mu], v[nu]),
                _factor * (
                    (1 - _X) * zeta**2 * delta + _square * (zeta**2 * v[mu]) * (zeta**2 * v[nu])
                ),
            ),
        ),
        _entry(
            "hess-n-v3", "Derivative of the shear forces by the dilatation strain.",
            rf"\frac{{\partial n_\mu}}{{\partial v_3}} = \frac{{\partial n_3}}{{\partial v_\mu}} = "
            rf"{_F_TEX} {_S_TEX} \zeta^2 v_\mu {_STRETCH_TEX}",
            equal(
                Partial(n[mu], v[3]), Partial(n[3], v[mu]),
                _factor * _square * zeta**2 * v[mu] * _stretch,
            ),
        ),
        _entry(
            "hess-n3-v3", "Derivative of the tension by the dilatation strain.",
            rf"\frac{{\partial n_3}}{{\partial v_3}} = {_F_TEX} \times \Bigl[{_X_TEX} \eta^2 + "
            rf"{_S_TEX} {_STRETCH_TEX}^2\Bigr]",
            equal(Partial(n[3], v[3]), _factor * ((1 - _X) * eta**2 + _square * _stretch**2)),
        ),
    )  # fmt: skip


def _right_side(form: sp.Expr) -> sp.Expr:
    work = (
        Summed(alpha**2 * a[mu] * u[mu], mu) + Summed(zeta**2 * b[mu] * v[mu], mu)
        + a[3] * _twist + b[3] * _stretch
    )  # fmt: skip
    return (1 - _X) * form + _square * work**2


def _quadratic_form() -> tuple[Statement, ...]:
    hessian = HessianForm(u, v, a, b)
    column = r"\begin{bmatrix} \mathsf a \\ \mathsf b \end{bmatrix}"
    right_tex = (
        rf"{_X_TEX} Q(\mathsf a, \mathsf b) + {_S_TEX} \Bigl(\alpha^2 a_\mu u_\mu + \zeta^2 b_\mu "
        rf"v_\mu + a_3{_TWIST_TEX} + b_3{_STRETCH_TEX}\Bigr)^2"
    )

    def definite(form: sp.Expr) -> Implies:
        return Implies(chain(Q(u, v), "<", 1), PositiveDefinite(_right_side(form), sp.Tuple(a, b)))

    return (
        Statement(
            id="hessian-quadratic-form", section=SECTION, label="-",
            claim="Closed form of the quadratic form of the Hessian.",
            latex=rf"\Bigl(1 - {_Q_TEX}\Bigr)^{{1/p+1}} {column} \cdot D^2 W(\mathsf u, \mathsf v) "
            rf"{column} = {right_tex}",
            printed=equal((1 - Q(u, v)) ** (1 / p + 1) * hessian, _right_side(Q(a, b))),
            correction=equal((1 - _X) ** (1 / p + 1) * hessian, _right_side(FormQ(a, b))),
            check=rules.TANGENTS,
            note="The power p/2 of Q is missing on the left (harmless only for p = 2). On the "
            "right Q(a, b) must be the form without the shift of the third component by one: "
            "eta^2 b_3^2 + 2 iota a_3 b_3 in place of eta^2 (b_3 - 1)^2 + 2 iota a_3 (b_3 - 1). At "
            "zero strain the second term means its limit 0.",
        ),
        Statement(
            id="hessian-conclusion", section=SECTION, label="-",
            claim="As Q is positive definite, the closed form proves that the Hessian is.",
            latex=rf"{_Q_TEX} < 1 \implies {right_tex} > 0 \quad ((\mathsf a, \mathsf b) \neq 0)",
            printed=definite(Q(a, b)), read_as=definite(FormQ(a, b)),
            check=rules.DefiniteTangent(UNIT_STRAINS),
            reading="Q(a, b) is meant as a form, without the shift v_3 - 1 of the definition of Q. "
            "As defined, Q(a, b) vanishes at a = 0, b = (0, 0, 1) and not at zero, and with "
            "u_3 = 0, v_3 = 1 the whole right-hand side is then zero. At zero strain the second "
            "term means its limit 0.",
        ),
    )  # fmt: skip
