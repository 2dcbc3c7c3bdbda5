"""Rewrites the naive forms into forms that hold in floating point.

Each `Rule` is an exact identity between expressions, together with the definitions its right side
needs. `apply` replaces literal occurrences and refuses a rule that finds none;
`rodproof.codegen.passes.choose` says which rules a function takes. The tests hold every rule
twice: as an identity, and for its error in doubles beside that of the form it replaces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen import lower
from rodproof.codegen.kernel import (
    Assignment,
    Dyad,
    Kernel,
    KernelError,
    log_max,
    symbol,
    tiny,
)
from rodproof.codegen.primitives import WorkShare
from rodproof.derivations.symbols import (
    LOADS,
    STRAINS,
    alpha,
    beta,
    chiral_gap,
    eta,
    gamma,
    iota,
    p,
    zeta,
)
from rodproof.derivations.theory import constitutive as theory

Pair = tuple[sp.Expr, sp.Expr]

x, y = theory.x, theory.y
m1, m2, m3, n1, n2, n3 = LOADS
u1, u2, u3, v1, v2, _ = STRAINS
stretch, size, factor, share, q = map(symbol, ("stretch", "size", "factor", "share", "q"))
unscale, reach, secant = map(symbol, ("unscale", "reach", "secant"))
chirality, gap, per_gap = map(symbol, ("chirality", "gap", "per_gap"))
mu_1, mu_2, mu_3, nu_1, nu_2, nu_3 = map(symbol, ("mu_1", "mu_2", "mu_3", "nu_1", "nu_2", "nu_3"))
n3_dilates, m3_contracts = symbol("n3_dilates"), symbol("m3_contracts")
twist, dilatation = symbol("twist"), symbol("dilatation")
kappa_1, kappa_2, kappa_3 = map(symbol, ("kappa_1", "kappa_2", "kappa_3"))
lam_1, lam_2, lam_3 = map(symbol, ("lam_1", "lam_2", "lam_3"))
torque, tension = symbol("torque"), symbol("tension")

#: Constants alone, evaluated exactly and rounded once: the gap 1 - chirality^2 cancels otherwise.
CHIRAL_CONSTANTS = (
    Assignment("chirality", iota / (beta * eta)),
    Assignment("gap", chiral_gap / (beta * eta) ** 2),
    Assignment("per_gap", (beta * eta) ** 2 / chiral_gap),
    Assignment("n3_dilates", eta * beta**2 / chiral_gap),
    Assignment("m3_contracts", eta * iota / chiral_gap),
)


@dataclass(frozen=True)
class Rule:
    """An exact identity ``before = after`` for each pair, given the definitions.

    ``why`` says what goes wrong with ``before`` in floating point.
    """

    name: str
    pairs: tuple[Pair, ...]
    definitions: tuple[Assignment, ...]
    why: str
    constants: tuple[Assignment, ...] = ()
    dyad: Dyad | None = None


def apply(rule: Rule, kernel: Kernel) -> Kernel:
    """The kernel with the rule's left sides replaced; `KernelError` if one does not occur."""
    for before, _after in rule.pairs:
        if not any(expr.has(before) for expr in kernel.expressions()):
            raise KernelError(f"kernel {kernel.name}: rule {rule.name!r} finds no {before}")
    changed = kernel.rewrite(dict(rule.pairs))
    known = {a.name for a in changed.body}
    added = tuple(a for a in rule.definitions if a.name not in known)
    fixed = {a.name for a in kernel.constants}
    constants = tuple(a for a in rule.constants if a.name not in fixed)
    return replace(
        changed,
        body=(*added, *changed.body),
        constants=(*kernel.constants, *constants),
        dyad=rule.dyad or kernel.dyad,
    )


COMPLETE_DUAL_FORM = Rule(
    "complete the square of Q*",
    (
        (
            theory.dual_form(),
            mu_1**2 + mu_2**2 + mu_3**2 + nu_1**2 + nu_2**2 + gap * dilatation**2,
        ),
    ),
    (
        Assignment("mu_1", m1 / alpha, (), "reduce_loads"),
        Assignment("mu_2", m2 / alpha, (), "reduce_loads"),
        Assignment("mu_3", m3 / beta, (), "reduce_loads"),
        Assignment("nu_1", n1 / zeta, (), "reduce_loads"),
        Assignment("nu_2", n2 / zeta, (), "reduce_loads"),
        Assignment("nu_3", n3 / eta, (), "reduce_loads"),
        Assignment("dilatation", n3_dilates * n3 - m3_contracts * m3, (), "reduce_loads"),
        Assignment("twist", mu_3 - chirality * dilatation, (), "reduce_loads"),
    ),
    "near iota = beta eta the three coupled terms are large and cancel; Q* may even be negative",
    CHIRAL_CONSTANTS,
)

