"""Run time beside what else a user could take: C, lambdify, numexpr, numba, JAX and CasADi.

Every peer computes the same function of the same points, components first. One call a round, the
peers of a round one after the other; the median of the rounds counts. Those that are not installed
are named as missing, and so is what a peer cannot do.
"""

from __future__ import annotations

import gc
import json
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from functools import cache, partial
from importlib import import_module
from pathlib import Path
from statistics import median
from time import perf_counter_ns
from typing import Any

import numpy as np
import sympy as sp

from rodproof.codegen.files import write_text
from rodproof.codegen.measure import peer_c, records
from rodproof.codegen.show import Tell
from rodproof.derivations.symbols import (
    LOADS,
    STRAINS,
    alpha,
    beta,
    eta,
    gamma,
    iota,
    p,
    zeta,
)
from rodproof.derivations.theory import constitutive as theory

Array = np.ndarray[Any, np.dtype[Any]]
FUNCTIONS = ("strains", "loads", "stiffness", "loads_and_stiffness")
CONSTANTS = (0.7, 1.1, 0.9, 1.6, -0.4, 2.3)  # alpha, beta, zeta, eta, iota, gamma
ORDER = (alpha, beta, zeta, eta, iota, gamma, p)
EXPONENTS = (3.3, 2.0)
REFERENCE = "C"
SHORTEST_NS = 100_000
APART = 1e-10  # relative to the largest component: a peer that is further off did something else


@dataclass(frozen=True)
class Task:
    """A function at points: six rows of inputs, the arrays to fill, and the constants."""

    function: str
    p: float
    first: Array
    second: Array
    outs: tuple[Array, ...]

    @property
    def points(self) -> int:
        return int(self.first.shape[1])

    @property
    def rows(self) -> list[Array]:
        return [*self.first, *self.second]

    @property
    def values(self) -> tuple[float, ...]:
        return (*CONSTANTS, self.p)


#: From a task to the call that is timed, which fills the outs or answers components in order.
Bind = Callable[[Task], Callable[[], Any]]


@dataclass(frozen=True)
class PeerTime:
    """Nanoseconds a point, and the ratio to the C kernel (to the first peer without a compiler)."""

    function: str
    p: float
    points: int
    peer: str
    nanoseconds: float
    ratio: float


@dataclass(frozen=True)
class Comparison:
    """What was measured, on what, and what was not measured for which reason."""

    machine: records.Machine
    rounds: int
    peers: dict[str, str]
    missing: dict[str, str]
    times: tuple[PeerTime, ...]


def compare(points: tuple[int, ...], rounds: int, tell: Tell) -> Comparison:
    """Measure every peer that is there."""
    with tempfile.TemporaryDirectory() as folder, np.errstate(all="ignore"):
        peers = dict(_peers(Path(folder)))
        missing: dict[str, str] = {}
        times: list[PeerTime] = []
        cases = [(f, p, n) for n in points for p in EXPONENTS for f in FUNCTIONS]
        for done, (function, p, n) in enumerate(cases):
            tell(f"{function}, p = {p:g}, {n} points", done, len(cases))
            times += _case(task(function, p, n), peers, rounds, missing)
        tell("done", len(cases), len(cases))
    measured = {row.peer for row in times}
    words = {name: said for name, (said, _) in peers.items() if name in measured}
    return Comparison(records.this_machine(), rounds, words, missing, tuple(times))


def task(function: str, p: float, points: int) -> Task:
    """Ordinary points inside the domain."""
    rng = np.random.default_rng(11)
    first, second = rng.uniform(-0.25, 0.25, (2, 3, points))
    second[2] += 0.0 if function == "strains" else 1.0
    shapes: dict[str, tuple[tuple[int, ...], ...]] = {
        "strains": ((3,), (3,)),
        "loads": ((3,), (3,)),
        "stiffness": ((6, 6),),
        "loads_and_stiffness": ((3,), (3,), (6, 6)),
    }
    outs = tuple(np.zeros((*head, points)) for head in shapes[function])
    return Task(function, p, first, second, outs)


