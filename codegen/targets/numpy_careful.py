"""Prints the bodies that hold everywhere, as expressions: the steps, and a body for each kernel.

A body works on one block of points. Where a kernel has a plain one beside it, the body is for
the blocks that this leaves; few, and so nothing is done here to save memory.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel, KernelError, Output
from rodproof.codegen.passes.order import order
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.codegen.targets.lines import INDENT, grouped
from rodproof.codegen.targets.numpy_body import (
    QUIET,
    beside,
    gathered,
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
from rodproof.codegen.texts import FunctionText, step_text


@dataclass(frozen=True)
class Step:
    """A step that kernels share: the union of what they assign in it.

    ``rows`` says that its inputs are the rows of a load or a strain.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Assignment, ...]
    results: tuple[str, ...]

    @property
    def rows(self) -> bool:
        return self.name.startswith("reduce")


def steps_of(kernels: tuple[Kernel, ...], printer: Printer) -> dict[str, Step]:
    """The steps of the kernels, by name."""
    names = dict.fromkeys(a.step for kernel in kernels for a in kernel.body if a.step)
    return {name: _step(name, kernels, printer) for name in names}


def _step(name: str, kernels: tuple[Kernel, ...], printer: Printer) -> Step:
    """The step as the kernels together need it; they must agree on every name."""
    users = [kernel for kernel in kernels if any(a.step == name for a in kernel.body)]
    body: dict[str, Assignment] = {}
    for a in (a for kernel in users for a in kernel.body if a.step == name):
        if body.setdefault(a.name, a).expr != a.expr:
            raise KernelError(f"step {name}: kernels disagree on {a.name!r}")
    wanted = set().union(*(_used_outside(kernel, name) for kernel in users)) & set(body)
    ordered = order(replace(users[0], body=tuple(body.values()))).body
    preparing = {a.name: a for a in users[0].body if not a.step}
    free = {s.name for a in ordered for s in a.expr.free_symbols} - set(body)
    arguments = [n for n in (*users[0].inputs, *preparing) if n in free]
    arguments = arguments or sorted(free - set(printer.spelling))
    results = tuple(a.name for a in ordered if a.name in wanted)
    return Step(name, tuple(arguments), ordered, results)


def _used_outside(kernel: Kernel, step: str) -> set[str]:
    """Names that the kernel needs from a step: later, for its gauge, or for its limit."""
    later = [a.expr for a in kernel.body if a.step != step] + [o.expr for o in kernel.outputs]
    used = {s.name for expr in later for s in expr.free_symbols}
    used |= {kernel.limit.quantity} if kernel.limit else set()
    return used | ({kernel.gauge.square} if kernel.gauge else set())


def step_function(step: Step, scene: Scene, printer: Printer) -> str:
    """A step as a private function that returns a tuple, its last result being the square."""
    taken = f"{rows_name(step.inputs)}: Rows" if step.rows else f"{step.inputs[0]}: Array"
    single = len(step.results) == 1 and not step.rows
    kind = "Array" if single else "Rows"
    lines = [f"def _{step.name}({taken}, c: Constants) -> {kind}:"]
    lines += [f'{INDENT}"""{step_text(step.name, scene)}"""']
    if step.rows:
        lines += [INDENT + unpacked(step.inputs, rows_name(step.inputs))]
    used = {s.name for a in step.body for s in a.expr.free_symbols}
    for limit in sorted({"tiny", "log_max"} & used):
        lines += [f"{INDENT}{limit} = {limit.upper()}[{step.inputs[0]}.dtype]"]
    lines += grouped(step.body, printer)
    if single:
        lines[-1] = lines[-1].replace(f"{step.results[0]} = ", f"{step.results[0]}: Array = ", 1)
    one_row = step.rows and len(step.results) == 1
    results = f"({step.results[0]},)" if one_row else ", ".join(step.results)
    return "\n".join([*lines, f"{INDENT}return {results}"])


def handed(kernel: Kernel) -> tuple[tuple[str, ...], str]:
    """What comes with the values of the gauge's step, and the function that hands it out."""
    gauge = kernel.gauge
    assert gauge is not None
    if {gauge.norm, gauge.radius} & {s.name for e in kernel.expressions() for s in e.free_symbols}:
        return (gauge.norm, gauge.radius, gauge.unscale, gauge.square), "_balanced"
    return ("", gauge.unscale, gauge.square), "_rescaled"


