"""Guards go where the ranges prove them needless, and only there."""

from __future__ import annotations

import itertools
import random
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from flint import arb

from rodproof.codegen import generate, scene
from rodproof.codegen.passes.drop_guards import _Intervals
from rodproof.codegen.scene import Scene, SceneError
from rodproof.codegen.targets.mpmath_target import Evaluator

CONSTANTS = {"alpha": (0.5, 1.0), "beta": (0.5, 1.0), "gamma": (1.0, 10.0), "p": (1.5, 10.0)}
LOADS = {"m1": (0.1, 0.5), "m2": (-1.0, 1.0), "m3": (-1.0, 1.0)}
STRAINS = {"u1": (0.1, 0.4), "u2": (-0.4, 0.4), "u3": (-0.5, 0.5)}
RANGES = {**CONSTANTS, **LOADS, **STRAINS}
KIRCHHOFF = Scene("own", constraints=("unshearable", "inextensible"), ranges=RANGES)


def dropped(own: Scene) -> dict[str, set[str]]:
    return {kernel.name: set(kernel.dropped) for kernel in generate.kernels(own)}


def test_what_goes_when_everything_is_declared() -> None:
    found = dropped(KIRCHHOFF)
    powers, squares = "underflow and overflow of powers", "overflow and underflow of squares"
    assert found["strains"] == found["compliance"] == {powers, squares}
    assert found["stiffness"] == {powers, "the strain limit"}
    assert found["loads"] == found["stored_energy"] == {powers, squares, "the strain limit"}
    text = generate.render(KIRCHHOFF)
    for word in ("_balanced", "_rescaled", "_within_limit", "LOG_MAX", "_PastLimit"):
        assert word not in text
    assert "Guards proved needless by interval arithmetic over the ranges" in text
    assert "Ranges: alpha in [0.5, 1]" in text
    assert "_balanced" in generate.render(replace(KIRCHHOFF, ranges={}))


def without(*names: str) -> Scene:
    return replace(KIRCHHOFF, ranges={n: r for n, r in RANGES.items() if n not in names})


@pytest.mark.parametrize("name", ["alpha", "m2", "m1"])
def test_an_undeclared_range_keeps_the_guard(name: str) -> None:
    """Without m1 > 0 there may be no load; without a bound on m2 the squares may overflow."""
    assert "overflow and underflow of squares" not in dropped(without(name))["strains"]


def test_a_plain_kernel_stands_alone_only_for_even_constants() -> None:
    """gamma is in no derived constant of the loads; as it is it may be far from the others."""
    narrow = {**RANGES, "p": (1.5, 3.0)}
    even = replace(KIRCHHOFF, ranges=narrow)
    wild = replace(KIRCHHOFF, ranges={**narrow, "gamma": (1e-200, 10.0)})
    for own, beside in ((even, False), (wild, True)):
        (loads,) = (k for k in generate.kernels(own) if k.name == "loads")
        assert (loads.plain is not None) == beside


def test_the_limit_is_tested_where_the_strains_may_reach_it() -> None:
    wide = replace(KIRCHHOFF, ranges={**RANGES, "u2": (-1.0, 1.0)})
    assert "the strain limit" not in dropped(wide)["loads"]
    assert "the strain limit" not in dropped(without("u3"))["loads"]
    close = {**RANGES, "u2": (0.0, 0.0), "u3": (0.0, 0.0), "u1": (0.1, 1 - 1e-9)}
    assert "the strain limit" not in dropped(replace(KIRCHHOFF, ranges=close))["loads"]


def test_single_precision_has_less_room() -> None:
    small = {**RANGES, "m1": (1e-40, 0.5)}
    assert (
        "overflow and underflow of squares"
        not in dropped(replace(KIRCHHOFF, ranges=small))["strains"]
    )
    double = replace(KIRCHHOFF, ranges=small, precision="float64")
    assert "overflow and underflow of squares" in dropped(double)["strains"]


def test_a_choice_by_size_is_settled() -> None:
    """Loads always below gamma: no maximum, no minimum, no choice is left."""
    weak = replace(
        KIRCHHOFF, functions=("strains", "compliance"), ranges={**RANGES, "gamma": (90, 99)}
    )
    text = generate.render(weak)
    assert "np.where" not in text
    assert "np.maximum(y" not in text
    assert "the choice by size of load and gamma" in text


