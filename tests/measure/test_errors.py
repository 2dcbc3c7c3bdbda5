"""What an ulp is, and what the inputs explain."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rodproof.codegen.measure.errors import SIDES, truth
from rodproof.codegen.measure.inputs import KINDS, Batch, batches

FUNCTIONS = tuple(SIDES)
PLAIN = (1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.0)


def one(first: list[float], second: list[float], constants: tuple[float, ...] = PLAIN) -> Batch:
    return Batch(constants, np.array(first)[:, None], np.array(second)[:, None])


def rounded(exact) -> list[float]:
    """The nearest doubles of the exact answer, v3 with its 1."""
    values = [float(entry.mid()) for entry in exact.value]
    return [*values[:5], 1 + values[5]] if exact.function == "strains" else values


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_the_nearest_numbers_are_within_an_ulp(function: str, dtype) -> None:
    (batch,) = batches("ordinary", SIDES[function], dtype, 7, 1, 6)
    for index in range(batch.size):
        exact = truth(function, batch, index, dtype)
        assert exact.error([float(dtype(value)) for value in rounded(exact)]) <= 1.5
        assert exact.inherent > 0.5


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_wrong_component_is_seen_and_sized(function: str) -> None:
    (batch,) = batches("ordinary", SIDES[function], np.float64, 7, 1, 1)
    exact = truth(function, batch, 0, np.float64)
    for size in (1e-12, 1e-6):
        moved = rounded(exact)
        largest = max(range(len(moved)), key=lambda i: abs(moved[i]))
        moved[largest] *= 1 + size
        assert size / 2**-52 / 40 < exact.error(moved) < size / 2**-52 * 40


def test_missing_answers_are_infinitely_wrong() -> None:
    exact = truth("loads", one([0.1, 0, 0], [0, 0, 1.1]), 0, np.float64)
    assert exact.error(None) == math.inf
    assert exact.error([math.nan] * 6) == math.inf
    assert exact.error([math.inf, *[0.0] * 5]) == math.inf


def test_v3_does_not_hide_the_other_strains() -> None:
    """A tiny bending strain beside v3 = 1 must be right to its own last place."""
    exact = truth("strains", one([1e-100, 0, 0], [0, 0, 0]), 0, np.float64)
    assert exact.error([1e-100, 0, 0, 0, 0, 1.0]) < 1
    assert exact.error([2e-100, 0, 0, 0, 0, 1.0]) > 1e15
    assert 0.9 < exact.error([1e-100, 0, 0, 0, 0, 1.0 + 2**-52]) < 1.1


def test_underflow_to_the_nearest_is_right() -> None:
    exact = truth("complementary_energy", one([1e-300, 0, 0], [0, 0, 0]), 0, np.float64)
    assert exact.error([0.0]) < 1


def test_an_answer_beyond_the_range_is_set_aside() -> None:
    stiff = (*PLAIN[:5], 1e200, 0.3)
    batch = one([1 - 1e-13, 0, 0], [0, 0, 1], (1e60, *stiff[1:]))
    batch = Batch(batch.constants, batch.first * 1e-60, batch.second)
    assert not truth("stiffness", batch, 0, np.float64).representable
    assert truth("stiffness", one([0.1, 0, 0], [0, 0, 1]), 0, np.float64).representable


def test_the_inputs_explain_more_near_the_limit() -> None:
    far = truth("loads", one([0.5, 0, 0], [0, 0, 1]), 0, np.float64)
    near = truth("loads", one([1 - 1e-9, 0, 0], [0, 0, 1]), 0, np.float64)
    assert far.inherent < 20
    assert near.inherent > 1e7


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_inherent_errors_are_numbers(kind, function: str) -> None:
    (batch,) = batches(kind, SIDES[function], np.float64, 3, 1, 4)
    truths = [truth(function, batch, index, np.float64) for index in range(batch.size)]
    assert all(math.isfinite(exact.inherent) for exact in truths)
