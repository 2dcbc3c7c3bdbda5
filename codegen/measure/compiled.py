"""The peers: the law as compiled code of others, and by hand in C; ours for numba among them.

Each is a form like the others, but may be missing on a machine; ``missing`` says so before, and
NotHere where one fails over a function. Loops over points, where a peer has none, are ours.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from importlib import import_module, metadata, resources
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import sympy as sp

from rodproof.codegen.measure import peer_c
from rodproof.codegen.measure.form import Bind, Call, Code, Form, NotHere, live_rows
from rodproof.codegen.measure.inputs import Array

C, CXX = "a C compiler", "a C++ compiler"
FLAGS = ("-O3", "-march=native", "-fPIC", "-shared")
#: What the kernel in C has, and the scenes it is the law of.
BY_HAND = ("strains", "loads", "stiffness", "loads_and_stiffness")
FULL, SQUARE = "full_rod", "full_rod_p2"

#: Makes the call for the constants that are given with each call.
Law = Callable[[tuple[float, ...]], Call]


def forms() -> tuple[Form, ...]:
    """Every peer, in the order of the report."""
    c = f"by hand, no guards, {' '.join(peer_c.FLAGS[:3])}, libmvec"
    derived = "the derivation's expressions"
    return (
        Form("C", f"{c}; powers by pow", _by_hand(peer_c.POW), _whole, can=_in_c, needs=(C,)),
        Form(
            "C exp/log",
            f"{c}; powers by exp and log",
            _by_hand(peer_c.EXP_LOG),
            _whole,
            can=lambda code: _in_c(code) and code.subject.name == FULL,
            needs=(C,),
        ),
        Form(
            "stable numba",
            "the generated module for numba, its results reused through out=",
            lambda code, values: reusing(_numba_module(code), code, values),
            _arrays,
            can=lambda code: code.subject.name in (FULL, SQUARE),
            needs=("numba",),
        ),
        Form(
            "numba cse",
            "the code of lambdify cse under numba.njit, arrays in",
            _built(_numba_cse),
            live_rows,
            can=_derived,
            needs=("numba",),
        ),
        Form(
            "numexpr",
            "the subexpressions of cse, one evaluate each, one thread",
            _built(_numexpr),
            live_rows,
            can=_derived,
            needs=("numexpr",),
        ),
        Form(
            "jax",
            "lambdify cse to JAX, jit, CPU, float64, one thread",
            _built(_jax),
            _jax_rows,
            can=_derived,
            needs=("jax",),
        ),
        Form(
            "casadi",
            f"its C code of {derived}, compiled with {FLAGS[0]}, mapped over the points",
            _built(_casadi),
            _casadi_columns,
            can=_derived,
            needs=("casadi", C),
        ),
        Form(
            "symforce",
            f"its C++ code of {derived}, {' '.join(FLAGS[:2])}, in a loop over the points",
            _built(_symforce),
            _stacked,
            can=_derived,
            needs=("symforce", CXX),
        ),
    )


def missing(form: Form) -> str | None:
    """Why a form cannot be had on this machine, as far as can be said without trying."""
    for need in form.needs:
        if need in (C, CXX):
            if peer_c.compiler(plus=need == CXX) is None:
                return f"needs {need}"
        elif find_spec(need) is None:
            return f"{need} is not installed: pip install 'rodproof[peers]'"
    return None


def versions(code: Code, needs: Sequence[str]) -> dict[str, str]:
    """What decides the results of the forms with these needs, besides the scene's own module."""
    found = {need: version(need) for need in needs}
    if C in found:
        found["kernel"] = hashlib.sha256(peer_c.SOURCE.read_bytes()).hexdigest()
    if "numba" in found and code.subject.name in (FULL, SQUARE):
        text = resources.files("rodproof.generated.numba").joinpath(f"{code.subject.name}.py")
        found["module"] = hashlib.sha256(text.read_bytes()).hexdigest()
    return found


@cache
def version(need: str) -> str:
    """Of a library, or what a compiler says of itself."""
    if need not in (C, CXX):
        return metadata.version(need)
    command = [str(peer_c.compiler(plus=need == CXX)), "--version"]
    said = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    return (said.splitlines() or [""])[0]


def reusing(module: ModuleType, code: Code, values: tuple[float, ...]) -> Call:
    """A generated function that fills its own earlier results again where it answered a block."""
    constants = code.subject.record(values, module)
    law, out = getattr(module, code.function), None

    def call(*arrays: Any) -> Any:
        nonlocal out
        answer = law(*arrays, constants, out=out)
        if isinstance(arrays[0], np.ndarray):
            out = answer
        return answer

    return call


