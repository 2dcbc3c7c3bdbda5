"""Prints plain kernels: bodies in place, one operation a line, and the constants they take.

A plain body answers False, with nothing written to the results, where its kernel's region does
not hold all points of the block. Its temporaries are rows of scratch that stay in the cache.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from string import Template

import sympy as sp

from rodproof.codegen.kernel import (
    SPAN_POWER,
    Assignment,
    Kernel,
    KernelError,
    Output,
    symbol,
)
from rodproof.codegen.targets.calls import Call, calls
from rodproof.codegen.targets.lines import INDENT, wrapped
from rodproof.codegen.targets.numpy_body import (
    QUIET,
    beside,
    heading,
    mirrored,
    packed_size,
    place_of,
    rows_name,
    spread,
    taken,
    unpacked,
    vector_places,
)
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.targets.rows import Printed, last_reads, print_calls
from rodproof.codegen.texts import FunctionText, square_text
from rodproof.derivations.symbols import CONSTANTS

RECORD = Template('''\
class Plain:
    """What the plain bodies take, each number rounded once, and the squares where they hold."""

    def __init__(self, c: Constants) -> None:
$exact$values
        used = [v for v in $used if v]
$regions        self.room: dict[Any, tuple[float, float]] = {}
        for kind, tiny in TINY.items():
            span = tiny**-$power
            even = all(1 < abs(v) * span < span**2 for v in used)
            self.room[kind] = (1 / span, span) if even else (1.0, 0.0)
$bounds
$points

def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan
''')

SCRATCH = '''\
def _scratch(count: int, like: Array) -> Array:
    """Rows of scratch, kept by each thread: fresh memory costs more than the work on it."""
    length = (like.size // LINE + 1) * LINE
    needed = count * length * like.itemsize
    memory = getattr(KEPT, "memory", None)
    if memory is None or len(memory) < needed:
        memory = KEPT.memory = _fresh((needed,), np.uint8)
    rows: Array = memory[:needed].view(like.dtype).reshape(count, length)
    return rows[:, : like.size]
'''

INSIDE = '''\
def _inside(square: Array, within: dict[Any, tuple[float, float]]) -> bool:
    """Whether all of it lies between the bounds for its type; nan does not."""
    low, high = within[square.dtype]
    return bool(low < square[square.argmin()] and square[square.argmax()] < high)
'''


@dataclass(frozen=True)
class Square:
    """What plain kernels share: the assignments down to their region's quantity, as printed.

    ``results`` are what the bodies take from it, the quantity last; ``first`` is the row of
    scratch from which on bodies may keep a vector.
    """

    quantity: str
    inputs: tuple[str, ...]
    body: tuple[Assignment, ...]
    results: tuple[str, ...]
    printed: Printed
    first: int


def plain_kernels(kernels: tuple[Kernel, ...]) -> tuple[Kernel, ...]:
    """The plain kernels that stand beside others."""
    return tuple(kernel.plain for kernel in kernels if kernel.plain)


def alone(kernel: Kernel) -> bool:
    """Whether the kernel is plain, and by itself."""
    return not any(a.step for a in kernel.body)


def squares_of(kernels: tuple[Kernel, ...], constants: dict[str, str]) -> dict[str, Square]:
    """The shared beginnings of the plain kernels, by the quantity of their regions."""
    plain = plain_kernels(kernels)
    quantities = dict.fromkeys(k.region.quantity for k in plain if k.region)
    return {name: _square(name, plain, constants) for name in quantities}


def _square(quantity: str, plain: tuple[Kernel, ...], constants: dict[str, str]) -> Square:
    users = [k for k in plain if k.region and k.region.quantity == quantity]
    body, *others = (kernel.down_to(quantity) for kernel in users)
    vectors = {k.dyad.vector for k in users if k.dyad}
    if any({*other} != {*body} for other in others) or len(vectors) > 1:
        raise KernelError(f"the plain kernels disagree on {quantity} or on what goes with it")
    used = set().union(*(_used_after(body, kernel) for kernel in users))
    results = (*(a.name for a in body if a.name in used and a.name != quantity), quantity)
    made = {a.name for a in body}
    work = [c for a in body for c in calls(a.name, a.expr, _printer(users[0], constants))]
    first = print_calls(work, {}, kept=results).rows
    fixed = {n: first + k for vector in vectors for k, n in enumerate(vector) if n in made}
    printed = print_calls(work, {}, fixed=fixed, kept=results)
    return Square(quantity, users[0].inputs, body, results, printed, first)


def _used_after(body: tuple[Assignment, ...], kernel: Kernel) -> set[str]:
    """What the kernel takes from this beginning of its own."""
    made = {a.name for a in body}
    later = [a.expr for a in kernel.body if a.name not in made] + [o.expr for o in kernel.outputs]
    used = {s.name for e in later for s in e.free_symbols}
    return made & (used | set(kernel.dyad.vector if kernel.dyad else ()))


def square_function(square: Square) -> str:
    """The shared beginning as a private function, in place."""
    results = ", ".join(square.results)
    kind = "Rows" if len(square.results) > 1 else "Array"
    rows = rows_name(square.inputs)
    lines = [f"def _{square.quantity}({rows}: Rows, c: Constants, s: Rows) -> {kind}:"]
    lines += [
        f'{INDENT}"""{square_text(square.quantity, square.results)}"""',
        f"{INDENT}k = c.plain",
    ]
    lines += [INDENT + unpacked(square.inputs, rows)]
    lines += [INDENT + line for line in square.printed.lines]
    return "\n".join([*lines, f"{INDENT}return {results}"])


def _printer(kernel: Kernel, constants: dict[str, str]) -> Printer:
    """How numbers are written: constants of a kernel beside another have a record of their own."""
    own = {a.name: f"k.{a.name}" for a in kernel.constants} if kernel.region else {}
    return Printer({**constants, **own})


def plain_body(
    kernel: Kernel, text: FunctionText, constants: dict[str, str], squares: Mapping[str, Square]
) -> str:
    """The body of a plain kernel, one operation a line; ``constants`` says how they are written.

    Beside another kernel it is told apart by its region, and by what it is called.
    """
    region, rows = kernel.region, rows_name(kernel.inputs)
    square = squares[region.quantity] if region else None
    printed, held = _printed(kernel, square, _printer(kernel, constants), packed_size(kernel, text))
    count = max(printed.rows, square.printed.rows if square else 0)
    own = " ".join(printed.lines)
    used = [name if re.search(rf"\b{name}\b", own) else "_" for name in kernel.inputs]
    lines = [unpacked(used, rows)] if {*used} != {"_"} else []
    lines += [f"work = _scratch({count}, {rows}[0])", "s = [*work]"]
    if kernel.dyad:
        first, vector = square.first if square else 0, kernel.dyad.vector
        lines += [f"{vector[0][0]} = work[{first}:{first + len(vector)}]"]
    lines += _begun(square, rows, held) if square else []
    lines = (
        ["k = c.plain", *lines, *printed.lines, "return True"]
        if region
        else [*lines, *printed.lines]
    )
    return "\n".join([*_opening(kernel, text), *(INDENT + line for line in lines)])


def _opening(kernel: Kernel, text: FunctionText) -> list[str]:
    """The heading and what it says."""
    if not kernel.region:
        return [*heading(kernel, kernel.name, text, "None"), f'{INDENT}"""{text.equation}"""']
    words = f"`_{kernel.name}` where nothing is extreme; else False."
    return [*heading(kernel, f"{kernel.name}_plain", text, "bool"), f'{INDENT}"""{words}"""']


def _begun(square: Square, rows: str, held: Mapping[str, int]) -> list[str]:
    """The call of the shared beginning, and the test of the region."""
    left = taken(square.results, (*held, square.quantity))
    return [
        QUIET,
        f"{INDENT}{left} = _{square.quantity}({rows}, c, s)",
        f"if not _inside({square.quantity}, k.within_{square.quantity}):",
        f"{INDENT}return False",
    ]


def _printed(
    kernel: Kernel, square: Square | None, printer: Printer, packed: int
) -> tuple[Printed, Mapping[str, int]]:
    """What comes after the shared beginning, and the rows of what it takes from there."""
    dyad = kernel.dyad
    made = {a.name for a in square.body} if square else set[str]()
    work = _arranged(kernel, printer, packed, made)
    rows = square.printed.row if square else {}
    held = {name: row for name, row in rows.items() if name in last_reads(work)}
    places = {place_of(o, packed): place_of(o, packed) for o in kernel.outputs}
    places |= {n: place for n, place in vector_places(kernel).items() if n not in made}
    first = square.first if square else 0
    fixed = {name: first + k for k, name in enumerate(dyad.vector)} if dyad else {}
    opened = [place_of(o, packed) for o in kernel.outputs if dyad and o.array == dyad.array]
    return print_calls(work, held, places=places, fixed=fixed, opened=opened), held


def _arranged(kernel: Kernel, printer: Printer, packed: int, known: set[str]) -> list[Call]:
    """What the body computes: each output as soon as it can be, the dyad last.

    What is ``known`` is there already.
    """
    waiting = {a.name: a for a in kernel.body if a.name not in known}
    work = list[Call]()

    def settle(exprs: Iterable[sp.Expr]) -> None:
        wanted = {s.name for expr in exprs for s in expr.free_symbols} & set(waiting)
        for a in [a for a in kernel.body if a.name in wanted]:
            if a.name in waiting:
                settle([a.expr])
                del waiting[a.name]
                work.extend(calls(a.name, a.expr, printer))

    dyad = kernel.dyad
    for o in (o for o in kernel.outputs if not dyad or o.array != dyad.array):
        settle([o.expr])
        work.extend(calls(place_of(o, packed), o.expr, printer))
    if dyad:
        settle(map(symbol, (dyad.weight, *dyad.vector)))
        reads = frozenset({dyad.weight, *dyad.vector})
        work += [Call("", "", (line,), reads) for line in spread(kernel)]
        for extra, entries in beside(kernel).items():
            settle([extra])
            work.extend(_added(extra, entries, printer, packed))
    return work + [Call("", "", (line,), frozenset()) for line in mirrored(kernel, packed)]


def _added(
    extra: sp.Expr, entries: list[tuple[Output, bool]], printer: Printer, packed: int
) -> list[Call]:
    """The calls that put a value beside the dyad, or in place of it."""
    (first, added), *_ = entries
    if not added:
        return list(calls(place_of(first, packed), extra, printer))
    slot = str(extra) if extra.is_Symbol else f"{place_of(first, packed)}.0"
    places = [place_of(o, packed) for o, _ in entries]
    work = [] if extra.is_Symbol else list(calls(slot, extra, printer))
    return work + [Call(p, "np.add", (p, slot), frozenset({slot, p})) for p in places]


def plain_record(kernels: tuple[Kernel, ...], points: list[str]) -> str:
    """The class of the plain kernels' constants, and where they hold; empty without any.

    ``points`` are lines that collect the constants for one point.
    """
    plain = plain_kernels(kernels)
    if not plain:
        return ""
    derived = {a.name: a.expr for kernel in plain for a in kernel.constants}
    regions = {k.region.quantity: k.region for k in plain if k.region}
    names = [s.name for s in CONSTANTS]
    exact = {s.name for e in derived.values() for s in e.free_symbols}
    sized = {name for kernel in plain for name in kernel.sizes()}
    printer = Printer({n: n for n in (*names, "span")})
    of_record = Printer({n: f"c.{n}" for n in names} | {"span": "span"})
    needed = [n for n in names if n in exact]
    values = [f"self.{n} = _rounded({printer.text(e)})" for n, e in derived.items()]
    used = [f"c.{n}" for n in names if n in sized]
    bounds = []
    for quantity, region in regions.items():
        low, high = _bound(region.low, of_record), _bound(region.high, of_record)
        bounds += [f"{quantity} = ({low}, {high})"]
        bounds += [f"self.within_{quantity}[kind] = {quantity} if even else (1.0, 0.0)"]
    own = "vars(self).values()"
    return RECORD.substitute(
        power=SPAN_POWER,
        exact=_exact(needed),
        values="\n".join(INDENT * 2 + line for line in values),
        used=f"({', '.join(used)}, *{own})" if used else own,
        regions="".join(
            f"{INDENT * 2}self.within_{q}: dict[Any, tuple[float, float]] = {{}}\n" for q in regions
        ),
        bounds="\n".join(INDENT * 3 + line for line in bounds),
        points="".join(f"{line}\n" for line in points),
    )


def _exact(names: list[str]) -> str:
    """The constants as exact fractions, under their names."""
    if not names:
        return ""
    given = ", ".join(f"c.{name}" for name in names)
    if len(names) == 1:
        return f"{INDENT * 2}{names[0]} = Fraction({given})\n"
    each = f"Fraction(v) for v in ({given})"
    lines = wrapped(f"{', '.join(names)} = (", [each], ")", "", INDENT * 2)
    return "\n".join(lines) + "\n"


def _bound(expr: sp.Expr, printer: Printer) -> str:
    """A bound in the functions of the math module."""
    if isinstance(expr, (sp.Max, sp.Min)):
        inner = ", ".join(_bound(a, printer) for a in sorted(expr.args, key=str))
        return f"{type(expr).__name__.lower()}({inner})"
    if isinstance(expr, sp.exp):
        return f"math.exp({_bound(expr.args[0], printer)})"
    return f"{float(expr)}" if expr.is_Integer else printer.text(expr).replace("np.", "math.")
