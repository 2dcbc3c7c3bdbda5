"""The fixed text of a NumPy module: everything that does not depend on a formula.

Fields in ``$name`` form are filled in by `numpy_target`.
"""

from __future__ import annotations

from string import Template

IMPORTS = Template("""\
from __future__ import annotations

import math$threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass$field_import
$standard_imports
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Array = np.ndarray[Any, np.dtype[Any]]
Pair = tuple[Array, Array]
Triple = tuple[Array, Array, Array]
Rows = Sequence[Array]
Given = ArrayLike | tuple[Any, ...]  # arrays and their like; one point
Inputs = dict[str, Given]

BLOCK = 16384  # at most so many points are worked on at a time, so that rows stay in cache
LINE = 64  # bytes of a cache line
KEPT = threading.local()  # scratch, from call to call
TINY = {np.dtype(t): float(np.finfo(t).tiny) for t in (np.float32, np.float64)}
LOG_MAX = {t: -0.99 * math.log(TINY[t]) for t in TINY}  # exp of it is near the largest number
LEAST = 2.0**-1022  # the smallest normal number, for one point
LOG_MOST = 0.99 * 1022 * math.log(2)  # its exponential is near the largest number
LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing
NOUGHT = 2.0**-700  # stands for a square at rest: its inverse is a number
DOUBLE = np.dtype(np.float64)
$heads
""")

CONSTANTS = Template('''\
@dataclass($decorator)
class Constants:
    """$doc
    """

$fields$derived_fields

    def __post_init__(self) -> None:
        for name in $names:
            value = float(getattr(self, name))
$value_check
            object.__setattr__(self, name, value)
$ranges$exact$coupling$derived''')

SIGNED_CHECK = """\
            if not math.isfinite(value) or (value <= 0 and name != "iota"):
                rule = "a finite number" if name == "iota" else "positive and finite"
                raise ValueError(f"Constants: {name} must be {rule}, not {value}")"""

POSITIVE_CHECK = """\
            if not 0 < value < math.inf:
                raise ValueError(f"Constants: {name} must be positive and finite, not {value}")"""

RANGE_CHECK = Template("""\
        if not $low <= self.$name <= $high:
            raise ValueError(f"Constants: $name must lie in [$low, $high], not {self.$name}")
""")

COUPLING_CHECK = Template("""\
        if not $form > 0:
            raise ValueError(
                "Constants: beta^2 eta^2 - iota^2 > 0 fails: |iota| must be smaller than beta*eta,"
                f" not $given"
            )
""")

DERIVED = Template("""\
        derived = {
$values
        }
        for name, ratio in derived.items():  # exact, then rounded once
            if abs(ratio) >= 2**1023:
                raise ValueError(f"Constants: {name} leaves the range of floating point numbers")
            object.__setattr__(self, name, float(ratio))
""")

OF_MODULI = Template('''
    @classmethod
    def of_moduli(
        cls,
$arguments        *,
$moduli    ) -> Constants:
        """Constants of the rod with these moduli at rest.

        $meaning
        """
        return cls(
$values
        )
''')

PLAIN = '''
    @cached_property
    def plain(self) -> Plain:
        """What the plain bodies take."""
        return Plain(self)
'''

WORK_SHARE_TABLES = '''
    @cached_property
    def work_share(self) -> tuple[list[float], list[float], float, float, float]:
        """Coefficients for `_work_share`: fraction, powers, their sum, and the nearest power."""
        a = 1 / self.p
        fraction = [a / (1 + 2 * a)]
        for k in range(1, 30):
            below = (2 * a + 2 * k) * (2 * a + 2 * k - 1)
            fraction += [k * (a + k) / below]
            below = (2 * a + 2 * k) * (2 * a + 2 * k + 1)
            fraction += [(a + k) * (2 * a + k) / below]
        at_split = 1.0
        for term in reversed(fraction):
            at_split = 1 + term * 8 / at_split
        nearest = min(max(round(a) - 1, 0), 23)
        powers, term = [], a / 9
        for k in range(24):
            exponent = ((k + 1) * self.p - 1) / self.p  # k + 1 - 1/p, small where p = 1/(k + 1)
            powers += [term / exponent if k != nearest else 0.0]
            if k == nearest:
                slope, single = exponent, term
            term *= (k + 1 - 2 * a) / (k + 1) / 9
        start = math.exp(2 * a * math.log(8 / 9)) * 0.5 / at_split + math.fsum(powers)
        return fraction, powers, start, slope, single
'''

