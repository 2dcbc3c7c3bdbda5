"""Section 4.2 on the branch of sheared states: its angle, roots, limits, strains and directors."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.routes import states
from rodproof.derivations.checks.thrust import domains, points
from rodproof.derivations.checks.thrust.branch import (
    NearThreshold,
    OnTheBranch,
    SharpPowers,
    angle_at_p2,
    limiting_angle,
)  # fmt: skip
from rodproof.derivations.checks.thrust.equations import (
    FLEXURE_1,
    Deduction,
    LinkByLink,
)
from rodproof.derivations.checks.thrust.points import N_thresh, d, fN, psi0, scalar_v, tangent, x_N
from rodproof.derivations.checks.thrust.states import (  # fmt: skip
    InAllStates,
    InEquilibrium,
)
from rodproof.derivations.notation import (
    Every,
    Implies,
    LimitOf,
    Partial,
    Prime,
    chain,
    equal,
    positive,
    u,
    v,
)  # fmt: skip
from rodproof.derivations.printed import section_4_2_terms as terms
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import beta, iota, p, u1, u2, u3, v1, v2, v3, zeta
from rodproof.derivations.theory.frames import phi, theta
from rodproof.derivations.theory.thrust import N, s, x


def statements() -> tuple[Statement, ...]:
    """The statements about the branch, in the order of the paper, and more about it."""
    return (
        *_angles(),
        *_function_f(),
        *_roots_and_limits(),
        *_strains(),
        *_directors(),
        *_extras(),
    )


def _angles() -> tuple[Statement, ...]:
    limit = LimitOf(points.theta_hat, N, sp.oo)
    return (
        terms.statement(
            "theta-limit", "Limit of the shear angle for infinite thrust.",
            rf"\lim_{{N \to \infty}} \hat\theta(N) = {terms.LIMIT_TEX}",
            equal(limit, sp.acos(terms.X / zeta)), limiting_angle(limit), label="eq:thetainfinity",
        ),
        terms.statement(
            "theta-p2", "Shear angle in closed form for p = 2.",
            rf"\hat\theta(N) = \cos^{{-1}}\Bigl\{{{terms.X_TEX} \Bigl(\frac{{1}}{{N^2}} + "
            r"\frac{1}{\zeta^2}\Bigr)^{1/2}\Bigr\}",
            equal(points.theta_hat, sp.acos(terms.X * (1 / N**2 + terms.A) ** sp.Rational(1, 2))),
            angle_at_p2(),
        ),
    )  # fmt: skip


def _function_f() -> tuple[Statement, ...]:
    f = Identity(domains.ON_COSINES)
    soft = Identity(domains.SOFT_COSINES)
    first = (1 + (N**2 / zeta**2 * (1 - x**2) + terms.B * N**2 * x**2) ** (p / 2)) ** (-1 / p)
    slope = terms.G ** (-1 / p - 1) * terms.B
    inner = terms.W ** (p / 2 - 1) * (terms.A - terms.B) * x**2
    f_at_1 = fN(sp.Integer(1))
    slope_tex = (
        rf"f_N'(x) = {terms.G_TEX}^{{-1/p - 1}} {terms.B_TEX} "
        rf"\Bigl[1 + \Bigl({terms.W_TEX}\Bigr)^{{p/2 - 1}}"
        rf"\Bigl({terms.A_TEX} - {terms.B_TEX}\Bigr) x^2\Bigr] > 0"
    )
    return (
        terms.statement(
            "fN-equation", "The equation of the shear angle through f_N.",
            rf"f_N(\cos\theta) = {terms.K_TEX}^{{-1}}",
            equal(fN(terms.cosine), 1 / terms.K), OnTheBranch((domains.BRANCH,)),
        ),
        terms.statement(
            "fN-definition", "v_3 - 1 as a function of the cosine of the angle.",
            r"f_N(x) = \Bigl[1 + \Bigl(\frac{N^2}{\zeta^2}(1 - x^2) + "
            rf"{terms.B_TEX} N^2 x^2\Bigr)"
            rf"^{{p/2}}\Bigr]^{{-1/p}} \frac{{N\beta^2}}{{{terms.D_TEX}}} x",
            equal(fN(x), first * N * beta**2 / terms.D * x), f, introduces=True,
        ),
        terms.statement(
            "fN-second-form", "Second form of f_N, for N > 0.",
            rf"f_N(x) = {terms.G_TEX}^{{-1/p}} {terms.B_TEX} x",
            equal(fN(x), terms.G ** (-1 / p) * terms.B * x), f,
        ),
        terms.statement(
            "fN-derivative", "Derivative of f_N and its sign.", slope_tex,
            chain(Partial(fN(x), x), "=", slope * (1 + inner), ">", 0), soft,
            correction=chain(Partial(fN(x), x), "=", slope * (terms.G + inner), ">", 0),
            note="In place of the 1 stands the content of the first bracket, N^{-p} + (...)^{p/2}. "
            "The sign, and with it the argument, is not affected. Shorter: "
            "extra-fN-derivative-short.",
        ),
        terms.statement(
            "fN-bijection", "f_N is an increasing bijection of [0, 1] and [0, f_N(1)].",
            r"f_N(0) = 0, \quad f_N'(x) > 0",
            Every(equal(fN(sp.Integer(0)), 0), positive(Partial(fN(x), x))), soft,
            note="It is continuous with positive slope on the closed interval; condition 1 is not "
            "needed for that.",
        ),
        terms.statement(
            "fN-at-one", "Value of f_N at 1 and its limit for infinite thrust.",
            rf"f_N(1) = {terms.F1_TEX} \to \beta({terms.D_TEX})^{{-1/2}}",
            Every(
                equal(f_at_1, terms.F1),
                equal(LimitOf(f_at_1, N, sp.oo), beta * terms.D ** sp.Rational(-1, 2)),
            ),
            f,
        ),
        terms.statement(
            "fN-inequality", "Above the threshold the value to be taken is below f_N(1).",
            rf"0 < {terms.K_TEX}^{{-1}} < {terms.F1_TEX} = f_N(1)",
            chain(0, "<", 1 / terms.K, "<", terms.F1, "=", f_at_1),
            SharpPowers(domains.ABOVE_THRESHOLD, p, ((points.delta, sp.Integer(0)),)),
        ),
    )  # fmt: skip


def _roots_and_limits() -> tuple[Statement, ...]:
    branch = (domains.BRANCH,)
    root_claim = equal(v[3], scalar_v * N * x_N)
    hats = (
        "The angle without a hat is the angle with a hat, also at infinity: theta(N_j) stands for "
        "hat theta(N_j), and hat theta(infinity) for the theta(infinity) just defined."
    )
    limit = LimitOf(points.theta_of_N, N, sp.oo)
    at_infinity = Identity(domains.AT_INFINITY)

    def limiting(power: int) -> sp.Basic:
        left = terms.W ** sp.Rational(-1, 2) * (beta**power / terms.D) * x
        return chain(left, "=", LimitOf(fN(x), N, sp.oo), "=", 1 / terms.K)

    return (
        terms.statement(
            "xN-existence", "Exactly one x_N in (0, 1) has the value that is needed.",
            rf"f_N(x_N) = {terms.K_TEX}^{{-1}}, \quad x_N \in (0, 1)",
            equal(fN(x_N), 1 / terms.K), OnTheBranch(branch, named=frozenset((x_N,))),
        ),
        terms.statement(
            "theta-hat", "The shear angle is the arccosine of the root.",
            r"v_3 = v N x_N, \quad x_N = \cos\hat\theta(N) \in (0, 1)",
            Every(root_claim, equal(x_N, sp.cos(points.theta_hat)), chain(0, "<", x_N, "<", 1)),
            OnTheBranch(branch, named=frozenset((x_N, scalar_v, points.theta_hat))),
        ),
        terms.statement(
            "theta-infinity-definition", "Definition of the limiting angle.",
            rf"\theta(\infty) = {terms.LIMIT_TEX}",
            equal(points.theta_infinity, sp.acos(terms.X / zeta)),
            limiting_angle(points.theta_infinity), introduces=True,
            note="Later written with a hat.",
        ),
        terms.statement(
            "xNk-definition", "Cosines of the shear angles along a sequence of thrusts.",
            r"x_{N_k} = \cos\theta(N_k)",
            equal(points.x_Nk, sp.cos(points.theta_Nk)), InAllStates(branch), introduces=True,
            note="The angle is the one with a hat.",
        ),
        terms.statement(
            "limiting-equation", "Equation for the limit x of the cosines.",
            rf"\Bigl({terms.W_TEX}\Bigr)^{{-1/2}} \frac{{\beta}}{{{terms.D_TEX}}} x = "
            r"\lim_{j \to \infty}"
            rf" f_{{N_j}}(x_{{N_j}}) = {terms.K_TEX}^{{-1}}",
            limiting(1), LinkByLink((Identity(domains.SOFT_COSINES), at_infinity)),
            correction=limiting(2),
            note="beta must be squared, as in f_N; the value of the limit that the proof then "
            "states is the root of the corrected equation, not of the printed one. The limit of "
            "f_N(x_N) is that of f_N(x), since the slopes of f_N are bounded uniformly in N.",
        ),
        terms.statement(
            "limiting-solution", "The limiting equation is solved by the cosine of the limit.",
            r"x = \cos\hat\theta(\infty)",
            equal(x, sp.cos(points.theta_hat_infinity)), at_infinity,
            reading="x solves the limiting equation with beta^2 in place of beta (see "
            "limiting-equation), and hat theta(infinity) is the theta(infinity) just defined. The "
            "printed equation has another root unless beta = 1: for beta = 2, eta = 49/8, "
            "zeta = 5/3, iota = 1/4 the cosine is 9/10, which makes its sides 1/25 and 2/25.",
        ),
        terms.statement(
            "theta-subsequence-limit", "The shear angles converge along the subsequence.",
            r"\lim_{j \to \infty} \theta(N_j) = \hat\theta(\infty)",
            equal(limit, points.theta_hat_infinity), limiting_angle(limit), reading=hats,
        ),
        terms.statement(
            "sheared-phi-constant", "On the sheared branch the azimuth is constant.",
            r"\sin\theta \neq 0,\ \sin\theta\,\varphi' = 0 \implies \varphi' = 0",
            Implies(
                Every(sp.Ne(terms.sine, 0), equal(terms.sine * Prime(phi), 0)), equal(Prime(phi), 0)
            ),
            Routed(Deduction(FLEXURE_1), states.AZIMUTH),
        ),
        terms.statement(
            "sheared-identity", "The factor of the law on the sheared branch.",
            rf"{terms.F_TEX} = \frac{{{terms.D_TEX}}}{{\beta^2}} \frac{{1}}{{N \cos\theta}}"
            rf" {terms.K_TEX}^{{-1}}",
            equal(terms.F, terms.D / beta**2 / (N * terms.cosine) / terms.K), InAllStates(branch),
            label="eq:bifidentity",
        ),
    )  # fmt: skip


def _state(*named: sp.Symbol) -> InEquilibrium:
    return InEquilibrium((domains.BRANCH,), named=frozenset(named))


def _strains() -> tuple[Statement, ...]:
    angle = u[3] * s + psi0
    shear = 1 / terms.K * terms.D / (beta**2 * zeta**2) * sp.tan(theta)
    shear_tex = rf"{terms.K_TEX}^{{-1}} \frac{{{terms.D_TEX}}}{{\beta^2\zeta^2}} \tan\theta"
    return (
        terms.statement(
            "sheared-u12", "Sheared states are not bent.", "u_1 = u_2 = 0",
            equal(u[1], u[2], 0), _state(u1, u2),
        ),
        terms.statement(
            "sheared-u3", "Twist of sheared states.",
            rf"u_3 = {terms.K_TEX}^{{-1}} \frac{{-\iota}}{{\beta^2}}",
            equal(u[3], 1 / terms.K * -iota / beta**2), _state(u3),
            note="It does not depend on N or p.",
        ),
        terms.statement(
            "sheared-v1", "First shear strain of sheared states.",
            rf"v_1 = -{shear_tex} \cos(u_3 s + \psi(0))",
            equal(v[1], -shear * sp.cos(angle)), _state(v1),
        ),
        terms.statement(
            "sheared-v2", "Second shear strain of sheared states.",
            rf"v_2 = {shear_tex} \sin(u_3 s + \psi(0))",
            equal(v[2], shear * sp.sin(angle)), _state(v2),
        ),
        terms.statement(
            "sheared-v3", "Dilatation of sheared states.", rf"v_3 - 1 = {terms.K_TEX}^{{-1}}",
            equal(v[3] - 1, 1 / terms.K), _state(v3),
        ),
        terms.statement(
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
        return terms.statement(
            f"sheared-d{k}", claim, rf"\boldsymbol d_{k}(s) = {latex}",
            Every(*(equal(d[k, i], part) for i, part in enumerate(parts, 1))), _state(*names),
        )  # fmt: skip

    return (
        director(
            1, (terms.cosine * C, S, -terms.sine * C),
            rf"\cos\theta \cos{turn} \boldsymbol g_1 + \sin{turn} \boldsymbol g_2 - "
            rf"\sin\theta \cos{turn} \boldsymbol g_3",
            "First director of sheared states.",
        ),
        director(
            2, (-terms.cosine * S, C, terms.sine * S),
            rf"-\cos\theta \sin{turn} \boldsymbol g_1 + \cos{turn} \boldsymbol g_2 + "
            rf"\sin\theta \sin{turn} \boldsymbol g_3",
            "Second director of sheared states.",
        ),
        director(
            3, (terms.sine, sp.Integer(0), terms.cosine),
            r"\sin\theta \boldsymbol g_1 + \cos\theta \boldsymbol g_3",
            "Third director of sheared states.",
        ),
    )  # fmt: skip


def _extras() -> tuple[Statement, ...]:
    C = terms.A - terms.B
    slope = terms.G ** (-1 / p - 1) * terms.B * (N ** (-p) + terms.W ** (p / 2 - 1) * terms.A)
    growth = (C**p + C * terms.B ** (p / 2 - 1)) * N_thresh ** (p + 1) / 2
    short = r"a = \zeta^{-2},\ b = \beta^2/(\beta^2\eta^2 - \iota^2),\ c = a - b"
    return (
        terms.statement(
            "extra-thrust-of-angle",
            "The branch of sheared states in closed form for every p: N from the angle.",
            r"N^{-p} = (c \cos\theta)^p - (a \sin^2\theta + b \cos^2\theta)^{p/2}, \quad " + short,
            equal(
                N ** (-p),
                (C * terms.cosine) ** p
                - (terms.A * terms.sine**2 + terms.B * terms.cosine**2) ** (p / 2),
            ),
            OnTheBranch((domains.BRANCH,)),
            note="Strictly monotone, so that it also proves existence, uniqueness and the limit "
            "of the angle in one line.",
        ),
        terms.statement(
            "extra-threshold-sharp", "Below the threshold there is no sheared state.",
            rf"0 < N < N_{{thresh}} \implies f_N(1) < {terms.K_TEX}^{{-1}}",
            chain(fN(sp.Integer(1)), "<", 1 / terms.K),
            SharpPowers(domains.BELOW_THRESHOLD, p, ((points.delta, sp.Integer(0)),)),
            note="f_N increases to f_N(1), so that f_N(x) stays below what is needed; at "
            "N = N_thresh only x = 1 would do, which is the straight state.",
        ),
        terms.statement(
            "extra-near-threshold", "The angle opens like the square root of N - N_thresh.",
            r"\lim_{\theta \to 0} \frac{N - N_{thresh}}{\theta^2} = \tfrac12 (c^p + "
            r"c\, b^{p/2 - 1}) N_{thresh}^{p + 1}, \quad " + short,
            equal(LimitOf((N - N_thresh) / theta**2, theta, sp.Integer(0)), growth),
            NearThreshold(),
        ),
        terms.statement(
            "extra-sheared-stretch", "Stretch of sheared states; it grows with the angle.",
            r"\boldsymbol r' = \frac{1}{\cos\theta} \Bigl(1 + " + terms.K_TEX
            + r"^{-1}\Bigr) \boldsymbol g_3",
            Every(equal(tangent[1], 0), equal(tangent[2], 0),
                  equal(tangent[3], (1 + 1 / terms.K) / terms.cosine)),
            _state(*(sp.Symbol(f"r'{i}", real=True) for i in (1, 2, 3))),
            note="The strains v_3 and u_3 stay at their values at the threshold; all further "
            "lengthening comes from shear.",
        ),
        terms.statement(
            "extra-fN-derivative-short",
            "The slope of f_N in a shorter form, positive without any condition on the moduli.",
            rf"f_N'(x) = {terms.G_TEX}^{{-1/p - 1}} {terms.B_TEX} "
            rf"\Bigl[N^{{-p}} + {terms.A_TEX}\Bigl({terms.W_TEX}"
            r"\Bigr)^{p/2 - 1}\Bigr] > 0",
            chain(Partial(fN(x), x), "=", slope, ">", 0), Identity(domains.ON_COSINES),
        ),
    )  # fmt: skip
