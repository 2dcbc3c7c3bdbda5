"""The functions in few operations, for points where nothing is extreme.

One rule a function takes the derivation's kernel to its plain one: the squares of the components
with their weights, the load radius in units of gamma, every product of constants formed once. It
is an identity as the rules of `rodproof.codegen.passes.stabilise` are, and as accurate inside its
`Region`; outside squares and powers may leave the range of numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen import lower
from rodproof.codegen.kernel import Assignment, Dyad, Kernel, Region, span, symbol
from rodproof.codegen.passes.stabilise import Pair, Rule, apply, e, factor, s, share, stretch, t
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

m1, m2, m3, n1, n2, n3 = LOADS
u1, u2, u3, v1, v2, _ = STRAINS
overload, excess, root, q = map(symbol, ("overload", "excess", "root", "q"))
bend, turn, shear = map(symbol, ("bend", "turn", "shear"))
extension, growth = symbol("extension"), symbol("growth")
torque, hard = symbol("torque"), symbol("hard")
r1, r2, r4, r5, r6 = map(symbol, ("r1", "r2", "r4", "r5", "r6"))
r = (r1, r2, torque, r4, r5, r6)  # K eps, the linear rod's loads over gamma
h = tuple(symbol(f"h{i}") for i in range(1, 7))  # the loads over gamma


@dataclass(frozen=True)
class Plain:
    """A rule that makes the whole function plain, and the region where that holds."""

    rule: Rule
    region: Region


# --- functions of loads ----------------------------------------------------------------------

#: Weights of the squares in Q*/gamma^2, and the compliances of the linear rod. The extension of
#: the linear rod carries the coupling: Q* is a sum of squares in it and the other loads.
LOAD_CONSTANTS = (
    Assignment("bend_load", 1 / (alpha * gamma) ** 2),
    Assignment("turn_load", 1 / (beta * gamma) ** 2),
    Assignment("shear_load", 1 / (zeta * gamma) ** 2),
    Assignment("slack", chiral_gap / beta**2),
    Assignment("n3_extends", beta**2 / (chiral_gap * gamma)),
    Assignment("m3_extends", iota / (chiral_gap * gamma)),
    Assignment("bend_soft", 1 / (alpha**2 * gamma)),
    Assignment("turn_soft", 1 / (beta**2 * gamma)),
    Assignment("shear_soft", 1 / (zeta**2 * gamma)),
    Assignment("untwist", iota / beta**2),
    Assignment("per_gamma", 1 / gamma),
)

OVERLOAD = (
    Assignment("extension", symbol("n3_extends") * n3 - symbol("m3_extends") * m3),
    Assignment(
        "overload",
        symbol("bend_load") * (m1**2 + m2**2)
        + symbol("shear_load") * (n1**2 + n2**2)
        + symbol("turn_load") * m3**2
        + symbol("slack") * extension**2,
        ("qstar-form",),
    ),
)
EXCESS = Assignment("excess", sp.exp(p / 2 * sp.log(overload)))
ROOT = Assignment("root", sp.exp(-log1p(excess) / p))
ROOT_SQUARE = Assignment("root", 1 / sp.sqrt(1 + overload))

#: log(y/gamma) multiplies its own rounding: y up to 32 gamma; and the power stays below span.
MOST = 2 * sp.log(span) / p
BELOW_POWERS = Region("overload", 1 / span, sp.exp(sp.Min(sp.log(1024), MOST)))
BELOW_SQUARES = Region("overload", 1 / span, span)

WHY = "twice as many operations where nothing is extreme"


def _strain_pairs() -> tuple[Pair, ...]:
    twisting = root * (symbol("turn_soft") * m3 - symbol("untwist") * extension)
    plain = (bend * m1, bend * m2, twisting, shear * n1, shear * n2, root * extension)
    return tuple((factor * row, new) for row, new in zip(e, plain, strict=True))


def _strains(square: bool) -> Plain:
    radial = (ROOT_SQUARE,) if square else (EXCESS, ROOT)
    soft = (
        Assignment("bend", symbol("bend_soft") * root),
        Assignment("shear", symbol("shear_soft") * root),
    )
    rule = Rule("strains", _strain_pairs(), (*OVERLOAD, *radial, *soft), WHY, LOAD_CONSTANTS)
    return Plain(rule, BELOW_SQUARES if square else BELOW_POWERS)


def _strains_and_gap(square: bool) -> Plain:
    plain = _strains(square)
    gap = (lower.limit_gap(), 1 / (1 + (overload if square else excess)))
    return replace(plain, rule=replace(plain.rule, pairs=(*plain.rule.pairs, gap)))


def _stiffness_at_loads(square: bool) -> Plain:
    """factor (K + excess (m, n) (m, n)^T/y^2), as (y/gamma)^p is the weight of the direction."""
    radial = gamma * (sp.sqrt(1 + overload) if square else sp.exp(log1p(excess) / p))
    ratio = sp.S.One if square else excess / overload
    definitions = (
        *OVERLOAD,
        *(() if square else (EXCESS,)),
        Assignment("hard", radial),
        Assignment("lift", ratio * hard),
        *(Assignment(k.name, symbol("per_gamma") * row) for k, row in zip(h, LOADS, strict=True)),
    )
    dyad = Dyad("stiff", "lift", tuple(k.name for k in h))
    rule = _rank_one("stiffness at loads", dyad, definitions, LOAD_CONSTANTS)
    return Plain(rule, BELOW_SQUARES if square else BELOW_POWERS)


# --- functions of strains --------------------------------------------------------------------

#: Stiffnesses of the linear rod over gamma, and what is left of eta^2 where the rod may untwist.
STRAIN_CONSTANTS = (
    Assignment("bending", alpha**2),
    Assignment("turning", beta**2),
    Assignment("shearing", zeta**2),
    Assignment("stretching", eta**2),
    Assignment("slack", chiral_gap / beta**2),
    Assignment("per_turning", 1 / beta**2),
    Assignment("untwist", iota / beta**2),
)


def _form() -> tuple[tuple[Assignment, ...], Pair, sp.Expr]:
    """Definitions, Q in squares, and the tension; the torque and it are K's coupled rows."""
    pull = symbol("slack_pull")
    definitions = (
        Assignment(torque.name, symbol("turning") * u3 + iota * stretch),
        Assignment(pull.name, symbol("slack") * stretch),
    )
    squares = (
        symbol("bending") * (u1**2 + u2**2)
        + symbol("shearing") * (v1**2 + v2**2)
        + symbol("per_turning") * torque**2
        + pull * stretch
    )
    tension = symbol("untwist") * torque + pull
    return definitions, (lower.from_rest(theory.quadratic_form()), squares), tension


