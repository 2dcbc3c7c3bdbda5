"""Prints a kernel as straight-line code on single numbers: plain Python, or numba.

Both dialects print the same assignments in the same order. They differ in what a `Dialect` says:
how a power is written, and whether the scale of the gauge is one or an argument.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen.kernel import Assignment, Kernel, Output, log_max, symbol, tiny
from rodproof.codegen.passes.share import drop_aliases
from rodproof.codegen.passes.specialise import drop_dead
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.targets.lines import INDENT, WIDTH, filled, grouped, wrapped
from rodproof.codegen.targets.printer import ATOM, POWER, PRODUCT, Printer
from rodproof.derivations.symbols import CONSTANTS

LOOSE = -1  # a choice binds less than a sum
MATH: dict[type, str] = {sp.exp: "exp", sp.log: "log", log1p: "log1p", expm1: "expm1"}
#: Properties of double precision, as the printed modules call them.
LIMITS = {tiny.name: "LEAST", log_max.name: "LOG_MOST"}
LETTERS = {"stiff": "k", "soft": "s"}  # entries of a matrix: k12 and its like
SCALE = symbol("scale")
ROOT = sp.sqrt(symbol(tiny.name))


@dataclass(frozen=True)
class Dialect:
    """What languages of single numbers spell differently.

    powers: exp(a log b) is written b**a, which is faster and closer there.
    scaled: the gauge's inputs are taken times the argument ``scale``; else its scale is one.
    prefix: what the names of exp, log, log1p and expm1 begin with.
    flat: the answer is one tuple of numbers, with the entries of a matrix on and above the
    diagonal; else it is a tuple for each array, and a tuple of rows for a matrix.
    """

    powers: bool
    scaled: bool
    prefix: str
    flat: bool


PYTHON = Dialect(powers=True, scaled=False, prefix="", flat=False)
NUMBA = Dialect(powers=False, scaled=True, prefix="_", flat=True)


@dataclass(frozen=True)
class Body:
    """A function on single numbers: indented lines, and the pieces that it returns."""

    lines: tuple[str, ...]
    answer: tuple[str, ...]


def square(kernel: Kernel, dialect: Dialect) -> str:
    """The name that must stay in the comfortable range of squares, or nothing."""
    if kernel.gauge is None:
        return ""
    return "square" if dialect.scaled else kernel.gauge.square


def body(
    kernel: Kernel,
    dialect: Dialect,
    spelling: Mapping[str, str],
    guards: Mapping[str, Sequence[str]],
    *,
    packed: bool = False,
) -> Body:
    """The kernel in the dialect; ``guards`` are lines that follow the assignment of a name.

    packed: matrices are the entries on and above the diagonal.
    """
    ready = atomic(_entries(_rows(_resolved(_named(kernel), dialect))))
    printer = ScalarPrinter({**spelling, **LIMITS}, dialect)
    lines: list[str] = []
    waiting: list[Assignment] = []
    scaled = kernel.gauge if dialect.scaled else None
    for a in ready.body:
        if scaled and a.step == scaled.step:
            lines += [*_grouped(waiting, printer), *_scale(scaled.inputs)]
            waiting, scaled = [], None
        waiting.append(a)
        if a.name in guards:
            lines += [*_grouped(waiting, printer), *guards[a.name]]
            waiting = []
    lines += _grouped(waiting, printer)
    if dialect.flat:
        return Body(tuple(lines), tuple(printer.text(o.expr, LOOSE) for o in ready.outputs))
    arrays = {o.array: [p for p in ready.outputs if p.array == o.array] for o in ready.outputs}
    answer = []
    for name, outputs in arrays.items():
        if len(outputs[0].index) == 2:
            alone = len(arrays) == 1
            opening = "return (" if alone else f"{name} = ("
            lines += [INDENT + opening, *_matrix(outputs, packed=packed), f"{INDENT})"]
            answer += [] if alone else [name]
        else:
            answer.append(_vector(outputs, printer))
    return Body(tuple(lines), tuple(answer))


def formless(kernel: Kernel) -> Kernel:
    """The kernel without the hint for rows of arrays, and without what only that needs."""
    return drop_dead(replace(kernel, form=None))


def hoisted(kernel: Kernel) -> Kernel:
    """With what a product has in constants alone as constants of its own; a sum has its signs."""
    plain = _named(kernel)
    known = {a.symbol for a in kernel.constants} | {symbol(s.name) for s in CONSTANTS}
    found: dict[sp.Expr, sp.Symbol] = {}

    def named(expr: sp.Expr, *, term: bool = False) -> sp.Expr:
        if expr.is_Atom:
            return expr
        if term and expr.could_extract_minus_sign():
            return -named(-expr)
        if expr.is_Mul:
            fixed, rest = expr.as_independent(*(expr.free_symbols - known), as_Add=False)
            if not fixed.is_Atom:
                found.setdefault(fixed, symbol(_constant_name(fixed)))
                return found[fixed] * named(rest)
        return expr.func(*(named(arg, term=expr.is_Add) for arg in expr.args))

    changed = {e: named(e) for e in plain.expressions()}
    return replace(
        plain,
        body=tuple(replace(a, expr=changed[a.expr]) for a in plain.body),
        outputs=tuple(replace(o, expr=changed[o.expr]) for o in plain.outputs),
        constants=(*plain.constants, *(Assignment(s.name, e) for e, s in found.items())),
    )


def _constant_name(expr: sp.Expr) -> str:
    """``half_p``, ``minus_per_p``, ``alpha_squared``: a product of constants in words."""
    number, rest = expr.as_coeff_Mul()
    words = {1: [], -1: ["minus"], sp.Rational(1, 2): ["half"], -sp.Rational(1, 2): ["minus_half"]}
    parts: list[str] = words[number]
    for base, power in sorted(rest.as_powers_dict().items(), key=str):
        parts = [*parts, f"{base}_squared" if power == 2 else f"{base}"]
    return "_".join(parts)


def returned(answer: Sequence[str], more: str = "") -> list[str]:
    """The last line of a function; ``more`` comes after the answer, which is then one piece.

    A matrix alone has been returned already, and leaves no answer.
    """
    if not answer:
        return []
    several = bool(more) and len(answer) > 1
    whole = f"({', '.join(answer)})" if several else ", ".join(answer)
    line = f"{INDENT}return {whole}"
    line += f", {more}" if more else ""
    if len(line) <= WIDTH:
        return [line]
    if not several:
        return wrapped("return (", [*answer, *([more] if more else [])], ")", ", ", INDENT)
    inner = filled(answer, INDENT * 3)
    lines = [f"{INDENT}return (", f"{INDENT * 2}(", *inner, f"{INDENT * 2}),"]
    return [*lines, f"{INDENT * 2}{more},", f"{INDENT})"]


def _vector(outputs: Sequence[Output], printer: ScalarPrinter) -> str:
    texts = [printer.text(o.expr, LOOSE) for o in outputs]
    return f"({', '.join(texts)})" if outputs[0].index else texts[0]


def _matrix(outputs: Sequence[Output], *, packed: bool) -> list[str]:
    """Whole rows, or what they have on and above the diagonal."""
    entry = {o.index: str(o.expr) for o in outputs}
    size = 1 + max(i for i, _ in entry)
    if packed:
        rows = [", ".join(entry[i, j] for j in range(i, size)) for i in range(size)]
    else:
        full = [[entry[min(i, j), max(i, j)] for j in range(size)] for i in range(size)]
        rows = [f"({', '.join(row)})" for row in full]
    return [f"{INDENT * 2}{row}," for row in rows]


def _scale(inputs: Sequence[str]) -> list[str]:
    parts = [inputs[i : i + 3] for i in range(0, len(inputs), 3)]
    return [
        f"{INDENT}{', '.join(part)} = {', '.join(f'{SCALE} * {name}' for name in part)}"
        for part in parts
    ]


def _grouped(assignments: Sequence[Assignment], printer: ScalarPrinter) -> list[str]:
    most = 3 if printer.dialect.powers else len(assignments)
    return grouped(assignments, printer, most, LOOSE)


def _named(kernel: Kernel) -> Kernel:
    """With one symbol for each name: kernels tell symbols apart by name alone."""
    every = {s for expr in kernel.expressions() for s in expr.free_symbols}
    return kernel.rewrite({s: symbol(s.name) for s in every})


def _resolved(kernel: Kernel, dialect: Dialect) -> Kernel:
    """Without its gauge: the norm and the radius come out of the square as assignments."""
    gauge = kernel.gauge
    if gauge is None:
        return kernel
    radius, norm, own = symbol(gauge.radius), symbol(gauge.norm), symbol(gauge.square)
    used = {s.name for e in kernel.expressions() for s in e.free_symbols}
    used |= {kernel.limit.quantity} if kernel.limit else set()
    taken = symbol(square(kernel, dialect))
    rooted = bool({gauge.norm, gauge.radius} & used)
    added = []
    if dialect.scaled:
        added += [Assignment(gauge.norm, sp.sqrt(taken))] if rooted else []
        added += [Assignment(gauge.radius, norm / SCALE)] if rooted else []
        whole = radius**2 if rooted else taken / SCALE**2
        added += [Assignment(gauge.square, whole)] if gauge.square in used else []
        after = {norm: sp.Max(norm, tiny), symbol(gauge.unscale): 1 / SCALE}
        after |= {sp.Max(norm, ROOT): sp.Max(norm, ROOT)}  # has a floor
    else:
        added += [Assignment(gauge.radius, sp.sqrt(own))] if rooted else []
        after = {norm: sp.Max(radius, tiny), symbol(gauge.unscale): sp.S.One}
        after |= {sp.Max(norm, ROOT): sp.Max(radius, ROOT)}
    body: list[Assignment] = []
    for a in kernel.body:
        if a.name == gauge.square:
            body += [replace(a, name=taken.name), *added]
        else:
            body.append(replace(a, expr=a.expr.xreplace(after)))
    outputs = tuple(replace(o, expr=o.expr.xreplace(after)) for o in kernel.outputs)
    return drop_aliases(replace(kernel, body=tuple(body), outputs=outputs))


def _rows(kernel: Kernel) -> Kernel:
    """The rank-one term by rows: its weight times one component, once."""
    dyad = kernel.dyad
    if dyad is None:
        return kernel
    n = len(dyad.vector)
    rows = [symbol(f"{dyad.weight}_{k}") for k in range(1, n + 1)]
    weight, vector = symbol(dyad.weight), [symbol(name) for name in dyad.vector]
    used = {
        i
        for i in range(n)
        for o in kernel.outputs
        if o.array == dyad.array and o.index[0] == i and _has_term(o.expr, dyad.term(*o.index))
    }
    added = tuple(Assignment(rows[i].name, weight * vector[i]) for i in sorted(used))
    changed = {dyad.term(i, j): rows[i] * vector[j] for i in range(n) for j in range(i, n)}
    outputs = tuple(
        replace(o, expr=o.expr.xreplace(changed)) if o.array == dyad.array else o
        for o in kernel.outputs
    )
    return replace(kernel, body=(*kernel.body, *added), outputs=outputs)


def _has_term(expr: sp.Expr, term: sp.Expr) -> bool:
    return term in sp.Add.make_args(expr)


def _entries(kernel: Kernel) -> Kernel:
    """With the entries of matrices as assignments, each used at two places."""
    entries = [o for o in kernel.outputs if len(o.index) == 2]
    names = {id(o): f"{LETTERS[o.array]}{o.index[0] + 1}{o.index[1] + 1}" for o in entries}
    added = tuple(Assignment(names[id(o)], o.expr) for o in entries)
    outputs = tuple(
        replace(o, expr=symbol(names[id(o)])) if id(o) in names else o for o in kernel.outputs
    )
    return replace(kernel, body=(*kernel.body, *added), outputs=outputs)


def atomic(kernel: Kernel) -> Kernel:
    """With a name for every compound argument of a Max or Min, which is written twice."""
    body: list[Assignment] = []
    numbered = 0

    def named(expr: sp.Expr, step: str) -> sp.Expr:
        nonlocal numbered
        changed: dict[sp.Expr, sp.Expr] = {}
        for node in sp.postorder_traversal(expr):
            if isinstance(node, (sp.Max, sp.Min)):
                for arg in node.args:
                    if not arg.is_Atom and arg not in changed:
                        inner = arg.xreplace(changed)
                        numbered += 1
                        name = f"raw_{numbered}"
                        body.append(Assignment(name, named(inner, step), (), step))
                        changed[arg] = symbol(name)
        return expr.xreplace(changed)

    for a in kernel.body:
        expr = named(a.expr, a.step)
        body.append(replace(a, expr=expr))
    outputs = tuple(replace(o, expr=named(o.expr, "")) for o in kernel.outputs)
    return replace(kernel, body=tuple(body), outputs=outputs)


class ScalarPrinter(Printer):
    """Text of an expression on single numbers, with the functions of the math module."""

    def __init__(self, spelling: Mapping[str, str], dialect: Dialect) -> None:
        super().__init__(spelling)
        self.dialect = dialect

    def _print(self, expr: sp.Expr) -> tuple[str, int]:
        if isinstance(expr, (sp.Max, sp.Min)):
            first, second = sorted(expr.args, key=lambda a: (self.scalar(a), str(a)))
            sign = ">" if isinstance(expr, sp.Max) else "<"
            a, b = self.text(first), self.text(second)
            if self.dialect.scaled:  # what is not a number stays that
                return f"{b} if {b} {sign} {a} else {a}", LOOSE
            return f"{a} if {a} {sign} {b} else {b}", LOOSE
        if isinstance(expr, WorkShare):
            return f"_work_share_at({self.text(expr.args[0], LOOSE)}, c)", ATOM
        if isinstance(expr, sp.exp) and self.dialect.powers:
            rate, log = expr.args[0].as_independent(sp.log)
            if isinstance(log, sp.log):
                return f"{self.text(log.args[0], ATOM)}**{self.text(rate, ATOM)}", POWER
        if type(expr) in MATH:
            return (
                f"{self.dialect.prefix}{MATH[type(expr)]}({self.text(expr.args[0], LOOSE)})",
                ATOM,
            )
        return super()._print(expr)

    def _power(self, expr: sp.Pow) -> tuple[str, int]:
        base, exponent = expr.args
        if exponent == sp.Rational(1, 2):
            return f"sqrt({self.text(base, LOOSE)})", ATOM
        if exponent == 2 and base.is_Symbol:
            return f"{self.text(base)} * {self.text(base)}", PRODUCT
        if exponent.is_Symbol:
            return f"{self.text(base, ATOM)}**{self.text(exponent)}", POWER
        return super()._power(expr)

    def _choice(self, expr: sp.Piecewise) -> tuple[str, int]:
        (value, condition), (other, last) = expr.args
        if last != sp.true:
            raise TypeError(f"the scalar printer takes a choice of two, not {expr}")
        if self.scalar(condition.lhs):
            condition = condition.reversed
        test = f"{self.text(condition.lhs)} {condition.rel_op} {self.text(condition.rhs)}"
        return f"{self._number(value)} if {test} else {self._number(other)}", LOOSE
