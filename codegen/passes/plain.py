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
from rodproof.codegen.kernel import Assignment, Dyad, Form, Kernel, Region, span, symbol
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
left, hard = symbol("left"), symbol("hard")
#: The linear rod's strains over gamma at the loads, and its loads over gamma at the strains.
w = tuple(map(symbol, ("w1", "w2", "twist", "w4", "w5", "extension")))
r = tuple(map(symbol, ("r1", "r2", "torque", "r4", "r5", "tension")))
h = tuple(symbol(f"h{i}") for i in range(1, 7))  # the loads over gamma
w1, w2, twist, w4, w5, extension = w
r1, r2, torque, r4, r5, tension = r
turn, pull = symbol("turn"), symbol("pull")


@dataclass(frozen=True)
class Plain:
    """A rule that makes the whole function plain, and the region where that holds."""

    rule: Rule
    region: Region
    form: Form


# --- functions of loads ----------------------------------------------------------------------

#: Compliances of the linear rod, all over gamma. The extension carries the coupling: Q* is a sum
#: of squares in it and the other loads.
LOAD_CONSTANTS = (
    Assignment("bend_soft", 1 / (alpha**2 * gamma)),
    Assignment("turn_soft", 1 / (beta**2 * gamma)),
    Assignment("shear_soft", 1 / (zeta**2 * gamma)),
    Assignment("n3_extends", beta**2 / (chiral_gap * gamma)),
    Assignment("m3_extends", iota / (chiral_gap * gamma)),
    Assignment("slack_load", chiral_gap * gamma / beta**2),
    Assignment("untwist", iota / beta**2),
    Assignment("per_gamma", 1 / gamma),
)

OVERLOAD = (
    Assignment(w1.name, symbol("bend_soft") * m1),
    Assignment(w2.name, symbol("bend_soft") * m2),
    Assignment(turn.name, symbol("turn_soft") * m3),
    Assignment(w4.name, symbol("shear_soft") * n1),
    Assignment(w5.name, symbol("shear_soft") * n2),
    Assignment(extension.name, symbol("n3_extends") * n3 - symbol("m3_extends") * m3),
    Assignment(
        overload.name,
        symbol("per_gamma")
        * (m1 * w1 + m2 * w2 + m3 * turn + n1 * w4 + n2 * w5 + symbol("slack_load") * extension**2),
        ("qstar-form",),
    ),
    Assignment(twist.name, turn - symbol("untwist") * extension),
)
LOAD_FORM = Form(overload.name, tuple(a.name for a in w))
EXCESS = Assignment("excess", sp.exp(p / 2 * sp.log(overload)))
ROOT = Assignment("root", sp.exp(-log1p(excess) / p))
ROOT_SQUARE = Assignment("root", 1 / sp.sqrt(1 + overload))

#: log(y/gamma) multiplies its own rounding: y up to 32 gamma; and the power stays below span.
MOST = 2 * sp.log(span) / p
BELOW_POWERS = Region("overload", 1 / span, sp.exp(sp.Min(sp.log(1024), MOST)))
BELOW_SQUARES = Region("overload", 1 / span, span)

WHY = "twice as many operations where nothing is extreme"


def _strains(square: bool) -> Plain:
    radial = (ROOT_SQUARE,) if square else (EXCESS, ROOT)
    pairs = tuple((factor * row, root * new) for row, new in zip(e, w, strict=True))
    rule = Rule("strains", pairs, (*OVERLOAD, *radial), WHY, LOAD_CONSTANTS)
    return Plain(rule, BELOW_SQUARES if square else BELOW_POWERS, LOAD_FORM)


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
    return Plain(rule, BELOW_SQUARES if square else BELOW_POWERS, LOAD_FORM)


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