GROWTH = (
    Assignment("growth", 1 / expm1(-p / 2 * sp.log(q))),
    Assignment("hard", gamma * sp.exp(log1p(growth) / p)),
)
LEFT = (Assignment("left", 1 - q), Assignment("hard", gamma / sp.sqrt(symbol("left"))))

#: The power stays above 1/span; what is near the limit is for the other kernel.
NEAR = 1 - sp.Rational(1, 2**10)
ABOVE_POWERS = Region("q", sp.exp(sp.Max(-sp.log(span), -MOST)), NEAR)
ABOVE_SQUARES = Region("q", 1 / span, NEAR)


def _loads(square: bool) -> Plain:
    form, squares, tension = _form()
    plain = (bend * u1, bend * u2, hard * torque, shear * v1, shear * v2, hard * tension)
    pairs = tuple((factor * row, new) for row, new in zip(s, plain, strict=True))
    stiff = (
        Assignment("bend", symbol("bending") * hard),
        Assignment("shear", symbol("shearing") * hard),
    )
    radial = LEFT if square else GROWTH
    rule = Rule("loads", (squares, *pairs), (*form, *radial, *stiff), WHY, STRAIN_CONSTANTS)
    return Plain(rule, ABOVE_SQUARES if square else ABOVE_POWERS)


