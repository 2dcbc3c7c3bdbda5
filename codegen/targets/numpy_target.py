"""Prints kernels as a NumPy module that stands alone.

A function comes out as a private body, which works on one block of points in the order of the
kernel, and a public function that checks, broadcasts and runs the body over blocks. A step that
kernels share is printed once, as a private function of its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import sympy as sp

from rodproof.codegen.count import cost
from rodproof.codegen.kernel import Assignment, Kernel, KernelError
from rodproof.codegen.passes.order import order
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.scene import Scene
from rodproof.codegen.targets import numpy_template as template
from rodproof.codegen.targets.printer import Printer, wrapped
from rodproof.codegen.texts import STATEMENT_LABELS, STEP_TEXTS, TEXTS, FunctionText
from rodproof.derivations.symbols import CONSTANTS

INDENT = "    "


@dataclass(frozen=True)
class Step:
    """A step as printed: the union of what the kernels assign in it."""

    name: str
    inputs: tuple[str, ...]
    body: tuple[Assignment, ...]
    results: tuple[str, ...]


def print_module(
    scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str] | None = None
) -> str:
    """The module's text; ``verdicts`` adds a verdict to each statement of the header."""
    printer = Printer(_spelling(kernels))
    steps = {name: _step(name, kernels) for name in _step_names(kernels)}
    limited = [kernel for kernel in kernels if kernel.limit]
    energies = any(expr.has(WorkShare) for kernel in kernels for expr in kernel.expressions())
    cached = "from functools import cached_property\n" if energies else ""
    raising = bool(limited) and scene.at_limit == "raise"
    parts = [
        header(scene, kernels, verdicts or {}),
        template.IMPORTS.replace("$cached_import\n", cached),
        _constants(kernels) + (template.WORK_SHARE_TABLES if energies else ""),
        *(_step_text(step, printer) for step in steps.values()),
    ]
    if any(kernel.gauge for kernel in kernels):
        parts.append(template.BALANCED)
    if energies:
        parts.append(template.WORK_SHARE)
    if limited:
        parts.append(template.RAISE if raising else template.NAN)
    if raising:
        parts.append(_past_limit(limited[0], steps, printer))
    parts.append(template.APPLY.substitute(run=template.RUN_RAISE if raising else template.RUN))
    for kernel in kernels:
        parts += [_body(kernel, steps, printer), _public(kernel)]
    return "\n\n".join(part.rstrip("\n") + "\n" for part in parts)


def header(scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str]) -> str:
    """The module's docstring: scene, command, statements, domain, operation counts."""
    statements = dict.fromkeys(s for kernel in kernels for s in kernel.statements())
    lines = [f'"""{scene.summary}', "", f"Scene {scene.name}, written by: rodproof generate {scene.name}", ""]
    lines += ["Statements it rests on (paper label" + (", verdict):" if verdicts else "):")]
    lines += [f"    {_statement(s, verdicts)}" for s in statements]
    lines += ["", "Domain: all finite loads; strains with Q(u, v) < 1, past which the answer is"]
    lines += ["an error." if scene.at_limit == "raise" else "nan."]
    lines += ["", "Operations a point (arithmetic, transcendental, energy share, temporaries):"]
    for kernel in kernels:
        c = cost(kernel)
        lines += [
            f"    {kernel.name:<22}{c.arithmetic:>4}{c.transcendental:>4}{c.special:>4}"
            f"{c.temporaries:>4}"
        ]
    return "\n".join([*lines, '"""'])


def _statement(statement: str, verdicts: Mapping[str, str]) -> str:
    label = STATEMENT_LABELS.get(statement, "")
    notes = ", ".join(note for note in (label, verdicts.get(statement, "")) if note)
    return f"{statement} ({notes})" if notes else statement


def _spelling(kernels: tuple[Kernel, ...]) -> dict[str, str]:
    derived = (a.name for kernel in kernels for a in kernel.constants)
    return {name: f"c.{name}" for name in (*(s.name for s in CONSTANTS), *derived)}


def _constants(kernels: tuple[Kernel, ...]) -> str:
    """The Constants record with the fields that the kernels derive from it."""
    derived = {a.name: a.expr for kernel in kernels for a in kernel.constants}
    printer = Printer({})
    fields = [f"    {name}: float = field(init=False, repr=False, compare=False)" for name in derived]
    values = [f'            "{name}": {printer.text(expr)},' for name, expr in derived.items()]
    return template.CONSTANTS.substitute(
        derived_fields="\n".join(fields), derived_values="\n".join(values)
    )


