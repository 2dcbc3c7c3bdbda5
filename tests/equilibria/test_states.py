"""The closed-form states: angles to the last digits, states of the derivation, what exists when."""

from __future__ import annotations

import math
import random
from types import ModuleType

import numpy as np
import pytest

from rodproof.derivations.symbols import CONSTANTS, gamma
from rodproof.derivations.theory import couple as couples
from rodproof.derivations.theory import euler
from rodproof.derivations.theory import thrust as thrusts
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.generated.equilibria import directors, states

EPS = 2.0**-52
POWERS = (0.3, 0.7, 1.0, 2.0, 3.3, 8.0, 40.0, 1000.0)
EXCESS = (1e-12, 1e-9, 1e-4, 0.3, 9.0, 1e3, 1e6, 1e12, 1e100)
CHIRAL = {"alpha": 0.7, "beta": 1.1, "zeta": 0.5, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3}


def soft_rod(seed: int, p: float) -> dict[str, float]:
    """Constants of a rod that shears: zeta is small enough."""
    rng = random.Random(f"soft {seed} {p}")
    beta, eta, g = (rng.uniform(0.5, 2) for _ in range(3))
    iota = rng.uniform(-0.9, 0.9) * beta * eta
    b = beta**2 / (beta**2 * eta**2 - iota**2)
    zeta = rng.uniform(0.1, 0.9) * (b + math.sqrt(b)) ** -0.5
    return {"alpha": rng.uniform(0.5, 2), "beta": beta, "zeta": zeta, "eta": eta, "iota": iota,
            "gamma": g, "p": p}  # fmt: skip


def moduli(exact: ModuleType, rod: dict[str, float]) -> tuple:
    """a, b, c of the derivation at these floats."""
    symbols = tuple(CONSTANTS)
    found = (thrusts.shear_compliance(), thrusts.axial_compliance(), thrusts.softness())
    return tuple(exact.evaluator(found, symbols)(*(rod[s.name] for s in symbols)))


def angle(exact: ModuleType, rod: dict[str, float], N: float) -> tuple:
    """theta by the derived equation N^-p = (c x)^p - w^(p/2), as a root in X with
    e^-X = w^(p/2)/(c x)^p, and 1 - e^-X at the threshold, which is how well it is determined."""
    ctx = exact.ctx
    _, b, c = moduli(exact, rod)
    p, nu = ctx.mpf(rod["p"]), ctx.mpf(N) / ctx.mpf(rod["gamma"])
    top = p / 2 * ctx.log(c**2 / b)

    def squares(X: object) -> tuple:
        grown = ctx.exp(2 * X / p)
        below = c**2 + c * grown
        return (b * grown * ctx.expm1(2 * (top - X) / p)) / below, (c * grown + b * grown) / below

    def off(log_X: object) -> object:
        X = ctx.exp(log_X)
        return -ctx.log(c**2 * squares(X)[1]) / 2 - ctx.log(-ctx.expm1(-X)) / p - ctx.log(nu)

    low, high = -(p * ctx.log(nu * c + 1) + 200), ctx.log(top)
    for _ in range(400):
        middle = (low + high) / 2
        low, high = (middle, high) if off(middle) > 0 else (low, middle)
        if high - low < ctx.mpf(10) ** -50 * abs(high):
            break
    sine, cosine = squares(ctx.exp(high))
    return ctx.atan2(ctx.sqrt(sine), ctx.sqrt(cosine)), -ctx.expm1(-top)


@pytest.mark.parametrize("p", POWERS)
def test_sheared_angle_to_the_last_digits(exact: ModuleType, p: float) -> None:
    """From 1e-12 above the threshold to 1e100 times it, for the floats as they are. The difference
    c^2 - b enters as 1 - (b/c^2)^(p/2); what it loses is beside the point."""
    for seed in range(3):
        rod = soft_rod(seed, p)
        c = states.Constants(**rod)
        start = states.threshold(c)
        N = np.array([start * (1 + e) for e in EXCESS])
        got = states.sheared_angle(N, c)
        for thrust, value in zip(N, got, strict=True):
            wanted, rest = angle(exact, rod, thrust)
            error = abs(exact.ctx.mpf(float(value)) - wanted) / wanted
            assert error < EPS * (4 + 4 / rest), (seed, thrust / start, float(error) / EPS)
        assert np.allclose(states.sheared_angle(-N, c), math.pi - got, rtol=2 * EPS, atol=0)


