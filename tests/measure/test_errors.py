"""What an ulp is, and what the inputs explain."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rodproof.codegen.measure.errors import Truth
from rodproof.codegen.measure.errors import truth as truth_of
from rodproof.codegen.measure.inputs import KINDS, Batch
from rodproof.codegen.measure.inputs import batches as drawn
from rodproof.codegen.measure.subjects import subject

FULL = subject("full_rod")
FUNCTIONS = FULL.functions
PLAIN = (1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.0)


def truth(function: str, batch: Batch, index: int, dtype: type) -> Truth:
    return truth_of(FULL, function, batch, index, dtype)


def one(first: list[float], second: list[float], constants: tuple[float, ...] = PLAIN) -> Batch:
    return Batch(constants, np.array(first)[:, None], np.array(second)[:, None])


def rounded(exact) -> list[float]:
    """The nearest doubles of the exact answer, v3 with its 1."""
    values = [float(entry.mid()) for entry in exact.value]
    return [*values[:5], 1 + values[5]] if exact.part == "strains" else values


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_the_nearest_numbers_are_within_an_ulp(function: str, dtype) -> None:
    (batch,) = drawn(FULL, function, "ordinary", dtype, 7, 1, 6)
    for index in range(batch.size):
        exact = truth(function, batch, index, dtype)
        assert exact.error([float(dtype(value)) for value in rounded(exact)]) <= 1.5
        assert exact.inherent > 0.5


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_wrong_component_is_seen_and_sized(function: str) -> None:
    (batch,) = drawn(FULL, function, "ordinary", np.float64, 7, 1, 1)
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


def test_an_ulp_of_a_subnormal_number_is_a_step() -> None:
    """The smallest load says only that there is one; no answer can be held to more."""
    exact = truth(
        "strains", one([5e-324, 0, 0], [0, 0, 0], (*PLAIN[:5], 1e-20, 2.0)), 0, np.float64
    )
    assert exact.inherent > 2**51
    assert exact.beyond(exact.error([3e-304, 0, 0, 0, 0, 1.0])) == 0
    assert exact.beyond(exact.error([5e-303, 0, 0, 0, 0, 1.0])) > 1e15


def test_right_answers_are_not_asked_for_the_inherent_error() -> None:
    exact = truth("loads", one([0.1, 0, 0], [0, 0, 1.1]), 0, np.float64)
    assert exact.beyond(7.5) == 7.5
    assert "inherent" not in vars(exact)
    assert exact.beyond(1e3) == 1e3 - exact.inherent
    assert exact.beyond(math.inf) == math.inf


def test_at_the_edge_of_the_domain_an_ulp_decides() -> None:
    assert truth("loads", one([1 - 2**-53, 0, 0], [0, 0, 1]), 0, np.float64).at_edge
    assert not truth("loads", one([1 - 2**-40, 0, 0], [0, 0, 1]), 0, np.float64).at_edge
    assert not truth("strains", one([1e30, 0, 0], [0, 0, 1]), 0, np.float64).at_edge


@pytest.mark.parametrize("name", ["dsdna", "planar", "kirchhoff", "thrust", "couple"])
def test_a_scene_is_measured_by_what_it_has(name: str) -> None:
    """Answers in the scene's own components; the rest of the full rod does not count."""
    scene = subject(name)
    for function in scene.functions:
        (batch,) = drawn(scene, function, "ordinary", np.float64, 7, 1, 1)
        exact = truth_of(scene, function, batch, 0, np.float64)
        places = scene.places(function)
        assert all(exact.value[k] == 0 for k in range(len(exact.value)) if k not in places)
        near = [float(exact.value[k].mid()) for k in places]
        if exact.part == "strains" and 5 in scene.strains:
            near[-1] += 1
        assert exact.error(near) < 2
        near[0] *= 1 + 1e-9
        assert exact.error(near) > 1e4


def test_the_inputs_explain_more_near_the_limit() -> None:
    far = truth("loads", one([0.5, 0, 0], [0, 0, 1]), 0, np.float64)
    near = truth("loads", one([1 - 1e-9, 0, 0], [0, 0, 1]), 0, np.float64)
    assert far.inherent < 20
    assert near.inherent > 1e7


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_inherent_errors_are_numbers(kind, function: str) -> None:
    (batch,) = drawn(FULL, function, kind, np.float64, 3, 1, 4)
    truths = [truth(function, batch, index, np.float64) for index in range(batch.size)]
    assert all(math.isfinite(exact.inherent) for exact in truths)
