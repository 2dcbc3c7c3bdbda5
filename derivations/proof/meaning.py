"""What the symbols of a transcription stand for on one domain, and points of that domain."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.notation import LimitOf, Partial

Point = Mapping[sp.Symbol, sp.Rational]
Values = Mapping[sp.Basic, Any]


class IllTyped(ValueError):
    """The transcription puts something where the notation allows none (a misprint)."""


def of_vector(base: sp.IndexedBase, vector: Iterable[Any]) -> dict[sp.Symbol, Any]:
    """Three components by the names that a transcription has for them."""
    return {sp.Symbol(f"{base.label}{k}", real=True): e for k, e in enumerate(vector, 1)}


def of_matrix(name: str, matrix: Any) -> dict[sp.Symbol, Any]:
    """The nine entries by their names, an expression or a number each."""
    return {
        sp.Symbol(f"{name}{i + 1}{j + 1}", real=True): matrix[i, j]
        for i in range(3)
        for j in range(3)
    }


@dataclass(frozen=True, eq=False)
class Meaning:
    """One domain, its variables and what is derived on it.

    free: the independent variables. components: dependent symbols, each as a derived expression
    in the free ones. functions: what an applied function of the notation means, given the
    components of its arguments. positive: what is positive on the domain (zero excepted, where
    `edges` speak). sample: generic rational points, by seed. simple: small rational points, for
    counterexamples. edges: points of the domain where the generic argument does not apply.
    route: the same quantities by another way, as numbers.
    """

    name: str
    free: tuple[sp.Symbol, ...]
    sample: Callable[[int], Point]
    simple: Callable[[], tuple[Point, ...]]
    components: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)
    functions: Mapping[Any, Callable[..., sp.Expr]] = field(default_factory=dict)
    positive: tuple[sp.Expr, ...] = ()
    edges: tuple[Mapping[sp.Symbol, sp.Expr], ...] = ()
    route: Callable[[Point, Any], Values] | None = None
    route_name: str = ""

    def interpret(self, tree: sp.Basic) -> sp.Basic:
        """The transcription as an ordinary expression in the free variables."""
        return self._notation(tree).xreplace(dict(self.components))

    def _notation(self, tree: sp.Basic) -> sp.Basic:
        if isinstance(tree, Partial):
            function, variable = tree.args
            if not isinstance(variable, sp.Symbol):
                raise IllTyped(f"{variable} is not a variable to differentiate by")
            return sp.diff(self._notation(function).xreplace(dict(self.components)), variable)
        if isinstance(tree, LimitOf):
            inner, variable, target = tree.args
            inner = self._notation(inner).xreplace(dict(self.components))
            return limit(inner, variable, self._notation(target), self.positive)
        meaning = self.functions.get(type(tree))
        if meaning is not None:
            return meaning(*(self._argument(a) for a in tree.args))
        if not tree.args or isinstance(tree, sp.Symbol | sp.IndexedBase):
            return tree
        return tree.func(*(self._notation(a) for a in tree.args))

    def _argument(self, arg: sp.Basic) -> Any:
        if isinstance(arg, sp.IndexedBase):
            return tuple(sp.Symbol(f"{arg.label}{k}", real=True) for k in (1, 2, 3))
        return self._notation(arg)

    def evaluator(self, ctx: Any, point: Point, values: Values | None = None) -> Evaluator:
        """Numbers for transcriptions at a point; `values` come from a second route."""
        return _NotationEvaluator(self, ctx, point, values or {})


class _NotationEvaluator(Evaluator):
    def __init__(self, meaning: Meaning, ctx: Any, point: Point, values: Values) -> None:
        super().__init__(ctx, dict(point))
        self._meaning = meaning
        self._point = point
        self._cache.update({node: ctx.convert(value) for node, value in values.items()})

    def moved(self, symbol: sp.Symbol, value: Any) -> Evaluator:
        return Evaluator(self.ctx, {**self.values, symbol: value})

    def __call__(self, expr: sp.Basic) -> Any:
        if expr not in self._cache:
            if isinstance(expr, LimitOf):
                self._cache[expr] = self._near_the_target(expr)
            elif isinstance(expr, Partial) or type(expr) in self._meaning.functions:
                self._cache[expr] = self(self._meaning.interpret(expr))
            elif isinstance(expr, sp.Symbol) and expr in self._meaning.components:
                self._cache[expr] = self(self._meaning.components[expr])
        return super().__call__(expr)

    def _near_the_target(self, expr: LimitOf) -> Any:
        """A limit as a value very near its target (400 digits away), not by the exact rule."""
        inner, variable, target = expr.args
        far = self.ctx.mpf(10) ** 400
        near = {sp.oo: far, -sp.oo: -far}.get(target)
        if near is None:
            near = self(target) + 1 / far
        function = self._meaning._notation(inner).xreplace(dict(self._meaning.components))
        return Evaluator(self.ctx, {**self.values, variable: near})(function)