def careful_body(
    kernel: Kernel, steps: dict[str, Step], spelling: dict[str, str], text: FunctionText
) -> str:
    """The private function that works on one block, wherever its points are."""
    packed = packed_size(kernel, text)
    printer = Printer(spelling, vector_places(kernel))
    lines = []
    if kernel.plain:
        arguments = ", ".join([*text.inputs, "c", *text.outputs])
        lines += [f"{INDENT}if _{kernel.name}_plain({arguments}):", f"{INDENT * 2}return"]
    lines += [f"{INDENT}{rows_name(kernel.inputs)} = {gathered(text)}"]
    lines += [INDENT + line for line in _rest(kernel)]
    steps_done, waiting = set[str](), list[Assignment]()
    for a in kernel.body:
        if a.name == "stretch":
            continue
        if not a.step:
            waiting.append(a)
        elif a.step not in steps_done:
            steps_done.add(a.step)
            step = steps[a.step]
            needed = [b for b in waiting if b.name in step.inputs]
            waiting = [b for b in waiting if b not in needed]
            lines += grouped(needed, printer)
            lines += [INDENT + line for line in _call(step, kernel)]
    rest = [a.expr for a in waiting] + [o.expr for o in kernel.outputs]
    if any(s.name == "tiny" for e in rest for s in e.free_symbols):
        like = "y" if kernel.inputs[0] in LOAD_NAMES else "q"  # an array of the block's type
        lines += [f"{INDENT}tiny = TINY[{like}.dtype]"]
    dyad = kernel.dyad
    if dyad:
        rows = f"{dyad.array}[:{len(dyad.vector)}]" if packed else f"{dyad.array}[0]"
        lines += [f"{INDENT}{dyad.vector[0][0]} = np.empty_like({rows})"]
    lines += grouped(waiting, printer)
    lines += grouped([*_vectors(kernel)], printer)
    lines += [INDENT + line for line in _matrix(kernel, printer, packed)]
    opening = heading(kernel.name, text, "None")
    return "\n".join([*opening, f'{INDENT}"""{text.equation}"""', *lines])


def _vectors(kernel: Kernel) -> Iterator[Assignment]:
    """The outputs that are no entries of a matrix, as assignments to their places."""
    for o in kernel.outputs:
        if len(o.index) < 2:
            yield Assignment(place_of(o) if o.index else f"{o.array}[...]", o.expr)


def _matrix(kernel: Kernel, printer: Printer, packed: int) -> list[str]:
    """The rank-one term, what is beside it or in its place, and what is below the diagonal."""
    entries = [o for o in kernel.outputs if len(o.index) == 2]
    lines = [spread(kernel.dyad, kernel.dyad.vector[0][0])] if kernel.dyad else []
    found = beside(kernel) if kernel.dyad else {o.expr: [(o, False)] for o in entries}
    for extra, places in found.items():
        lines += _put(extra, places, printer, packed)
    return lines + mirrored(kernel, packed)


def _put(
    extra: sp.Expr, places: list[tuple[Output, bool]], printer: Printer, packed: int
) -> list[str]:
    """Lines that put one value beside the dyad, or in place of it."""
    targets = [place_of(o, packed) for o, _ in places]
    text = printer.text(extra)
    if not places[0][1]:
        lines = grouped([Assignment(targets[0], extra)], printer)
        return [line.removeprefix(INDENT) for line in lines]
    if len(targets) == 1:
        return [f"{targets[0]} += {text}"]
    name = text if extra.is_Symbol else "beside"
    lines = [] if extra.is_Symbol else [f"{name} = {text}"]
    return lines + [f"{target} += {name}" for target in targets]


def _call(step: Step, kernel: Kernel) -> list[str]:
    """The call of a step, with the limit's guard where its quantity comes out of it."""
    needed = _used_outside(replace(kernel, gauge=None), step.name)
    gauge = kernel.gauge if kernel.gauge and kernel.gauge.step == step.name else None
    given = rows_name(step.inputs) if step.rows else step.inputs[0]
    if not gauge:
        left = taken(step.results, needed)
        left = f"({left},)" if step.rows and len(step.results) == 1 else left
        lines = [f"{left} = _{step.name}({given}, c)"]
        if kernel.limit and kernel.limit.quantity in step.results:  # the guard answers for these
            lines = [QUIET, INDENT + lines[0]]
    else:
        values = [name if name in needed else "_" for name in step.results[:-1]]
        given_out, function = handed(kernel)
        radii = [n if n in needed else "_" for n in given_out]
        call = f"{', '.join(radii)} = {function}(_{step.name}, {given}, c)"
        if set(values) <= {"_"}:
            lines = [f"_, {call}"]
        else:
            named = ", ".join(values) if len(values) > 1 else f"({values[0]},)"
            lines = [f"values, {call}", f"{named} = values"]
    if kernel.limit and kernel.limit.quantity in step.results:
        lines += [f"{kernel.limit.quantity} = _within_limit({kernel.limit.quantity})"]
    return lines


def _rest(kernel: Kernel) -> list[str]:
    """``rest``, the strains from rest, in place of the assignment to ``stretch``."""
    if not any(a.name == "stretch" for a in kernel.body):
        return []
    place = len(kernel.inputs) - 1
    before = f"*strains[:{place}], " if place else ""
    return [f"rest = [{before}strains[{place}] - 1]"]


def form_again(kernel: Kernel, steps: dict[str, Step]) -> list[str]:
    """Lines that form the limit's quantity for whole rows ``strains``, beyond the limit too."""
    assert kernel.limit is not None
    step = next(s for s in steps.values() if kernel.limit.quantity in s.results)
    lines = [*_rest(kernel), QUIET]
    lines += [f"{INDENT}*_, {kernel.limit.quantity} = _{step.name}({rows_name(step.inputs)}, c)"]
    return [INDENT + line for line in lines]