WORK_SHARE = '''\
def _work_share(depth: Array, c: Constants) -> Array:
    """Stored energy over work, 1/2 2F1(1, 1/p; 1 + 2/p; 1 - exp(depth)), depth = -log(1 - x^p).

    Up to exp(depth) = 9 by the continued fraction of Gauss, whose terms are all positive; from
    there by its integral over t = 1 - s^p, with (1 - t)^(2/p - 1) expanded. The power of t nearest
    to -1 is integrated through expm1, which makes the sum smooth at p = 1, 1/2, 1/3, ...
    """
    fraction, powers, start, slope, single = c.work_share
    split = math.log(9)
    growth = np.expm1(np.minimum(depth, split))
    value = np.ones_like(growth)
    for term in reversed(fraction):
        np.divide(growth, value, out=value)
        value *= term
        value += 1
    share: Array = 0.5 / value
    far = depth > split
    if far.any():
        beyond = depth[far] - split
        left = np.exp(-beyond)
        rest = np.zeros_like(left)
        for coefficient in reversed(powers):
            rest *= left
            rest += coefficient
        turns = -np.expm1(np.minimum(-slope * beyond, 80)) / slope if slope else beyond
        inner = np.exp(-beyond / c.p) * (start + single * turns) - left * rest
        share[far] = inner * np.exp(-2 / c.p * np.log1p(-left / 9))
    return share
'''

RAISE = '''\
class _PastLimit(Exception):
    """Some strains have Q >= 1."""


def _within_limit(q: Array) -> Array:
    """Q where all of it is below the limit."""
    if not q.max() < 1:
        raise _PastLimit
    return q
'''

NAN = '''\
def _within_limit(q: Array) -> Array:
    """Q below the limit, nan at and past it."""
    if not q.max() < 1:
        q[~(q < 1)] = np.nan
    return q
'''

PAST_LIMIT = Template('''\
def _past_limit(strains: Rows, c: Constants, shape: tuple[int, ...]) -> ValueError:
    """The error for strains at or past the limit: how many points, the first and its Q."""
$reduce
    bad = np.flatnonzero(~(q < 1))
    index = tuple(map(int, np.unravel_index(bad[0], shape)))
    first = f"the first at index {index} with Q = {float(q[bad[0]])!r}"
    return ValueError(f"$sentence: {bad.size} of {q.size} do not, {first}")
''')

ARGUMENTS = Template('''\
def _fresh(shape: tuple[int, ...], dtype: Any) -> Array:
    """A new array. A long one begins a cache line: stores across two of them take twice as long."""
    wanted = math.prod(shape) * np.dtype(dtype).itemsize
    if wanted < 2**15:
        return np.empty(shape, dtype)
    memory = np.empty(wanted + LINE, np.uint8)
    return np.ndarray(shape, dtype, memory, -memory.ctypes.data % LINE)


def _arguments(inputs: Inputs) -> tuple[list[Array], tuple[int, ...]]:
    """The inputs as float arrays of one type, components first, and the trailing shape."""
$alike    arrays = {name: np.asarray(value) for name, value in inputs.items()}
    for name, array in arrays.items():
        head = HEADS[name]
        if array.dtype.kind not in "iuf" or array.shape[$leading] != head:
            wanted = ", ".join($wanted)
            kind = f"{array.dtype} of shape {array.shape}"
            raise ValueError(f"{name} must hold real numbers in the shape ({wanted}), not {kind}")
    dtype = $dtype
    shapes = {a.shape[$trailing] for name, a in arrays.items()}
    try:
        shape = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
    except ValueError:
        given = " and ".join(f"{name} {a.shape}" for name, a in arrays.items())
        raise ValueError(f"{given} do not broadcast $after") from None
    ready = []
    for name, array in arrays.items():
        head = HEADS[name]
$align        if array.shape != (*head, *shape):
            fill = (1,) * (len(head) + len(shape) - array.ndim)
            array = array.reshape((*head, *fill, *array.shape[len(head) :]))
            array = np.broadcast_to(array, (*head, *shape))
        ready.append(array.astype(dtype, copy=False))
    return ready, shape


def _results(names: Sequence[str], shape: tuple[int, ...], dtype: Any, out: Any) -> list[Array]:
    """The arrays to fill: new ones, or ``out`` after a check of its shapes and types."""
    shapes = [$result for name in names]
    if out is None:
        return [_fresh(wanted, dtype) for wanted in shapes]
    given = out if isinstance(out, tuple) else (out,)
    if len(given) != len(names):
        raise ValueError(f"out must be {len(names)} arrays, for {' and '.join(names)}")
    for name, array, wanted in zip(names, given, shapes, strict=True):
        if not isinstance(array, np.ndarray) or (array.dtype, array.shape) != (dtype, wanted):
            kind = f"{getattr(array, 'dtype', type(array).__name__)} of shape {np.shape(array)}"
            raise ValueError(f"out for {name} must be {dtype} of shape {wanted}, not {kind}")
    return list(given)
''')

#: Nothing is to be done where inputs are alike.
ALIKE = Template("""\
    ready = [*map(np.asarray, inputs.values())]
    common, shape = ready[0].dtype, ready[0].shape[len(HEADS[next(iter(inputs))]) :]
    if common $known and all(
        a.dtype == common and a.shape == (*HEADS[name], *shape)
        for name, a in zip(inputs, ready, strict=True)
    ):
        return ready, shape
""")
KNOWN_TYPE = {
    "input": "in (np.float64, np.float32)",
    "float32": "== np.float32",
    "float64": "== np.float64",
}

