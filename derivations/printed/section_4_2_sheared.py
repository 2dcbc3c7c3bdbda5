"""Section 4.2, the branch of sheared tensile states, as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.thrust import domains
from rodproof.derivations.checks.thrust.branch import (
    ClosedAngle,
    NearThreshold,
    OnTheBranch,
    SharpPowers,
    SharpSign,
    angle_at_p2,
    limiting_angle,
)  # fmt: skip
from rodproof.derivations.checks.thrust.domains import N_thresh, d, fN, psi0, scalar_v, tangent, x_N
from rodproof.derivations.checks.thrust.moduli import (
    Necessary,
    SameSides,
    SameSign,
    b,
    c,
    condition_1_follows,
    condition_2_follows,
    kappa,
)  # fmt: skip
from rodproof.derivations.checks.thrust.states import (
    COUPLE_BALANCE,
    FLEXURE_1,
    Both,
    Deduction,
    Equation,
    InAllStates,
    InEquilibrium,
    Jointly,
    LinkByLink,
)  # fmt: skip
from rodproof.derivations.notation import (
    Every,
    Iff,
    Implies,
    LimitOf,
    Partial,
    Prime,
    chain,
    equal,
    n,
    positive,
    u,
    v,
)  # fmt: skip
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.records import Check, Statement
from rodproof.derivations.symbols import beta, eta, iota, p, u1, u2, u3, v1, v2, v3, zeta
from rodproof.derivations.theory.frames import phi, theta
from rodproof.derivations.theory.thrust import N, s, x

SECTION = "4.2"

_D = beta**2 * eta**2 - iota**2
_D_TEX = r"\beta^2 \eta^2 - \iota^2"
_K = _D / (beta**2 * zeta**2) - 1
_K_TEX = rf"\Bigl(\frac{{{_D_TEX}}}{{\beta^2 \zeta^2}} - 1\Bigr)"
_A, _B = 1 / zeta**2, beta**2 / _D
_A_TEX, _B_TEX = r"\frac{1}{\zeta^2}", rf"\frac{{\beta^2}}{{{_D_TEX}}}"
_sin, _cos = sp.sin(theta), sp.cos(theta)
_F = (1 + (_A * N**2 * _sin**2 + _B * N**2 * _cos**2) ** (p / 2)) ** (-1 / p)
_F_TEX = (
    rf"\Bigl[1 + \Bigl({_A_TEX} N^2 \sin^2\theta + {_B_TEX} N^2 \cos^2\theta\Bigr)^{{p/2}}"
    r"\Bigr]^{-1/p}"
)
_W = _A * (1 - x**2) + _B * x**2
_W_TEX = rf"{_A_TEX}(1 - x^2) + {_B_TEX} x^2"
_G = N ** (-p) + _W ** (p / 2)
_G_TEX = rf"\Bigl[N^{{-p}} + \Bigl({_W_TEX}\Bigr)^{{p/2}}\Bigr]"
_X = ((_A - _B) ** 2 + _A - _B) ** sp.Rational(-1, 2)
_X_TEX = rf"\Bigl[\Bigl({_A_TEX} - {_B_TEX}\Bigr)^2 + {_A_TEX} - {_B_TEX}\Bigr]^{{-1/2}}"
_root_b = beta / _D ** sp.Rational(1, 2)
_ROOT_TEX = rf"\frac{{\beta}}{{({_D_TEX})^{{1/2}}}}"
_F1 = (N ** (-p) + beta**p / _D ** (p / 2)) ** (-1 / p) * _B
_F1_TEX = rf"\Bigl(N^{{-p}} + \frac{{\beta^p}}{{({_D_TEX})^{{p/2}}}}\Bigr)^{{-1/p}} {_B_TEX}"
_LIMIT_TEX = rf"\cos^{{-1}}\Bigl\{{{_X_TEX} \frac{{1}}{{\zeta}}\Bigr\}}"

_CONDITION_1 = SameSign(needed=(c, sp.Integer(0)))
_CONDITION_2 = SameSign(needed=(c, sp.sqrt(b)), given=domains.SOFTER_IN_SHEAR)


def statements() -> tuple[Statement, ...]:
    """The statements about sheared states, in the order of the paper, and more about them."""
    return (
        *_sheared_condition(),
        *_conditions_on_the_moduli(),
        *_threshold_and_existence(),
        *_angles(),
        *_function_f(),
        *_roots_and_limits(),
        *_strains(),
        *_directors(),
        *_extras(),
    )


def _statement(
    name: str, claim: str, latex: str, printed: sp.Basic, check: Check, *, label: str = "-",
    introduces: bool = False, reading: str = "", read_as: sp.Basic | None = None,
    correction: sp.Basic | None = None, note: str = "",
) -> Statement:  # fmt: skip
    return Statement(
        id=name, section=SECTION, label=label, claim=claim, latex=latex, printed=printed,
        check=check, introduces=introduces, reading=reading, read_as=read_as,
        correction=correction, note=note,
    )  # fmt: skip


def _sheared_condition() -> tuple[Statement, ...]:
    condition = equal(v[3], scalar_v * N * _cos)
    on_branch = InAllStates((domains.BRANCH, domains.MIRRORED_BRANCH))
    sheared = Identity(domains.SHEARED)
    every_thrust = InAllStates(domains.PUSHED_OR_PULLED)
    return (
        _statement(
            "sheared-condition", "Condition of the sheared states.",
            r"v_3 = v N \cos\theta, \quad \theta \in (0, \pi)",
            Every(condition, positive(_sin)), on_branch, label="eq:TTcase2", introduces=True,
        ),
        _statement(
            "sheared-tension-positive",
            "In a sheared state the tension is N cos theta and positive, as v and v_3 are.",
            r"n_3 = N \cos\theta > 0",
            chain(n[3], "=", N * _cos, ">", 0), LinkByLink((every_thrust, sheared)),
            note="Uses v_3 > 0 as Section 2 demands it; with v_3 < 0 there would be states with "
            "n_3 < 0 where zeta is large.",
        ),
        _statement(
            "sheared-tensile-state", "In a sheared state v_3 exceeds 1.", "v_3 - 1 > 0",
            positive(v[3] - 1), SharpSign(domains.SHEARED, zeta, sp.Integer(0)),
            note="m_3 = 0, so that v_3 - 1 has the sign of n_3.",
        ),
        _statement(
            "sheared-subcase-N-positive",
            "In a sheared state theta is below pi/2 exactly if N is positive.",
            r"\theta \in (0, \tfrac{\pi}{2}) \iff N > 0",
            Iff(positive(_cos), positive(N)), SameSides(domains.SHEARED),
        ),
        _statement(
            "sheared-v3-first", "v_3 of a sheared state through the law.",
            rf"v_3 = {_F_TEX} \frac{{n_3}}{{\zeta^2}}",
            equal(v[3], _F * n[3] / zeta**2), on_branch,
        ),
        _statement(
            "sheared-v3-second", "The same as a multiple of v_3 - 1.",
            rf"{_F_TEX} \frac{{n_3}}{{\zeta^2}} = \frac{{{_D_TEX}}}{{\beta^2 \zeta^2}} (v_3 - 1)",
            equal(_F * n[3] / zeta**2, _D / (beta**2 * zeta**2) * (v[3] - 1)), every_thrust,
            note="Holds for every N and theta, sheared in equilibrium or not.",
        ),
        _statement(
            "sheared-v3-value", "Value of v_3 - 1 in a sheared state.",
            rf"v_3 - 1 = {_K_TEX}^{{-1}}",
            equal(v[3] - 1, 1 / _K), on_branch, label="eq:TTv3",
            note="It does not depend on N or p.",
        ),
    )  # fmt: skip


def _conditions_on_the_moduli() -> tuple[Statement, ...]:
    sheared = equal(v3, scalar_v * N * _cos)
    valued = equal(v3 - 1, 1 / _K)
    first, second, third = positive(_K), positive(_A - _B), chain(
        eta**2, ">", zeta**2 + iota**2 / beta**2)  # fmt: skip
    limited = chain(1 / _K, "<", _root_b)
    in_powers = chain(_K**p * beta ** (2 * p) / _D**p, ">", beta**p / _D ** (p / 2))
    k_tex = rf"\frac{{{_D_TEX}}}{{\beta^2 \zeta^2}} - 1 > 0"
    pulled = domains.PUSHED_OR_PULLED[0]

    def derived(claim: sp.Basic) -> Equation:
        left, right = claim.sides
        return Equation(pulled.interpret(left - right), pulled)

    return (
        _statement(
            "moduli-condition-1-necessary",
            "A sheared state can only exist if the first condition on the moduli holds.",
            rf"v_3 = v N \cos\theta \implies {k_tex}",
            Implies(sheared, first),
            Necessary(
                Equation(domains.sheared_residual(), pulled), _CONDITION_1, condition_1_follows,
                "F n_3 = 1/c and v_3 = a/c > 0, F > 0 by the law; so c > 0",
            ),
            note="If the difference is 0 there is no sheared state either: v_3 = v_3 - 1.",
        ),
        _statement(
            "moduli-condition-1", "Three forms of the first condition on the moduli.",
            rf"{k_tex} \iff {_A_TEX} - {_B_TEX} > 0 \iff \eta^2 > \zeta^2 + "
            r"\frac{\iota^2}{\beta^2}",
            Iff(first, second, third), _CONDITION_1, label="eq:TTin1",
        ),
        _statement(
            "moduli-condition-2-necessary",
            "A sheared state can only exist if its v_3 - 1 is below the limit of the straight one.",
            rf"v_3 - 1 = {_K_TEX}^{{-1}} \implies {_K_TEX}^{{-1}} < {_ROOT_TEX}",
            Implies(valued, limited),
            Necessary(derived(equal(v3 - 1, 1 / kappa)), _CONDITION_2, condition_2_follows,
                      "(v_3 - 1)^2 < b for every load, by exact identities and signs"),
            note="The paper expects it; it is true, by the strain limit: v_3 - 1 < "
            "beta (beta^2 eta^2 - iota^2)^{-1/2} in every state.",
        ),
        _statement(
            "moduli-condition-2", "Second condition on the moduli.",
            rf"{_K_TEX}^{{-1}} < {_ROOT_TEX}", limited, _CONDITION_2,
            label="eq:TTin2", introduces=True,
            note="Meant together with condition 1; without it the left side is negative.",
        ),
        _statement(
            "moduli-condition-2-iff", "The second condition with powers p.",
            rf"{_K_TEX}^{{-1}} < {_ROOT_TEX} \iff {_K_TEX}^p "
            rf"\frac{{\beta^{{2p}}}}{{({_D_TEX})^p}} > \frac{{\beta^p}}{{({_D_TEX})^{{p/2}}}}",
            Iff(limited, in_powers),
            SameSign(needed=(1 / sp.sqrt(b), 1 / c), hypothesis=c),
            reading="Condition 1 holds. Without it the first inequality is true and the second "
            "need not be, or its power is undefined: p = 2, beta = eta = 1, iota = 0, zeta = 2 "
            "gives -4/3 < 1 and 9/16 < 1.",
            read_as=Implies(first, Iff(limited, in_powers)),
        ),
    )  # fmt: skip


def _threshold_and_existence() -> tuple[Statement, ...]:
    branch = OnTheBranch((domains.BRANCH,))
    power = _K**p * beta ** (2 * p) / _D**p - beta**p / _D ** (p / 2)
    dilatation = _F * _B * N * _cos
    return (
        _statement(
            "sheared-branch",
            "The sheared states are a branch that leaves the straight ones at N_thresh.",
            r"N \sin\theta\,(v_3 - v N \cos\theta) = 0, \quad "
            r"\lim_{\theta \to 0} N = N_{thresh} \ \text{along}\ \theta = \hat\theta(N)",
            Every(
                equal(N * _sin * (v[3] - scalar_v * N * _cos), 0),
                equal(LimitOf(N, theta, sp.Integer(0)), N_thresh),
            ),
            Both((Jointly((COUPLE_BALANCE, OnTheBranch((domains.BRANCH,)))),
                  OnTheBranch((domains.BRANCH_FROM_ZERO,), named=frozenset((N_thresh,))))),
            note="N increases with the angle from N_thresh to infinity, so that the branch is a "
            "continuous graph over N > N_thresh and meets theta = 0 only at N_thresh. The straight "
            "branch satisfies the equation for every N; at N = 0 it is unstressed, not tensile.",
        ),
        _statement(
            "n-thresh", "Definition of the threshold thrust.",
            rf"N_{{thresh}}^{{-p}} = {_K_TEX}^p \frac{{\beta^{{2p}}}}{{({_D_TEX})^p}} - "
            rf"\frac{{\beta^p}}{{({_D_TEX})^{{p/2}}}}",
            equal(N_thresh ** (-p), power), branch, label="eq:N0def", introduces=True,
            note="Positive exactly under conditions 1 and 2.",
        ),
        _statement(
            "sheared-existence",
            "Above the threshold exactly one angle in (0, pi/2) gives a sheared state.",
            rf"v_3 - 1 = {_F_TEX} {_B_TEX} N \cos\theta = {_K_TEX}^{{-1}}, \quad "
            r"\theta = \hat\theta(N)",
            chain(v[3] - 1, "=", dilatation, "=", 1 / _K), branch,
            note="At and below the threshold there is none: extra-threshold-sharp.",
        ),
        _statement(
            "sheared-v3-of-theta", "v_3 - 1 as a function of thrust and angle.",
            rf"v_3 - 1 = {_F_TEX} {_B_TEX} N \cos\theta",
            equal(v[3] - 1, dilatation), InAllStates(domains.PUSHED_OR_PULLED),
            label="eq:TTv3def",
        ),
    )  # fmt: skip


def _limiting(left: sp.Expr) -> ClosedAngle:
    return limiting_angle(left)


def _angles() -> tuple[Statement, ...]:
    limit = LimitOf(domains.theta_hat, N, sp.oo)
    return (
        _statement(
            "theta-limit", "Limit of the shear angle for infinite thrust.",
            rf"\lim_{{N \to \infty}} \hat\theta(N) = {_LIMIT_TEX}",
            equal(limit, sp.acos(_X / zeta)), _limiting(limit), label="eq:thetainfinity",
        ),
        _statement(
            "theta-p2", "Shear angle in closed form for p = 2.",
            rf"\hat\theta(N) = \cos^{{-1}}\Bigl\{{{_X_TEX} \Bigl(\frac{{1}}{{N^2}} + "
            r"\frac{1}{\zeta^2}\Bigr)^{1/2}\Bigr\}",
            equal(domains.theta_hat, sp.acos(_X * (1 / N**2 + _A) ** sp.Rational(1, 2))),
            angle_at_p2(),
        ),
    )  # fmt: skip


def _function_f() -> tuple[Statement, ...]:
    f = Identity(domains.ON_COSINES)
    soft = Identity(domains.SOFT_COSINES)
    first = (1 + (N**2 / zeta**2 * (1 - x**2) + _B * N**2 * x**2) ** (p / 2)) ** (-1 / p)
    slope = _G ** (-1 / p - 1) * _B
    inner = _W ** (p / 2 - 1) * (_A - _B) * x**2
    f_at_1 = fN(sp.Integer(1))
    slope_tex = (
        rf"f_N'(x) = {_G_TEX}^{{-1/p - 1}} {_B_TEX} \Bigl[1 + \Bigl({_W_TEX}\Bigr)^{{p/2 - 1}}"
        rf"\Bigl({_A_TEX} - {_B_TEX}\Bigr) x^2\Bigr] > 0"
    )
    return (
        _statement(
            "fN-equation", "The equation of the shear angle through f_N.",
            rf"f_N(\cos\theta) = {_K_TEX}^{{-1}}",
            equal(fN(_cos), 1 / _K), OnTheBranch((domains.BRANCH,)),
        ),
        _statement(
            "fN-definition", "v_3 - 1 as a function of the cosine of the angle.",
            rf"f_N(x) = \Bigl[1 + \Bigl(\frac{{N^2}}{{\zeta^2}}(1 - x^2) + {_B_TEX} N^2 x^2\Bigr)"
            rf"^{{p/2}}\Bigr]^{{-1/p}} \frac{{N\beta^2}}{{{_D_TEX}}} x",
            equal(fN(x), first * N * beta**2 / _D * x), f, introduces=True,
        ),
        _statement(
            "fN-second-form", "Second form of f_N, for N > 0.",
            rf"f_N(x) = {_G_TEX}^{{-1/p}} {_B_TEX} x",
            equal(fN(x), _G ** (-1 / p) * _B * x), f,
        ),
        _statement(
            "fN-derivative", "Derivative of f_N and its sign.", slope_tex,
            chain(Partial(fN(x), x), "=", slope * (1 + inner), ">", 0), soft,
            correction=chain(Partial(fN(x), x), "=", slope * (_G + inner), ">", 0),
            note="In place of the 1 stands the content of the first bracket, N^{-p} + (...)^{p/2}. "
            "The sign, and with it the argument, is not affected. Shorter: "
            "extra-fN-derivative-short.",
        ),
        _statement(
            "fN-bijection", "f_N is an increasing bijection of [0, 1] and [0, f_N(1)].",
            r"f_N(0) = 0, \quad f_N'(x) > 0",
            Every(equal(fN(sp.Integer(0)), 0), positive(Partial(fN(x), x))), soft,
            note="It is continuous with positive slope on the closed interval; condition 1 is not "
            "needed for that.",
        ),
        _statement(
            "fN-at-one", "Value of f_N at 1 and its limit for infinite thrust.",
            rf"f_N(1) = {_F1_TEX} \to \beta({_D_TEX})^{{-1/2}}",
            Every(
                equal(f_at_1, _F1),
                equal(LimitOf(f_at_1, N, sp.oo), beta * _D ** sp.Rational(-1, 2)),
            ),
            f,
        ),
        _statement(
            "fN-inequality", "Above the threshold the value to be taken is below f_N(1).",
            rf"0 < {_K_TEX}^{{-1}} < {_F1_TEX} = f_N(1)",
            chain(0, "<", 1 / _K, "<", _F1, "=", f_at_1),
            SharpPowers(domains.ABOVE_THRESHOLD, p, ((domains.delta, sp.Integer(0)),)),
        ),
    )  # fmt: skip


def _roots_and_limits() -> tuple[Statement, ...]:
    branch = (domains.BRANCH,)
    root_claim = equal(v[3], scalar_v * N * x_N)
    hats = (
        "The angle without a hat is the angle with a hat, also at infinity: theta(N_j) stands for "
        "hat theta(N_j), and hat theta(infinity) for the theta(infinity) just defined."
    )
    limit = LimitOf(domains.theta_of_N, N, sp.oo)
    at_infinity = Identity(domains.AT_INFINITY)

    def limiting(power: int) -> sp.Basic:
        left = _W ** sp.Rational(-1, 2) * (beta**power / _D) * x
        return chain(left, "=", LimitOf(fN(x), N, sp.oo), "=", 1 / _K)

    return (
        _statement(
            "xN-existence", "Exactly one x_N in (0, 1) has the value that is needed.",
            rf"f_N(x_N) = {_K_TEX}^{{-1}}, \quad x_N \in (0, 1)",
            equal(fN(x_N), 1 / _K), OnTheBranch(branch, named=frozenset((x_N,))),
        ),
        _statement(
            "theta-hat", "The shear angle is the arccosine of the root.",
            r"v_3 = v N x_N, \quad x_N = \cos\hat\theta(N) \in (0, 1)",
            Every(root_claim, equal(x_N, sp.cos(domains.theta_hat)), chain(0, "<", x_N, "<", 1)),
            OnTheBranch(branch, named=frozenset((x_N, scalar_v, domains.theta_hat))),
        ),
        _statement(
            "theta-infinity-definition", "Definition of the limiting angle.",
            rf"\theta(\infty) = {_LIMIT_TEX}",
            equal(domains.theta_infinity, sp.acos(_X / zeta)), _limiting(domains.theta_infinity),
            introduces=True, note="Later written with a hat.",
        ),
        _statement(
            "xNk-definition", "Cosines of the shear angles along a sequence of thrusts.",
            r"x_{N_k} = \cos\theta(N_k)",
            equal(domains.x_Nk, sp.cos(domains.theta_Nk)), InAllStates(branch), introduces=True,
            note="The angle is the one with a hat.",
        ),
        _statement(
            "limiting-equation", "Equation for the limit x of the cosines.",
            rf"\Bigl({_W_TEX}\Bigr)^{{-1/2}} \frac{{\beta}}{{{_D_TEX}}} x = \lim_{{j \to \infty}}"
            rf" f_{{N_j}}(x_{{N_j}}) = {_K_TEX}^{{-1}}",
            limiting(1), LinkByLink((Identity(domains.SOFT_COSINES), at_infinity)),
            correction=limiting(2),
            note="beta must be squared, as in f_N; the value of the limit that the proof then "
            "states is the root of the corrected equation, not of the printed one. The limit of "
            "f_N(x_N) is that of f_N(x), since the slopes of f_N are bounded uniformly in N.",
        ),
        _statement(
            "limiting-solution", "The limiting equation is solved by the cosine of the limit.",
            r"x = \cos\hat\theta(\infty)",
            equal(x, sp.cos(domains.theta_hat_infinity)), at_infinity,
            reading="x solves the limiting equation with beta^2 in place of beta (see "
            "limiting-equation), and hat theta(infinity) is the theta(infinity) just defined. The "
            "printed equation has another root unless beta = 1: for beta = 2, eta = 49/8, "
            "zeta = 5/3, iota = 1/4 the cosine is 9/10, which makes its sides 1/25 and 2/25.",
        ),
        _statement(
            "theta-subsequence-limit", "The shear angles converge along the subsequence.",
            r"\lim_{j \to \infty} \theta(N_j) = \hat\theta(\infty)",
            equal(limit, domains.theta_hat_infinity), _limiting(limit), reading=hats,
        ),
        _statement(
            "sheared-phi-constant", "On the sheared branch the azimuth is constant.",
            r"\sin\theta \neq 0,\ \sin\theta\,\varphi' = 0 \implies \varphi' = 0",
            Implies(
                Every(sp.Ne(_sin, 0), equal(_sin * Prime(phi), 0)), equal(Prime(phi), 0)
            ),
            Deduction(FLEXURE_1),
        ),
        _statement(
            "sheared-identity", "The factor of the law on the sheared branch.",
            rf"{_F_TEX} = \frac{{{_D_TEX}}}{{\beta^2}} \frac{{1}}{{N \cos\theta}}"
            rf" {_K_TEX}^{{-1}}",
            equal(_F, _D / beta**2 / (N * _cos) / _K), InAllStates(branch),
            label="eq:bifidentity",
        ),
    )  # fmt: skip


def _state(*named: sp.Symbol) -> InEquilibrium:
    return InEquilibrium((domains.BRANCH,), named=frozenset(named))


def _strains() -> tuple[Statement, ...]:
    angle = u[3] * s + psi0
    shear = 1 / _K * _D / (beta**2 * zeta**2) * sp.tan(theta)
    shear_tex = rf"{_K_TEX}^{{-1}} \frac{{{_D_TEX}}}{{\beta^2\zeta^2}} \tan\theta"
    return (
        _statement(
            "sheared-u12", "Sheared states are not bent.", "u_1 = u_2 = 0",
            equal(u[1], u[2], 0), _state(u1, u2),
        ),
        _statement(
            "sheared-u3", "Twist of sheared states.",
            rf"u_3 = {_K_TEX}^{{-1}} \frac{{-\iota}}{{\beta^2}}",
            equal(u[3], 1 / _K * -iota / beta**2), _state(u3),
            note="It does not depend on N or p.",
        ),
        _statement(
            "sheared-v1", "First shear strain of sheared states.",
            rf"v_1 = -{shear_tex} \cos(u_3 s + \psi(0))",
            equal(v[1], -shear * sp.cos(angle)), _state(v1),
        ),
        _statement(
            "sheared-v2", "Second shear strain of sheared states.",
            rf"v_2 = {shear_tex} \sin(u_3 s + \psi(0))",
            equal(v[2], shear * sp.sin(angle)), _state(v2),
        ),
        _statement(
            "sheared-v3", "Dilatation of sheared states.", rf"v_3 - 1 = {_K_TEX}^{{-1}}",
            equal(v[3] - 1, 1 / _K), _state(v3),
        ),
        _statement(
            "sheared-centerline", "The center line of sheared states is along g_3.",
            r"|\boldsymbol r'|^2 = (\boldsymbol r' \cdot \boldsymbol g_3)^2",
            equal(v[1] ** 2 + v[2] ** 2 + v[3] ** 2, tangent[3] ** 2),
            InAllStates((domains.BRANCH, domains.MIRRORED_BRANCH)),
        ),
    )  # fmt: skip


def _directors() -> tuple[Statement, ...]:
    angle = u[3] * s + psi0
    C, S = sp.cos(angle), sp.sin(angle)
    turn = r"(u_3 s + \psi(0))"

    def director(k: int, parts: tuple[sp.Expr, ...], latex: str, claim: str) -> Statement:
        names = (sp.Symbol(f"d{k}{i}", real=True) for i in (1, 2, 3))
        return _statement(
            f"sheared-d{k}", claim, rf"\boldsymbol d_{k}(s) = {latex}",
            Every(*(equal(d[k, i], part) for i, part in enumerate(parts, 1))), _state(*names),
        )  # fmt: skip

    return (
        director(
            1, (_cos * C, S, -_sin * C),
            rf"\cos\theta \cos{turn} \boldsymbol g_1 + \sin{turn} \boldsymbol g_2 - "
            rf"\sin\theta \cos{turn} \boldsymbol g_3",
            "First director of sheared states.",
        ),
        director(
            2, (-_cos * S, C, _sin * S),
            rf"-\cos\theta \sin{turn} \boldsymbol g_1 + \cos{turn} \boldsymbol g_2 + "
            rf"\sin\theta \sin{turn} \boldsymbol g_3",
            "Second director of sheared states.",
        ),
        director(
            3, (_sin, sp.Integer(0), _cos),
            r"\sin\theta \boldsymbol g_1 + \cos\theta \boldsymbol g_3",
            "Third director of sheared states.",
        ),
    )  # fmt: skip


def _extras() -> tuple[Statement, ...]:
    C = _A - _B
    slope = _G ** (-1 / p - 1) * _B * (N ** (-p) + _W ** (p / 2 - 1) * _A)
    growth = (C**p + C * _B ** (p / 2 - 1)) * N_thresh ** (p + 1) / 2
    short = r"a = \zeta^{-2},\ b = \beta^2/(\beta^2\eta^2 - \iota^2),\ c = a - b"
    return (
        _statement(
            "extra-thrust-of-angle",
            "The branch of sheared states in closed form for every p: N from the angle.",
            r"N^{-p} = (c \cos\theta)^p - (a \sin^2\theta + b \cos^2\theta)^{p/2}, \quad " + short,
            equal(N ** (-p), (C * _cos) ** p - (_A * _sin**2 + _B * _cos**2) ** (p / 2)),
            OnTheBranch((domains.BRANCH,)),
            note="Strictly monotone, so that it also proves existence, uniqueness and the limit "
            "of the angle in one line.",
        ),
        _statement(
            "extra-threshold-sharp", "Below the threshold there is no sheared state.",
            rf"0 < N < N_{{thresh}} \implies f_N(1) < {_K_TEX}^{{-1}}",
            chain(fN(sp.Integer(1)), "<", 1 / _K),
            SharpPowers(domains.BELOW_THRESHOLD, p, ((domains.delta, sp.Integer(0)),)),
            note="f_N increases to f_N(1), so that f_N(x) stays below what is needed; at "
            "N = N_thresh only x = 1 would do, which is the straight state.",
        ),
        _statement(
            "extra-near-threshold", "The angle opens like the square root of N - N_thresh.",
            r"\lim_{\theta \to 0} \frac{N - N_{thresh}}{\theta^2} = \tfrac12 (c^p + "
            r"c\, b^{p/2 - 1}) N_{thresh}^{p + 1}, \quad " + short,
            equal(LimitOf((N - N_thresh) / theta**2, theta, sp.Integer(0)), growth),
            NearThreshold(),
        ),
        _statement(
            "extra-sheared-stretch", "Stretch of sheared states; it grows with the angle.",
            r"\boldsymbol r' = \frac{1}{\cos\theta} \Bigl(1 + " + _K_TEX
            + r"^{-1}\Bigr) \boldsymbol g_3",
            Every(equal(tangent[1], 0), equal(tangent[2], 0),
                  equal(tangent[3], (1 + 1 / _K) / _cos)),
            _state(*(sp.Symbol(f"r'{i}", real=True) for i in (1, 2, 3))),
            note="The strains v_3 and u_3 stay at their values at the threshold; all further "
            "lengthening comes from shear.",
        ),
        _statement(
            "extra-fN-derivative-short",
            "The slope of f_N in a shorter form, positive without any condition on the moduli.",
            rf"f_N'(x) = {_G_TEX}^{{-1/p - 1}} {_B_TEX} \Bigl[N^{{-p}} + {_A_TEX}\Bigl({_W_TEX}"
            r"\Bigr)^{p/2 - 1}\Bigr] > 0",
            chain(Partial(fN(x), x), "=", slope, ">", 0), Identity(domains.ON_COSINES),
        ),
    )  # fmt: skip
