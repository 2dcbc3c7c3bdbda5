"""The fixed text of the module of states; formulas of the derivation fill the fields."""

from __future__ import annotations

from string import Template

STATE = Template('''\
@dataclass(frozen=True)
class State:
    """A rod in equilibrium whose strains are constant in a frame that turns at a constant rate.

    The force is thrust g_3, the couple is couple g_3 (force times length); theta, in radians, is
    the angle of d_3 and g_3, with sine and cosine. In the intermediate frame e_k = R_3(phi)
    R_2(theta), phi = precession s, psi = spin s (both rates in 1/length), the strains are
    u (3, ...), in 1/length, and v (3, ...). energy is the stored energy less the work of the loads,
    per length, a force: -W* - thrust cos(theta), by which states under one load are compared. kind
    is straight, sheared, twisted, helix or circle. Numbers, or arrays of one shape. The methods
    take s, the place along the rod, as a number or an array that fits that shape.
    """

    kind: str
    thrust: Number
    couple: Number
    theta: Number
    sine: Number
    cosine: Number
    precession: Number
    spin: Number
    u: Array
    v: Array
    energy: Number

    @property
    def across(self) -> Number:
        """The tangent's length across g_3; its length along g_3 is `along`."""
        return $across

    @property
    def along(self) -> Number:
        """The tangent's length along g_3: the height of the rod over its reference length."""
        return $along

    @property
    def curvature(self) -> Number:
        """Of the center line, 1/length."""
        return np.abs(self.across * self.precession) / (self.across**2 + self.along**2)

    @property
    def torsion(self) -> Number:
        """Of the center line, 1/length; positive where it is a right-handed helix."""
        return self.along * self.precession / (self.across**2 + self.along**2)

    def angles(self, s: Number) -> Array:
        """phi, theta, psi at s, (3, ...), in radians."""
        return _stack((self.precession * s, self.theta + 0 * s, self.spin * s))

    def directors(self, s: Number) -> Array:
        """(3, 3, ...): column k - 1 is d_k in the fixed basis."""
        turns = (self.precession * s, self.spin * s)
        sines = [np.sin(turns[0]), self.sine, np.sin(turns[1])]
        cosines = [np.cos(turns[0]), self.cosine, np.cos(turns[1])]
        entries = _stack(_frame(sines, cosines))
        return entries.reshape(3, 3, *entries.shape[1:])

    def center_line(self, s: Number) -> Array:
        """r(s) from r(0) = 0, (3, ...), in the fixed basis, in the unit of length of s."""
        half = self.precession * s / 2
        reach = self.across * s * np.sinc(half / np.pi)
        return _stack((reach * np.cos(half), reach * np.sin(half), self.along * s))

    def strains_at(self, s: Number) -> Pair:
        """u and v in the directors at s, (3, ...) each."""
        return self._in_directors(self.u, s), self._in_directors(self.v, s)

    def loads_at(self, s: Number) -> Pair:
        """m (force times length) and n (force) in the directors at s, (3, ...) each."""
        tilt = _stack(_axis(self.sine, self.cosine))
        return self._in_directors(self.couple * tilt, s), self._in_directors(self.thrust * tilt, s)

    def rows(self, s: Number) -> Array:
        """The state of `rodproof.generated.equilibria.directors`: q, m, r, (10, ...)."""
        first, second = self.precession * s, self.spin * s
        # half the angle from its sine and cosine, without losing small ones
        low = np.sqrt((1 + np.abs(self.cosine)) / 2)
        high = self.sine / (2 * low)
        up = self.cosine >= 0
        cosine, sine = np.where(up, low, high), np.where(up, high, low)
        plus, minus = (first + second) / 2, (first - second) / 2
        q = (cosine * np.cos(plus), -sine * np.sin(minus), sine * np.cos(minus),
             cosine * np.sin(plus))
        return _stack((*q, *self.loads_at(s)[0], *self.center_line(s)))

    def _in_directors(self, vector: Array, s: Number) -> Array:
        """Components in the directors from those in the intermediate frame, at s."""
        sine, cosine = np.sin(self.spin * s), np.cos(self.spin * s)
        x, y, z = vector
        return _stack((x * cosine + y * sine, y * cosine - x * sine, z + 0 * cosine))
''')

