"""Prints an equilibrium module: the law's module, and after it the equations around the law."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping

import sympy as sp

from rodproof.codegen.equilibria.system import Piece
from rodproof.codegen.passes.share import DIVISORS
from rodproof.codegen.passes.stabilise import CHIRAL_CONSTANTS
from rodproof.codegen.targets.lines import INDENT, wrapped
from rodproof.codegen.targets.printer import Printer
from rodproof.derivations.symbols import CONSTANTS

WIDTH = 98
FUTURE = "from __future__ import annotations\n"
SPELLING = {
    name: f"c.{name}"
    for name in (
        *(c.name for c in CONSTANTS),
        *(a.name for a in CHIRAL_CONSTANTS),
        *(f"per_{c.name}" for c in DIVISORS),
    )
}


def module(
    heading: list[str], law: str, parts: list[str], imports: Mapping[str, str] | None = None
) -> str:
    """The law's module under another heading, with ``parts`` after it.

    ``imports`` says what its lines of imports become.
    """
    _, mark, rest = law.partition(FUTURE)
    for old, new in (imports or {}).items():
        if rest.count(old) != 1:
            raise ValueError(f"the law's module must have one line {old!r}")
        rest = rest.replace(old, new)
    text = "\n".join(['"""' + heading[0], *heading[1:], '"""']) + "\n\n" + mark + rest
    return "\n\n\n".join([text.rstrip("\n"), *(part.strip("\n") for part in parts)]) + "\n"


def paragraphs(*said: str) -> list[str]:
    """Lines of a docstring, a blank one before each paragraph."""
    return [
        line
        for paragraph in said
        for line in ("", *textwrap.wrap(paragraph, WIDTH, break_on_hyphens=False))
    ]


def cited(statements: tuple[str, ...], verdicts: Mapping[str, str]) -> str:
    """Statements with their verdicts."""
    noted = " (verdict; as corrected if refuted)" if verdicts else ""
    each = ", ".join(f"{s} {verdicts.get(s, '')}".strip() for s in statements)
    return f"Statements it rests on{noted}: {each}."


def table(name: str, entries: list[str]) -> str:
    """A tuple of pieces of text, on as few lines as hold it."""
    return "\n".join(_filled(f"{name} = ({', '.join(entries)})", f"{name} = (", entries, ")"))


def _filled(line: str, opening: str, entries: list[str], closing: str) -> list[str]:
    """The line, or opening and closing with the entries between them on as few lines as go."""
    if len(line) <= 100:
        return [line]
    indent = opening[: len(opening) - len(opening.lstrip())]
    width = 96 - len(indent)
    rows = textwrap.wrap(", ".join(e.replace(" ", "~") for e in entries) + ",", width)
    inside = [indent + INDENT + row.replace("~", " ") for row in rows]
    return [opening, *inside, indent + closing]


def function(piece: Piece) -> str:
    """A piece as a private function on floats or arrays, with its table of entries before it."""
    kernel, printer = piece.kernel, Printer(SPELLING)
    exprs = [sp.factor_terms(o.expr) for o in kernel.outputs]
    used = {s.name for e in (*(a.expr for a in kernel.body), *exprs) for s in e.free_symbols}
    lines = []
    if piece.entries:
        lines += [
            table(piece.entries, [f"({i}, {j})" for i, j in (o.index for o in kernel.outputs)])
        ]
        lines += ["", ""]
    given = [
        f"{name}: {'Numbers' if len(names) > 1 else 'Number'}"
        for name, names in piece.arguments.items()
        if used & set(names)
    ]
    given += ["c: Constants"] if used & set(SPELLING) else []
    lines += wrapped(f"def _{kernel.name}(", given, ") -> Numbers:", ", ", "")
    lines += [f'{INDENT}"""{piece.doc}"""']
    for name, names in piece.arguments.items():
        if used & set(names) and (name,) != names:
            taken = [n if n in used else "_" for n in names]
            lines += _filled(
                f"{INDENT}{', '.join(taken)} = {name}", f"{INDENT}(", taken, f") = {name}"
            )
    for a in kernel.body:
        lines += _assign(a.name, sp.factor_terms(a.expr), printer)
    entries = [printer.text(e) if e != 0 else "0.0" for e in exprs]
    return "\n".join([*lines, *_returned(entries, exprs, printer)])


def _assign(name: str, expr: sp.Expr, printer: Printer) -> list[str]:
    line = f"{INDENT}{name} = {printer.text(expr)}"
    if len(line) <= 100:
        return [line]
    return wrapped(f"{name} = (", printer.terms(expr), ")", " ", INDENT)


def _returned(entries: list[str], exprs: list[sp.Expr], printer: Printer) -> list[str]:
    line = f"{INDENT}return ({', '.join(entries)})"
    if len(line) <= 100 and not any(e.is_Add or e.is_Mul for e in exprs):
        return [line.replace("(", "", 1)[:-1]]
    lines = [f"{INDENT}return ("]
    for entry, expr in zip(entries, exprs, strict=True):
        row = f"{INDENT * 2}{entry},"
        if len(row) <= 100:
            lines += [row]
        else:
            lines += [f"{INDENT * 2}("]
            lines += [INDENT * 3 + term for term in printer.terms(expr)]
            lines += [f"{INDENT * 2}),"]
    return [*lines, f"{INDENT})"]
