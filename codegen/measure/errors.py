"""How far an answer is from the truth, in ulps, and how far the inputs alone would throw it.

The unit of a vector or matrix is normwise, in the whitened coordinates of the oracle, where the
energy is isotropic and all six components have the same unit: one ulp is 2^-52 (2^-23 in single
precision) of the whitened length of the true answer, or one step of the subnormal numbers where
that is larger. The strains come with v3 and not v3 - 1: the error of v3 is counted apart, in steps
of v3 itself or ulps of the largest v3 - 1 that a strain of this length can have, whichever is
larger, so that a large v3 hides no error of the other five.

Inherent error is what no algorithm could avoid: the rounding of the exact answer, and the sum of
the changes when each constant and each component of the input moves by one ulp of itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from flint import arb

from rodproof.codegen.measure import oracle
from rodproof.codegen.measure.inputs import Batch, Side
from rodproof.codegen.measure.oracle import Constants, Vector

SIDES: dict[str, Side] = {
    "strains": "loads",
    "complementary_energy": "loads",
    "compliance": "loads",
    "loads": "strains",
    "stored_energy": "strains",
    "stiffness": "strains",
}
ORACLES: dict[str, oracle.Function] = {
    "strains": oracle.strains,
    "complementary_energy": oracle.complementary_energy,
    "compliance": oracle.compliance,
    "loads": oracle.loads,
    "stored_energy": oracle.stored_energy,
    "stiffness": oracle.stiffness,
}
WHITEN: dict[str, Callable[[Constants, Sequence[arb]], Vector]] = {
    "strains": oracle.whitened_strain,
    "compliance": oracle.whitened_strain,
    "loads": oracle.whitened_load,
    "stiffness": oracle.whitened_load,
}


def length(function: str, c: Constants, value: Sequence[arb]) -> arb:
    """The whitened length of an answer of the function (strains counted from rest)."""
    if function in ("stored_energy", "complementary_energy"):
        return abs(value[0])
    whiten = WHITEN[function]
    if function in ("strains", "loads"):
        return oracle.norm(whiten(c, value))
    rows = [whiten(c, value[6 * i : 6 * i + 6]) for i in range(6)]
    columns = [whiten(c, [row[j] for row in rows]) for j in range(6)]
    return oracle.norm([entry for column in columns for entry in column])


@dataclass(frozen=True)
class Truth:
    """The exact answer at one point, the size of an ulp there, and the inherent error in ulps."""

    function: str
    constants: Constants
    value: tuple[arb, ...]
    ulp: arb
    ulp_v3: arb
    inherent: float
    representable: bool

    @oracle.exactly
    def error(self, answer: Sequence[object] | None) -> float:
        """The error of a form's answer in ulps; inf where it gave none or not a number."""
        if answer is None:
            return float("inf")
        return self.distance(balls(self.function, answer))

    @oracle.exactly
    def distance(self, answer: Sequence[arb]) -> float:
        """The distance of six, 36 or one numbers (strains from rest) from the truth, in ulps."""
        delta = [a - v for a, v in zip(answer, self.value, strict=True)]
        if not all(entry.is_finite() for entry in delta):
            return float("inf")
        stretch = arb(0)
        if self.function == "strains":
            stretch, delta[5] = abs(delta[5]) / self.ulp_v3, arb(0)
        rest = length(self.function, self.constants, delta) / self.ulp
        return max(float(rest.mid()), float(stretch.mid()))


@oracle.exactly
def truth(function: str, batch: Batch, index: int, dtype: type[np.floating]) -> Truth:
    """The oracle's answer at a point of a batch, and what an error there is measured by."""
    c, argument = batch.exact_constants(), batch.exact(index, SIDES[function])
    value = oracle.certain(ORACLES[function], c, argument)
    ulp, ulp_v3 = _ulps(function, c, value, dtype)
    limit = float(np.finfo(dtype).max)
    representable = all(abs(entry) < limit for entry in value)
    bare = Truth(function, c, tuple(value), ulp, ulp_v3, 0.0, representable)
    if not representable:
        return bare
    inherent = bare.distance(_rounded(function, value, dtype)) + sum(
        bare.distance(oracle.certain(ORACLES[function], *moved))
        for moved in _moved(function, c, argument, dtype)
    )
    return replace(bare, inherent=inherent)


def _ulps(
    function: str, c: Constants, value: Sequence[arb], dtype: type[np.floating]
) -> tuple[arb, arb]:
    info = np.finfo(dtype)
    eps, step = arb(float(info.eps)), arb(float(info.smallest_subnormal))
    size = length(function, c, value)
    least = length(function, c, [step] * len(value))
    ulp = max(eps * size, least)
    if function != "strains":
        return ulp, ulp
    reach = oracle.norm(oracle.whitened_load(c, [arb(0)] * 5 + [arb(1)]))  # sup of v3 - 1 at x = 1
    return ulp, max(eps * abs(1 + value[5]), eps * size * reach)


def _rounded(function: str, value: Sequence[arb], dtype: type[np.floating]) -> Vector:
    """The exact answer in the nearest numbers of the precision."""
    whole = [*value[:5], 1 + value[5]] if function == "strains" else list(value)
    return balls(function, [float(dtype(float(entry.mid()))) for entry in whole])


def balls(function: str, components: Sequence[object]) -> Vector:
    """The components that a form returned as balls, strains taken from rest."""
    exact = [arb(float(c)) if isinstance(c, np.floating) else arb(c) for c in components]
    return [*exact[:5], exact[5] - 1] if function == "strains" else exact


def _moved(
    function: str, c: Constants, argument: Sequence[arb], dtype: type[np.floating]
) -> list[tuple[Constants, list[arb]]]:
    """The inputs with one of them an ulp away from where it is, inside the domain."""
    eps = arb(float(np.finfo(dtype).eps))
    inputs = [*c.entries, *argument]
    moved = []
    for i, entry in enumerate(inputs):
        for factor in (1 + eps, 1 - eps) if entry != 0 else ():
            changed = [*inputs[:i], entry * factor, *inputs[i + 1 :]]
            constants, point = Constants(*changed[:7]), changed[7:]
            if _inside(function, constants, point):
                moved.append((constants, point))
                break
    return moved


def _inside(function: str, c: Constants, point: Sequence[arb]) -> bool:
    if not c.gap > 0:
        return False
    return SIDES[function] == "loads" or bool(oracle.norm(oracle.whitened_strain(c, point)) < 1)
