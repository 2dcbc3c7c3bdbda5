"""Prints plain kernels: bodies in place, rows that follow each other at once, and their constants.

A plain body answers False where its kernel's region does not hold all points of the block; the
results are to be written again then. Its temporaries are rows of scratch that stay in the cache.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from string import Template

import sympy as sp

from rodproof.codegen.kernel import SPAN_POWER, Kernel, Output, symbol
from rodproof.codegen.scene import Scene
from rodproof.codegen.targets.calls import Call, calls
from rodproof.codegen.targets.lines import INDENT, wrapped
from rodproof.codegen.targets.numpy_body import (
    QUIET,
    beside,
    heading,
    mirrored,
    packed_size,
    place_of,
    spread,
)
from rodproof.codegen.targets.numpy_form import (
    PRODUCTS,
    Head,
    Square,
    answer_of,
    beginning,
    beginning_calls,
    printer_of,
    products_at,
    rows_of,
)
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.targets.rows import Printed, last_reads, print_calls
from rodproof.codegen.texts import FunctionText
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
    """Rows of scratch, kept by each thread: fresh memory costs more than the work on it.

    Short ones follow each other, to be worked on as one; of long ones NumPy would make copies.
    """
    points = like.shape[-1]
    length = points if points < 512 else (points // LINE + 1) * LINE
    needed = count * length * like.itemsize
    memory = getattr(KEPT, "memory", None)
    if memory is None or len(memory) < needed:
        memory = KEPT.memory = _fresh((needed,), np.uint8)
    rows: Array = memory[:needed].view(like.dtype).reshape(count, length)
    return rows[:, :points]
'''

INSIDE = '''\
def _inside(square: Array, within: dict[Any, tuple[float, float]]) -> bool:
    """Whether all of it lies between the bounds for its type; nan does not."""
    low, high = within[square.dtype]
    return bool(low < square[square.argmin()] and square[square.argmax()] < high)
'''


#: Arrays of scratch: the linear rod's answer, and the dyad's vector where that is another one.
VECTOR, ALONG = "w", "h"


def plain_kernels(kernels: tuple[Kernel, ...]) -> tuple[Kernel, ...]:
    """The plain kernels that stand beside others."""
    return tuple(kernel.plain for kernel in kernels if kernel.plain)


def alone(kernel: Kernel) -> bool:
    """Whether the kernel is plain, and by itself."""
    return not any(a.step for a in kernel.body)


def plain_body(
    kernel: Kernel,
    text: FunctionText,
    constants: dict[str, str],
    squares: Mapping[str, Square],
    scene: Scene,
) -> str:
    """The body of a plain kernel; ``constants`` says how they are written.

    Beside another kernel it is told apart by its region, and by what it is called. The linear rod's
    answer is in the results, or in so many rows of scratch if others than these are made of it.
    """
    assert kernel.form is not None
    square = squares[kernel.form.quantity] if kernel.region else None
    answer = answer_of(kernel, scene)
    others = (o.expr for o in kernel.outputs if o.array not in answer)
    read = {s.name for expr in others for s in expr.free_symbols} & {*kernel.form.vector}
    size = len(kernel.form.vector) if read or not {*answer} <= {*text.outputs} else 0
    printed, views = _printed(kernel, text, square, constants, answer, size)
    count = max(printed.rows, square.printed.rows if square else 0) + size
    lines = [f"s = _scratch({count}, {next(iter(text.inputs))})", *views]
    lines += _begun(square, size) if square else []
    lines += printed.lines
    lines = ["k = c.plain", *lines, "return True"] if square else lines
    return "\n".join([*_opening(kernel, text), *(INDENT + line for line in lines)])


def _opening(kernel: Kernel, text: FunctionText) -> list[str]:
    """The heading and what it says."""
    if not kernel.region:
        return [*heading(kernel.name, text, "None"), f'{INDENT}"""{text.equation}"""']
    words = f"`_{kernel.name}` where nothing is extreme; else False."
    return [*heading(f"{kernel.name}_plain", text, "bool"), f'{INDENT}"""{words}"""']


def _begun(square: Square, size: int) -> list[str]:
    """The call of the shared beginning, and the test of the region."""
    name, first, answer = square.quantity, 0, list[str]()
    for array, head in square.answer.items():
        last = first + (head[0] if head else 1)
        part = f"{first or ''}:{last if last < size else ''}" if head else f"{first}"
        answer.append(f"{VECTOR}[{part}]" if size else array)
        first = last
    answer = [VECTOR] if answer == [f"{VECTOR}[:]"] else answer
    given = ", ".join([*square.given, "c", *answer, "s"])
    return [
        QUIET,
        f"{INDENT}{name} = _{name}({given})",
        f"if not _inside({name}, k.within_{name}):",
        f"{INDENT}return False",
    ]


def _printed(
    kernel: Kernel,
    text: FunctionText,
    square: Square | None,
    constants: dict[str, str],
    answer: Mapping[str, Head],
    size: int,
) -> tuple[Printed, list[str]]:
    """What comes after the shared beginning, or all of it, and the lines that part the scratch.

    The linear rod's answer is in the results, or in ``size`` rows of scratch.
    """
    printer, packed = printer_of(kernel, constants), packed_size(kernel, text)
    dyad, form = kernel.dyad, kernel.form
    assert form is not None
    places, lengths = rows_of(text.inputs, kernel.inputs)
    of_vector, own = rows_of({VECTOR: (size,)} if size else answer, form.vector)
    places |= {place_of(o, packed): place_of(o, packed) for o in kernel.outputs} | of_vector
    lengths |= {a: head[0] for a, head in text.outputs.items() if len(head) == 1} | own
    views = [f"{VECTOR}, s = s[:{size}], s[{size}:]"] if size else []
    done, work, first = (square.body if square else beginning(kernel)), list[Call](), 0
    if not square:
        work, first = beginning_calls(kernel, done, printer, places)
        places, lengths = places | products_at(first), lengths | {PRODUCTS: first}
        views += [f"{PRODUCTS} = s[:{first}]"] if first else []
    taken = {*range(first)}
    if dyad and dyad.vector != form.vector:
        first = square.printed.row[form.quantity] + 1 if square else first
        last = first + len(dyad.vector)
        places |= {n: f"{ALONG}[{k}]" for k, n in enumerate(dyad.vector)}
        lengths |= {ALONG: len(dyad.vector)}
        views += [f"{ALONG} = s[{first}:{last}]"]
        taken |= {*range(first, last)}
    work += _arranged(kernel, printer, packed, {a.name for a in done})
    rows = square.printed.row if square else {}
    held = {n: rows[n] for n in (form.quantity,) if n in rows and n in last_reads(work)}
    opened = [place_of(o, packed) for o in kernel.outputs if dyad and o.array == dyad.array]
    printed = print_calls(work, held, places=places, lengths=lengths, taken=taken, opened=opened)
    return printed, views


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
        along = VECTOR if kernel.form and dyad.vector == kernel.form.vector else ALONG
        work.append(Call("", "", (spread(dyad, along),), reads))
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
