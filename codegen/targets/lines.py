"""Lays text out in lines that hold it: assignments side by side, long sums, lists of names."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from rodproof.codegen.kernel import Assignment
from rodproof.codegen.targets.printer import SUM, Printer

INDENT = "    "
WIDTH = 100


def grouped(
    assignments: Sequence[Assignment], printer: Printer, most: int = 3, loosest: int = SUM
) -> list[str]:
    """A line for up to ``most`` assignments of one kind that do not need each other.

    The lines are indented once; Python makes a tuple of four names and more.
    """
    left = list(assignments)
    lines: list[str] = []
    while left:
        first, *left = left
        group, text = [first], printer.text(first.expr, loosest)
        line = f"{INDENT}{printer.name(first)} = {text}"
        if len(line) > WIDTH:
            lines += broken(printer.name(first), text)
            continue
        texts, unset = [text], {first.name, *(a.name for a in left)}
        for a in tuple(left):
            if len(group) == most:
                break
            early = {s.name for s in a.expr.free_symbols} & unset
            if early or _kind(a, printer) != _kind(first, printer):
                continue
            more = [*texts, printer.text(a.expr, loosest)]
            names = ", ".join(printer.name(b) for b in (*group, a))
            longer = f"{INDENT}{names} = {', '.join(more)}"
            if len(longer) > WIDTH:
                break
            line, texts = longer, more
            group.append(a)
            left.remove(a)
        lines.append(line)
    return lines


def _kind(a: Assignment, printer: Printer) -> object:
    """What stands on one line is alike: entries of an array, or expressions of the same form."""
    if re.fullmatch(r"[a-z]\d\d", a.name):
        return a.name[:2]
    array, entry, _ = printer.name(a).partition("[")
    form = a.expr.func, len(a.expr.args), all(arg.is_Atom for arg in a.expr.args)
    return (array, form) if entry else form


def broken(name: str, text: str) -> list[str]:
    """A long sum, a few of its terms a line; or a product, its last factor by itself."""
    lines = [""]
    terms = _terms(text)
    for piece in terms if len(terms) > 1 else text.replace(" * (", "\0* (", 1).split("\0"):
        if len(lines[-1]) + len(piece) > WIDTH - 10:
            lines.append("")
        lines[-1] += f"{' ' * bool(lines[-1])}{piece}"
    return [
        f"{INDENT}{name} = (",
        *(f"{INDENT * 2}{line}" for line in lines),
        f"{INDENT})",
    ]


def _terms(text: str) -> list[str]:
    """The terms of a sum with their signs; what stands in parentheses stays together."""
    terms, depth = [""], 0
    for word in text.split(" "):
        if word in ("+", "-") and not depth:
            terms.append(word)
        else:
            terms[-1] += f"{' ' * bool(terms[-1])}{word}"
        depth += word.count("(") - word.count(")")
    return terms


def filled(pieces: Sequence[str], indent: str) -> list[str]:
    """The pieces with commas, on as few lines as hold them."""
    lines = [""]
    for piece in pieces:
        if len(indent + lines[-1] + piece) + 2 > WIDTH:
            lines.append("")
        lines[-1] += f"{' ' * bool(lines[-1])}{piece},"
    return [indent + line for line in lines]


def wrapped(opening: str, pieces: list[str], closing: str, joint: str, indent: str) -> list[str]:
    """Lines for ``opening + joint.join(pieces) + closing``, one piece a line if it is too long."""
    line = indent + opening + joint.join(pieces) + closing
    if len(line) <= WIDTH:
        return [line]
    inner = indent + INDENT
    if len(inner + joint.join(pieces)) <= WIDTH:
        return [indent + opening, inner + joint.join(pieces), indent + closing]
    comma = joint.rstrip() if joint.strip() else ""
    return [
        indent + opening,
        *(f"{inner}{piece}{comma}" for piece in pieces),
        indent + closing,
    ]


def needed(opening: str, text: str) -> str:
    """The opening of a module without the lines that set what neither it nor the text uses."""
    kept: list[str] = []
    for line in reversed(opening.split("\n")):
        names = re.match(r"[A-Z]\w*(, [A-Z]\w*)* = ", line)
        rest = "\n".join([*kept, text])
        every = re.findall(r"\w+", names[0]) if names else []
        if not names or any(re.search(rf"\b{name}\b", rest) for name in every):
            kept.insert(0, line)
    return "\n".join(kept)


def called(functions: Mapping[str, str], text: str) -> list[str]:
    """Of the functions, by name, those that the text calls and those that they call."""
    found: list[str] = []
    for name, function in reversed([*functions.items()]):
        if re.search(rf"(?<!def )\b{name}\(", text + "".join(found)):
            found.insert(0, function)
    return found
