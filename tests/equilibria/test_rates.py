"""The generated right-hand sides are the derived equations, and their Jacobians the derivatives."""

from __future__ import annotations

import random
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from rodproof.generated.equilibria import directors, euler_angles

RODS = (
    {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3},
    {"alpha": 1.3, "beta": 0.8, "zeta": 0.4, "eta": 2.1, "iota": 1.2, "gamma": 0.6, "p": 0.8},
    {"alpha": 0.9, "beta": 1.2, "zeta": 0.5, "eta": 1.4, "iota": 0.3, "gamma": 1.0, "p": 40.0},
)
SIZES = (1e-3, 1.0, 1e6, 1e12)
CASES = [(k, size) for k in range(len(RODS)) for size in SIZES]


def numbers(seed: str, count: int, size: float = 1.0) -> list[float]:
    rng = random.Random(seed)
    return [rng.uniform(-1, 1) * size for _ in range(count)]


def apart(got: Any, wanted: Any) -> float:
    """The largest difference, relative to the largest entry."""
    a, b = np.asarray(got, dtype=float), np.array(wanted, dtype=float)
    return float(np.abs(a - b).max() / np.abs(b).max())


def by_blocks(got: np.ndarray, wanted: Any) -> float:
    """The same, rows of different units apart."""
    b = np.array(wanted, dtype=float)
    cuts = [range(4), range(4, 7), range(7, 10)]
    return max(apart(got[list(rows)], b[list(rows)]) for rows in cuts)


def director_state(k: int, size: float) -> tuple[list[float], list[float], list[float]]:
    q = [2 * x for x in numbers(f"q{k}", 4)]  # not of norm one
    m, r = numbers(f"m{k}", 3, min(size, 1e3)), numbers(f"r{k}", 3)
    return [*q, *m, *r], numbers(f"n{k}", 3, size), numbers(f"b{k}", 3)


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(("k", "size"), CASES)
def test_directors_are_the_derived_equations(
    exact: ModuleType, k: int, size: float, linear: bool
) -> None:
    """Against the law and the balance of the fixed basis at 60 digits, the force given or carried;
    errors beside the largest rate of the block."""
    state, force, body = director_state(k, size)
    c = directors.Constants(**RODS[k])
    wanted = exact.director_rates(state, RODS[k], force, body, linear=linear)
    got = directors.rates(0.3, state, c, force, None, body, linear=linear)
    assert by_blocks(got, wanted) < 2e-15
    load = numbers("f", 3)
    carried = directors.rates(0.3, [*state, *force], c, None, load, body, linear=linear)
    assert (carried[:10] == got).all()
    assert carried[10:].tolist() == [-f for f in load]


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(("k", "size"), CASES)
def test_jacobian_of_directors(exact: ModuleType, k: int, size: float, linear: bool) -> None:
    state, force, body = director_state(k, size)
    c = directors.Constants(**RODS[k])
    whole = exact.jacobian(
        lambda x: exact.director_rates(x[:10], RODS[k], x[10:], body, linear=linear),
        [*state, *force],
    )
    got = directors.jacobian(0, [*state, *force], c, None, None, body, linear=linear)
    for columns in (range(4), range(4, 7), range(10, 13)):
        part = np.ix_(range(10), columns)
        assert by_blocks(got[part], np.array(whole, dtype=float)[part]) < 1e-14
    assert not got[:, 7:10].any() and not got[10:].any()
    given = directors.jacobian(0, state, c, force, None, body, linear=linear)
    assert (given == got[:10, :10]).all()


def euler_state(k: int, size: float) -> tuple[list[float], float]:
    phi, psi = numbers(f"angles{k}", 2, 3)
    theta = (0.9, -2.0, 4.1)[k]
    return [phi, theta, psi, *numbers(f"M{k}", 3, min(size, 1e3)), 0.1, 0.2, 0.3], size


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(("k", "size"), CASES)
def test_euler_angles_are_the_derived_system(
    exact: ModuleType, k: int, size: float, linear: bool
) -> None:
    state, thrust = euler_state(k, size)
    c = euler_angles.Constants(**RODS[k])
    wanted = np.array(exact.euler_rates(state, RODS[k], thrust, linear=linear), dtype=float)
    got = euler_angles.rates(0, state, c, thrust, linear=linear)
    for rows in (slice(0, 3), slice(3, 6), slice(6, 9)):
        assert apart(got[rows], wanted[rows]) < 4e-15
    assert got[5] == 0  # the first integral M3, exactly
    assert (euler_angles.rates(0, state[:6], c, thrust, linear=linear) == got[:6]).all()


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(("k", "size"), CASES)
def test_jacobian_of_euler_angles(exact: ModuleType, k: int, size: float, linear: bool) -> None:
    state, thrust = euler_state(k, size)
    c = euler_angles.Constants(**RODS[k])
    wanted = np.array(
        exact.jacobian(lambda x: exact.euler_rates(x, RODS[k], thrust, linear=linear), state),
        dtype=float,
    )
    got = euler_angles.jacobian(0, state, c, thrust, linear=linear)
    for columns in ([0], [1], [3, 4, 5]):
        for rows in ([0, 1, 2], [3, 4], [6, 7, 8]):
            part = np.ix_(rows, columns)
            if wanted[part].any():
                assert apart(got[part], wanted[part]) < 2e-14
    for column in (2, 6, 7, 8):
        assert not got[:, column].any()
    # M3' = 0 holds on the law only; off it the derived row is not zero, on it it is.
    assert not got[5].any() and np.abs(wanted[5]).max() <= 1e-14 * np.abs(wanted).max()


