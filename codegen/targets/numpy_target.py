"""Prints kernels as a NumPy module that stands alone.

A function comes out as a private body, which works on one block of points in the order of the
kernel, and a public function that checks, broadcasts and runs the body over blocks. A step that
kernels share is printed once, as a private function of its own; steps that a gauge governs are
called through `_balanced`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel, KernelError, Output
from rodproof.codegen.passes.order import order
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.codegen.targets import numpy_template as template
from rodproof.codegen.targets.numpy_constants import (
    all_have_values,
    derived_constants,
    needs_work_share,
    print_constants,
    used_constants,
)
from rodproof.codegen.targets.numpy_header import header
from rodproof.codegen.targets.printer import PRODUCT, Printer, wrapped
from rodproof.codegen.texts import FunctionText, function_text, step_text
from rodproof.derivations.symbols import CONSTANTS

INDENT = "    "


@dataclass(frozen=True)
class Step:
    """A step as printed: the union of what the kernels assign in it.

    ``rows`` says that its inputs are the rows of a load or a strain.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Assignment, ...]
    results: tuple[str, ...]

    @property
    def rows(self) -> bool:
        return self.name.startswith("reduce")


def print_module(
    scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str] | None = None
) -> str:
    """The module's text; ``verdicts`` adds a verdict to each statement of the header."""
    steps = {name: _step(name, kernels) for name in _step_names(kernels)}
    printer = Printer(_spelling(kernels))
    words = {kernel.name: function_text(kernel, scene) for kernel in kernels}
    limited = [kernel for kernel in kernels if kernel.limit]
    raising = bool(limited) and scene.at_limit == "raise"
    parts = [
        header(scene, kernels, verdicts or {}) + "\n\n" + _imports(scene, kernels, words),
        print_constants(scene, kernels),
        *(_step_text(step, printer, scene) for step in steps.values()),
    ]
    parts += [template.BALANCED] if any(kernel.gauge for kernel in kernels) else []
    parts += [template.WORK_SHARE] if needs_work_share(kernels) else []
    if limited:
        parts.append(template.RAISE if raising else template.NAN)
    if raising:
        parts.append(_past_limit(limited[0], steps, printer))
    parts += _plumbing(scene, raising=raising)
    default = " = ROD" if all_have_values(scene, kernels) else ""
    for kernel in kernels:
        text = words[kernel.name]
        parts += [_body(kernel, steps, printer, text), _public(kernel, text, default)]
    return "\n\n\n".join(part.strip("\n") for part in parts) + "\n"


def _imports(scene: Scene, kernels: tuple[Kernel, ...], words: Mapping[str, FunctionText]) -> str:
    """Imports, names of types, and the tables that the functions look things up in."""
    derived = derived_constants(kernels)
    heads = {n: h for text in words.values() for n, h in (text.inputs | text.outputs).items()}
    standard = ["from fractions import Fraction"] if derived else []
    standard += ["from functools import cached_property"] if needs_work_share(kernels) else []
    used = {s.name for kernel in kernels for e in kernel.expressions() for s in e.free_symbols}
    guards = [template.LOG_MAX] if "log_max" in used else []
    if guards or "tiny" in used or any(kernel.gauge for kernel in kernels):
        guards = [template.TINY, *guards]
    several = sorted({len(text.outputs) for text in words.values()} - {1})
    kinds = {2: "Pair = tuple[Array, Array]", 3: "Triple = tuple[Array, Array, Array]"}
    text = template.IMPORTS.substitute(
        field_import=", field"
        if derived or set(scene.fixed) & set(used_constants(kernels))
        else "",
        standard_imports="\n".join(standard) or "$",
        tuples="\n".join(kinds[n] for n in several) or "$",
        limits="\n".join(guards) or "$",
        heads=_table("HEADS", {f'"{name}"': str(head) for name, head in heads.items()}),
    )
    return text.replace("$\n", "")


def _table(name: str, entries: Mapping[str, str]) -> str:
    """A dictionary, on as few lines as hold it."""
    pieces = [f"{key}: {value}," for key, value in entries.items()]
    line = f"{name} = {{{' '.join(pieces)[:-1]}}}"
    if len(line) <= 100:
        return line
    lines = [INDENT]
    for piece in pieces:
        if len(lines[-1] + piece) > 100:
            lines.append(INDENT)
        lines[-1] += piece + " "
    return "\n".join([f"{name} = {{", *(line.rstrip() for line in lines), "}"])


