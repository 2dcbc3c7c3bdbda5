"""The true values of the six functions at given floats, and errors against them in ulps.

How an error is counted. The components of a result have different units and, with extreme moduli,
different magnitudes, so they are first made comparable by the moduli on the diagonal of the
stiffness K at rest: strains (alpha u1, alpha u2, beta u3, zeta v1, zeta v2, eta (v3 - 1)), loads
(m1/alpha, ..., n3/eta), stiffness and compliance entries by two such factors, energies as they
are. The error is the Euclidean (for matrices Frobenius) norm of the difference over that of the
true value, in units of the last place, 2^-52 in doubles. Two things that no algorithm can avoid
are taken off: half an ulp of v3, which holds 1 + (v3 - 1), and the smallest normal number.

The conditioning is the sum, over the inputs, of what one ulp of each does to the true value in
the same norm, by a derivative at high precision; over loads or strains alone, or with constants.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from rodproof.codegen.generate import kernels
from rodproof.codegen.kernel import Kernel
from rodproof.codegen.scene import Scene
from rodproof.codegen.targets.mpmath_target import Evaluator
from rodproof.derivations.symbols import CONSTANTS

Constants = Mapping[str, Any]
CONSTANT_NAMES = tuple(symbol.name for symbol in CONSTANTS)
MODULI = ("alpha", "alpha", "beta", "zeta", "zeta", "eta")

#: How a component scales with its modulus: strains times it, loads over it.
POWERS = {
    "strains": 1,
    "loads": -1,
    "stiffness": -1,
    "compliance": 1,
    "stored_energy": 0,
    "complementary_energy": 0,
}


@dataclass(frozen=True)
class Oracle:
    """True values of one function, as mpf numbers with ``digits`` decimal digits."""

    function: str
    digits: int = 60

    def __call__(self, first: Sequence[Any], second: Sequence[Any], constants: Constants) -> Any:
        """The value at one point: a list of 6 (with v3, not v3 - 1), a 6x6 list, or one number."""
        flat = self._flat(first, second, constants)
        if len(flat) == 1:
            return flat[0]
        if len(flat) == 6:
            return flat
        rows: list[list[Any]] = [[None] * 6 for _ in range(6)]
        upper = iter(flat)
        for i in range(6):
            for j in range(i, 6):
                rows[i][j] = rows[j][i] = next(upper)
        return rows

    def error(
        self,
        got: Sequence[float],
        first: Sequence[Any],
        second: Sequence[Any],
        constants: Constants,
        bits: int = 52,
        smallest: float = 2.0**-1022,
    ) -> float:
        """The error of ``got`` (6, 21 upper entries row by row, or 1 number) in ulps."""
        ctx = Evaluator(self.digits).context()
        true = self._flat(first, second, constants)
        weights = self._weights(ctx, constants)
        norm = self._norm(ctx, self._from_rest(true), weights)
        off = [abs(ctx.mpf(float(g)) - t) for g, t in zip(got, true, strict=True)]
        if self.function == "strains":
            off[5] -= abs(true[5]) * ctx.mpf(2) ** (-bits - 1)
        off = [max(d - smallest, ctx.zero) for d in off]
        error = self._norm(ctx, off, weights)
        return float(error / norm * 2**bits) if error else 0.0

    def conditioning(
        self,
        first: Sequence[Any],
        second: Sequence[Any],
        constants: Constants,
        with_constants: bool = False,
    ) -> float:
        """What one ulp of every input explains, in ulps of the result."""
        ctx = Evaluator(self.digits).context()
        step = ctx.mpf(10) ** (-self.digits // 3)
        true = self._from_rest(self._flat(first, second, constants))
        weights = self._weights(ctx, constants)
        norm = self._norm(ctx, true, weights)
        if not norm:
            return 0.0
        inputs = [ctx.mpf(float(x)) for x in (*first, *second)]
        total = ctx.zero

        def change(moved: list[Any], moved_constants: Constants) -> Any:
            new = self._from_rest(self._flat(moved[:3], moved[3:], moved_constants))
            return self._norm(ctx, [a - b for a, b in zip(new, true, strict=True)], weights)

        stretched = _kernel(self.function).limit is not None  # inputs end in v3, which is near 1
        for k, value in enumerate(inputs):
            part = value - 1 if stretched and k == 5 else value
            moved = [*inputs[:k], value + part * step, *inputs[k + 1 :]]
            total += change(moved, constants) * abs(value / part) if part else 0
        near = ctx.mpf(10) ** (-self.digits // 6)  # smaller still: iota may be close to beta*eta
        for name in CONSTANT_NAMES if with_constants else ():
            value = ctx.mpf(float(constants[name])) * (1 + step * near)
            total += change(inputs, {**constants, name: value}) / near
        return float(total / step / norm)

    def _flat(self, first: Sequence[Any], second: Sequence[Any], constants: Constants) -> list[Any]:
        kernel = _kernel(self.function)
        inputs = dict(zip(kernel.inputs, (*first, *second), strict=True))
        return list(Evaluator(self.digits).evaluate(kernel, inputs, constants).values())

    def _from_rest(self, flat: list[Any]) -> list[Any]:
        return [*flat[:5], flat[5] - 1] if self.function == "strains" else flat

    def _weights(self, ctx: Any, constants: Constants) -> list[Any]:
        power = POWERS[self.function]
        moduli = [ctx.mpf(float(constants[name])) ** power for name in MODULI]
        if self.function in ("strains", "loads"):
            return moduli
        if self.function in ("stiffness", "compliance"):
            return [
                moduli[i] * moduli[j] * (1 if i == j else ctx.sqrt(2))
                for i in range(6)
                for j in range(i, 6)
            ]
        return [ctx.one]

    def _norm(self, ctx: Any, values: list[Any], weights: list[Any]) -> Any:
        return ctx.sqrt(ctx.fsum((v * w) ** 2 for v, w in zip(values, weights, strict=True)))


@cache
def _kernel(function: str) -> Kernel:
    (kernel,) = kernels(Scene("oracle", functions=(function,)))
    return kernel
