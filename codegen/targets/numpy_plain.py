"""Prints plain kernels: a flat body, one operation a line, and the constants they take.

A plain body answers False, with nothing written to the results, where its kernel's region does
not hold all points of the block.
"""

from __future__ import annotations

from string import Template

import sympy as sp

from rodproof.codegen.kernel import SPAN_POWER, Kernel
from rodproof.codegen.targets.numpy_body import (
    INDENT,
    Body,
    arranged,
    heading,
    packed_size,
    place_of,
    rows_name,
)
from rodproof.codegen.targets.printer import Printer, wrapped
from rodproof.codegen.targets.rows import print_calls
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


def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan
''')

TEST = """\
low, high = k.within_{quantity}[{quantity}.dtype]
if not (low < {quantity}.min() and {quantity}.max() < high):
    return False"""


def plain_kernels(kernels: tuple[Kernel, ...]) -> tuple[Kernel, ...]:
    """The plain kernels that stand beside others."""
    return tuple(kernel.plain for kernel in kernels if kernel.plain)


def plain_body(kernel: Kernel, text: FunctionText, constants: dict[str, str]) -> Body:
    """The flat body of a plain kernel; ``constants`` says how they are written.

    Beside another kernel it is told apart by its region, and by what it is called.
    """
    region, dyad = kernel.region, kernel.dyad
    own = {a.name: f"k.{a.name}" for a in kernel.constants} if region else {}
    printer = Printer({**constants, **own})
    packed = packed_size(kernel, text)
    after = {region.quantity: TEST.format(quantity=region.quantity)} if region else {}
    work = arranged(kernel, printer, packed, set(), after)
    places = {place_of(o, packed): place_of(o, packed) for o in kernel.outputs}
    vector = {name: f"{name[0]}[{k}]" for k, name in enumerate(dyad.vector)} if dyad else {}
    fixed = {name: k for k, name in enumerate(vector)}
    opened = [place_of(o, packed) for o in kernel.outputs if dyad and o.array == dyad.array]
    printed = print_calls(work, {}, places=places | vector, fixed=fixed, opened=opened)
    comma = "," if len(kernel.inputs) == 1 else ""
    lines = heading(kernel, f"{kernel.name}_plain", text, "bool") if region else []
    lines = lines or heading(kernel, kernel.name, text, "None")
    words = f"`_{kernel.name}` where nothing is extreme; else False." if region else text.equation
    lines += [f'{INDENT}"""{words}"""']
    lines += [f"{INDENT}k = c.plain"] if region else []
    lines += [f"{INDENT}{', '.join(kernel.inputs)}{comma} = {rows_name(kernel.inputs)}"]
    lines += [f"{INDENT}s = [*work[:{printed.rows}]]"]
    lines += [f"{INDENT}{dyad.vector[0][0]} = work[:{len(vector)}]"] if dyad else []
    lines += [INDENT + line for line in _guarded(printed.lines)]
    lines += [f"{INDENT}return True"] if region else []
    return Body("\n".join(lines), printed.rows)


def _guarded(lines: tuple[str, ...]) -> list[str]:
    """What comes before the test of the region may overflow: the test answers for it."""
    tests = [at for at, line in enumerate(lines) if line.startswith("low, high = ")]
    if not tests:
        return [*lines]
    quiet = ['with np.errstate(over="ignore", invalid="ignore"):']
    return [*quiet, *(INDENT + line for line in lines[: tests[0]]), *lines[tests[0] :]]


def plain_record(kernels: tuple[Kernel, ...]) -> str:
    """The class of the plain kernels' constants, and where they hold; empty without any."""
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
    )


def _exact(names: list[str]) -> str:
    """The constants as exact fractions, under their names."""
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