def quaternion(phi: float, theta: float, psi: float) -> np.ndarray:
    """The product of the three turns."""
    half, total = theta / 2, (phi + psi) / 2
    apart = (phi - psi) / 2
    return np.array([
        np.cos(half) * np.cos(total), -np.sin(half) * np.sin(apart),
        np.sin(half) * np.cos(apart), np.cos(half) * np.sin(total),
    ])  # fmt: skip


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(("k", "size"), CASES)
def test_the_two_systems_agree(k: int, size: float, linear: bool) -> None:
    """One rod in both: the same frame, the same couple in space, the same rates of either."""
    state, thrust = euler_state(k, size)
    c = euler_angles.Constants(**RODS[k])
    angles = np.array(state[:3])
    turn = np.array([
        [np.cos(angles[2]), np.sin(angles[2]), 0], [-np.sin(angles[2]), np.cos(angles[2]), 0],
        [0, 0, 1],
    ])  # fmt: skip
    m = turn @ state[3:6]
    x = np.array([*quaternion(*angles), *m, *state[6:]])
    by_angles = euler_angles.rates(0, state, c, thrust, linear=linear)
    by_frame = directors.rates(0, x, directors.Constants(**RODS[k]), (0, 0, thrust), linear=linear)
    step = 1e-5 / np.abs(by_angles[:3]).max()
    ahead, behind = (quaternion(*(angles + h * by_angles[:3])) for h in (step, -step))
    assert apart(by_frame[:4], (ahead - behind) / (2 * step)) < 1e-8
    spun = turn @ by_angles[3:6] + np.cross([0, 0, 1], m) * -by_angles[2]
    assert apart(by_frame[4:7], spun) < 1e-12
    assert apart(by_frame[7:], by_angles[6:]) < 1e-14


@pytest.mark.parametrize(
    "theta", [0.0, -0.0, np.pi, -np.pi, 2 * np.pi, 1000 * np.pi, 1e-320, np.nan]
)
def test_pole_is_refused_by_angles_and_nothing_to_directors(theta: float) -> None:
    c = euler_angles.Constants(**RODS[0])
    states = np.array([[0.2, 0.2], [1.0, theta], [0.3, 0.3], [0.1, 0.1], [0.2, 0.2], [0.3, 0.3]])
    for call in (euler_angles.rates, euler_angles.jacobian):
        said = rf"sin\(theta\) = 0: theta = {float(theta)!r}"
        with pytest.raises(ValueError, match=rf"{said} in state\[:, 1\], the first of 1 such of 2"):
            call(0, states, c, 2.0)
        alone = rf"{said}; the module directors" if np.isfinite(theta) else "must be finite"
        with pytest.raises(ValueError, match=alone):
            call(0, states[:, 1], c, 2.0)
    if np.isfinite(theta):
        x = [*quaternion(0.2, theta, 0.3), 0.1, 0.2, 0.3, 0, 0, 0]
        d = directors.Constants(**RODS[0])
        assert np.isfinite(directors.rates(0, x, d, (0, 0, 2.0))).all()
        assert np.isfinite(directors.jacobian(0, x, d, (0, 0, 2.0))).all()


def test_angles_that_are_not_finite_are_refused() -> None:
    """By their values, and not by what math.sin makes of them."""
    c = euler_angles.Constants(**RODS[0])
    for phi, theta in ((np.inf, 1.0), (0.2, -np.inf), (np.nan, 1.0)):
        with pytest.raises(ValueError, match=rf"phi = {phi} and theta = {theta} must be finite"):
            euler_angles.rates(0, [phi, theta, 0.3, 0.1, 0.2, 0.3], c, 2.0)


@pytest.mark.parametrize("size", [0.0, 1e-320, 1e-160, 1e154, 1e200, 1e308, np.inf])
def test_quaternion_without_a_norm_is_refused(size: float) -> None:
    """Of one rod and of many, with the rod named; just inside the bound the frame is right."""
    c, whole = directors.Constants(**RODS[0]), np.ones((10, 2, 3))
    whole[:4, 1, 2] = size
    said = rf"1e-150 < \|q\| < 1e150: q = {size!r}, {size!r}, {size!r}, {size!r}".replace(
        "+", r"\+"
    )
    for call in (directors.rates, directors.jacobian):
        with pytest.raises(ValueError, match=rf"{said}; .* divide it by its norm"):
            call(0, whole[:, 1, 2], c, (0, 0, 1))
        with pytest.raises(
            ValueError, match=rf"{said} in state\[:, 1, 2\], the first of 1 such of 6"
        ):
            call(0, whole, c, (0, 0, 1))
    with pytest.raises(ValueError, match=said):
        directors.frame(whole)


