"""The samples are what they say, and the same for the same seed."""

from __future__ import annotations

import numpy as np
import pytest
from flint import ctx

from rodproof.codegen.measure import oracle
from rodproof.codegen.measure.inputs import KINDS, Batch, coupling, kinds, strain_along
from rodproof.codegen.measure.inputs import batches as drawn
from rodproof.codegen.measure.subjects import subject, subjects

FULL = subject("full_rod")


def batches(kind, side: str, dtype, *counts: int) -> tuple[Batch, ...]:
    return drawn(FULL, {"loads": "strains", "strains": "loads"}[side], kind, dtype, *counts)


def both(kind, dtype=np.float64) -> tuple[tuple[Batch, ...], tuple[Batch, ...]]:
    return batches(kind, "loads", dtype, 1, 30, 5), batches(kind, "strains", dtype, 1, 30, 5)


def radii(batch: Batch) -> list[float]:
    with ctx.workprec(400):
        c = batch.exact_constants()
        points = (batch.exact(index, "strains") for index in range(batch.size))
        return [float(1 - oracle.norm(oracle.whitened_strain(c, point))) for point in points]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_every_sample_lies_in_the_domain(kind, dtype) -> None:
    loads, strains = both(kind, dtype)
    for batch in (*loads, *strains):
        assert batch.first.dtype == batch.second.dtype == dtype
        assert batch.exact_constants().gap > 0
        assert all(value > 0 for value in np.delete(batch.constants, 4))
    for batch in strains:
        assert all(gap > 0 for gap in radii(batch))
        assert np.all(batch.second[2] > 0)


def test_scenes_get_points_of_their_own() -> None:
    for one in subjects():
        assert ("chiral" in kinds(one)) == ("iota" in one.constants)
        for function in one.functions:
            (batch,) = drawn(one, function, "extreme", np.float64, 1, 1, 3)
            rest = [0.0, 0.0, 0.0, 0.0, 0.0, float(one.side(function) == "strains")]
            whole = np.concatenate([batch.first, batch.second])
            dead = [i for i in range(6) if i not in one.loads]
            assert np.array_equal(whole[dead], np.array(rest)[dead, None] + 0 * whole[dead])
            assert one.restricted(batch.constants) == batch.constants
            one.record(batch.constants)


def test_directions_become_loads_and_strains() -> None:
    """L L^T = K, and a whitened direction times L^-T has that length."""
    k = (0.7, 1.1, 0.9, 1.6, 1.1 * 1.6 * (1 - 2**-40), 1.0, 2.0)
    L = coupling(k)
    whole = L @ L.T
    np.testing.assert_allclose(np.diag(whole), [0.49, 0.49, 1.21, 0.81, 0.81, 2.56], rtol=1e-15)
    assert abs(whole[2, 5] - k[4]) < 1e-15
    direction = np.array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6])
    np.testing.assert_allclose(L.T @ strain_along(k, direction), direction, rtol=1e-9)


def test_same_seed_same_inputs() -> None:
    for kind in KINDS:
        for first, second in zip(*(both(kind)[0] for _ in range(2)), strict=True):
            assert first.constants == second.constants
            assert np.array_equal(first.first, second.first)
    other = batches("ordinary", "loads", np.float64, 2, 1, 5)[0]
    assert not np.array_equal(other.first, both("ordinary")[0][0].first)


def test_extreme_inputs_span_the_contract() -> None:
    loads, strains = both("extreme")
    sizes = np.concatenate([np.abs([b.first, b.second]).max(axis=(0, 1)) for b in loads])
    gammas, powers = (np.array([b.constants[i] for b in loads]) for i in (5, 6))
    assert sizes.min() == 0.0  # rest is there
    assert sizes[sizes > 0].min() < 1e-120
    assert sizes.max() > 1e120
    assert gammas.min() < 1e-150
    assert gammas.max() > 1e150
    assert {0.3, 1000.0} & set(powers)
    assert all(np.array_equal(b.second[:, 0], [0, 0, 1]) for b in strains)


def test_limit_and_chiral_inputs_are_near_the_edge() -> None:
    _, limit = both("limit")
    assert max(gap for batch in limit for gap in radii(batch)) < 2e-3
    assert min(gap for batch in limit for gap in radii(batch)) < 1e-10
    chiral = [b.constants for b in both("chiral")[0]]
    gaps = [1 - abs(c[4]) / (c[1] * c[3]) for c in chiral]
    assert max(gaps) < 0.11
    assert min(gaps) < 1e-7