e = tuple(symbol(f"e{i}") for i in range(1, 7))  # K^{-1} sigma, as lowered
s = tuple(symbol(f"s{i}") for i in range(1, 7))  # K eps, as lowered
d = tuple(symbol(f"d{i}") for i in range(1, 7))  # K^{-1} sigma/y
t = tuple(symbol(f"t{i}") for i in range(1, 7))  # K eps/x
moduli = (alpha, alpha, beta, zeta, zeta, eta)
bend, turn, shear, extend = map(symbol, ("bend", "turn", "shear", "extend"))
answers = (bend, bend, turn, shear, shear, extend)

REDUCE_STRAINS = Rule(
    "strains from reduced loads",
    tuple(
        (factor * row, answer * reduced)
        for row, answer, reduced in zip(
            e, answers, (mu_1, mu_2, twist, nu_1, nu_2, dilatation), strict=True
        )
    ),
    (
        Assignment("reach", factor * unscale),
        *(
            Assignment(answer.name, reach / modulus)
            for answer, modulus in dict(zip(answers, moduli, strict=True)).items()
        ),
    ),
    "products such as eta^2 m3 leave the range of numbers before the quotient comes back",
    CHIRAL_CONSTANTS,
)

COMPLETE_FORM = Rule(
    "complete the square of Q",
    (
        (
            lower.from_rest(theory.quadratic_form()),
            kappa_1**2 + kappa_2**2 + torque**2 + lam_1**2 + lam_2**2 + gap * lam_3**2,
        ),
    ),
    (
        Assignment("kappa_1", alpha * u1, (), "reduce_strains"),
        Assignment("kappa_2", alpha * u2, (), "reduce_strains"),
        Assignment("kappa_3", beta * u3, (), "reduce_strains"),
        Assignment("lam_1", zeta * v1, (), "reduce_strains"),
        Assignment("lam_2", zeta * v2, (), "reduce_strains"),
        Assignment("lam_3", eta * stretch, (), "reduce_strains"),
        Assignment("torque", kappa_3 + chirality * lam_3, (), "reduce_strains"),
    ),
    "near iota = beta eta the three coupled terms cancel; Q may even be negative",
    CHIRAL_CONSTANTS,
)

TENSION = Assignment("tension", chirality * torque + gap * lam_3, (), "reduce_strains")

REDUCE_LOADS = Rule(
    "loads from reduced strains",
    tuple(
        (factor * row, answer * reduced)
        for row, answer, reduced in zip(
            s, answers, (kappa_1, kappa_2, torque, lam_1, lam_2, tension), strict=True
        )
    ),
    (
        TENSION,
        Assignment("secant", factor * unscale),
        *(
            Assignment(answer.name, secant * modulus)
            for answer, modulus in dict(zip(answers, moduli, strict=True)).items()
        ),
    ),
    "beta^2 u3 + iota (v3 - 1) forms squares of constants that may leave the range of numbers",
    CHIRAL_CONSTANTS,
)

ratio, power = symbol("ratio"), symbol("power")
growth, depth = symbol("growth"), symbol("depth")

SOFTEN_DEFINITIONS = (
    Assignment("ratio", sp.Max(sp.Min(y, gamma) / sp.Max(y, gamma), tiny), (), "soften"),
    Assignment("power", sp.exp(p * sp.log(ratio)), (), "soften"),
)

SCALE_RADIAL_FACTOR = Rule(
    "take the larger of gamma and y out of the radial factor",
    ((lower.strain_factor(), sp.exp(-log1p(power) / p) / sp.Max(y, gamma)),),
    SOFTEN_DEFINITIONS,
    "gamma^p and y^p overflow or underflow: y = 1e10, p = 40 answers 0 instead of 1/y",
)

SPLIT_STRAIN_WEIGHT = Rule(
    "strain weight by the same power",
    (
        (
            lower.strain_weight(),
            sp.Piecewise((power, y <= gamma), (1, True), evaluate=False) / (1 + power),
        ),
    ),
    SOFTEN_DEFINITIONS,
    "gamma^p and y^p overflow or underflow",
)

#: What the weight leaves, gamma^p/(gamma^p + y^p) = 1 - x^p: the distance to the strain limit.
REMAIN = Assignment(
    "remain", sp.Piecewise((1, y <= gamma), (power, True), evaluate=False) / (1 + power)
)