#: How inputs are brought to (components, trailing shape), by layout.
FIRST = {
    "leading": ": len(head)",
    "wanted": '[*map(str, head), "..."]',
    "trailing": "len(HEADS[name]) :",
    "after": "after their first axis",
    "align": "",
    "result": "(*HEADS[name], *shape)",
}
LAST = {
    "leading": "array.ndim - len(head) :",
    "wanted": '["...", *map(str, head)]',
    "trailing": ": a.ndim - len(HEADS[name])",
    "after": "before their last axis",
    "align": """\
        array = np.moveaxis(array, -1, 0) if head else array
""",
    "result": "(*shape, *HEADS[name])",
}
DTYPES = {
    "input": "np.float32 if np.result_type(*arrays.values()) == np.float32 else np.float64",
    "float32": "np.float32",
    "float64": "np.float64",
}


def arguments(layout: str, precision: str) -> str:
    """The function that takes the inputs in."""
    alike = ALIKE.substitute(known=KNOWN_TYPE[precision]) if layout == "first" else ""
    places = FIRST if layout == "first" else LAST
    return ARGUMENTS.substitute(places, dtype=DTYPES[precision], alike=alike)


APPLY_FIRST = Template('''\
def _apply(
    body: Callable[..., None], inputs: Inputs, c: Constants, names: Sequence[str], out: Any
) -> list[Array]:
    """Runs ``body`` over blocks of points, straight into the results where that is safe."""
    if out is not None and all(type(value) is tuple for value in inputs.values()):
        raise ValueError("out is for arrays; tuples of numbers are answered with new tuples")
    arrays, shape = _arguments(inputs)
    results = _results(names, shape, arrays[0].dtype, out)
    points = math.prod(shape)
    direct = out is None or all(
        r.flags.c_contiguous and not any(np.may_share_memory(r, a) for a in arrays) for r in results
    )
    given = arrays
    flat = results if direct else [_fresh(r.shape, r.dtype) for r in results]
    if len(shape) != 1:
        given = [a.reshape(*HEADS[name], points) for name, a in zip(inputs, given, strict=True)]
        flat = [r.reshape(*HEADS[name], points) for name, r in zip(names, flat, strict=True)]
    blocks = max(1, -(-points // BLOCK))
    size = max(1, -(-points // blocks // LINE)) * LINE  # blocks of one length, whole cache lines
    with np.errstate(under="ignore"):
        for start in range(0, points, size):
            part = slice(start, min(start + size, points))
            block = [a[..., part] for a in given]
$run
    if not direct:
        for result, values in zip(results, flat, strict=True):
            result[...] = values.reshape(result.shape)
    return results
''')

APPLY_LAST = Template('''\
def _apply(
    body: Callable[..., None], inputs: Inputs, c: Constants, names: Sequence[str], out: Any
) -> list[Array]:
    """Runs ``body`` over blocks of points, components first in them, last in the results."""
    if out is not None and all(type(value) is tuple for value in inputs.values()):
        raise ValueError("out is for arrays; tuples of numbers are answered with new tuples")
    arrays, shape = _arguments(inputs)
    results = _results(names, shape, arrays[0].dtype, out)
    points = math.prod(shape)
    given = [a.reshape(*HEADS[name], points) for name, a in zip(inputs, arrays, strict=True)]
    direct = out is None or all(
        r.flags.c_contiguous and not any(np.may_share_memory(r, a) for a in arrays) for r in results
    )
    whole = [
        (r if direct else _fresh(r.shape, r.dtype)).reshape(points, *HEADS[name])
        for name, r in zip(names, results, strict=True)
    ]
    blocks = max(1, -(-points // BLOCK))
    size = max(1, -(-points // blocks // LINE)) * LINE  # blocks of one length, whole cache lines
    taken = [_fresh((*a.shape[:-1], size), a.dtype) for a in given]
    made = [_fresh((*HEADS[name], size), arrays[0].dtype) for name in names]
    with np.errstate(under="ignore"):
        for start in range(0, points, size):
            part = slice(start, min(start + size, points))
            block = [array[..., : part.stop - start] for array in taken]
            for rows, values in zip(block, given, strict=True):
                # a row at a time: a vector's axis is too short to loop over
                for row, value in zip(np.atleast_2d(rows), np.atleast_2d(values), strict=True):
                    row[...] = value[part]
            flat = [array[..., : part.stop - start] for array in made]
$run
            for values, array in zip(whole, flat, strict=True):
                if array.ndim == 2:
                    for k, row in enumerate(array):
                        values[part, k] = row
                else:
                    values[part] = np.moveaxis(array, -1, 0)
    if not direct:
        for result, values in zip(results, whole, strict=True):
            result[...] = values.reshape(result.shape)
    return results
''')

#: The call of the body for each policy at the limit and layout, by how an output is written to.
RUN_RAISE = Template("""\
            try:
                body(*block, c, *$outputs)
            except _PastLimit:
                rows = [row for a in given for row in np.atleast_2d(a)]
                raise _past_limit(rows, c, shape) from None""")
RUN = Template("""\
            body(*block, c, *$outputs)""")
OUTPUTS = {"first": "(array[..., part] for array in flat)", "last": "flat"}
