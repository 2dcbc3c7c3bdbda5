"""Prints what the plain bodies of a NumPy module share: the quadratic form, and what goes with it.

Q comes with the linear rod's loads at the strains, Q* with its strains at the loads: rows that the
bodies go on from. Products of rows that follow each other are taken in one call.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel, KernelError
from rodproof.codegen.live import groups, live
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.codegen.targets.calls import Call, calls
from rodproof.codegen.targets.lines import INDENT, wrapped
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.targets.rows import ROW, Printed, print_calls
from rodproof.codegen.texts import FunctionText, square_text

Head = tuple[int, ...]
PRODUCTS = "x"  # rows of scratch for the products that make up the form


@dataclass(frozen=True)
class Square:
    """What plain kernels share: the quadratic form and the linear rod's answer, as printed.

    ``given`` and ``answer`` are arrays with their leading shapes. The first rows of scratch, as
    many as ``products`` says, are for these.
    """

    quantity: str
    body: tuple[Assignment, ...]
    given: Mapping[str, Head]
    answer: Mapping[str, Head]
    products: int
    printed: Printed


def squares_of(
    kernels: tuple[Kernel, ...],
    words: Mapping[str, FunctionText],
    constants: dict[str, str],
    scene: Scene,
) -> dict[str, Square]:
    """The shared beginnings of the plain kernels, by the form's quantity."""
    found = dict[str, Square]()
    for kernel in (k.plain for k in kernels if k.plain):
        assert kernel.form is not None
        name = kernel.form.quantity
        if name not in found:
            found[name] = _square(kernel, words[kernel.name], constants, scene)
        known = found[name]
        if {*known.body} != {*beginning(kernel)} or known.answer != answer_of(kernel, scene):
            raise KernelError(f"the plain kernels disagree on {name} or on what goes with it")
    return found


def _square(kernel: Kernel, text: FunctionText, constants: dict[str, str], scene: Scene) -> Square:
    assert kernel.form is not None
    body, answer = beginning(kernel), answer_of(kernel, scene)
    places, lengths = rows_of(text.inputs, kernel.inputs)
    of_answer, own = rows_of(answer, kernel.form.vector)
    places |= of_answer
    work, products = beginning_calls(kernel, body, printer_of(kernel, constants), places)
    printed = print_calls(
        work,
        {},
        places=places | products_at(products),
        lengths=lengths | own | {PRODUCTS: products},
        taken=range(products),
        kept=(kernel.form.quantity,),
    )
    return Square(kernel.form.quantity, body, text.inputs, answer, products, printed)


def beginning(kernel: Kernel) -> tuple[Assignment, ...]:
    """What the form's quantity and its vector need, in order."""
    assert kernel.form is not None
    needed = [a for n in (kernel.form.quantity, *kernel.form.vector) for a in kernel.down_to(n)]
    return tuple(a for a in kernel.body if a in needed)


def beginning_calls(
    kernel: Kernel, body: tuple[Assignment, ...], printer: Printer, places: Mapping[str, str]
) -> tuple[list[Call], int]:
    """The calls for it; products of rows that follow each other stand in so many rows at most."""
    assert kernel.form is not None
    work, most = list[Call](), 0
    for a in body:
        if a.name != kernel.form.quantity:
            work.extend(calls(a.name, a.expr, printer))
            continue
        scale, total = a.expr.as_independent(sp.Add)
        scale, total = (scale, total) if a.expr.is_Mul and total.is_Add else (sp.S.One, a.expr)
        runs = _runs(sp.Add.make_args(total), kernel.inputs, places)
        most = max((len(run) for run in runs if len(run) > 1), default=0)
        for k, run in enumerate(runs):
            work += _summed(a.name, run, printer, opening=k == 0)
        if scale != 1:
            scaled = (a.name, printer.text(scale))
            work.append(Call(a.name, "np.multiply", scaled, frozenset({a.name})))
    return work, most