STIFFEN_DEFINITIONS = (
    Assignment(
        "growth",
        1 / expm1(sp.Min(-p / 2 * sp.log(sp.Max(q, tiny)), log_max)),
        (),
        "stiffen",
    ),
    Assignment("depth", log1p(growth), (), "stiffen"),
)

GROW_LOAD_FACTOR = Rule(
    "load factor by the growth x^p/(1 - x^p)",
    ((lower.load_factor(), gamma * sp.exp(depth / p)),),
    STIFFEN_DEFINITIONS,
    "1 - x^p cancels near the limit: Q = 1 - 1e-8, p = 0.7 loses half the digits",
)

GROW_LOAD_WEIGHT = Rule(
    "load weight is the growth",
    ((lower.load_weight(), growth),),
    STIFFEN_DEFINITIONS,
    "1 - x^p cancels near the limit",
)

FLOOR_STRAIN_RADIUS = Rule(
    "floor under the strain radius",
    ((sp.sqrt(q), sp.sqrt(sp.Max(q, tiny))),),
    (),
    "at rest the direction K eps/x is 0/0; there its weight is zero and any finite value serves",
)

strain, load = symbol("strain"), symbol("load")

SHARE_COMPLEMENTARY_ENERGY = Rule(
    "complementary energy as its share of the work",
    ((theory.complementary_energy(), strain * y * (1 - WorkShare(depth, p))),),
    (
        *SOFTEN_DEFINITIONS,
        Assignment("factor", sp.exp(-log1p(power) / p) / sp.Max(y, gamma), (), "soften"),
        Assignment("strain", y * factor),
        Assignment(
            "depth",
            log1p(power) - p * sp.Piecewise((0, y <= gamma), (sp.log(ratio), True), evaluate=False),
        ),
    ),
    "the integral has no elementary form; its hypergeometric form fails in SciPy near p = 1",
)

SHARE_STORED_ENERGY = Rule(
    "stored energy as its share of the work",
    ((theory.stored_energy(), load * x * WorkShare(depth, p)),),
    (
        *STIFFEN_DEFINITIONS,
        Assignment("factor", gamma * sp.exp(depth / p), (), "stiffen"),
        Assignment("load", factor * x),
    ),
    "the integral has no elementary form; closed forms at p = 1, 2 cancel at small strain",
)

a1, a2, a3, b1, b2, b3 = map(symbol, ("a1", "a2", "a3", "b1", "b2", "b3"))
c3, c6 = symbol("c3"), symbol("c6")
across, coupled, remain = symbol("across"), symbol("coupled"), symbol("remain")


def _complements(*, coupling: bool) -> tuple[Pair, ...]:
    """The diagonal and the coupled entry of K^{-1} - share d d^T without a difference.

    In coordinates that make the reduced load a unit vector k the bracket is I - share k k^T; by
    Lagrange's identity its entries are sums of the other components' squares, plus 1 - share
    times the component's own.
    """
    rest = theory.compliance_at_rest()

    def before(i: int, j: int) -> sp.Expr:
        return rest[i, j] - share * d[i] * d[j]

    squares = (a1**2, a2**2, b1**2, b2**2)
    plain = tuple(
        (
            before(i, i),
            per * (sp.Add(*(s for s in squares if s != own)) + coupled + remain * own) * per,
        )
        for i, own, per in zip(
            (0, 1, 3, 4), squares, (1 / alpha, 1 / alpha, 1 / zeta, 1 / zeta), strict=True
        )
    )
    twisting = ((across + b3**2) * per_gap + remain * c3**2) / beta**2
    stretching = ((across + a3**2) * per_gap + remain * c6**2) / eta**2
    if coupling:
        mixed = (remain * c3 * c6 - (chirality * across + a3 * b3) * per_gap) / (beta * eta)
    else:  # iota = 0, and K^{-1} has no entry there to cancel
        mixed = -share * d[2] * d[5]
    return (
        *plain,
        (before(2, 2), twisting),
        (before(5, 5), stretching),
        (before(2, 5), mixed),
    )


#: Without a load any direction serves. A floor under the reduced loads makes it that of the first
#: live load: of m3 or n3 with what the coupling makes of it.
FLOORS: dict[int, dict[str, sp.Expr]] = {
    0: {"a1": tiny},
    1: {"a2": tiny},
    2: {"a3": tiny, "b3": chirality * tiny, "c3": tiny},
    3: {"b1": tiny},
    4: {"b2": tiny},
    5: {
        "b3": gap * sp.sqrt(per_gap) * tiny,
        "c3": -chirality * sp.sqrt(per_gap) * tiny,
        "c6": sp.sqrt(per_gap) * tiny,
    },
}