@pytest.mark.parametrize(
    "own",
    [
        KIRCHHOFF,
        replace(KIRCHHOFF, fixed={"p": 2.0}, ranges={n: r for n, r in RANGES.items() if n != "p"}),
    ],
    ids=["general p", "p = 2"],
)
def test_the_module_without_guards_has_the_same_numbers(own: Scene) -> None:
    """At corners and inside, beside the guarded module; no warning."""
    guarded = replace(own, ranges={})
    names: dict = {}
    for text, label in ((own, "bare"), (guarded, "guarded")):
        source = generate.render(text).replace("from __future__ import annotations\n", "")
        names[label] = {"__name__": "builtins"}
        exec(source, names[label])
    rng = random.Random(7)
    for _ in range(20):
        fields = [n for n in CONSTANTS if n not in own.fixed]
        given = {n: rng.choice([*RANGES[n], rng.uniform(*RANGES[n])]) for n in fields}
        for function in own.functions:
            over = LOADS if function in scene.FUNCTIONS_OF_LOADS else STRAINS
            corners = np.array(list(itertools.product(*over.values()))).T
            with np.errstate(all="raise", under="ignore"):
                got, want = (
                    names[label][function](corners, names[label]["Constants"](**given))
                    for label in ("bare", "guarded")
                )
            for a, b in zip(got, want, strict=True) if isinstance(got, tuple) else [(got, want)]:
                np.testing.assert_allclose(a, b, rtol=1e-13, atol=1e-15 * np.abs(b).max())


def test_constants_outside_their_range_are_refused() -> None:
    names: dict = {"__name__": "builtins"}
    source = generate.render(KIRCHHOFF).replace("from __future__ import annotations\n", "")
    exec(source, names)
    with pytest.raises(ValueError, match=r"p must lie in \[1\.5, 10\.0\], not 11\.0"):
        names["Constants"](alpha=0.7, beta=0.7, gamma=2, p=11)


@pytest.mark.parametrize("name", ["full_rod", "full_rod_p2", "dsdna"])
def test_intervals_enclose_the_values(name: str) -> None:
    """Every quantity of every kernel, at random points of random boxes."""
    rng = random.Random(name)
    own = scene.committed(name)
    for kernel in generate.kernels(own):
        box = {n: sorted(rng.uniform(0.4, 0.6) for _ in "ab") for n in scene.CONSTANT_NAMES}
        box["iota"] = sorted(rng.uniform(-0.1, 0.1) for _ in "ab")
        box |= {n: sorted(rng.uniform(-0.3, 0.3) for _ in "ab") for n in kernel.inputs}
        box |= {"v3": sorted(rng.uniform(0.8, 1.2) for _ in "ab")}
        del box["p"]
        known = _Intervals(kernel, replace(own, ranges=box, fixed={"p": 2.0}, moduli={}))
        at = {n: rng.choice([*ends, rng.uniform(*ends)]) for n, ends in box.items()} | {"p": 2.0}
        inputs = {n: at[n] for n in kernel.inputs}
        constants = {n: at[n] for n in scene.CONSTANT_NAMES}
        got = Evaluator(40).evaluate(kernel, inputs, constants)
        enclosed = 0
        for o in kernel.outputs:
            interval = known.of(o.expr)
            if not (interval.low.is_nan() or interval.high.is_nan()):
                enclosed += bool(interval.high.is_finite())
                value = arb(mpmath.nstr(got[o.array, o.index], 38))
                assert interval.low <= value + arb("1e-30")
                assert value - arb("1e-30") <= interval.high
        assert enclosed or kernel.name == "compliance"


@pytest.mark.parametrize(
    ("ranges", "sentence"),
    [
        ("p = [2]", "ranges must be a table of pairs of numbers"),
        ('p = ["1", 2]', "ranges must be a table of numbers"),
        ("p = [3, 2]", "range p must be two finite numbers in order, not 3.0, 2.0"),
        ("p = [0, 2]", "range p must be positive, not 0.0"),
        ("m4 = [0, 2]", "range 'm4' is unknown; did you mean"),
        ("p = [1, inf]", "range p must be two finite numbers in order"),
    ],
)
def test_bad_ranges_get_one_sentence(ranges: str, sentence: str) -> None:
    with pytest.raises(SceneError) as caught:
        scene.parse(f'name = "a"\n[ranges]\n{ranges}\n', "my.toml")
    assert sentence in str(caught.value)


def test_ranges_agree_with_the_other_numbers() -> None:
    with pytest.raises(SceneError, match="p is fixed and has a range"):
        Scene("a", fixed={"p": 2.0}, ranges={"p": (1.0, 3.0)})
    with pytest.raises(SceneError, match="the default of p is not in its range"):
        Scene("a", defaults={"p": 5.0}, ranges={"p": (1.0, 3.0)})
