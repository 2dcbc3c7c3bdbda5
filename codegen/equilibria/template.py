"""The fixed text of the equilibrium modules: what takes arrays in and hands them out.

The functions that the kernels print hold for floats and arrays alike; here is where one rod (a
state with one axis) becomes floats and many become arrays.
"""

from __future__ import annotations

TYPES = """\
Number = Any  # a float or an array
Numbers = Sequence[Any]  # one for each component
"""

STACK = '''\
def _stack(rows: Numbers) -> Array:
    """One array of components, floats spread over the arrays' shape."""
    shapes = [row.shape for row in rows if isinstance(row, np.ndarray)]
    if not shapes:
        return np.array(rows)
    out = np.empty((len(rows), *np.broadcast_shapes(*shapes)))
    for i, row in enumerate(rows):
        out[i] = row
    return out
'''

COMMON = '''\
def _rows(name: str, value: ArrayLike, lengths: tuple[int, ...]) -> Numbers:
    """The components of an array: floats where it has one axis, else arrays."""
    array = np.asarray(value, dtype=float)
    if array.ndim == 0 or len(array) not in lengths:
        wanted = " or ".join(f"({length}, ...)" for length in lengths)
        raise ValueError(f"{name} must have the shape {wanted}, not {array.shape}")
    rows: Numbers = array.tolist() if array.ndim == 1 else list(array)
    return rows


def _law(m: Numbers, n: Numbers, c: Constants, linear: bool) -> tuple[Numbers, Numbers]:
    """The strains u and v under the loads."""
    if linear:
        found = _linear_strains((*m, *n), c)
        return found[:3], found[3:]
    u, v = strains(*_given(m, n), c)
    return u, v  # type: ignore[return-value]


def _given(m: Numbers, n: Numbers) -> tuple[Any, Any]:
    """Loads as the law takes them: of one rod as tuples, which is quick, of many as arrays."""
    if all(type(x) is float for x in (*m, *n)):
        return tuple(m), tuple(n)
    return _stack(m), _stack(n)


def _tangent(m: Numbers, n: Numbers, c: Constants, linear: bool) -> Numbers:
    """The entries of d(u, v)/d(m, n) on and above the diagonal, row by row."""
    if linear:
        return _linear_compliance(c)
    soft = compliance(*_given(m, n), c)
    return [soft[i][j] for i in range(6) for j in range(i, 6)]


def _matrix(size: int, entries: Sequence[tuple[int, int]], values: Numbers) -> Array:
    """A matrix of ``size`` rows from the entries that are not zero."""
    shapes = [value.shape for value in values if isinstance(value, np.ndarray)]
    out = np.zeros((size, size, *np.broadcast_shapes(*shapes)))
    for (i, j), value in zip(entries, values, strict=True):
        if i < size:
            out[i, j] = value
    return out


def _first(bad: Number, name: str, values: Numbers) -> str:
    """These rows of the first state that is refused, and of many states, which and how many."""
    place = tuple(map(int, np.argwhere(bad)[0]))
    numbers = ", ".join(repr(float(np.asarray(value)[place])) for value in values)
    said = f"{name} = {numbers}"
    if not place:
        return said
    where = f"state[:, {', '.join(map(str, place))}]"
    return f"{said} in {where}, the first of {np.sum(bad)} such of {np.size(bad)} states"
'''

