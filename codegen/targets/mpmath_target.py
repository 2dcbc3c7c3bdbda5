"""Evaluates a kernel with mpmath at any precision: the oracle of the same kernel.

Every expression of a kernel is evaluated node by node in a private mpmath context, exactly as it
stands. The naive kernel evaluated here is the derivation in numbers; the stabilised kernel
evaluated here must agree with it, and the NumPy text is the stabilised kernel printed.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import mpmath
import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen.kernel import Assignment, Kernel
from rodproof.codegen.primitives import WorkShare

COMPARE = {"<=": operator.le, ">=": operator.ge, "<": operator.lt, ">": operator.gt}

Values = Mapping[str, Any]  # numbers by name: int, float, Fraction, str or mpf


class LimitError(ValueError):
    """The point is outside the kernel's domain."""


@dataclass(frozen=True)
class Evaluator:
    """Evaluates kernels at ``digits`` decimal digits.

    ``tiny`` and ``log_max`` of the kernels become 10^-reach and 10^reach, which is far outside
    what any input reaches. ``quadrature`` evaluates the energies' integrals by their definition
    instead of the hypergeometric function: slow, and another way.
    """

    digits: int = 50
    quadrature: bool = False
    reach: int = 10**9

    def context(self) -> Any:
        """A private context, so that nobody else's precision changes."""
        ctx = mpmath.mp.clone()
        ctx.dps = self.digits
        return ctx

    def evaluate(
        self, kernel: Kernel, inputs: Values, constants: Values, scale: Any = 1
    ) -> dict[tuple[str, tuple[int, ...]], Any]:
        """The outputs by array and index; ``scale`` is the gauge and must not matter.

        Raises `LimitError` at or past the limit.
        """
        ctx = self.context()
        values = {name: _number(ctx, v) for name, v in {**constants, **inputs}.items()}
        values |= {"tiny": ctx.mpf(10) ** -self.reach, "log_max": ctx.mpf(10) ** self.reach}
        walk = _Walk(ctx, values, self.quadrature)
        for a in kernel.constants:
            values[a.name] = walk.value(a.expr)
        factor = _number(ctx, scale) if kernel.gauge else ctx.mpf(1)
        for a in kernel.body:
            values[a.name] = walk.value(self._scaled(a, kernel, factor, ctx))
            if kernel.gauge and a.name == kernel.gauge.square:
                size = max(ctx.sqrt(values[a.name]), values["tiny"])
                values[kernel.gauge.norm] = size
                values[kernel.gauge.radius] = ctx.sqrt(values[a.name]) / factor
                values[kernel.gauge.unscale] = 1 / factor
                values[a.name] /= factor**2
            if kernel.limit and a.name == kernel.limit.quantity and not values[a.name] < 1:
                raise LimitError(f"{kernel.limit.sentence}; Q = {ctx.nstr(values[a.name], 17)}")
        return {(o.array, o.index): walk.value(o.expr) for o in kernel.outputs}

    def _scaled(self, a: Assignment, kernel: Kernel, factor: Any, ctx: Any) -> sp.Expr:
        """The expression with the gauge's inputs multiplied, inside the gauge's step only."""
        if factor == 1 or not kernel.gauge or a.step != kernel.gauge.step:
            return a.expr
        scale = sp.Float(str(factor), self.digits)
        inputs = {s: scale * s for s in a.expr.free_symbols if s.name in kernel.gauge.inputs}
        return a.expr.xreplace(inputs)


def _number(ctx: Any, value: Any) -> Any:
    """An mpf, exact for ints, floats and NumPy numbers; a fraction is divided here."""
    if hasattr(value, "numerator") and hasattr(value, "denominator"):
        return ctx.mpf(int(value.numerator)) / int(value.denominator)
    return ctx.mpf(value if isinstance(value, str) or hasattr(value, "_mpf_") else float(value))


