"""Checks of what the energies satisfy beyond their gradients: duality, convexity, closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.prover import DIGITS, POINTS
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import gamma, p
from rodproof.derivations.theory import constitutive as theory

x, y = theory.x, theory.y
STORED = sp.Function("W")
COMPLEMENTARY = sp.Function("W_star")
LOAD = sp.Function("load")
_r = sp.Symbol("r", positive=True)
_INSIDE = (1 - x**p,)

_LOAD = theory.radial_law().load
_STRAIN = theory.radial_law().strain
_STORED_INTEGRAL = sp.Integral(_LOAD.subs(x, _r), (_r, 0, x))
_COMPLEMENTARY_INTEGRAL = sp.Integral(_STRAIN.subs(y, _r), (_r, 0, y))


@dataclass(frozen=True, eq=False)
class Proof:
    """A step with its exact argument as a function, and a numerical one."""

    argument: Callable[[], bool]
    method: str
    left: sp.Expr
    right: sp.Expr

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        return Decision(self.argument() or None, True, self.method)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        worst = 0.0
        for seed in range(POINTS):
            evaluate = Evaluator(context(DIGITS), _point(seed))
            a, b = evaluate(self.left), evaluate(self.right)
            worst = max(worst, float(abs(a - b) / abs(b)))
        return Confirmation(worst, POINTS, DIGITS, "quadrature of the defining integrals")


def _point(seed: int) -> dict[sp.Symbol, Any]:
    return {**sampling.constants(seed), x: sp.Rational(3 + seed, 7), y: sp.Rational(4 + seed, 3)}


def _young() -> bool:
    """d/dy of W(x(y)) + W*(y) - x(y) y, with dW/dx = load and dW*/dy = strain."""
    slope = sp.diff(_STRAIN, y)
    total = _LOAD.subs(x, _STRAIN) * slope + _STRAIN - (slope * y + _STRAIN)
    return Field().is_zero(total)


def _convex() -> bool:
    return Field(_INSIDE).sign(sp.diff(_LOAD, x)) == 1


_k = sp.Symbol("k", positive=True)
_rising = sp.Symbol("rising", positive=True)  # (1/p)_k/k!, the binomial coefficient


def _series_stored() -> bool:
    """Term k: int_0^x r^{pk+1} dr against x^2/2 (2/p)_k/(1+2/p)_k x^{pk}."""
    term = _rising * gamma * x ** (p * _k + 2) / (p * _k + 2)
    closed = gamma * x**2 / 2 * _rising * _ratio() * (x**p) ** _k
    return Field().equal(term, closed)


def _series_complementary() -> bool:
    """Term k of r/gamma (1 + (r/gamma)^p)^{-1/p}, the sign (-1)^k left out on both sides."""
    term = _rising * y ** (p * _k + 2) / (gamma ** (p * _k + 1) * (p * _k + 2))
    closed = y**2 / (2 * gamma) * _rising * _ratio() * ((y / gamma) ** p) ** _k
    return Field().equal(term, closed)


def _ratio() -> sp.Expr:
    """(b)_k/(b + 1)_k = b/(b + k), telescoping, with b = 2/p."""
    return (2 / p) / (2 / p + _k)


YOUNG = Proof(
    _young,
    "the derivative in the load vanishes, and so does the value at zero",
    _STORED_INTEGRAL.subs(x, _STRAIN) + _COMPLEMENTARY_INTEGRAL,
    _STRAIN * y,
)
CONVEX = Proof(_convex, "sign certificate", sp.Derivative(_LOAD, x), sp.diff(_LOAD, x))
SERIES_STORED = Proof(
    _series_stored, "term by term, exactly", _STORED_INTEGRAL, theory.stored_energy_closed()
)
SERIES_COMPLEMENTARY = Proof(
    _series_complementary,
    "term by term, exactly",
    _COMPLEMENTARY_INTEGRAL,
    theory.complementary_energy_closed(),
)


@dataclass(frozen=True, eq=False)
class Elementary:
    """An elementary closed form at one p: right slope, and zero at zero."""

    power: sp.Rational

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (_, stored), (_, complementary) = (claim.sides for claim in printed.args)
        field = Field((1 - x, 1 + x))
        right = (
            field.equal(sp.diff(stored, x), _LOAD.subs(p, self.power))
            and field.equal(sp.diff(complementary, y), _STRAIN.subs(p, self.power))
            and stored.subs(x, 0) == 0
            and complementary.subs(y, 0) == 0
        )
        return Decision(right or None, True, "same slope, same value at zero, exactly")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        worst = 0.0
        for seed in range(POINTS):
            point = _point(seed) | {p: self.power}
            evaluate = Evaluator(context(DIGITS), point)
            for claim, integral in zip(
                printed.args, (_STORED_INTEGRAL, _COMPLEMENTARY_INTEGRAL), strict=True
            ):
                a, b = evaluate(claim.sides[1]), evaluate(integral)
                worst = max(worst, float(abs(a - b) / abs(b)))
        return Confirmation(worst, POINTS, DIGITS, "quadrature of the defining integrals")