def _plumbing(scene: Scene, *, raising: bool) -> list[str]:
    """The functions that take arrays in, run a body over blocks, and hand results out."""
    first = scene.layout == "first"
    places = template.FIRST if first else template.LAST
    run = template.RUN_RAISE if raising else template.RUN
    whole = template.APPLY_FIRST if first else template.APPLY_LAST
    return [
        template.ARGUMENTS.substitute(places, dtype=template.DTYPES[scene.precision]),
        whole.substitute(run=run.substitute(outputs=template.OUTPUTS[scene.layout])),
    ]


def _spelling(kernels: tuple[Kernel, ...]) -> dict[str, str]:
    derived = (a.name for kernel in kernels for a in kernel.constants)
    return {name: f"c.{name}" for name in (*(s.name for s in CONSTANTS), *derived)}


def _step_names(kernels: tuple[Kernel, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(a.step for kernel in kernels for a in kernel.body if a.step))


def _step(name: str, kernels: tuple[Kernel, ...]) -> Step:
    """The step as the kernels together need it; they must agree on every name."""
    users = [kernel for kernel in kernels if any(a.step == name for a in kernel.body)]
    body: dict[str, Assignment] = {}
    for a in (a for kernel in users for a in kernel.body if a.step == name):
        if body.setdefault(a.name, a).expr != a.expr:
            raise KernelError(f"step {name}: kernels disagree on {a.name!r}")
    wanted = set().union(*(_used_outside(kernel, name) for kernel in users)) & set(body)
    ordered = order(replace(users[0], body=tuple(body.values()))).body
    inputs = users[0].inputs
    preparing = {a.name: a for a in users[0].body if not a.step}
    free = {s.name for a in ordered for s in a.expr.free_symbols} - set(body)
    known = {*_spelling(kernels), "tiny", "log_max"}
    arguments = [n for n in (*inputs, *preparing) if n in free] or sorted(free - known)
    return Step(name, tuple(arguments), ordered, tuple(a.name for a in ordered if a.name in wanted))


def _used_outside(kernel: Kernel, step: str) -> set[str]:
    """Names that the kernel needs from a step: later, for its gauge, or for its limit."""
    later = [a.expr for a in kernel.body if a.step != step] + [o.expr for o in kernel.outputs]
    used = {s.name for expr in later for s in expr.free_symbols}
    used |= {kernel.limit.quantity} if kernel.limit else set()
    return used | ({kernel.gauge.square} if kernel.gauge else set())


def _step_text(step: Step, printer: Printer, scene: Scene) -> str:
    """A step as a private function that returns a tuple, its last result being the square."""
    taken = f"{_rows(step.inputs)}: Rows" if step.rows else f"{step.inputs[0]}: Array"
    single = len(step.results) == 1 and not step.rows
    lines = [f"def _{step.name}({taken}, c: Constants) -> {'Array' if single else 'Rows'}:"]
    lines += [f'{INDENT}"""{step_text(step.name, scene)}"""']
    if step.rows:
        comma = "," if len(step.inputs) == 1 else ""
        lines += [f"{INDENT}{', '.join(step.inputs)}{comma} = {_rows(step.inputs)}"]
    used = {s.name for a in step.body for s in a.expr.free_symbols}
    for limit in sorted({"tiny", "log_max"} & used):
        lines += [f"{INDENT}{limit} = {limit.upper()}[{step.inputs[0]}.dtype]"]
    lines += [line for a in step.body for line in _assign(a, printer)]
    one_row = step.rows and len(step.results) == 1
    results = f"({step.results[0]},)" if one_row else ", ".join(step.results)
    lines += [f"{INDENT}return {results}"]
    return "\n".join(lines)


def _rows(inputs: tuple[str, ...]) -> str:
    """What rows are called: loads, strains, or strains from rest."""
    return "loads" if inputs[0] in LOAD_NAMES else "rest" if "stretch" in inputs else "strains"


def _assign(a: Assignment, printer: Printer) -> list[str]:
    plain = f"{INDENT}{a.name} = {printer.text(a.expr)}"
    return [plain] if len(plain) <= 100 else _broken(f"{a.name} = (", a.expr, printer)


def _broken(opening: str, expr: sp.Expr, printer: Printer) -> list[str]:
    return wrapped(opening, printer.terms(expr), ")", " ", INDENT)


def _call(step: Step, kernel: Kernel) -> list[str]:
    """The call of a step, with the limit's guard where its quantity comes out of it."""
    needed = _used_outside(replace(kernel, gauge=None), step.name)
    gauge = kernel.gauge if kernel.gauge and kernel.gauge.step == step.name else None
    names = [name if name in needed else "_" for name in step.results]
    given = _rows(step.inputs) if step.rows else step.inputs[0]
    if not gauge:
        left = f"*_, {names[-1]}" if set(names[:-1]) == {"_"} else ", ".join(names)
        left = f"({left},)" if step.rows and len(names) == 1 else left
        lines = [f"{left} = _{step.name}({given}, c)"]
        if kernel.limit and kernel.limit.quantity in step.results:  # the guard answers for these
            lines = ['with np.errstate(over="ignore", invalid="ignore"):', INDENT + lines[0]]
    else:
        values = names[:-1]
        radii = [n if n in needed else "_" for n in (gauge.norm, gauge.radius, gauge.square)]
        call = f"{', '.join(radii)} = _balanced(_{step.name}, {given}, c)"
        if set(values) <= {"_"}:
            lines = [f"_, {call}"]
        else:
            taken = ", ".join(values) if len(values) > 1 else f"({values[0]},)"
            lines = [f"values, {call}", f"{taken} = values"]
    if kernel.limit and kernel.limit.quantity in step.results:
        lines += [f"{kernel.limit.quantity} = _within_limit({kernel.limit.quantity})"]
    return [INDENT + line for line in lines]


def _body(kernel: Kernel, steps: dict[str, Step], printer: Printer, text: FunctionText) -> str:
    """The private function that works on one block."""
    given = ", ".join(f"{a}: Array" for a in text.outputs)
    lines = [f"def _{kernel.name}({_rows(kernel.inputs)}: Rows, c: Constants, {given}) -> None:"]
    lines += [f'{INDENT}"""{text.equation}"""']
    vector = kernel.dyad.vector if kernel.dyad else ()
    spelled = {name: f"{name[0]}[{i}]" for i, name in enumerate(vector)}
    called: set[str] = set()
    like = "y" if kernel.inputs[0] in LOAD_NAMES else "q"  # an array with the block's shape
    tiny_at = next((a.name for a in kernel.body if not a.step and _uses(a.expr, "tiny")), "")
    for a in kernel.body:
        if a.name == tiny_at:
            lines += [f"{INDENT}tiny = TINY[{like}.dtype]"]
        if a.step and a.step not in called:
            called.add(a.step)
            lines += _call(steps[a.step], kernel)
        elif a.name == "stretch":
            lines += [*_rest(kernel, printer)]
        elif a.name in spelled:
            if a.name == vector[0]:
                letter = a.name[0]
                lines += [
                    f"{INDENT}{letter} = np.empty(({len(vector)}, {like}.size), {like}.dtype)"
                ]
            lines += _store(spelled[a.name], a.expr, printer)
        elif not a.step:
            lines += _assign(a, printer)
    packed = len(vector) if vector and len(text.outputs[kernel.outputs[-1].array]) == 1 else 0
    return "\n".join([*lines, *_outputs(kernel, printer, packed)])


def _uses(expr: sp.Expr, name: str) -> bool:
    return any(s.name == name for s in expr.free_symbols)


def _shifted(kernel: Kernel) -> bool:
    """Whether v3 is among the inputs, and v3 - 1 is to be formed."""
    return any(a.name == "stretch" for a in kernel.body)


def _rest(kernel: Kernel, printer: Printer) -> list[str]:
    """``rest``, the strains from rest, in place of the assignment to ``stretch``."""
    (stretch,) = (a for a in kernel.body if a.name == "stretch")
    place = len(kernel.inputs) - 1
    last = {s: sp.Symbol(f"strains[{place}]") for s in stretch.expr.free_symbols}
    shifted = printer.text(stretch.expr.xreplace(last))
    before = f"*strains[:{place}], " if place else ""
    return [f"{INDENT}rest = [{before}{shifted}]"]


def _outputs(kernel: Kernel, printer: Printer, packed: int) -> list[str]:
    """The outputs; a dyad row by row first, then what other terms the entries have."""
    dyad = kernel.dyad
    plain = [o for o in kernel.outputs if not dyad or o.array != dyad.array]
    lines = [line for o in plain for line in _store(_place(o), o.expr, printer)]
    if not dyad:
        return lines
    letter, place, n = dyad.vector[0][0], dyad.array, len(dyad.vector)
    product = f"np.multiply({dyad.weight} * {letter}[i], {letter}[i:], out={place}"
    if packed:
        lines += [f"{INDENT}first = 0", f"{INDENT}for i in range({n}):"]
        lines += [f"{INDENT * 2}{product}[first : first + {n} - i])"]
        lines += [f"{INDENT * 2}first += {n} - i"]
    else:
        lines += [f"{INDENT}for i in range({n}):", f"{INDENT * 2}{product}[i, i:])"]
    for o in (o for o in kernel.outputs if o.array == dyad.array):
        extra = o.expr - dyad.term(o.index[0], o.index[1])
        if not extra:
            continue
        if o.expr.is_Add and not extra.is_Add:
            lines += [f"{INDENT}{_place(o, packed)} += {printer.text(extra)}"]
        else:
            lines += _store(_place(o, packed), o.expr, printer)
    if packed:
        return lines
    return [
        *lines,
        f"{INDENT}for i in range(1, {len(dyad.vector)}):",
        f"{INDENT * 2}{place}[i, :i] = {place}[:i, i]",
    ]


def _place(o: Output, packed: int = 0) -> str:
    """Where an output goes; ``packed`` is the size of a matrix whose upper rows follow on."""
    if packed:
        i, j = o.index
        return f"{o.array}[{i * packed - i * (i - 1) // 2 + j - i}]"
    return f"{o.array}[{', '.join(map(str, o.index))}]" if o.index else o.array


def _store(place: str, expr: sp.Expr, printer: Printer) -> list[str]:
    """One value, computed straight into its place by the outermost operation."""
    if expr.is_Add:
        *most, last = sorted(expr.as_ordered_terms(), key=lambda term: bool(term.is_Number))
        call = f"np.add({printer.text(sp.Add(*most))}, {printer.text(last)}, out={place})"
    else:
        above, below = printer.factors(expr)
        if below or len(above) < 2:
            return _divide(place, above, below, printer)
        *front, back = sorted(above, key=lambda factor: bool(factor.is_Add))
        left = " * ".join(printer.text(factor, PRODUCT) for factor in front)
        call = f"np.multiply({left}, {printer.text(back)}, out={place})"
        if len(INDENT + call) > 100:
            whole = f"{place} = {left} * ({printer.text(back)})"
            if len(INDENT + whole) <= 100:
                return [INDENT + whole]
            return wrapped(f"{place} = {left} * (", printer.terms(back), ")", " ", INDENT)
    if len(INDENT + call) <= 100:
        return [INDENT + call]
    return _broken(f"{place}[...] = (", expr, printer)


def _divide(place: str, above: list[sp.Expr], below: list[sp.Expr], printer: Printer) -> list[str]:
    """A quotient, or a value that is there already."""
    if len(below) == 1 and above:
        over, under = (printer.text(sp.Mul(*part)) for part in (above, below))
        return [f"{INDENT}np.divide({over}, {under}, out={place})"]
    value = printer.text(sp.Mul(*above) / sp.Mul(*below))
    return [f"{INDENT}{place if '[' in place else f'{place}[...]'} = {value}"]


def _past_limit(kernel: Kernel, steps: dict[str, Step], printer: Printer) -> str:
    assert kernel.limit is not None
    step = next(s for s in steps.values() if kernel.limit.quantity in s.results)
    lines = _rest(kernel, printer) if _shifted(kernel) else []
    lines += [f'{INDENT}with np.errstate(over="ignore", invalid="ignore"):']
    lines += [f"{INDENT * 2}*_, {kernel.limit.quantity} = _{step.name}({_rows(step.inputs)}, c)"]
    return template.PAST_LIMIT.substitute(reduce="\n".join(lines), sentence=kernel.limit.sentence)


def _public(kernel: Kernel, text: FunctionText, default: str) -> str:
    """The public function; ``default`` is that of the constants, if they have one."""
    single = len(text.outputs) == 1
    kind = ("Array", "Pair", "Triple")[len(text.outputs) - 1]
    names = ", ".join(text.outputs)
    given = ", ".join(f"{name}: ArrayLike" for name in text.inputs)
    arguments = f"{given}, constants: Constants{default}"
    lines = wrapped(
        f"def {kernel.name}(", [arguments, f"out: {kind} | None = None"], f") -> {kind}:", ", ", ""
    )
    lines += [f'    """{text.doc}', '    """'] if "\n" in text.doc else [f'    """{text.doc}"""']
    inputs = "{" + ", ".join(f'"{name}": {name}' for name in text.inputs) + "}"
    results = ", ".join(f'"{name}"' for name in text.outputs) + ("," if single else "")
    lines += wrapped(
        f"{f'({names},)' if single else names} = _apply(",
        [f"_{kernel.name}", inputs, "constants", f"({results})", "out"],
        ")",
        ", ",
        INDENT,
    )
    return "\n".join([*lines, f"    return {names}"])