#: Q in squares; the torque and the tension are K's coupled rows.
FORM = (
    Assignment(r1.name, symbol("bending") * u1),
    Assignment(r2.name, symbol("bending") * u2),
    Assignment(torque.name, symbol("turning") * u3 + iota * stretch),
    Assignment(r4.name, symbol("shearing") * v1),
    Assignment(r5.name, symbol("shearing") * v2),
    Assignment(pull.name, symbol("slack") * stretch),
    Assignment(tension.name, symbol("untwist") * torque + pull),
)
SQUARES = u1 * r1 + u2 * r2 + symbol("per_turning") * torque**2 + v1 * r4 + v2 * r5 + stretch * pull
STRAIN_FORM = Form(q.name, tuple(a.name for a in r))

#: What is left of the way to the limit, 1 - Q^(p/2). Its logarithm counts by its size alone.
LEFT = (
    Assignment(left.name, -expm1(p / 2 * sp.log(q))),
    Assignment(hard.name, gamma * sp.exp(-sp.log(left) / p)),
)
LEFT_SQUARE = (Assignment(left.name, 1 - q), Assignment(hard.name, gamma / sp.sqrt(left)))

#: The power stays above 1/span; what is near the limit is for the other kernel.
NEAR = 1 - sp.Rational(1, 2**10)
ABOVE_POWERS = Region("q", sp.exp(sp.Max(-sp.log(span), -MOST)), NEAR)
ABOVE_SQUARES = Region("q", 1 / span, NEAR)


def _squares() -> Pair:
    return lower.from_rest(theory.quadratic_form()), SQUARES


def _loads(square: bool) -> Plain:
    pairs = tuple((factor * row, hard * new) for row, new in zip(s, r, strict=True))
    radial = LEFT_SQUARE if square else LEFT
    rule = Rule("loads", (_squares(), *pairs), (*FORM, *radial), WHY, STRAIN_CONSTANTS)
    return Plain(rule, ABOVE_SQUARES if square else ABOVE_POWERS, STRAIN_FORM)


def _stiffness(square: bool) -> Plain:
    """factor (K + Q^(p/2)/left K eps (K eps)^T/Q)."""
    weight = hard / left if square else (1 - left) * hard / left / q
    definitions = (*FORM, *(LEFT_SQUARE if square else LEFT), Assignment("steep", weight))
    dyad = Dyad("stiff", "steep", STRAIN_FORM.vector)
    rule = _rank_one("stiffness", dyad, definitions, STRAIN_CONSTANTS)
    rule = replace(rule, pairs=(_squares(), *rule.pairs))
    return Plain(rule, ABOVE_SQUARES if square else ABOVE_POWERS, STRAIN_FORM)


def _loads_and_stiffness(square: bool) -> Plain:
    """The loads as they are by themselves, to the bit."""
    (_, *rows), stiffness = _loads(square).rule.pairs, _stiffness(square)
    whole = replace(stiffness.rule, pairs=(*rows, *stiffness.rule.pairs))
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
    stiff = (
        Assignment("bend", symbol("bending") * hard),
        Assignment("shear", symbol("shearing") * hard),
    )
    twice = {a.expr: a.symbol for a in stiff}
    pairs = tuple(
        (
            factor * (rest[i, j] + share * t[i] * t[j]),
            (hard * rest[i, j].xreplace(moduli)).xreplace(twice) + dyad.term(i, j),
        )
        for i in range(6)
        for j in range(i, 6)
    )
    added = tuple(a for a in STRAIN_CONSTANTS if a.symbol in moduli.values() and a not in constants)
    return Rule(name, pairs, (*definitions, *stiff), WHY, (*constants, *added), dyad)


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
    changed = replace(
        apply(found.rule, kernel),
        gauge=None,
        limit=None,
        region=found.region,
        form=found.form,
    )
    return replace(changed, body=tuple(replace(a, step="") for a in changed.body))


def uncouple(kernel: Kernel) -> Kernel:
    """What comes of one component alone squares as that: closer, and easier to enclose."""
    products = (
        (torque, symbol("turning"), u3, symbol("per_turning")),
        (extension, symbol("n3_extends"), n3, symbol("slack_load")),
    )
    body = {a.symbol: a.expr for a in kernel.body}
    squares = {
        weight * row**2: row * one
        for row, ratio, one, weight in products
        if body.get(row) == ratio * one
    }
    return kernel.rewrite(squares)