BRANCH = Template('''\
@dataclass(frozen=True)
class Branch:
    """Where a rod shears under a thrust, once a set of constants; nothing of it depends on N.

    threshold + remainder is the thrust at which the sheared states begin, to twice a float's
    digits. ratio is b/c, quotient b/c^2, log_quotient -p/2 log(b/c^2) for a = 1/zeta^2,
    b = beta^2/(beta^2 eta^2 - iota^2), c = a - b. limit holds sin^2 and cos^2 of the last angle.
    """

    threshold: float
    remainder: float
    ratio: float
    quotient: float
    log_quotient: float
    limit: tuple[float, float]


@cache
def _branch(constants: Constants) -> Branch:
    """The branch in exact arithmetic, rounded at the end; ValueError names what fails."""
    exact = (Fraction(getattr(constants, name)) for name in ("beta", "zeta", "eta", "iota"))
    beta, zeta, eta, iota = exact
    a = $a
    b = $b
    c = $c
    if c <= 0:
        raise ValueError(
            "no sheared states: the rod must be softer in shear than in extension,"
            f" 1/zeta^2 - beta^2/(beta^2 eta^2 - iota^2) > 0, not {float(c)!r}"
        )
    if c**2 <= b:
        raise ValueError(
            "no sheared states: 1/zeta^2 - beta^2/(beta^2 eta^2 - iota^2) must exceed"
            f" beta (beta^2 eta^2 - iota^2)^(-1/2), not {float(c)!r} against {math.sqrt(b)!r}"
        )
    sharp = $limit
    with localcontext() as context:
        context.prec = 100
        context.Emax, context.Emin = MAX_EMAX, MIN_EMIN
        p, gamma = Decimal(constants.p), Decimal(constants.gamma)
        log_quotient = p / 2 * (_decimal(c**2 / b)).ln()
        threshold = gamma / _decimal(c) * (-(1 - (-log_quotient).exp()).ln() / p).exp()
        if threshold.adjusted() > 307:
            raise ValueError(f"the threshold of the sheared states, {threshold:.3e}, is no float")
        start = float(threshold)
        remainder = float(threshold - Decimal(start))
    return Branch(
        start,
        remainder,
        float(b / c),
        float(b / c**2),
        float(log_quotient),
        (float(1 - sharp), float(sharp)),
    )


def _decimal(value: Fraction) -> Decimal:
    return Decimal(value.numerator) / Decimal(value.denominator)


def threshold(constants: Constants) -> float:
    """N_thresh, a force: sheared states exist for |N| > N_thresh (n-thresh, extra-threshold-sharp).

    N_thresh^-p = c^p - b^(p/2) in units of gamma, rounded once. Raises ValueError, with the
    condition on the moduli that fails and by how much.
    """
    return _branch(constants).threshold


def limiting_angle(constants: Constants) -> float:
    """The angle of the sheared states as N grows, in radians; raises as `threshold`."""
    sine, cosine = _branch(constants).limit
    return math.atan2(math.sqrt(sine), math.sqrt(cosine))


def sheared_angle(thrust: ArrayLike, constants: Constants) -> Array:
    """theta of the sheared state under N g_3, in (0, pi/2) for N > 0, in (pi/2, pi) for N < 0.

    thrust is N, a number or an array, whose shape the angle, in radians, has. With y the load
    radius over gamma and c N x = (1 + y^p)^(1/p)
    (x = cos theta, N over gamma) the equation is y^2 + (1 + y^p)^(2/p)/c = a N^2, its slope in y^2
    between 1 and 1 + 1/c for p >= 2; for p = 2 it is linear. It is solved less its value
    at the threshold, for t in sin^2 theta = b/c t (1 - (N_thresh/N)^2): monotonically by Newton,
    to the last digits from just above the threshold to infinity. Raises ValueError where
    |N| <= N_thresh, with the threshold, and as `threshold` does.
    """
    N = np.asarray(thrust, dtype=float)
    sine, cosine = _sheared(N, constants)
    return np.asarray(np.arctan2(sine, np.where(N > 0, cosine, -cosine)))


def _sheared(N: Array, constants: Constants) -> tuple[Array, Array]:
    """sin theta and |cos theta| of the sheared states."""
    branch, p = _branch(constants), constants.p
    size = np.abs(N)
    start, rest = branch.threshold, -math.expm1(-branch.log_quotient)
    over = (size - start) - branch.remainder  # exact near the threshold
    bad = np.flatnonzero(~((over > 0) & (size < math.inf)))
    if bad.size:
        first = float(np.ravel(N)[bad[0]])
        raise ValueError(
            f"no sheared state at N = {first!r}: |N| must be finite and exceed the threshold"
            f" {start!r}, which lies {start - abs(first)!r} above"
        )
    with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
        over = over / size  # 1 - N_thresh/N
        under = start / size
        rise = over * (1 + under)  # 1 - (N_thresh/N)^2
        per = under**2 / rise  # the reciprocal of (N/N_thresh)^2 - 1
        log_rise = np.log(rise) + 2 * (np.log(size) - math.log(start))
        t = np.full(np.shape(N), 1 / branch.ratio if p >= 2 else 0.0)
        for _ in range(100):
            growth, slope = _growth(t, per, log_rise, rest, branch, p)
            step = (branch.ratio * t + growth - 1) / (branch.ratio + slope)
            t = t - step
            if not (np.abs(step) > 2**-52 * t).any():
                break
        growth, _ = _growth(t, per, log_rise, rest, branch, p)
        sine, cosine = branch.ratio * t * rise, under**2 + rise * growth
    return np.sqrt(sine), np.sqrt(cosine)


def _growth(
    t: Array, per: Array, log_rise: Array, rest: float, branch: Branch, p: float
) -> tuple[Array, Array]:
    """((1 + y^p)^(2/p) over its value at the threshold, less 1), times per; its slope by t.

    At (y/y_thresh)^2 = 1 + (1 + t)/per.
    """
    lean = 1 + t + per
    log_square = np.where(per < 1, np.log(lean) + log_rise, np.log1p((1 + t) / per))
    up = p / 2 * log_square - branch.log_quotient
    above = up > 0
    beside = np.exp(np.minimum(-up, 0)) * rest
    beneath = np.exp(np.minimum(up, 0))
    inside = beneath * -np.expm1(-p / 2 * log_square)
    power = 2 / p * np.where(above, up + np.log1p(beside), np.log1p(inside))
    whole = branch.quotient * lean * np.exp(2 / p * np.log1p(beside)) - per
    growth = np.where(above & (log_square > 1), whole, np.expm1(np.minimum(power, 700)) * per)
    weight = np.where(above, 1 / (1 + beside), beneath / (beneath + rest))
    return growth, (growth + per) / lean * weight
''')