def _case(
    given: Task, peers: dict[str, tuple[str, Bind]], rounds: int, missing: dict[str, str]
) -> Iterator[PeerTime]:
    """The times of one function, for the peers that answer as ours does."""
    calls: dict[str, Callable[[], Any]] = {}
    want: Array | None = None
    for name, (_, bind) in peers.items():
        for out in given.outs:
            out[...] = 0
        try:
            call = bind(given)
            got = _flat(call(), given)
        except Exception as error:  # whatever a peer fails with, the others go on
            missing.setdefault(name, f"{type(error).__name__}: {error}".splitlines()[0][:200])
            continue
        want = got if want is None else want
        off = np.abs(got - want).max() / np.abs(want).max()
        if not off < APART:
            missing[f"{name}, {given.function}"] = f"off by {off:.1e} of the largest component"
        else:
            calls[name] = call
    samples = _rounds(calls, rounds)
    base = median(samples[REFERENCE if REFERENCE in samples else next(iter(samples))])
    for name, found in samples.items():
        ns, ratio = median(found) / given.points, median(found) / base
        rounded = (records.finite(ns) or 0.0, records.finite(ratio) or 0.0)
        yield PeerTime(given.function, given.p, given.points, name, *rounded)


def _rounds(calls: dict[str, Callable[[], Any]], rounds: int) -> dict[str, list[float]]:
    repeats = {name: max(1, round(SHORTEST_NS / _clock(call, 1))) for name, call in calls.items()}
    samples: dict[str, list[float]] = {name: [] for name in calls}
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for name, call in calls.items():
                samples[name].append(_clock(call, repeats[name]))
    finally:
        gc.enable()
    return samples


def _clock(call: Callable[[], Any], count: int) -> float:
    start = perf_counter_ns()
    for _ in range(count):
        call()
    return max((perf_counter_ns() - start) / count, 1.0)


def _flat(answer: Any, given: Task) -> Array:
    """What a call answered as rows of components, the outs where it filled them."""
    if answer is None:
        parts: list[Any] = [out.reshape(-1, given.points) for out in given.outs]
    else:
        parts = [np.reshape(np.asarray(part), (-1, given.points)) for part in _leaves(answer)]
    return np.concatenate(parts)


def _leaves(answer: Any) -> Iterator[Any]:
    if isinstance(answer, (tuple, list)):
        for part in answer:
            yield from _leaves(part)
    else:
        yield answer


def _peers(folder: Path) -> Iterator[tuple[str, tuple[str, Bind]]]:
    """The peers in the order of a round; the first answers are the ones to agree with."""
    yield "rodproof numpy", ("the generated module, out= given; one point by tuples", _ours)
    c = f"by hand, no guards, {' '.join(peer_c.FLAGS[:3])}, libmvec"
    yield "C", (f"{c}; powers by pow", partial(_c, folder, peer_c.POW))
    yield "C exp/log", (f"{c}; powers by exp and log", partial(_c, folder, peer_c.EXP_LOG))
    yield "rodproof numba", ("the generated module for numba, out= given", _ours_numba)
    yield "lambdify", ("SymPy, NumPy code", partial(_lambdify, False))
    yield "lambdify cse", ("SymPy, NumPy code with cse=True", partial(_lambdify, True))
    yield "numba cse", ("the code of lambdify cse under numba.njit, arrays in", _numba_cse)
    yield "numexpr", ("the subexpressions of cse, one evaluate each, one thread", _numexpr)
    yield "jax", ("lambdify cse to JAX, jit, CPU, float64", _jax)
    yield (
        "casadi",
        ("its C code compiled with -O3, mapped over the points", partial(_casadi, folder)),
    )


def _ours(given: Task) -> Callable[[], Any]:
    return _module("scenes", given, tuples=given.points == 1)


def _ours_numba(given: Task) -> Callable[[], Any]:
    return _module("numba", given, tuples=False)


def _module(folder: str, given: Task, *, tuples: bool) -> Callable[[], Any]:
    name = "full_rod_p2" if given.p == 2 else "full_rod"
    module = import_module(f"rodproof.generated.{folder}.{name}")
    c = module.Constants(*(CONSTANTS if given.p == 2 else given.values))
    law = getattr(module, given.function)
    if tuples:
        m, n = tuple(given.first[:, 0].tolist()), tuple(given.second[:, 0].tolist())
        return lambda: law(m, n, c)
    out = given.outs if len(given.outs) > 1 else given.outs[0]

    def call() -> None:
        law(given.first, given.second, c, out=out)

    return call


def _c(folder: Path, power: int, given: Task) -> Callable[[], Any]:
    a, b, z, h, iota, gamma = CONSTANTS
    library = peer_c.build(peer_c.SQUARE if given.p == 2 else power, folder)
    k = np.array([a * a, b * b, z * z, h * h, iota, gamma, given.p])
    arrays = (given.first, given.second, k, *given.outs)
    call = peer_c.bound(library, given.function, arrays, given.points)

    def keeping(kept: Any = arrays) -> None:
        call()

    return keeping