@pytest.mark.parametrize("p", POWERS)
def test_threshold_and_limit(exact: ModuleType, p: float) -> None:
    """Both rounded once: the threshold of the derivation, and its limiting angle."""
    ctx = exact.ctx
    for seed in range(6):
        rod = soft_rod(seed, p)
        values = [rod[s.name] for s in CONSTANTS]
        _, b, c = moduli(exact, rod)
        power = ctx.mpf(p)
        wanted = ctx.mpf(rod["gamma"]) * (c**power - b ** (power / 2)) ** (-1 / power)
        constants = states.Constants(**rod)
        assert states.threshold(constants) == pytest.approx(float(wanted), rel=1e-16)
        (cosine,) = exact.evaluator((thrusts.limiting_cosine(),), tuple(CONSTANTS))(*values)
        assert states.limiting_angle(constants) == pytest.approx(
            float(ctx.acos(cosine)), rel=2 * EPS
        )
        if p >= 1:
            last = states.sheared_angle(1e300, constants)
            assert last == pytest.approx(states.limiting_angle(constants), rel=4 * EPS)


def test_p_two_is_one_linear_equation() -> None:
    """b t + (b/c^2)^(p/2) c (1 + t) = c at p = 2, whatever N: the slope does not depend on t."""
    c = states.Constants(**{**CHIRAL, "p": 2.0})
    branch = states._branch(c)
    rest = -math.expm1(-branch.log_quotient)
    at = [
        states._growth(np.array(t), np.array(0.5), np.log(2.0), rest, branch, 2.0)[1]
        for t in (0.0, 0.3, 2.0)
    ]
    assert at == pytest.approx([math.exp(-branch.log_quotient)] * 3, rel=1e-14)


@pytest.mark.parametrize("factor", [0.5, 1.2, 50.0, 1e6])
@pytest.mark.parametrize("p", [0.7, 3.3, 40.0])
def test_thrust_states_are_the_derived_ones(exact: ModuleType, p: float, factor: float) -> None:
    """Strains of the derivation at the exact angle; balance of couples; energy."""
    ctx, rod = exact.ctx, soft_rod(1, p)
    c = states.Constants(**rod)
    N = float(states.threshold(c)) * factor
    names = (thrusts.N, theta, psi, *(s for s in CONSTANTS if s != gamma))
    derived = exact.evaluator(thrusts.strains_from_rest(), names)
    found = states.equilibria(N, c)
    assert [s.kind for s in found][: 1 + (factor > 1)] == ["sheared", "straight"][factor < 1 :]
    energies = []
    for state in found:
        tilt = ctx.mpf(float(state.theta))
        if state.kind == "sheared":
            tilt = angle(exact, rod, N)[0]
        elif state.theta > 3:
            tilt = ctx.pi
        scaled = ctx.mpf(N) / ctx.mpf(rod["gamma"])
        at = (scaled, tilt, 0, *(rod[s.name] for s in names[3:]))
        wanted = [float(x) for x in derived(*at)]
        got = [*state.u, *state.v[:2], state.v[2] - 1]
        assert np.allclose(got, wanted, rtol=2e-13, atol=1e-15 * max(map(abs, wanted)))
        # The couple about e_2 that r' x n leaves, relative to the force.
        lever = state.v[2] * state.sine * N + state.v[0] * state.cosine * N
        assert abs(lever) < 4e-15 * abs(N) * max(1, np.abs(state.v).max())
        energies.append(_energy(exact, rod, N, tilt))
        assert float(state.energy) == pytest.approx(float(energies[-1]), rel=1e-13)
    assert energies == sorted(energies)


