"""What the bodies of a NumPy module have in common: headings, places, and matrices."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import sympy as sp

from rodproof.codegen.kernel import Dyad, Kernel, Output
from rodproof.codegen.scene import LOAD_NAMES
from rodproof.codegen.targets.lines import wrapped
from rodproof.codegen.texts import FunctionText
from rodproof.derivations.symbols import CONSTANTS

#: What may leave the range of numbers before a test finds out.
QUIET = 'with np.errstate(over="ignore", invalid="ignore"):'

SPREAD = '''\
def _spread(matrix: Array, weight: Array, vector: Array) -> None:
    """weight vector vector^T, a row and its mirror image at a time."""
    for i, row in enumerate(vector):
        np.multiply(weight * row, vector[i:], out=matrix[i, i:])
        matrix[i + 1 :, i] = matrix[i, i + 1 :]
'''

SPREAD_PACKED = '''\
def _spread(matrix: Array, weight: Array, vector: Array) -> None:
    """weight vector vector^T, on and above the diagonal, row after row."""
    first = 0
    for i, row in enumerate(vector):
        last = first + len(vector) - i
        np.multiply(weight * row, vector[i:], out=matrix[first:last])
        first = last
'''

MIRROR = '''\
def _mirror(matrix: Array) -> None:
    """What is above the diagonal, below it."""
    for i in range(1, len(matrix)):
        matrix[i, :i] = matrix[:i, i]
'''


def spelling(kernels: tuple[Kernel, ...]) -> dict[str, str]:
    """How the text writes numbers: constants by their record, limits of the format by name."""
    derived = (a.name for kernel in kernels for a in kernel.constants)
    limits = {"tiny": "tiny", "log_max": "log_max"}
    return limits | {name: f"c.{name}" for name in (*(s.name for s in CONSTANTS), *derived)}


def rows_name(inputs: tuple[str, ...]) -> str:
    """What rows are called: loads, strains, or strains from rest."""
    return "loads" if inputs[0] in LOAD_NAMES else "rest" if "stretch" in inputs else "strains"


def heading(name: str, text: FunctionText, answer: str) -> list[str]:
    """The first lines of a body."""
    given = [f"{array}: Array" for array in text.inputs]
    taken = [f"{array}: Array" for array in text.outputs]
    pieces = [", ".join([*given, "c: Constants", *taken])]
    return wrapped(f"def _{name}(", pieces, f") -> {answer}:", ", ", "")


def gathered(text: FunctionText) -> str:
    """A list of the rows of all inputs."""
    rows = ", ".join(f"*{name}" if head else name for name, head in text.inputs.items())
    return f"[{rows}]"


def unpacked(names: Sequence[str], rows: str) -> str:
    """The line that gives rows their names; a single one comes in a sequence too."""
    return f"{', '.join(names)}{',' * (len(names) == 1)} = {rows}"


def taken(results: Sequence[str], wanted: Collection[str]) -> str:
    """The left side that takes of several results those that are wanted."""
    names = [name if name in wanted else "_" for name in results]
    return f"*_, {names[-1]}" if {*names[:-1]} == {"_"} else ", ".join(names)


def upper(size: int, i: int, j: int) -> int:
    """The place of an entry among those on and above the diagonal, row after row."""
    return i * size - i * (i + 1) // 2 + j


def place_of(o: Output, packed: int = 0) -> str:
    """Where an output goes; ``packed`` is the size of a matrix whose upper rows follow on."""
    if packed and len(o.index) == 2:
        i, j = o.index
        return f"{o.array}[{upper(packed, i, j)}]"
    return f"{o.array}[{', '.join(map(str, o.index))}]" if o.index else o.array


def packed_size(kernel: Kernel, text: FunctionText) -> int:
    """The size of a matrix whose upper rows follow on, or 0."""
    array, size = matrix_of(kernel)
    return size if array and len(text.outputs[array]) == 1 else 0


def matrix_of(kernel: Kernel) -> tuple[str, int]:
    """The symmetric matrix among the outputs and its size; a dyad or not, it is mirrored."""
    found = [o for o in kernel.outputs if len(o.index) == 2]
    return (found[0].array, 1 + max(o.index[0] for o in found)) if found else ("", 0)


def vector_places(kernel: Kernel) -> dict[str, str]:
    """The entries of the dyad's vector as rows of one array."""
    names = kernel.dyad.vector if kernel.dyad else ()
    return {name: f"{names[0][0]}[{k}]" for k, name in enumerate(names)}


def spread(dyad: Dyad, along: str) -> str:
    """The line that writes the rank-one term, of the vector in the array ``along``."""
    return f"_spread({dyad.array}, {dyad.weight}, {along})"


def mirrored(kernel: Kernel, packed: int) -> list[str]:
    """The lines that mirror what is beside the dyad, or a whole matrix without one."""
    array, size = matrix_of(kernel)
    if packed or size < 2:
        return []
    if kernel.dyad is None:
        return [f"_mirror({array})"]
    places = [o.index for found in beside(kernel).values() for o, _ in found]
    return [f"{array}[{j}, {i}] = {array}[{i}, {j}]" for i, j in places if i != j]


def beside(kernel: Kernel) -> dict[sp.Expr, list[tuple[Output, bool]]]:
    """What the entries hold beside the dyad: outputs by it, and whether it is to be added."""
    dyad = kernel.dyad
    assert dyad is not None
    found = dict[sp.Expr, list[tuple[Output, bool]]]()
    for o in (o for o in kernel.outputs if o.array == dyad.array):
        extra = o.expr - dyad.term(o.index[0], o.index[1])
        if extra:
            added = bool(o.expr.is_Add and not extra.is_Add)
            found.setdefault(extra if added else o.expr, []).append((o, added))
    return found
