"""How far an answer is from the truth, in ulps, and how far the inputs alone would throw it.

The unit of a vector or matrix is normwise, in the whitened coordinates of the oracle, where the
energy is isotropic and all six components have the same unit: one ulp is 2^-52 (2^-23 in single
precision) of the whitened length of the true answer, or one step of the subnormal numbers where
that is larger. The strains come with v3 and not v3 - 1: the error of v3 is counted apart, in steps
of v3 itself or ulps of the largest v3 - 1 that a strain of this length can have, whichever is
larger, so that a large v3 hides no error of the other five.

Inherent error is what nobody could avoid: the sum of the changes when each constant, each component
of the input and each of the answer moves by one ulp of itself (of the subnormal numbers, a step).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import arb

from rodproof.codegen.measure import oracle
from rodproof.codegen.measure.inputs import Batch
from rodproof.codegen.measure.oracle import MOVED, Constants, Vector
from rodproof.codegen.measure.subjects import PARTS, Subject
from rodproof.codegen.scene import CONSTANT_NAMES

ORACLES: dict[str, oracle.Function] = {
    "strains": oracle.strains,
    "complementary_energy": oracle.complementary_energy,
    "compliance": oracle.compliance,
    "loads": oracle.loads,
    "stored_energy": oracle.stored_energy,
    "stiffness": oracle.stiffness,
    "stiffness_at_loads": oracle.stiffness_at_loads,
    "limit_gap": oracle.limit_gap,
}
WHITENERS: dict[str, Callable[..., oracle.Whitener]] = {
    "strains": oracle.whitener_of_strains,
    "compliance": oracle.whitener_of_strains,
    "loads": oracle.whitener_of_loads,
    "stiffness": oracle.whitener_of_loads,
    "stiffness_at_loads": oracle.whitener_of_loads,
}
#: The error, in ulps beyond the inherent one, up to which an answer is called right.
RIGHT = 8.0


def length(part: str, c: Constants, value: Sequence[arb], *, worst: bool = False) -> arb:
    """The whitened length of an answer (strains counted from rest).

    worst: the largest that it can have whatever the signs of the value, which is not negative.
    """
    if part not in WHITENERS:
        return abs(value[0])
    whiten = WHITENERS[part](c, worst=worst)
    if len(value) == 6:
        return oracle.norm(whiten(value))
    rows = [whiten(value[6 * i : 6 * i + 6]) for i in range(6)]
    columns = [whiten([row[j] for row in rows]) for j in range(6)]
    return oracle.norm([entry for column in columns for entry in column])


@dataclass(frozen=True)
class Truth:
    """The exact answer of a scene's function at one point, and the size of an ulp there."""

    subject: Subject
    function: str
    constants: Constants
    argument: tuple[arb, ...]
    dtype: type[np.floating]
    value: tuple[arb, ...]
    ulp: arb
    ulp_v3: arb

    @property
    def part(self) -> str:
        """What the function is measured by."""
        return PARTS.get(self.function, self.function)

    @property
    def representable(self) -> bool:
        """Whether the precision has numbers large enough for the answer."""
        limit = float(np.finfo(self.dtype).max)
        return all(abs(entry) < limit for entry in self.value)

    @oracle.exactly
    def error(self, answer: Sequence[object] | None) -> float:
        """The error of a form's answer in ulps; inf where it gave none or not a number.

        answer: the components that the scene has, as its function returns them.
        """
        if answer is None:
            return math.inf
        whole = [arb(0)] * len(self.value)
        for place, number in zip(self.subject.places(self.function), answer, strict=True):
            whole[place] = ball(number)
        if self.part == "strains":
            whole[5] = whole[5] - (5 in self.subject.strains)
        return self.distance(whole)

    @oracle.exactly
    def distance(self, answer: Sequence[arb]) -> float:
        """The distance of six, 36 or one numbers (strains from rest) from the truth, in ulps."""
        delta = [a - v for a, v in zip(answer, self.value, strict=True)]
        if not all(entry.is_finite() for entry in delta):
            return math.inf
        stretch = arb(0)
        if self.part == "strains":
            stretch, delta[5] = abs(delta[5]) / self.ulp_v3, arb(0)
        rest = length(self.part, self.constants, delta) / self.ulp
        return max(float(rest.mid()), float(stretch.mid()))

    @cached_property
    def inherent(self) -> float:
        """What one ulp of each input and of each number of the answer explain."""
        return self._inherent()

    @oracle.exactly
    def _inherent(self) -> float:
        law = ORACLES[self.part]
        moved = (
            self._kept(oracle.certain(law, constants, point, MOVED))
            for constants, point in self._moved()
        )
        return self._rounding() + sum(self.distance(other) for other in moved)

    def beyond(self, error: float) -> float:
        """The error less what is inherent; an error that is right as it stands is left alone."""
        if error <= RIGHT or not math.isfinite(error):
            return error
        return max(error - self.inherent, 0.0)

    @cached_property
    def at_edge(self) -> bool:
        """Whether an ulp of the inputs together could take the strain to the limit or past it.

        There the strain does not say on which side it is: a refusal is as right as a number.
        """
        return self.subject.side(self.function) == "strains" and self._edge()

    @oracle.exactly
    def _edge(self) -> bool:
        eps = arb(float(np.finfo(self.dtype).eps))
        q = _square(self.constants, self.argument)
        room = 1 - q
        inputs = [*self.constants.entries, *self.argument]
        for i, entry in enumerate(inputs):
            own = 1 + entry if i == 12 else entry  # v3 is given, not v3 - 1
            changed = [*inputs[:i], entry + eps * own, *inputs[i + 1 :]]
            room = room - abs(_square(Constants(*changed[:7]), changed[7:]) - q)
        return bool(room <= 0)

    def _kept(self, value: Sequence[arb]) -> Vector:
        return _kept(self.subject, self.function, value)

    def _rounding(self) -> float:
        """What an ulp of each number of the answer makes of it, whatever the signs."""
        info = np.finfo(self.dtype)
        eps, step = arb(float(info.eps)), arb(float(info.smallest_subnormal))
        moved = [max(eps * abs(entry), step) if entry != 0 else arb(0) for entry in self.value]
        if self.part != "strains":
            return float((length(self.part, self.constants, moved, worst=True) / self.ulp).mid())
        moved[5] = arb(0)  # v3 is counted apart
        rest = length(self.part, self.constants, moved, worst=True) / self.ulp
        return max(float(rest.mid()), 1.0)

    def _moved(self) -> list[tuple[Constants, list[arb]]]:
        """The inputs with one of them an ulp away from where it is, inside the domain."""
        info = np.finfo(self.dtype)
        eps, step = arb(float(info.eps)), arb(float(info.smallest_subnormal))
        inputs = [*self.constants.entries, *self.argument]
        free = [CONSTANT_NAMES.index(name) for name in self.subject.constants]
        free += [7 + i for i in self.subject.loads]
        moved = []
        for i in (i for i in free if inputs[i] != 0):
            ulp = max(eps * abs(inputs[i]), step)
            for change in (ulp, -ulp):
                changed = [*inputs[:i], inputs[i] + change, *inputs[i + 1 :]]
                constants, point = Constants(*changed[:7]), changed[7:]
                if self._inside(constants, point):
                    moved.append((constants, point))
                    break
        return moved

    def _inside(self, c: Constants, point: Sequence[arb]) -> bool:
        if not c.gap > 0:
            return False
        of_loads = self.subject.side(self.function) == "loads"
        return of_loads or bool(oracle.norm(oracle.whitened_strain(c, point)) < 1)