def _energy(exact: ModuleType, rod: dict, N: float, tilt: object) -> object:
    """-W* - N cos theta, with W* = y^2/(2 gamma) 2F1(1/p, 2/p; 1 + 2/p; -(y/gamma)^p)."""
    ctx = exact.ctx
    a, b, _ = moduli(exact, rod)
    y = ctx.mpf(N) * ctx.sqrt(a * ctx.sin(tilt) ** 2 + b * ctx.cos(tilt) ** 2)
    p, g = ctx.mpf(rod["p"]), ctx.mpf(rod["gamma"])
    z = (y / g) ** p
    closed = y**2 / (2 * g) * ctx.hyp2f1(1 / p, 2 / p, 1 + 2 / p, -z)
    return -closed - ctx.mpf(N) * ctx.cos(tilt)


@pytest.mark.parametrize("p", [0.7, 2.0, 3.3, 40.0])
def test_sheared_state_takes_over_at_the_threshold(exact: ModuleType, p: float) -> None:
    """Just above the threshold the sheared state is the lower one, by the square of the excess;
    the gap to the straight state is what the difference of the extensions adds up to."""
    ctx, rod = exact.ctx, soft_rod(2, p)
    c = states.Constants(**rod)
    start = states.threshold(c)
    gaps = []
    for excess in (1e-4, 1e-3, 1e-2):
        N = start * (1 + excess)
        tilt, _ = angle(exact, rod, N)
        gaps.append(_energy(exact, rod, N, ctx.mpf(0)) - _energy(exact, rod, N, tilt))
        longer = states.sheared(N, c).along - states.straight(N, c).along
        assert gaps[-1] > 0 and longer > 0
    assert float(gaps[1] / gaps[0]) == pytest.approx(100, rel=0.05)
    assert float(gaps[2] / gaps[1]) == pytest.approx(100, rel=0.5)


@pytest.mark.parametrize("tilt", [1e-9, 0.3, 1.2, math.pi / 2, 2.5])
@pytest.mark.parametrize("M", [-3.0, 1e-4, 40.0])
def test_couple_states_are_the_derived_ones(exact: ModuleType, M: float, tilt: float) -> None:
    """Rates of the angles, strains, shape of the center line at M_1 = -M sin theta (gamma = 1)."""
    rod = {**CHIRAL, "gamma": 1.0}
    c = states.Constants(**rod)
    state = states.helix(M, tilt, c)
    names = (euler.M1, theta, psi, *(s for s in CONSTANTS if s != gamma))
    helix = couples.helix()
    first = -exact.ctx.mpf(M) * exact.ctx.sin(exact.ctx.mpf(tilt))
    at = (first, tilt, 0, *(rod[s.name] for s in names[3:]))
    turn, spin = map(float, exact.evaluator(helix.rates, names)(*at))
    assert state.precession == pytest.approx(turn, rel=1e-14)
    assert state.spin == pytest.approx(spin, rel=1e-13, abs=1e-15 * abs(turn))
    strains = [float(x) for x in exact.evaluator(helix.strains, names)(*at)]
    assert np.allclose([*state.u, *state.v], strains, rtol=1e-14, atol=1e-15)
    shape = couples.shape()
    of = (euler.phi_s, theta, couples.STRAINS[5])
    wanted = exact.evaluator((shape.curvature, shape.torsion), of)(turn, tilt, strains[5])
    assert state.curvature == pytest.approx(float(wanted[0]), rel=1e-13)
    assert state.torsion == pytest.approx(float(wanted[1]), rel=1e-13, abs=1e-16)
    for s in (0.4, 2.0):
        line = exact.evaluator(tuple(couples.center_line()), (*of, couples.s))
        wanted = np.array(line(turn, tilt, strains[5], s), dtype=float)
        wanted -= np.array(line(turn, tilt, strains[5], 0), dtype=float)
        assert np.allclose(state.center_line(s), wanted, rtol=1e-12, atol=1e-12)


def test_helix_survives_a_vanishing_angle() -> None:
    """As theta goes to 0 the helix becomes the twisted rod, in every digit that theta allows."""
    c = states.Constants(**CHIRAL)
    end = states.twisted(2.0, c)
    assert end.kind == "twisted"
    for tilt in (0.0, 1e-300, 1e-12):
        near = states.helix(2.0, tilt, c)
        assert near.precession == pytest.approx(end.precession, rel=1e-15)
        assert near.spin == pytest.approx(end.spin, rel=1e-15)
        assert np.allclose(near.directors(0.7), end.directors(0.7), atol=2 * tilt, rtol=1e-15)
    bent = states.circle(2.0, c)
    assert bent.kind == "circle" and bent.along == 0 and bent.torsion == 0
    turn = 2 * math.pi / bent.precession
    assert np.allclose(bent.center_line(turn), 0, atol=1e-14)