def _built(build: Callable[[Code], Law]) -> Bind:
    """Built once for each code; whatever a library fails with says why it is not here."""
    return lambda code, values: _law(build, code)(code.given(values))


@cache
def _law(build: Callable[[Code], Law], code: Code) -> Law:
    try:
        return build(code)
    except Exception as error:
        raise NotHere(sentence(error)) from error


def sentence(error: Exception) -> str:
    """What a peer failed with, in a line."""
    if isinstance(error, NotHere):
        return str(error)
    return f"{type(error).__name__}: {error}".splitlines()[0][:200]


def _derived(code: Code) -> bool:
    """Whether the derivation has an elementary expression."""
    return not code.needs_2f1 and code.function != "stiffness_at_loads"


# -- by hand in C, and ours for numba -------------------------------------------------------------


def _in_c(code: Code) -> bool:
    return code.subject.name in (FULL, SQUARE) and code.function in BY_HAND


def _by_hand(power: int) -> Bind:
    def bind(code: Code, values: tuple[float, ...]) -> Call:
        library = _kernel(peer_c.SQUARE if code.subject.name == SQUARE else power)
        a, b, z, h, iota, gamma, p = values
        k = np.array([a * a, b * b, z * z, h * h, iota, gamma, p])
        pair, whole = ((3,), (3,)), ((6, 6),)
        heads = {"stiffness": whole, "loads_and_stiffness": (*pair, *whole)}
        kept: tuple[Any, ...] = ()

        def call(first: Array, second: Array) -> Any:
            nonlocal kept
            if not kept or kept[0] is not first or kept[1] is not second:
                points = first.shape[1]
                shapes = heads.get(code.function, pair)
                outs = tuple(peer_c.aligned((*head, points)) for head in shapes)
                run = peer_c.bound(library, code.function, (first, second, k, *outs), points)
                kept = (first, second, outs, run)
            kept[3]()
            return kept[2]

        return call

    return bind


