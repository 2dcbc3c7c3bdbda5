"""Drops guards that the scene's ranges make needless, where interval arithmetic proves it.

A guard is a floor or a ceiling, a choice, the scaled path of a gauge, or the test of the limit.
Intervals enclose the exact values over the ranges (Arb); margins leave room for rounding. A
quantity whose range is not declared may be anything, so that its guards stay.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import sympy as sp
from flint import arb
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen.kernel import (
    SPAN_POWER,
    Assignment,
    Kernel,
    log_max,
    span,
    symbol,
    tiny,
)
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.scene import CONSTANT_NAMES, LOAD_NAMES, Scene
from rodproof.derivations.theory import constitutive as theory

#: What rounding may change: far more than the few ulps of a form, even in single precision.
MARGIN = 1 - 2.0**-16
#: The smallest normal numbers; a scene that keeps single precision must hold there.
TINY = {"float64": 2.0**-1022, "float32": 2.0**-126, "input": 2.0**-126}


@dataclass(frozen=True)
class Interval:
    """All numbers between two balls; a bound that is not a number proves nothing."""

    low: arb
    high: arb

    @staticmethod
    def around(*points: arb) -> Interval:
        """The smallest interval that holds the points."""
        low, high = points[0], points[0]
        for point in points[1:]:
            low, high = low.min(point), high.max(point)
        return Interval(low, high)

    def below(self, other: Interval, factor: float = MARGIN) -> bool:
        """Whether every number of this one is at most ``factor`` times every one of the other."""
        return bool(self.high <= other.low * factor)


def drop_guards(kernel: Kernel, scene: Scene) -> Kernel:
    """The kernel without needless guards; ``dropped`` says which went."""
    if not scene.ranges:
        return kernel
    known = _Intervals(kernel, scene)
    smallest = TINY[scene.precision]
    settled = _settle(kernel, known)
    if settled.gauge is not None:
        square = known.of(symbol(settled.gauge.square))
        room = Interval.around(arb(smallest * 2.0**62), arb(2.0**-62 / smallest))
        if room.low <= square.low and square.high <= room.high:
            settled = _without_gauge(settled)
    if settled.limit is not None:
        quantity = known.of(symbol(settled.limit.quantity))
        if quantity.high < MARGIN:
            dropped = (*settled.dropped, "the strain limit")
            settled = replace(settled, limit=None, dropped=dropped)
    return settled


def _settle(kernel: Kernel, known: _Intervals) -> Kernel:
    """Floors, ceilings and choices that the intervals decide."""
    nodes = {
        node
        for expr in kernel.expressions()
        for node in sp.preorder_traversal(expr)
        if isinstance(node, (sp.Max, sp.Min, sp.Piecewise))
    }
    changed: dict[sp.Expr, sp.Expr] = {}
    for node in sorted(nodes, key=lambda n: (sp.count_ops(n), sp.default_sort_key(n))):
        inner = node.xreplace(changed)  # a choice inside may be settled already
        chosen = _choose(inner, known)
        if chosen is not inner:
            changed[node] = chosen
            changed[inner] = chosen
    if not changed:
        return kernel
    floors = any(node.has(tiny) or node.has(log_max) for node in changed)
    choices = any(not (node.has(tiny) or node.has(log_max)) for node in changed)
    dropped = [*kernel.dropped]
    dropped += ["underflow and overflow of powers"] if floors else []
    dropped += ["the choice by size of load and gamma"] if choices else []
    return replace(kernel.rewrite(changed), dropped=tuple(dropped))


def _choose(node: sp.Expr, known: _Intervals) -> sp.Expr:
    if isinstance(node, sp.Piecewise):
        (value, test), (other, _) = node.args
        low, high = (test.lhs, test.rhs) if test.rel_op in ("<=", "<") else (test.rhs, test.lhs)
        left, right = known.of(low), known.of(high)
        if left.below(right):
            return value
        return other if right.below(left) else node
    if isinstance(node, (sp.Max, sp.Min)) and len(node.args) == 2:
        for small, large in (node.args, node.args[::-1]):
            if known.of(small).below(known.of(large)):
                return large if isinstance(node, sp.Max) else small
    return node


def alone(kernel: Kernel, plain: Kernel, scene: Scene) -> Kernel | None:
    """The plain kernel by itself, where the ranges prove that every point is in its region."""
    region = plain.region
    if region is None or not scene.ranges:
        return None
    known = _Intervals(plain, scene)
    # a product of a name and its own multiple is a square, which intervals must be shown
    multiples = {a.symbol: a.expr for a in plain.body if a.expr.is_Mul}
    (quantity,) = (a.expr for a in plain.body if a.name == region.quantity)
    inside = known.of(quantity.xreplace(multiples))
    bounds = known.of(region.low), known.of(region.high)
    room = known.of(span)
    sizes = [known.of(symbol(name)) for name in plain.sizes()]
    if not (bounds[0].below(inside) and inside.below(bounds[1])):
        return None
    if not all(_even(size, room) for size in sizes):
        return None
    dropped = [*kernel.dropped]
    dropped += ["overflow and underflow of squares"] if kernel.gauge else []
    return replace(plain, region=None, dropped=tuple(dropped))


def _even(size: Interval, room: Interval) -> bool:
    """Whether the magnitude is nought or between 1/span and span."""
    largest, smallest = size.high.max(-size.low), size.low.max(-size.high)
    if not bool(largest < room.low):
        return False
    return bool(smallest > 1 / room.low) or bool(largest == 0)


def _without_gauge(kernel: Kernel) -> Kernel:
    """The radius as the root of the square, and the norm as the radius."""
    gauge = kernel.gauge
    assert gauge is not None
    radius = theory.y if gauge.radius == "y" else theory.x
    root = Assignment(gauge.radius, sp.sqrt(symbol(gauge.square)))
    ones = {symbol(gauge.norm): radius, symbol(gauge.radius): radius}
    plain = kernel.rewrite(ones | {symbol(gauge.unscale): sp.S.One})
    dropped = (*kernel.dropped, "overflow and underflow of squares")
    return replace(plain, body=(root, *plain.body), gauge=None, dropped=dropped)


class _Intervals:
    """Intervals of a kernel's expressions over the ranges of a scene."""

    def __init__(self, kernel: Kernel, scene: Scene) -> None:
        anything = Interval(arb("-inf"), arb("inf"))
        positive = Interval(arb(0), arb("inf"))
        self._known = dict.fromkeys((*CONSTANT_NAMES, "size", "x", "y"), positive)
        self._known |= dict.fromkeys(("iota", *kernel.inputs), anything)
        self._known |= {name: Interval(arb(a), arb(b)) for name, (a, b) in scene.ranges.items()}
        self._known |= {name: Interval(arb(v), arb(v)) for name, v in scene.fixed.items()}
        smallest = TINY[scene.precision]
        largest = -0.99 * math.log(smallest)
        self._known["tiny"] = Interval(arb(smallest), arb(smallest))
        self._known["log_max"] = Interval(arb(largest), arb(largest))
        room = arb(smallest) ** -SPAN_POWER
        self._known["span"] = Interval(room, room)
        self._defined = {a.name: a.expr for a in (*kernel.constants, *kernel.body)}
        square = "q_star" if kernel.inputs[0] in LOAD_NAMES else "q"
        self._defined |= dict.fromkeys(("size", "y", "x"), sp.sqrt(symbol(square)))
        self._defined["unscale"] = sp.S.One

    def of(self, expr: sp.Basic) -> Interval:
        """The interval of an expression."""
        if isinstance(expr, sp.Symbol):
            if expr.name in self._defined:
                self._known[expr.name] = self.of(self._defined.pop(expr.name))
            return self._known[expr.name]
        if isinstance(expr, sp.Rational):
            exact = arb(int(expr.p)) / int(expr.q)
            return Interval(exact, exact)
        if isinstance(expr, WorkShare):
            return Interval(arb(0), arb(0.5))
        if isinstance(expr, sp.Piecewise):
            values = [self.of(value) for value, _ in expr.args]
            return Interval.around(*(end for v in values for end in (v.low, v.high)))
        args = [self.of(arg) for arg in expr.args]
        if isinstance(expr, sp.Add):
            return Interval(sum((a.low for a in args), arb(0)), sum((a.high for a in args), arb(0)))
        if isinstance(expr, sp.Mul):
            product = args[0]
            for factor in args[1:]:
                product = _product(product, factor)
            return product
        if isinstance(expr, (sp.Max, sp.Min)):
            pick = arb.max if isinstance(expr, sp.Max) else arb.min
            low, high = args[0].low, args[0].high
            for other in args[1:]:
                low, high = pick(low, other.low), pick(high, other.high)
            return Interval(low, high)
        if isinstance(expr, sp.Pow):
            return _power(args[0], expr.args[1])
        function = MONOTONE[type(expr)]
        return Interval(function(args[0].low), function(args[0].high))


def _product(a: Interval, b: Interval) -> Interval:
    return Interval.around(a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high)


def _power(base: Interval, exponent: sp.Expr) -> Interval:
    """A rational power; where that has a pole nothing is known."""
    if exponent.is_negative:
        if not (base.low > 0 or base.high < 0):
            return Interval(arb("nan"), arb("nan"))
        inverse = Interval.around(1 / base.low, 1 / base.high)
        return _power(inverse, -exponent)
    if exponent == sp.Rational(1, 2):
        return Interval(base.low.max(arb(0)).sqrt(), base.high.sqrt())
    if not exponent.is_Integer:
        return Interval(arb("nan"), arb("nan"))
    power = int(exponent)
    ends = [base.low**power, base.high**power]
    if power % 2 == 0 and not (base.low > 0 or base.high < 0):
        ends.append(arb(0))
    return Interval.around(*ends)


MONOTONE: Mapping[type, Callable[[arb], arb]] = {
    sp.exp: arb.exp,
    sp.log: arb.log,
    log1p: arb.log1p,
    expm1: arb.expm1,
}