def _step_names(kernels: tuple[Kernel, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(a.step for kernel in kernels for a in kernel.body if a.step))


def _step(name: str, kernels: tuple[Kernel, ...]) -> Step:
    """The step as the kernels together need it; they must agree on every name."""
    body: dict[str, Assignment] = {}
    inputs: tuple[str, ...] = ()
    wanted: set[str] = set()
    for kernel in kernels:
        mine = [a for a in kernel.body if a.step == name]
        if not mine:
            continue
        for a in mine:
            if body.setdefault(a.name, a).expr != a.expr:
                raise KernelError(f"step {name}: kernels disagree on {a.name!r}")
        later = [a.expr for a in kernel.body if a.step != name] + [o.expr for o in kernel.outputs]
        wanted |= {s.name for expr in later for s in expr.free_symbols}
        inputs = kernel.gauge.inputs if kernel.gauge and kernel.gauge.step == name else inputs
        ends = kernel.gauge or kernel.limit
        last = (kernel.gauge.square if kernel.gauge else kernel.limit.quantity) if ends else ""  # type: ignore[union-attr]
        wanted |= {last} & set(body)
        example = kernel
    ordered = order(replace(example, body=tuple(body.values()))).body
    free = {s.name for a in ordered for s in a.expr.free_symbols} - set(body)
    known = set(_spelling(kernels)) | {"tiny", "log_max"}
    results = tuple(a.name for a in ordered if a.name in wanted)
    return Step(name, inputs or tuple(sorted(free - known)), ordered, results)


def _step_text(step: Step, printer: Printer) -> str:
    arguments = ", ".join(f"{name}: Array" for name in step.inputs)
    returned = "Array" if len(step.results) == 1 else "tuple[Array, ...]"
    lines = wrapped(f"def _{step.name}(", [*(f"{n}: Array" for n in step.inputs), "c: Constants"], f") -> {returned}:", ", ", "")
    del arguments
    lines += [f'    """{STEP_TEXTS[step.name]}"""']
    used = {s.name for a in step.body for s in a.expr.free_symbols}
    first = step.inputs[0]
    if "tiny" in used:
        lines += [f"    tiny = TINY[{first}.dtype]"]
    if "log_max" in used:
        lines += [f"    log_max = LOG_MAX[{first}.dtype]"]
    lines += [line for a in step.body for line in _assign(a, printer)]
    lines += wrapped("return (", list(step.results), ")", ", ", INDENT) if len(step.results) > 1 else [f"    return {step.results[0]}"]
    return "\n".join(lines).replace("return (", "return (")


def _assign(a: Assignment, printer: Printer) -> list[str]:
    plain = f"{INDENT}{a.name} = {printer.text(a.expr)}"
    if len(plain) <= 100:
        return [plain]
    return wrapped(f"{a.name} = (", printer.terms(a.expr), ")", " ", INDENT)


def _call(step: Step, kernel: Kernel, needed: set[str]) -> list[str]:
    """The call of a step, with the limit's guard where its quantity comes out of it."""
    gauge = kernel.gauge if kernel.gauge and kernel.gauge.step == step.name else None
    names = [name if name in needed else "_" for name in step.results]
    if gauge:
        values = names[:-1]
        inner = f"({', '.join(values)}{',' if len(values) == 1 else ''})"
        size, radius, square = (
            n if n in needed else "_" for n in (gauge.norm, gauge.radius, gauge.square)
        )
        inputs = _gauge_inputs(kernel, gauge.inputs)
        if set(values) == {"_"}:
            inner = "_"
        lines = [f"{INDENT}{inner}, {size}, {radius}, {square} = _balanced(_{step.name}, {inputs}, c)"]
    else:
        left = ", ".join(names)
        lines = [f"{INDENT}{left} = _{step.name}({', '.join(step.inputs)}, c)"]
    limit = kernel.limit
    if limit and limit.quantity in step.results:
        lines += [f"{INDENT}{limit.quantity} = _within_limit({limit.quantity})"]
    return lines


def _gauge_inputs(kernel: Kernel, inputs: tuple[str, ...]) -> str:
    return _rows(kernel) if inputs == kernel.inputs else f"({', '.join(inputs)})"


def _rows(kernel: Kernel) -> str:
    return "loads" if kernel.inputs[0] == "m1" else "strains"


def _body(kernel: Kernel, steps: dict[str, Step], printer: Printer) -> str:
    """The private function that works on one block."""
    text = TEXTS[kernel.name]
    arrays = tuple(dict.fromkeys(o.array for o in kernel.outputs))
    lines = wrapped(
        f"def _{kernel.name}(",
        [f"{_rows(kernel)}: Rows", "c: Constants", *(f"{a}: Array" for a in arrays)],
        ") -> None:",
        ", ",
        "",
    )
    lines += [f'    """{text.equation}"""']
    lines += _body_lines(kernel, steps, printer)
    lines += [line for o in kernel.outputs for line in _store(o.array, o.index, o.expr, printer)]
    if any(len(o.index) == 2 for o in kernel.outputs):
        lines += [
            f"{INDENT}for row in range(1, 6):",
            f"{INDENT * 2}{arrays[0]}[row, :row] = {arrays[0]}[:row, row]",
        ]
    return "\n".join(lines)


def _body_lines(kernel: Kernel, steps: dict[str, Step], printer: Printer) -> list[str]:
    gauged = kernel.gauge is not None and kernel.gauge.inputs == kernel.inputs
    lines = [] if gauged else [f"{INDENT}{', '.join(kernel.inputs)} = {_rows(kernel)}"]
    later = [s.name for expr in kernel.expressions() for s in expr.free_symbols]
    needed = set(later) | ({kernel.limit.quantity} if kernel.limit else set())
    called: set[str] = set()
    local = [a for a in kernel.body if not a.step]
    if any(s.name == "tiny" for a in local for s in a.expr.free_symbols):
        square = kernel.limit.quantity if kernel.limit else "y"
        tiny = [f"{INDENT}tiny = TINY[{square}.dtype]"]
    else:
        tiny = []
    for a in kernel.body:
        if a.step and a.step not in called:
            called.add(a.step)
            used = {s.name for b in kernel.body if b.step != a.step for s in b.expr.free_symbols}
            used |= {s.name for o in kernel.outputs for s in o.expr.free_symbols}
            used |= {kernel.limit.quantity} if kernel.limit else set()
            lines += _call(steps[a.step], kernel, used & needed)
        elif not a.step:
            if tiny and any(s.name == "tiny" for s in a.expr.free_symbols):
                lines += tiny
                tiny = []
            lines += _assign(a, printer)
    return lines


def _store(array: str, index: tuple[int, ...], expr: sp.Expr, printer: Printer) -> list[str]:
    """One output, computed straight into its array by the outermost operation."""
    place = f"{array}[{', '.join(map(str, index))}]" if index else array
    if expr.is_Add:
        *most, last = sorted(expr.as_ordered_terms(), key=lambda t: bool(t.is_Number))
        function, args = "np.add", [printer.text(sp.Add(*most)), printer.text(last)]
        if last.is_Number:
            args = [args[0], f"{last}"]
    elif expr.is_Mul:
        above, below = printer.factors(expr)
        if below or len(above) < 2:
            raise KernelError(f"output {place}: {expr} is not a product or a sum")
        *front, back = sorted(above, key=lambda f: bool(f.is_Add))
        function = "np.multiply"
        args = [" * ".join(printer.text(f, 1) for f in front), printer.text(back)]
    else:
        raise KernelError(f"output {place}: {expr} is not a product or a sum")
    return wrapped(f"{function}(", [*args, f"out={place}"], ")", ", ", INDENT)


def _past_limit(kernel: Kernel, steps: dict[str, Step], printer: Printer) -> str:
    assert kernel.limit is not None
    step = next(s for s in steps.values() if kernel.limit.quantity in s.results)
    lines = [f"{INDENT}{', '.join(kernel.inputs)} = strains"]
    lines += [line for a in kernel.body if a.name in step.inputs for line in _assign(a, printer)]
    lines += [f"{INDENT}*_, {kernel.limit.quantity} = _{step.name}({', '.join(step.inputs)}, c)"]
    return template.PAST_LIMIT.substitute(reduce="\n".join(lines), sentence=kernel.limit.sentence)


def _public(kernel: Kernel) -> str:
    """The public function."""
    text: FunctionText = TEXTS[kernel.name]
    first, second = text.inputs
    many = len(text.outputs) > 1
    one = "Array" if not many else "tuple[Array, Array]"
    arguments = [f"{first}: ArrayLike", f"{second}: ArrayLike", "constants: Constants"]
    lines = wrapped(
        f"def {kernel.name}(", [*arguments, f"out: {one} | None = None"], f") -> {one}:", ", ", ""
    )
    lines += [f'    """{text.doc}', '    """'] if "\n" in text.doc else [f'    """{text.doc}"""']
    heads = "{" + ", ".join(f'"{name}": {head}' for name, head in text.outputs.items()) + "}"
    lines += [f'    inputs = {{"{first}": {first}, "{second}": {second}}}']
    given = "out" if many else "None if out is None else (out,)"
    names = ", ".join(text.outputs) + ("" if many else ",")
    call = f"_apply(_{kernel.name}, inputs, constants, {heads}, {given})"
    left = names if many else f"({names})"
    lines += wrapped(f"{left} = _apply(", [f"_{kernel.name}", "inputs", "constants", heads, given], ")", ", ", INDENT)
    del call
    lines += [f"    return {names.rstrip(',')}"]
    return "\n".join(lines)