class _Walk:
    """Evaluates expressions node by node over the given values."""

    def __init__(self, ctx: Any, values: dict[str, Any], quadrature: bool) -> None:
        self.ctx, self.values, self.quadrature = ctx, values, quadrature

    def value(self, expr: sp.Basic) -> Any:
        ctx = self.ctx
        if isinstance(expr, sp.Symbol):
            return self.values[expr.name]
        if isinstance(expr, sp.Rational):
            return ctx.mpf(expr.p) / expr.q
        if isinstance(expr, sp.Float):
            return ctx.mpf(expr._mpf_)
        if isinstance(expr, sp.Piecewise):
            return next(self.value(e) for e, test in expr.args if self.holds(test))
        if isinstance(expr, sp.Integral):
            return self.integral(expr)
        args = [self.value(arg) for arg in expr.args]
        if isinstance(expr, sp.Add):
            return ctx.fsum(args)
        if isinstance(expr, sp.Mul):
            return ctx.fprod(args)
        if isinstance(expr, sp.Pow):
            return args[0] ** args[1]
        if isinstance(expr, sp.Max):
            return max(args)
        if isinstance(expr, sp.Min):
            return min(args)
        if isinstance(expr, WorkShare):
            return self.work_share(*args)
        for kind, function in (
            (sp.exp, ctx.exp),
            (sp.log, ctx.log),
            (log1p, ctx.log1p),
            (expm1, self.expm1),
        ):
            if isinstance(expr, kind):
                return function(*args)
        raise TypeError(f"the mpmath target has no rule for {type(expr).__name__}: {expr}")

    def holds(self, test: sp.Basic) -> bool:
        if test in (sp.true, sp.false):
            return bool(test)
        left, right = (self.value(arg) for arg in test.args)
        return bool(COMPARE[test.rel_op](left, right))

    def expm1(self, argument: Any) -> Any:
        """Zero is where 1/expm1 is wanted only at infinity; huge arguments give infinity."""
        return self.ctx.inf if argument > 10**8 else self.ctx.expm1(argument)

    def integral(self, expr: sp.Integral) -> Any:
        """By tanh-sinh quadrature of the integrand over its limits, on the scale of each end."""
        (variable, low, high) = expr.limits[0]
        start, end = self.value(low), self.value(high)
        if start == end:
            return self.ctx.mpf(0)
        inner = _Walk(self.ctx, dict(self.values), self.quadrature)

        def integrand(point: Any) -> Any:
            inner.values[variable.name] = point
            return inner.value(expr.function)

        cuts = [start, *(start + (end - start) * self.ctx.mpf(k) / 16 for k in (1, 4, 12, 15)), end]
        return self.ctx.quad(integrand, cuts)

    def work_share(self, depth: Any, p: Any) -> Any:
        ctx = self.ctx
        if self.quadrature:
            return self.work_share_by_quadrature(depth, p)
        if depth > 10**6:  # share below e^-depth, e^-(depth/p) or their like: the last term alone
            return ctx.zero if p <= 1 else ctx.exp(-depth / p) * _limit_share(ctx, p)
        return ctx.hyp2f1(1, 1 / p, 1 + 2 / p, -ctx.expm1(depth)) / 2

    def work_share_by_quadrature(self, depth: Any, p: Any) -> Any:
        """The definition with s = x r: int_0^1 r ((1 - x^p)/(1 - x^p r^p))^{1/p} dr."""
        ctx = self.ctx
        left = ctx.exp(-depth)  # 1 - x^p
        return ctx.quad(
            lambda r: r * (left / (1 - (1 - left) * r**p)) ** (1 / p), [0, 0.25, 0.75, 0.98, 1]
        )


def _limit_share(ctx: Any, p: Any) -> Any:
    """w at the limit, B(2/p, 1 - 1/p)/p, for p > 1."""
    return ctx.beta(2 / p, 1 - 1 / p) / p