DIRECTORS = '''\
def _field(name: str, value: Field | None, s: Any) -> Numbers:
    """The components at s of a vector that is constant, given at every s, or a function of s."""
    if value is None:
        return 0.0, 0.0, 0.0
    return _rows(name, value(s) if callable(value) else value, (3,))


def _loads_at(
    s: Any, state: ArrayLike, force: Field | None
) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """Quaternion, couple, frame and force in the directors; which rows the state has is checked."""
    x = _rows("state", state, (10, 13))
    if (len(x) == 13) != (force is None):
        raise ValueError(
            "a state of 10 rows needs the force; one of 13 carries it in its last three"
            f" (here: {len(x)} rows, force {'not ' if force is None else ''}given)"
        )
    _has_a_norm(x[:4])
    d = _frame(x[:4])
    n = x[10:] if force is None else _field("force", force, s)
    return x[:4], x[4:7], d, _in_directors(d, n)


def _has_a_norm(q: Numbers) -> None:
    """Refuses a quaternion whose squared norm is zero or no float; one with a nan passes."""
    if isinstance(q[0], float):
        square: Number = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
        if 1e-300 < square < 1e300:
            return
    else:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    bad = np.less_equal(square, 1e-300) | np.greater_equal(square, 1e300)
    if np.any(bad):
        raise ValueError(
            f"the quaternion of the frame needs 1e-150 < |q| < 1e150: {_first(bad, 'q', q)}; any"
            " multiple of q is the same frame, divide it by its norm. If an integrator made it, its"
            " step was too large, ask for a smaller max_step or tolerance"
        )


def frame(state: ArrayLike) -> Array:
    """The directors, (3, 3, ...): column k - 1 is d_k in the fixed basis.

    state (10, ...) or (13, ...) as in `rates`; its quaternion need not be of norm one, but between
    1e-150 and 1e150 (ValueError).
    """
    q = _rows("state", state, (10, 13))[:4]
    _has_a_norm(q)
    d = _stack(_frame(q))
    return d.reshape(3, 3, *d.shape[1:]).swapaxes(0, 1)


def loads(s: Any, state: ArrayLike, force: Field | None = None) -> Pair:
    """Couple and force in the directors, m (3, ...) and n (3, ...): what `strains` takes."""
    _, m, _, n = _loads_at(s, state, force)
    return _stack(m), _stack(n)


def rates(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    force: Field | None = None,
    body_force: Field | None = None,
    body_couple: Field | None = None,
    *,
    linear: bool = False,
) -> Array:
    """d(state)/ds of a rod in equilibrium, in the shape of the state.

    s is the place, a number or an array; state holds in its rows

        0 to 3    q, the quaternion of the frame: its norm is kept and plays no part
        4 to 6    m, the couple in the directors, force times length
        7 to 9    r, the center line in the fixed basis
        10 to 12  n, the force in the fixed basis, where the state carries it

    and any trailing shape: rods, nodes, both. With 10 rows the force is an argument (the end load
    plus what body force lies beyond s); with 13 rows it is integrated, n' = -body_force. force,
    body_force and body_couple are in the fixed basis, per length where they are of the body: three
    numbers, an array (3, ...) over s, or a function of s that answers either. linear = True drops
    the limit: strains K^-1 (m, n)/gamma for every load. As `solve_ivp` and `solve_bvp` want it:

        fun = lambda s, x: rates(s, x, constants, force)

    Raises ValueError for other shapes, for a force both given and carried, and for a quaternion of
    a norm outside 1e-150 to 1e150, with the first such state; a state with a nan has rates of nan.
    """
    q, m, d, n = _loads_at(s, state, force)
    carried = force is None
    if body_force is not None and not carried:
        raise ValueError("body_force changes a force that the state carries, in 13 rows, only")
    b = _in_directors(d, _field("body_couple", body_couple, s))
    u, v = _law(m, n, constants, linear)
    found = _rates(q, m, d, n, b, u, v)
    if carried:
        found = (*found, *(-f for f in _field("body_force", body_force, s)))
        return _stack(found) + 0.0
    return _stack(found)


def jacobian(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    force: Field | None = None,
    body_force: Field | None = None,
    body_couple: Field | None = None,
    *,
    linear: bool = False,
) -> Array:
    """The derivative of `rates` by the state, (10, 10, ...) or (13, 13, ...).

    Arguments as there; entry (i, j) is that of row i by row j. body_force plays no part.
    """
    q, m, d, n = _loads_at(s, state, force)
    b = _in_directors(d, _field("body_couple", body_couple, s))
    u, v = _law(m, n, constants, linear)
    soft = _tangent(m, n, constants, linear)
    entries, values = list(BY_STATE), list(_by_state(q, m, d, n, b, u, v, soft))
    if force is None:
        entries += BY_FORCE
        values += _by_force(q, m, d, n, v, soft)
    return _matrix(13 if force is None else 10, entries, values)
'''

EULER_ANGLES = '''\
def _at(
    state: ArrayLike, thrust: ArrayLike
) -> tuple[int, Numbers, Numbers, Numbers, Number]:
    """Rows, sines and cosines, couple, force in the intermediate frame, thrust; checked."""
    x = _rows("state", state, (6, 9))
    one = isinstance(x[1], float)
    if one and not (math.isfinite(x[0]) and math.isfinite(x[1])):
        raise ValueError(f"the angles phi = {x[0]!r} and theta = {x[1]!r} must be finite")
    sin, cos = (math.sin, math.cos) if one else (np.sin, np.cos)
    angles = sin(x[1]), cos(x[1]), sin(x[0]), cos(x[0])
    _off_the_pole(x[1], angles[0])
    given = np.asarray(thrust, dtype=float)
    N = given if given.ndim else float(given)
    return len(x), angles, x[3:6], _force(angles, N), N


def _off_the_pole(theta: Number, sine: Number) -> None:
    """Refuses sin(theta) = 0, as far as theta as a float can tell, where phi' is not determined."""
    if isinstance(theta, float) and abs(sine) > max(2**-51 * abs(theta), 2.0**-1000):
        return
    bad = ~(np.abs(sine) > np.maximum(2**-51 * np.abs(theta), 2.0**-1000))
    if np.any(bad):
        raise ValueError(
            f"Euler angles are singular at sin(theta) = 0: {_first(bad, 'theta', [theta])};"
            " the module directors has no such place"
        )


def rates(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    thrust: ArrayLike,
    *,
    linear: bool = False,
) -> Array:
    """d(state)/ds of a rod in equilibrium under the force N g_3, in the shape of the state.

    s plays no part (the rod is uniform and the force dead); state holds in its rows

        0 to 2    phi, theta, psi; the directors are R_3(phi) R_2(theta) R_3(psi)
        3 to 5    M1, M2, M3, the couple in the intermediate frame R_3(phi) R_2(theta)
        6 to 8    r, the center line in the fixed basis, if wanted

    and any trailing shape; thrust is N, a number or an array of that shape. linear = True drops
    the limit: strains K^-1 (m, n)/gamma for every load. M3' is zero. As `solve_ivp` and
    `solve_bvp` want it:

        fun = lambda s, x: rates(s, x, constants, thrust)

    Raises ValueError where sin(theta) = 0, which these angles cannot pass, and for other shapes.
    """
    rows, angles, M, n, N = _at(state, thrust)
    u, v = _law(M, n, constants, linear)
    return _stack(_rates(angles, M, N, u, v)[:rows])


def jacobian(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    thrust: ArrayLike,
    *,
    linear: bool = False,
) -> Array:
    """The derivative of `rates` by the state, (6, 6, ...) or (9, 9, ...).

    Arguments as there; entry (i, j) is that of row i by row j.
    """
    rows, angles, M, n, N = _at(state, thrust)
    u, v = _law(M, n, constants, linear)
    soft = _tangent(M, n, constants, linear)
    return _matrix(rows, BY_STATE, _by_state(angles, M, N, u, v, soft))
'''