def _whole(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    return np.ascontiguousarray(first), np.ascontiguousarray(second)


@cache
def _kernel(power: int) -> ctypes.CDLL:
    with _folder() as folder:
        return peer_c.build(power, folder)


def _numba_module(code: Code) -> ModuleType:
    return import_module(f"rodproof.generated.numba.{code.subject.name}")


def _arrays(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    return code.subject.arguments(code.function, first, second)


# -- libraries ------------------------------------------------------------------------------------


def _numba_cse(code: Code) -> Law:
    numba = import_module("numba")
    law = numba.njit(sp.lambdify((*code.rows, *code.constants), code.components, "numpy", cse=True))
    return lambda values: lambda *rows: law(*rows, *values)


def _numexpr(code: Code) -> Law:
    numexpr = import_module("numexpr")
    numexpr.set_num_threads(1)
    shared, reduced = sp.cse(code.components)
    steps = [(str(name), str(expr)) for name, expr in shared]
    last = [str(expr) for expr in reduced]
    names = [s.name for s in code.rows]

    def law(values: tuple[float, ...]) -> Call:
        constants = {s.name: v for s, v in zip(code.constants, values, strict=True)}

        def call(*rows: Array) -> list[Any]:
            known: dict[str, Any] = constants | dict(zip(names, rows, strict=True))
            for name, text in steps:
                known[name] = numexpr.evaluate(text, known, {}, truediv=True)
            return [numexpr.evaluate(text, known, {}, truediv=True) for text in last]

        return call

    return law


def _jax(code: Code) -> Law:
    jax = _jax_in_one_thread()
    made = sp.lambdify((*code.rows, *code.constants), code.components, "jax", cse=True)
    law = jax.jit(made)

    def bind(values: tuple[float, ...]) -> Call:
        constants = [jax.numpy.asarray(value) for value in values]
        return lambda *rows: jax.block_until_ready(law(*rows, *constants))

    return bind


def _jax_rows(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    jax = _jax_in_one_thread()
    return [jax.numpy.asarray(row) for row in live_rows(code, first, second, False)]


@cache
def _jax_in_one_thread() -> Any:
    """JAX with doubles; XLA takes its threads from NPROC when it first computes."""
    jax = import_module("jax")
    jax.config.update("jax_enable_x64", True)
    before = os.environ.get("NPROC")
    os.environ["NPROC"] = "1"
    jax.block_until_ready(jax.numpy.zeros(1))
    del os.environ["NPROC"]
    if before is not None:
        os.environ["NPROC"] = before
    return jax


def _casadi(code: Code) -> Law:
    casadi = import_module("casadi")
    rows, constants = (
        [casadi.SX.sym(s.name) for s in symbols] for symbols in (code.rows, code.constants)
    )
    names = (*code.rows, *code.constants)
    known = [{"sqrt": casadi.sqrt}, "math"]
    built = sp.lambdify(names, code.components, known, cse=True)(*rows, *constants)
    given = [casadi.vertcat(*rows), casadi.vertcat(*constants)]
    law = casadi.Function(code.name, given, [casadi.vertcat(*built)])
    generator = casadi.CodeGenerator(f"{code.name}.c")
    generator.add(law)
    with _folder() as folder:
        generator.generate(f"{folder}/")
        target = _shared(peer_c.compiler(), folder / f"{code.name}.c")
        external = casadi.external(code.name, str(target))
    mapped = cache(lambda points: external.map(code.name, "serial", points, [1], []))

    def bind(values: tuple[float, ...]) -> Call:
        fixed = casadi.DM(list(values))
        return lambda columns: mapped(columns.shape[1])(columns, fixed).full()

    return bind


def _casadi_columns(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    return [import_module("casadi").DM(*_stacked(code, first, second, single))]


LOOP = """\
#include <cstddef>
#include "{name}.h"

extern "C" void over_points(const double* in, const double* k, double* out, std::ptrdiff_t n) {{
    for (std::ptrdiff_t i = 0; i < n; i++) sym::{call}<double>({arguments});
}}
"""


def _symforce(code: Code) -> Law:
    with _folder() as folder:
        source = _symforce_source(code, folder)
        library = ctypes.CDLL(str(_shared(peer_c.compiler(plus=True), source)))
    rows = len(code.components)

    def bind(values: tuple[float, ...]) -> Call:
        constants, out = np.array(values), np.empty((rows, 0))

        def call(points: Array) -> Array:
            nonlocal out
            size = points.shape[1]
            if out.shape[1] != size:
                out = np.empty((rows, size))
            pointers = (ctypes.c_void_p(a.ctypes.data) for a in (points, constants, out))
            library.over_points(*pointers, ctypes.c_ssize_t(size))
            return out

        return call

    return bind


def _symforce_source(code: Code, folder: Path) -> Path:
    """SymForce's function of one point, scalars in and out, and a loop over it."""
    sf, values, codegen = _symforce_modules()
    inputs, outputs = values.Values(), values.Values()
    for symbol in (*code.rows, *code.constants):
        inputs[symbol.name] = sf.Symbol(symbol.name)
    for place, component in enumerate(code.components):
        outputs[f"out_{place}"] = sf.S(component)
    config = codegen.CppConfig()
    made = codegen.Codegen(inputs=inputs, outputs=outputs, config=config, name=code.name)
    made.generate_function(output_dir=folder, skip_directory_nesting=True)
    # The header asks for Eigen, of which scalars use nothing.
    (folder / "Eigen").mkdir()
    (folder / "Eigen" / "Core").write_text("#include <cmath>\n")
    arguments = [f"in[{k} * n + i]" for k in range(len(code.rows))]
    arguments += [f"k[{k}]" for k in range(len(code.constants))]
    arguments += [f"&out[{k} * n + i]" for k in range(len(code.components))]
    call = "".join(part.capitalize() for part in code.name.split("_"))
    source = folder / "loop.cc"
    text = LOOP.format(name=code.name, call=call, arguments=", ".join(arguments))
    source.write_text(text)
    return source


@cache
def _symforce_modules() -> tuple[ModuleType, ...]:
    import_module("symforce").set_epsilon_to_symbol()  # to be said first, though it is not used
    return tuple(import_module(f"symforce.{name}") for name in ("symbolic", "values", "codegen"))


def _stacked(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    return [np.stack(live_rows(code, first, second, False))]


@contextmanager
def _folder() -> Iterator[Path]:
    """A folder to compile in; what is loaded from it stays when it is gone."""
    with tempfile.TemporaryDirectory(prefix="rodproof-") as name:
        yield Path(name)


def _shared(compiler: str | None, source: Path) -> Path:
    """The source as a shared library beside it."""
    target = source.with_suffix(".so")
    command = [str(compiler), *FLAGS, f"-I{source.parent}", str(source), "-o", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise NotHere(f"{compiler}: {(done.stderr.splitlines() or ['failed'])[0]}")
    return target