@oracle.exactly
def truth(
    subject: Subject, function: str, batch: Batch, index: int, dtype: type[np.floating]
) -> Truth:
    """The oracle's answer at a point of a batch, and what an error there is measured by."""
    c, argument = batch.exact_constants(), batch.exact(index, subject.side(function))
    part = PARTS.get(function, function)
    value = _kept(subject, function, oracle.certain(ORACLES[part], c, argument))
    ulp, ulp_v3 = _ulps(part, c, value, dtype)
    return Truth(subject, function, c, tuple(argument), dtype, tuple(value), ulp, ulp_v3)


def _kept(subject: Subject, function: str, value: Sequence[arb]) -> Vector:
    """The answer with what the scene does not have left out."""
    places = set(subject.places(function))
    return [entry if k in places else arb(0) for k, entry in enumerate(value)]


def _ulps(
    part: str, c: Constants, value: Sequence[arb], dtype: type[np.floating]
) -> tuple[arb, arb]:
    info = np.finfo(dtype)
    eps, step = arb(float(info.eps)), arb(float(info.smallest_subnormal))
    size = length(part, c, value)
    least = length(part, c, [step] * len(value))
    ulp = max(eps * size, least)
    if part != "strains":
        return ulp, ulp
    reach = oracle.norm(oracle.whitened_load(c, [arb(0)] * 5 + [arb(1)]))  # sup of v3 - 1 at x = 1
    return ulp, max(eps * abs(1 + value[5]), eps * size * reach)


def _square(c: Constants, strain: Sequence[arb]) -> arb:
    """Q, also where the moved constants are no rod's."""
    own = (c.alpha, c.alpha, c.beta, c.zeta, c.zeta, c.eta)
    squares = sum(((m * e) ** 2 for m, e in zip(own, strain, strict=True)), arb(0))
    return squares + 2 * c.iota * strain[2] * strain[5]


def ball(number: object) -> arb:
    """A component that a form returned, exactly."""
    return arb(float(number)) if isinstance(number, np.floating) else arb(number)