@pytest.mark.parametrize("state", ["sheared", "straight", "helix", "circle", "twisted"])
def test_directors_and_rows(exact: ModuleType, state: str) -> None:
    """The frame is that of the Euler angles; the rows hold the same frame, couple and place."""
    c = states.Constants(**CHIRAL)
    made = {
        "sheared": lambda: states.sheared(2.0, c),
        "straight": lambda: states.straight(0.3, c, turned=True),
        "helix": lambda: states.helix([2.0, -1.0], [0.4, 2.2], c),
        "circle": lambda: states.circle(1.0, c),
        "twisted": lambda: states.twisted(-1.0, c),
    }[state]()
    s = 0.8
    frame, rows = made.directors(s), made.rows(s)
    assert np.allclose(directors.frame(rows), frame, atol=4 * EPS)
    angles = made.angles(s)
    derived = exact.evaluator(tuple(e for d in euler.directors() for e in d), (phi, theta, psi))
    for k in np.ndindex(angles.shape[1:]):
        wanted = np.array(derived(*angles[(..., *k)]), dtype=float).reshape(3, 3).T
        assert np.allclose(frame[(..., *k)], wanted, atol=4 * EPS)
    assert np.allclose(np.einsum("ik...,k...->i...", frame, made.loads_at(s)[0])[2], made.couple)
    u, v = directors.strains(*made.loads_at(s), directors.Constants(**CHIRAL))
    assert np.allclose(made.strains_at(s), (u, v), atol=1e-14)


def test_what_fails_is_said_with_its_size() -> None:
    stiff = states.Constants(**{**CHIRAL, "zeta": 3.0})
    with pytest.raises(ValueError, match=r"softer in shear than in extension.* not -0\.30"):
        states.threshold(stiff)
    between = states.Constants(**{**CHIRAL, "zeta": 1.3})
    with pytest.raises(ValueError, match=r"must exceed .* not 0\.17.* against 0\.64"):
        states.sheared(5.0, between)
    c = states.Constants(**CHIRAL)
    start = states.threshold(c)
    for N in (np.nextafter(start, 0), 0.9 * start, -0.9 * start, 0.0, math.nan, math.inf):
        with pytest.raises(ValueError, match=r"exceed the threshold 0\.6416"):
            states.sheared_angle([2.0, N], c)
    assert states.sheared_angle(np.nextafter(start, 9), c) > 0
    weak = states.Constants(**{**CHIRAL, "eta": 0.8})
    with pytest.raises(ValueError, match=r"no straight state at thrust = 1.*: v_3 > 0 fails"):
        states.straight(1e9, weak, turned=True)
    with pytest.raises(ValueError, match="v_3 > 0 fails"):
        states.helix(1e9, 0.1, states.Constants(**{**CHIRAL, "eta": 0.5, "iota": 0.5}))
    with pytest.raises(ValueError, match=r"theta, .* must lie in \[0, pi\], not 4\.0"):
        states.helix([1.0, 2.0], [0.3, 4.0], c)


def test_list_of_states() -> None:
    c = states.Constants(**CHIRAL)
    start = states.threshold(c)

    def kinds(N: float) -> list[tuple[str, float]]:
        return [(s.kind, round(float(s.theta), 2)) for s in states.equilibria(N, c)]

    assert kinds(0.0) == [("straight", 0.0)]
    assert kinds(0.9 * start) == [("straight", 0.0), ("straight", 3.14)]
    assert kinds(-0.9 * start) == [("straight", 3.14), ("straight", 0.0)]
    assert [k for k, _ in kinds(1.1 * start)] == ["sheared", "straight", "straight"]
    weak = states.Constants(**{**CHIRAL, "eta": 0.8, "zeta": 0.3})
    assert [(s.kind, float(s.cosine) > 0) for s in states.equilibria(1e9, weak)] == [
        ("sheared", True), ("straight", True),
    ]  # fmt: skip
    with pytest.raises(ValueError, match="finite"):
        states.equilibria(math.inf, c)
