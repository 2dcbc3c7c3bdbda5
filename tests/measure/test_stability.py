"""The promise of the generated module: eight ulps beyond what the inputs explain, everywhere."""

from __future__ import annotations

import numpy as np
import pytest

from rodproof.codegen.measure.errors import SIDES, truth
from rodproof.codegen.measure.inputs import KINDS, Kind, batches
from rodproof.codegen.measure.records import FUNCTIONS
from rodproof.codegen.measure.rivals import all_forms, answers

STABLE = {form.dtype: form for form in all_forms() if form.name.startswith("stable")}


@pytest.mark.parametrize("dtype", STABLE, ids=lambda dtype: dtype.__name__)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_error_is_explained_to_eight_ulps(function: str, kind: Kind, dtype) -> None:
    for batch in batches(kind, SIDES[function], dtype, 11, 12, 5):
        for index, answer in enumerate(answers(STABLE[dtype], function, batch)):
            exact = truth(function, batch, index, dtype)
            if exact.representable:
                error = exact.error(answer)
                assert error <= exact.inherent + 8, (batch.constants, batch.column(index))


def test_the_textbook_form_breaks_it() -> None:
    """The same check is failed by the formulas as a textbook has them."""
    textbook = next(form for form in all_forms() if form.name == "textbook")
    broken = 0
    with np.errstate(all="ignore"):
        for batch in batches("extreme", "loads", np.float64, 11, 12, 5):
            for index, answer in enumerate(answers(textbook, "strains", batch)):
                exact = truth("strains", batch, index, np.float64)
                broken += exact.error(answer) > exact.inherent + 8
    assert broken > 10