def _stiffness(square: bool) -> Plain:
    """factor (K + growth K eps (K eps)^T/Q)."""
    weight = hard / symbol("left") if square else growth / q * hard
    form, squares, tension = _form()
    definitions = (
        *form,
        *(LEFT if square else GROWTH),
        Assignment("steep", weight),
        Assignment("r1", symbol("bending") * u1),
        Assignment("r2", symbol("bending") * u2),
        Assignment("r4", symbol("shearing") * v1),
        Assignment("r5", symbol("shearing") * v2),
        Assignment("r6", tension),
    )
    dyad = Dyad("stiff", "steep", tuple(k.name for k in r))
    rule = _rank_one("stiffness", dyad, definitions, STRAIN_CONSTANTS)
    rule = replace(rule, pairs=(squares, *rule.pairs))
    return Plain(rule, ABOVE_SQUARES if square else ABOVE_POWERS)


def _loads_and_stiffness(square: bool) -> Plain:
    """The loads as they are by themselves, to the bit."""
    loads, stiffness = _loads(square).rule, _stiffness(square)
    _, *rows = loads.pairs
    coupled = {hard * _form()[2]: hard * r6}
    pairs = tuple((before, after.xreplace(coupled)) for before, after in rows)
    radial = {hard * symbol("bending"): bend, hard * symbol("shearing"): shear}
    radii = tuple(a for a in loads.definitions if a.name in ("bend", "shear"))
    whole = replace(
        stiffness.rule,
        pairs=(*pairs, *((a, b.xreplace(radial)) for a, b in stiffness.rule.pairs)),
        definitions=(*stiffness.rule.definitions, *radii),
    )
    return replace(stiffness, rule=whole)


def _rank_one(
    name: str,
    dyad: Dyad,
    definitions: tuple[Assignment, ...],
    constants: tuple[Assignment, ...],
) -> Rule:
    """Every entry as hard times K's, and the dyad."""
    rest = theory.stiffness_at_rest()
    moduli = {a.expr: a.symbol for a in STRAIN_CONSTANTS if a.expr.is_Pow}
    pairs = tuple(
        (
            factor * (rest[i, j] + share * t[i] * t[j]),
            hard * rest[i, j].xreplace(moduli) + dyad.term(i, j),
        )
        for i in range(6)
        for j in range(i, 6)
    )
    added = tuple(a for a in STRAIN_CONSTANTS if a.symbol in moduli.values() and a not in constants)
    return Rule(name, pairs, definitions, WHY, (*constants, *added), dyad)


PLAIN: dict[str, Callable[[bool], Plain]] = {
    "strains": _strains,
    "loads": _loads,
    "stiffness": _stiffness,
    "loads_and_stiffness": _loads_and_stiffness,
    "strains_and_gap": _strains_and_gap,
    "stiffness_at_loads": _stiffness_at_loads,
}


def plain(kernel: Kernel, *, square: bool) -> Kernel | None:
    """The plain kernel of a lowered one; ``square`` says that p = 2. None if it has none."""
    if kernel.name not in PLAIN:
        return None
    found = PLAIN[kernel.name](square)
    changed = replace(apply(found.rule, kernel), gauge=None, limit=None, region=found.region)
    return replace(changed, body=tuple(replace(a, step="") for a in changed.body))


def uncouple(kernel: Kernel) -> Kernel:
    """A torque that comes of the twist alone squares as that: closer, and easier to enclose."""
    alone = symbol("turning") * u3
    squares = {
        symbol("per_turning") * a.symbol**2: alone * u3 for a in kernel.body if a.expr == alone
    }
    return kernel.rewrite(squares)
