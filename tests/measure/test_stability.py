"""The promise of the generated modules: eight ulps beyond what the inputs explain, everywhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rodproof.codegen.measure import atlas, spots
from rodproof.codegen.measure.errors import truth
from rodproof.codegen.measure.extremes import outcomes
from rodproof.codegen.measure.form import answers
from rodproof.codegen.measure.inputs import KINDS, Kind, batches
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.subjects import subject, subjects

STABLE = {np.float64: form_of("stable float64"), np.float32: form_of("stable float32")}
FULL = subject("full_rod")
EVERY = [(one.name, function) for one in subjects() for function in one.functions]


@pytest.mark.parametrize("dtype", STABLE, ids=lambda dtype: dtype.__name__)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("function", FULL.functions)
def test_error_is_explained_to_eight_ulps(function: str, kind: Kind, dtype) -> None:
    for batch in batches(FULL, function, kind, dtype, 11, 8, 4):
        with np.errstate(over="ignore", invalid="ignore"):  # where no number holds it
            found = answers(STABLE[dtype], FULL, function, batch)
        for index, answer in enumerate(found):
            exact = truth(FULL, function, batch, index, dtype)
            if exact.representable:
                assert exact.beyond(exact.error(answer)) <= 8, (batch.constants, index)


@pytest.mark.parametrize("precision", spots.DTYPES)
@pytest.mark.parametrize(("name", "function"), EVERY)
def test_a_slice_of_the_atlas_is_right(name: str, function: str, precision: str) -> None:
    """Every fifth place of each map; the whole atlas is `rodproof measure --atlas`."""
    looked = spots.spots(subject(name), function, precision, coarse=5, choices=1)
    assert len(looked) > 15
    wrong = [spot.name for spot in looked if atlas.look(spot).wrong]
    assert not wrong


#: What the whole atlas found wrong, or nearly so, on the way; each has its rule or its reason.
FOUND = [
    "full_rod.stiffness_at_loads.float64.moduli.6.1.1",
    "dsdna.stiffness_at_loads.float64.moduli.8.4.0",
    "full_rod_p2.stiffness.float64.limit.9.10.0",
    "full_rod_p2.strains.float64.load.2.1.0",
    "full_rod.loads.float64.load.7.2.1",
    "full_rod.compliance.float32.moduli.10.1.0",
]


@pytest.mark.parametrize("name", FOUND)
def test_spots_that_were_hard_are_right(name: str) -> None:
    assert not atlas.replay(name).wrong


def test_the_textbook_form_fails_on_the_same_slice() -> None:
    """The check can fail: it rejects the formulas as a textbook has them."""
    looked = spots.spots(FULL, "strains", "float64", coarse=4, choices=1)
    marks = [atlas.look(spot).book_mark for spot in looked]
    assert sum(atlas.rank(mark) > 8 for mark in marks) > len(marks) / 10


def test_a_slip_in_the_answer_is_a_mark() -> None:
    """A component wrong in its tenth digit, and one that is missing."""
    spot = spots.named("full_rod.strains.float64.limit.9.9.0")
    seen = atlas.look(spot)
    assert not seen.wrong
    slipped = replace(seen, ours=[seen.ours[0] * (1 + 1e-9), *seen.ours[1:]])
    assert slipped.wrong
    assert 1e4 < slipped.mark < 1e8
    assert replace(seen, ours=None).mark == atlas.NO_NUMBER
    assert replace(seen, ours=[float("nan")] * 6).wrong


def test_past_the_limit_a_number_is_wrong_and_a_refusal_right() -> None:
    seen = replace(atlas.look(spots.named("full_rod.loads.float64.limit.9.9.0")), truth=None)
    assert seen.wrong
    assert seen.mark == atlas.NO_NUMBER
    assert not replace(seen, ours=None).wrong


def test_stiff_and_extreme_cases_end_as_they_should() -> None:
    """Right, refused in a sentence, or lost by the inputs alone; nothing is wrong in silence."""
    found = outcomes()
    kinds = {(case.title, case.function): case for case in found}
    assert {case.what for case in found} == {"right", "inherent loss", "refused", "overflow"}
    assert kinds["Q = 1", "loads"].detail.startswith("strains must satisfy Q(u, v) < 1")
    assert "beta=1.0, eta=1.0, iota=1.0" in kinds["iota = beta eta", "strains"].detail
    assert kinds["Q = 1 - 2e-15", "loads"].what == "inherent loss"
    assert kinds["a load of 1e15 gamma", "stiffness_at_loads"].what == "right"
    overflow = kinds["a load of 1e15 gamma, p = 1000", "stiffness_at_loads"]
    assert "overflow encountered" in overflow.detail


@pytest.mark.parametrize(
    "name",
    [
        *("", "full_rod", "full_rod.strains.float64.limit.3.7"),
        *("full_rod.strains.float64.limit.99.0.0", "full_rod.strain.float64.limit.1.1.0"),
        *("rod.strains.float64.limit.1.1.0", "full_rod.strains.float64.map.1.1.0"),
        "full_rod.strains.float64.limit.a.1.0",
    ],
)
def test_a_spot_that_is_none_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match=r"SCENE\.FUNCTION\.PRECISION\.MAP\.COLUMN\.ROW\.CHOICE"):
        spots.named(name)


def test_spots_are_the_same_again_and_cover_their_maps() -> None:
    for one in (FULL, subject("planar"), subject("full_rod_p2")):
        for precision in spots.DTYPES:
            for spot in spots.spots(one, "strains", precision, coarse=4, choices=1):
                again = spots.named(spot.name)
                assert again == spot
                assert again.point.constants == spot.point.constants
                assert np.array_equal(again.point.first, spot.point.first)
    across, up = spots.axes(FULL, "strains", "float64", "limit")
    assert {0.3, 1000.0, 1 - 1e-10, 1 + 1e-10} <= set(across.values)
    assert (min(up.values), max(up.values)) == (1e-160, 1e160)
    _, forms = spots.axes(FULL, "loads", "float64", "limit")
    assert (min(forms.values), max(forms.values)) == (1e-300, 1 - 1e-15)
    gammas, sizes = spots.axes(FULL, "strains", "float64", "load")
    assert (min(gammas.values), max(gammas.values)) == (1e-100, 1e100)
    assert {0.0, 5e-324} <= set(sizes.values)
    gaps, scales = spots.axes(FULL, "strains", "float64", "moduli")
    assert min(gaps.values) == 1e-15
    assert (min(scales.values), max(scales.values)) == (1e-100, 1e100)