def complement_compliance(
    soften: tuple[Assignment, ...], first: int = 0, *, coupling: bool = True
) -> Rule:
    """The entries of the compliance that would cancel; ``first`` is the first live load."""
    return Rule(
        "complements as sums of squares",
        _complements(coupling=coupling),
        (
            *soften,
            REMAIN,
            Assignment("per_size", 1 / size),
            *(
                Assignment(name, symbol("per_size") * (reduced + FLOORS[first].get(name, 0)))
                for name, reduced in zip(
                    ("a1", "a2", "a3", "b1", "b2", "b3", "c3", "c6"),
                    (mu_1, mu_2, mu_3, nu_1, nu_2, nu_3, twist, dilatation),
                    strict=True,
                )
            ),
            Assignment("across", a1**2 + a2**2 + b1**2 + b2**2),
            Assignment("coupled", a3**2 + gap * c6**2),
        ),
        "at large loads K^{-1} and the rank-one term cancel along the load: 7e3 ulps near D = 0",
        CHIRAL_CONSTANTS,
    )


directions = (a1, a2, c3, b1, b2, c6)

DIRECT_COMPLIANCE = Rule(
    "strain direction from the reduced loads",
    tuple((row / y, k / modulus) for row, k, modulus in zip(e, directions, moduli, strict=True)),
    (),  # those of the complements
    "K^{-1} sigma and y leave the range of numbers where their quotient does not",
    CHIRAL_CONSTANTS,
)


def _direct_stiffness(root: sp.Symbol, least: sp.Expr = sp.S.Zero) -> Rule:
    """K eps/x by the root of Q, or by that of the scaled Q with strains of the same scale.

    Where the root may be nought, ``least`` is small beside every other, and so large that its
    inverse times a modulus is a number.
    """
    per = symbol(f"per_{root}")
    reduced = (kappa_1, kappa_2, torque, lam_1, lam_2, tension)
    scaled = dict(zip(answers, moduli, strict=True))
    return Rule(
        f"load direction from the reduced strains, by {root}",
        tuple(
            (row / x, symbol(f"{answer}_{per}") * strain)
            for row, answer, strain in zip(s, answers, reduced, strict=True)
        ),
        (
            TENSION,
            Assignment(per.name, 1 / (sp.Max(root, least) if least else root)),
            *(Assignment(f"{answer}_{per}", modulus * per) for answer, modulus in scaled.items()),
        ),
        "beta^2 u3 + iota (v3 - 1) forms squares of constants that may leave the range of numbers",
        CHIRAL_CONSTANTS,
    )


DIRECT_STIFFNESS = _direct_stiffness(sp.Symbol("x", positive=True))
DIRECT_SCALED_STIFFNESS = _direct_stiffness(size, sp.sqrt(tiny))


def _rank_one(
    name: str, sign: int, dyad: Dyad, own: tuple[tuple[int, int], ...], *, coupling: bool = True
) -> Rule:
    """The rank-one term with its factor and weight in one name; ``own`` entries keep K's part."""
    along = tuple(map(symbol, dyad.vector))
    rest = theory.stiffness_at_rest()
    upper = ((i, j) for i in range(6) for j in range(i + 1, 6))
    off = (entry for entry in upper if not coupling or entry != (2, 5))
    pairs = tuple((sign * factor * share * along[i] * along[j], dyad.term(i, j)) for i, j in off)
    kept = tuple(
        (
            factor * (rest[i, j] + share * along[i] * along[j]),
            factor * rest[i, j] + dyad.term(i, j),
        )
        for i, j in own
    )
    definitions = (Assignment(dyad.weight, sign * factor * share),)
    why = "each entry would take two more products"
    return Rule(name, pairs + kept, definitions, why, (), dyad)


SOFT = Dyad("soft", "steep", tuple(s.name for s in d))
RANK_ONE_COMPLIANCE = _rank_one("rank-one term of the compliance", -1, SOFT, ())
RANK_ONE_ACHIRAL = _rank_one("rank-one term without coupling", -1, SOFT, (), coupling=False)
RANK_ONE_STIFFNESS = _rank_one(
    "rank-one term of the stiffness",
    1,
    Dyad("stiff", "steep", tuple(s.name for s in t)),
    (*((i, i) for i in range(6)), (2, 5)),
)