def _expressions(given: Task) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Arguments and components of the derivation, with the constants as numbers."""
    return (LOADS if given.function == "strains" else STRAINS), _components(given.function, given.p)


@cache
def _components(function: str, power: float) -> tuple[Any, ...]:
    rest = (0, 0, 0, 0, 0, 1)
    every = {
        "strains": lambda: tuple(a + b for a, b in zip(theory.strains(), rest, strict=True)),
        "loads": lambda: tuple(theory.loads()),
        "stiffness": lambda: tuple(theory.stiffness()),
    }
    found = tuple(e for part in function.split("_and_") for e in every[part]())
    known = dict(zip(ORDER, (*CONSTANTS, power), strict=True))
    exact = {s: sp.Float(v) for s, v in known.items()}
    exact |= {s: sp.Integer(2) for s, v in known.items() if s == p and v == 2}
    return tuple(e.subs(exact) for e in found)


def _lambdify(cse: bool, given: Task) -> Callable[[], Any]:
    arguments, found = _expressions(given)
    law, rows = sp.lambdify(arguments, found, "numpy", cse=cse), given.rows
    return lambda: law(*rows)


def _numba_cse(given: Task) -> Callable[[], Any]:
    arguments, found = _expressions(given)
    law = import_module("numba").njit(sp.lambdify(arguments, found, "numpy", cse=True))
    rows = [np.ascontiguousarray(row) for row in given.rows]
    return lambda: law(*rows)


def _numexpr(given: Task) -> Callable[[], Any]:
    numexpr = import_module("numexpr")
    numexpr.set_num_threads(1)
    arguments, found = _expressions(given)
    shared, reduced = sp.cse(found)
    steps = [(str(name), str(expr)) for name, expr in shared]
    rows = {str(s): row for s, row in zip(arguments, given.rows, strict=True)}

    def call() -> list[Any]:
        known = dict(rows)
        for name, text in steps:
            known[name] = numexpr.evaluate(text, known, {})
        return [numexpr.evaluate(str(e), known, {}) for e in reduced]

    return call


def _jax(given: Task) -> Callable[[], Any]:
    jax = import_module("jax")
    jax.config.update("jax_enable_x64", True)
    arguments, found = _expressions(given)
    law = jax.jit(sp.lambdify(arguments, found, "jax", cse=True))
    rows = [jax.numpy.asarray(row) for row in given.rows]
    return lambda: jax.block_until_ready(law(*rows))


def _casadi(folder: Path, given: Task) -> Callable[[], Any]:
    casadi = import_module("casadi")
    arguments, found = _expressions(given)
    symbols = [casadi.SX.sym(str(s)) for s in arguments]
    built = sp.lambdify(arguments, found, [{"sqrt": casadi.sqrt}, "math"], cse=True)(*symbols)
    name = f"{given.function}_{'p2' if given.p == 2 else 'general'}"
    law = casadi.Function(name, [casadi.vertcat(*symbols)], [casadi.vertcat(*built)])
    target = folder / f"{name}.so"
    if not target.exists():
        source = folder / f"{name}.c"
        generator = casadi.CodeGenerator(source.name)
        generator.add(law)
        generator.generate(f"{folder}/")
        found_compiler = peer_c.compiler()
        if found_compiler is None:
            raise ValueError("no C compiler")
        flags = ["-O3", "-march=native", "-fPIC", "-shared"]
        subprocess.run([found_compiler, *flags, str(source), "-o", str(target)], check=True)
    mapped = casadi.external(name, str(target)).map(given.points)
    columns = casadi.DM(np.concatenate([given.first, given.second]))
    return lambda: np.array(mapped(columns))


def save(found: Comparison, path: Path) -> None:
    """Store as JSON, one time a line."""
    record = asdict(found)
    keys = ("machine", "rounds", "peers", "missing")
    lines = [f'"{key}": {json.dumps(record[key])}' for key in keys]
    rows = ",\n".join("  " + json.dumps(row) for row in record["times"])
    write_text(path, "{\n" + ",\n".join([*lines, f'"times": [\n{rows}\n]']) + "\n}\n")


def table(found: Comparison) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Columns and rows for the terminal: ns a point and the ratio to C, a row a peer."""
    cases = list(dict.fromkeys((t.function, t.p, t.points) for t in found.times))
    cells = {(t.peer, t.function, t.p, t.points): t for t in found.times}
    rows: list[tuple[str, ...]] = []
    for function, power, points in cases:
        for name in found.peers:
            t = cells.get((name, function, power, points))
            if t:
                ns, ratio = f"{t.nanoseconds:.1f}", f"{t.ratio:.2f}"
                rows.append((function, f"{power:g}", str(points), name, ns, ratio))
    return ("function", "p", "points", "peer", "ns a point", "to C"), rows
