"""Section 4 by solving problems: what integrators and continuation find are the closed forms."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rodproof.codegen.measure import branches
from rodproof.codegen.measure.branches import SOFT
from rodproof.codegen.scene import CONSTANT_NAMES
from rodproof.generated.equilibria import directors, states

POWERS = (0.8, 3.3, 20.0)


def rod(p: float) -> states.Constants:
    return states.Constants(**{name: getattr(SOFT, name) for name in CONSTANT_NAMES} | {"p": p})


@pytest.fixture(scope="module", params=POWERS)
def found(request: pytest.FixtureRequest) -> tuple[states.Constants, branches.Found]:
    constants = rod(request.param)
    return constants, branches.bifurcation(constants)


def test_continuation_finds_the_derived_threshold(
    found: tuple[states.Constants, branches.Found], record_property: pytest.RecordProperty
) -> None:
    _, start = found
    record_property("threshold", f"{start.derived!r} derived, {start.thrust!r} found")
    assert start.apart < 1e-11


def test_branch_is_switched_and_followed(found: tuple[states.Constants, branches.Found]) -> None:
    """Pseudo-arclength from the null direction; the angles are the closed form's."""
    constants, start = found
    followed = branches.sheared_branch(constants, start, steps=3, reach=0.15)
    thrusts, angles = np.array(followed).T
    assert (np.diff(thrusts) > 0).all() and thrusts[0] > start.derived
    assert np.allclose(angles, states.sheared_angle(thrusts, constants), rtol=1e-9, atol=0)
    assert angles[-1] > 0.3


def test_a_wrong_law_has_another_threshold() -> None:
    """The linear rod's straight branch loses its neighbour elsewhere: the check can fail."""
    derived = states.threshold(SOFT)
    c = branches.law(SOFT)
    x = np.array([1, 0, 0, 0, 0, 0, 0, 0, 0, 0.0])
    bent = [
        directors.jacobian(0, x, c, (0, 0, derived), linear=linear)[5, 2]
        for linear in (False, True)
    ]
    assert abs(bent[0]) < 1e-14 < 1e-3 < abs(bent[1])


@pytest.mark.parametrize("p", POWERS)
@pytest.mark.parametrize("kind", ["straight", "pushed", "sheared", "twisted", "helix", "circle"])
def test_integration_stays_on_the_closed_form(kind: str, p: float) -> None:
    c = rod(p)
    thrust = 1.5 * states.threshold(c)
    state = {
        "straight": lambda: states.straight(thrust, c),
        "pushed": lambda: states.straight(0.3, c, turned=True),
        "sheared": lambda: states.sheared(thrust, c),
        "twisted": lambda: states.twisted(-1.5, c),
        "helix": lambda: states.helix(1.5, 0.7, c),
        "circle": lambda: states.circle(1.5, c),
    }[kind]()
    kept = branches.stay(state, c, length=1.0)
    assert kept.away < 1e-10
    assert max(kept.moment, kept.twisting_couple, kept.energy) < 1e-11


def test_first_integrals_of_a_rod_that_is_no_closed_form() -> None:
    """Bent, twisted and sheared, under a force at an angle: three integrals hold, and the couple
    itself does not."""
    start = np.array([0.8, 0.3, -0.4, 0.3, 0.7, -0.5, 0.4, 0, 0, 0])
    force = (0.6, -0.3, 1.1)
    got = branches.integrate(start, force, SOFT, np.linspace(0, 3, 40))
    assert max(branches.first_integrals(got.y, force, SOFT)) < 1e-10
    assert np.ptp(got.y[4]) > 0.1 and np.ptp(np.linalg.norm(got.y[4:7], axis=0)) > 0.1
    assert np.linalg.norm(got.y[:4], axis=0) == pytest.approx(np.linalg.norm(start[:4]), rel=1e-10)


@pytest.mark.parametrize("p", POWERS)
def test_boundary_values_have_both_branches(p: float) -> None:
    """Free ends: either branch, by where it starts; clamped: only the straight one."""
    c = rod(p)
    thrust = 2 * states.threshold(c)
    angle = float(states.sheared_angle(thrust, c))
    upright = branches.solve(thrust, c, 0.0)
    tilted = branches.solve(thrust, c, angle + 0.05)
    held = branches.solve(thrust, c, angle, "clamped")
    assert upright.theta[1] < 1e-8 and held.theta[0] < 1e-8
    assert tilted.theta == pytest.approx((angle, angle), rel=1e-7)
    for solved, state in ((upright, states.straight), (tilted, states.sheared)):
        closed = state(thrust, c)
        assert solved.energy == pytest.approx(float(closed.energy), rel=1e-9)
        assert solved.height == pytest.approx(float(closed.along), rel=1e-7)
    assert tilted.energy < upright.energy


def test_command_says_how_far_apart() -> None:
    command = Path(sys.executable).with_name("rodproof")
    done = subprocess.run(
        [command, "equilibria", "--json"], capture_output=True, text=True, check=True
    )
    told = json.loads(done.stdout)
    start = told["bifurcation"]
    assert abs(start["thrust"] / start["derived"] - 1) < 1e-11
    assert all(abs(b["theta"] - b["derived"]) < 1e-10 for b in told["branch"])
    assert max(s["away"] for s in told["stays"]) < 1e-10
    assert all(e["sheared"] < e["straight"] for e in told["energies"])