def _runs(
    terms: Sequence[sp.Expr], inputs: tuple[str, ...], places: Mapping[str, str]
) -> list[list[sp.Expr]]:
    """The terms in the order of the inputs; those of rows that follow each other together."""
    first = {t: min((inputs.index(n) for n in _names(t) if n in inputs), default=6) for t in terms}
    runs, last = list[list[sp.Expr]](), set[tuple[str, int]]()
    for term in sorted(terms, key=lambda t: (first[t], str(t))):
        rows = {
            (row[1], int(row[2])) for n in _names(term) if (row := ROW.match(places.get(n, "")))
        }
        both = term.is_Mul and len(term.args) == len(rows) == 2
        if both and rows == {(array, k + 1) for array, k in last}:
            runs[-1].append(term)
        else:
            runs.append([term])
        last = rows if both else set()
    return runs


def _names(expr: sp.Expr) -> list[str]:
    return [s.name for s in expr.free_symbols]


def _summed(name: str, run: list[sp.Expr], printer: Printer, *, opening: bool) -> list[Call]:
    """The calls that add a run of products to the sum, or open it."""
    if len(run) == 1 and opening:
        return list(calls(name, run[0], printer))
    rows = [*products_at(len(run))] if len(run) > 1 else [f"{name}.{run[0]}"]
    work = [c for row, term in zip(rows, run, strict=True) for c in calls(row, term, printer)]
    sums = [(name, row) for row in rows]
    if opening:
        sums[:2] = [(rows[0], rows[1])]
    return work + [Call(name, "np.add", pair, frozenset(pair)) for pair in sums]


def answer_of(kernel: Kernel, scene: Scene) -> dict[str, Head]:
    """The arrays of the linear rod's answer, and their leading shapes."""
    at, of_loads = live(scene), kernel.inputs[0] in LOAD_NAMES
    found = groups("uv", at.strains) if of_loads else groups("mn", at.loads)
    return {group.array: group.head for group in found}


def rows_of(
    heads: Mapping[str, Head], names: Sequence[str]
) -> tuple[dict[str, str], dict[str, int]]:
    """Where the components are in their arrays, and how many rows these have."""
    sizes = [head[0] if head else 1 for head in heads.values()]
    rows = [
        (array, head, k)
        for (array, head), n in zip(heads.items(), sizes, strict=True)
        for k in range(n)
    ]
    places = {
        name: f"{array}[{k}]" if head else array
        for name, (array, head, k) in zip(names, rows, strict=True)
    }
    return places, {array: head[0] for array, head in heads.items() if len(head) == 1}


def products_at(count: int) -> dict[str, str]:
    """The places of products are their names."""
    return {f"{PRODUCTS}[{k}]": f"{PRODUCTS}[{k}]" for k in range(count)}


def square_function(square: Square) -> str:
    """The shared beginning as a private function, in place."""
    given, taken = (
        ", ".join(f"{a}: Array" for a in arrays) for arrays in (square.given, square.answer)
    )
    lines = wrapped(
        f"def _{square.quantity}(",
        [f"{given}, c: Constants, {taken}, s: Array"],
        ") -> Array:",
        ", ",
        "",
    )
    lines += [f'{INDENT}"""{square_text(square.quantity, [*square.answer])}"""']
    name = square.quantity
    body = [re.sub(rf"^{name} = ", f"{name}: Array = ", line) for line in square.printed.lines]
    if any("k." in line for line in body):
        lines += [f"{INDENT}k = c.plain"]
    if square.products:
        lines += [f"{INDENT}{PRODUCTS} = s[:{square.products}]"]
    return "\n".join([*lines, *(INDENT + line for line in body), f"{INDENT}return {name}"])


def printer_of(kernel: Kernel, constants: dict[str, str]) -> Printer:
    """How numbers are written: constants of a kernel beside another have a record of their own."""
    own = {a.name: f"k.{a.name}" for a in kernel.constants} if kernel.region else {}
    return Printer({**constants, **own})