LISTED = Template('''\
def straight(thrust: ArrayLike, constants: Constants, *, turned: bool = False) -> State:
    """The straight state under N g_3: theta = 0, or pi if turned (section 4.2).

    thrust is N, a force: a number or an array, whose shape the state has. It exists for every N,
    as long as v_3 > 0: a rod that compresses to nothing is refused
    (ValueError). Pulled where N cos(theta) > 0.
    """
    N = np.asarray(thrust, dtype=float)
    cosine = np.full(N.shape, -1.0 if turned else 1.0)
    state = _under_thrust("straight", N, np.zeros(N.shape), cosine, constants)
    return _not_flat(state, "thrust")


def sheared(thrust: ArrayLike, constants: Constants) -> State:
    """The sheared state under N g_3, thrust as of `straight`; raises as `sheared_angle`."""
    N = np.asarray(thrust, dtype=float)
    sine, cosine = _sheared(N, constants)
    return _under_thrust("sheared", N, sine, np.where(N > 0, cosine, -cosine), constants)


def twisted(couple: ArrayLike, constants: Constants) -> State:
    """The straight, twisted state under M g_3 (section 4.3); the helix at theta = 0."""
    return helix(couple, 0.0, constants)


def circle(couple: ArrayLike, constants: Constants) -> State:
    """The state bent into a circle under M g_3 (section 4.3); the helix at theta = pi/2."""
    return helix(couple, math.pi / 2, constants)


def helix(couple: ArrayLike, theta: ArrayLike, constants: Constants) -> State:
    """The helical state about g_3 under M g_3 with the angle theta in [0, pi] (section 4.3).

    couple is M, force times length, and theta in radians: numbers or arrays that broadcast. Every
    couple and angle give one. M and theta stay regular where the paper's M_1 = -M sin theta
    does not, at theta = 0. Raises ValueError for other angles and where v_3 > 0 fails.
    """
    M, angle = np.broadcast_arrays(np.asarray(couple, dtype=float), np.asarray(theta, dtype=float))
    if not ((angle >= 0) & (angle <= math.pi)).all():
        first = float(angle[~((angle >= 0) & (angle <= math.pi))][0])
        raise ValueError(f"theta, the angle of d_3 and g_3, must lie in [0, pi], not {first!r}")
    sine = np.sin(angle)
    cosine = np.where(angle == math.pi / 2, 0.0, np.cos(angle))
    sine = np.where(angle == math.pi, 0.0, sine)
    kind = "twisted" if not sine.any() else "helix" if np.abs(cosine).any() else "circle"
    loads = M * _stack(_axis(sine, cosine))
    u, v = strains(loads, np.zeros_like(loads), constants)
    ratio = float(_bend_over_twist(constants))
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = np.where(np.abs(sine) > np.abs(cosine), -u[0] / sine, ratio * u[2] / cosine)
    energy = -complementary_energy(loads, np.zeros_like(loads), constants)
    state = State(
        kind, np.zeros(M.shape), M, angle, sine, cosine, turn, u[2] - cosine * turn, u, v, energy
    )
    return _not_flat(state, "couple")


def _bend_over_twist(constants: Constants) -> Fraction:
    """The compliance to bending over that to twist, exactly."""
    exact = (Fraction(getattr(constants, n)) for n in ("alpha", "beta", "eta", "iota"))
    alpha, beta, eta, iota = exact
    return $bend_over_twist


def _under_thrust(kind: str, N: Array, sine: Array, cosine: Array, c: Constants) -> State:
    """The state under N g_3 at an angle."""
    loads = N * _stack(_axis(sine, cosine))
    none = np.zeros_like(loads)
    u, v = strains(none, loads, c)
    energy = -complementary_energy(none, loads, c) - loads[2]
    theta = np.arctan2(sine, cosine)
    return State(kind, N, np.zeros(N.shape), theta, sine, cosine, np.zeros(N.shape), u[2], u, v,
                 energy)


def _not_flat(state: State, load: str) -> State:
    """The state, if v_3 > 0 in all of it."""
    bad = np.flatnonzero(~(state.v[2] > 0))
    if bad.size:
        first = np.ravel(getattr(state, load))[bad[0]]
        raise ValueError(
            f"no {state.kind} state at {load} = {first}: v_3 > 0 fails, it is"
            f" {np.ravel(state.v[2])[bad[0]]}"
        )
    return state


def equilibria(thrust: float, constants: Constants) -> list[State]:
    """All equilibria under N g_3 without couples, but for turns about g_3; lowest energy first.

    Without a thrust there is one, the rod at rest. Else the straight state that is pulled; the
    straight state that is pushed, unless it would compress to nothing; and above the threshold the
    sheared state, which then has the lowest energy. Raises ValueError if thrust, a number, is not
    finite.
    """
    N = float(thrust)
    if not math.isfinite(N):
        raise ValueError(f"thrust must be finite, not {N}")
    if N == 0:
        return [straight(N, constants)]
    pulled, pushed = N < 0, N > 0
    candidates: Sequence[Callable[[], State]] = (
        lambda: sheared(N, constants),
        lambda: straight(N, constants, turned=pulled),
        lambda: straight(N, constants, turned=pushed),
    )
    found = []
    for state in candidates:
        with suppress(ValueError):
            found.append(state())
    return found
''')