@pytest.mark.parametrize("size", [1e-149, 1e149])
def test_frame_does_not_know_the_size_of_its_quaternion(size: float) -> None:
    c, x = directors.Constants(**RODS[0]), np.array([0.8, 0.3, -0.4, 0.3, 1, 2, 3, 0, 0, 0])
    big = np.concatenate([size * x[:4], x[4:]])
    got, wanted = (directors.rates(0, y, c, (0.1, 0, 1)) for y in (big, x))
    assert apart(got[:4] / size, wanted[:4]) < 1e-15
    assert apart(got[4:], wanted[4:]) < 1e-15


def test_a_state_with_a_nan_has_rates_of_nan_and_the_others_their_own() -> None:
    c, whole = directors.Constants(**RODS[0]), np.ones((10, 3))
    whole[1, 1] = np.nan
    got = directors.rates(0, whole, c, (0, 0, 1))
    assert np.isnan(got[:, 1]).all()
    alone = directors.rates(0, whole[:, [0, 2]], c, (0, 0, 1))
    assert np.allclose(got[:, [0, 2]], alone, rtol=1e-14, atol=0)
    assert np.isnan(directors.rates(0, whole[:, 1], c, (0, 0, 1))).all()


def test_near_the_pole_angles_are_taken() -> None:
    c = euler_angles.Constants(**RODS[0])
    for theta in (1e-6, -1e-300, np.pi - 1e-6):
        assert np.isfinite(euler_angles.rates(0, [0, theta, 0, 0.1, 0.2, 0.3], c, 2.0)).all()


def test_many_rods_are_the_single_ones() -> None:
    """Vectorised over rods and nodes, forces and couples per rod, fields of s at every node."""
    rng = np.random.default_rng(1)
    state, force, body = (rng.normal(size=(rows, 4, 5)) for rows in (10, 3, 3))
    c = directors.Constants(**RODS[0])
    s = rng.uniform(size=(4, 5))
    turning = lambda s: np.array([np.cos(s), np.sin(s), s])  # noqa: E731
    for couple in (body, turning):
        whole = directors.rates(s, state, c, force, None, couple)
        tangent = directors.jacobian(s, state, c, force, None, couple)
        for i, j in np.ndindex(4, 5):
            one = couple[:, i, j] if couple is body else couple
            args = (s[i, j], state[:, i, j], c, force[:, i, j], None, one)
            assert apart(directors.rates(*args), whole[..., i, j]) < 1e-14
            assert apart(directors.jacobian(*args), tangent[..., i, j]) < 1e-14
    e = euler_angles.Constants(**RODS[0])
    angles, thrust = rng.uniform(0.2, 1, (9, 6)), rng.normal(size=6)
    whole, tangent = (f(0, angles, e, thrust) for f in (euler_angles.rates, euler_angles.jacobian))
    for i in range(6):
        assert apart(euler_angles.rates(0, angles[:, i], e, thrust[i]), whole[:, i]) < 1e-14
        assert apart(euler_angles.jacobian(0, angles[:, i], e, thrust[i]), tangent[..., i]) < 1e-14


def test_frame_and_loads() -> None:
    """The columns are an orthonormal right-handed frame; loads are what the rates see."""
    state, force, _ = director_state(0, 1.0)
    c = directors.Constants(**RODS[0])
    R = directors.frame(state)
    assert apart(R.T @ R, np.eye(3)) < 1e-15 and np.linalg.det(R) == pytest.approx(1)
    m, n = directors.loads(0, state, force)
    assert m.tolist() == state[4:7] and apart(R @ n, force) < 1e-15
    _, v = directors.strains(m, n, c)
    assert apart(R @ v, directors.rates(0, state, c, force)[7:10]) < 1e-15
    many = np.array(state)[:, None] * np.ones(3)
    assert directors.frame(many).shape == (3, 3, 3) and (directors.frame(many)[..., 2] == R).all()


@pytest.mark.parametrize(
    ("state", "how", "message"),
    [
        (
            np.zeros(9),
            {"force": (0, 0, 1)},
            r"must have the shape \(10, ...\) or \(13, ...\)",
        ),
        (np.zeros(()), {"force": (0, 0, 1)}, "state must have the shape"),
        (np.ones(10), {}, "10 rows needs the force"),
        (np.ones(13), {"force": (0, 0, 1)}, "one of 13 carries it"),
        (np.ones(10), {"force": (0, 1)}, r"force must have the shape \(3, ...\), not \(2,\)"),
        (np.ones(10), {"force": (0, 0, 1), "body_force": (1, 0, 0)}, "13 rows, only"),
        (np.ones(10), {"force": (0, 0, 1), "body_couple": 3.0}, "body_couple must have the shape"),
    ],
)
def test_wrong_shapes_are_refused(state: np.ndarray, how: dict, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        directors.rates(0, state, directors.Constants(**RODS[0]), **how)
