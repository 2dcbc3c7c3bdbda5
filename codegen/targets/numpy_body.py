"""Prints the private functions of a NumPy module: the steps, and a body for each kernel.

A body works on one block of points, in the order of the kernel, in rows of scratch ``s`` that the
plumbing hands in. The last two rows are spoken for: ``s[-1]`` takes the root of the square, and
``s[-2]`` holds v3 - 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel, KernelError, Output, symbol
from rodproof.codegen.passes.order import order
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.codegen.targets.calls import Call, calls
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.targets.rows import Printed, last_reads, print_calls
from rodproof.codegen.texts import FunctionText, step_text
from rodproof.derivations.symbols import CONSTANTS

INDENT = "    "
SPOKEN_FOR = 2
WIDTH = 100


@dataclass(frozen=True)
class Step:
    """A step as printed: the union of what the kernels assign in it.

    ``rows`` says that its inputs are the rows of a load or a strain.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Assignment, ...]
    results: tuple[str, ...]
    printed: Printed

    @property
    def rows(self) -> bool:
        return self.name.startswith("reduce")

    @property
    def kept(self) -> int:
        """How many rows at the start its results take."""
        return max(self.printed.row[name] for name in self.results) + 1


@dataclass(frozen=True)
class Body:
    """The private function of a kernel, and how many rows of scratch it needs."""

    text: str
    rows: int


def spelling(kernels: tuple[Kernel, ...]) -> dict[str, str]:
    """How the text writes numbers: constants by their record, limits of the format by name."""
    derived = (a.name for kernel in kernels for a in kernel.constants)
    limits = {"tiny": "tiny", "log_max": "log_max"}
    return limits | {name: f"c.{name}" for name in (*(s.name for s in CONSTANTS), *derived)}


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
    work = [call for a in ordered for call in calls(a.name, a.expr, printer)]
    printed = print_calls(work, {}, fixed=_own_rows(users, set(results)), kept=results)
    return Step(name, tuple(arguments), ordered, results, printed)


def _own_rows(users: list[Kernel], results: set[str]) -> dict[str, int]:
    """The results that go into one entry each of a vector, in the order of the entries.

    Given these rows, they can stay where they are until they are the entries.
    """
    for kernel in users:
        defined = {a.name: a.expr for a in kernel.body}
        entries = kernel.dyad.vector if kernel.dyad else ()
        exprs = [defined[e] for e in entries] or [o.expr for o in kernel.outputs]
        rows = {s.name: k for k, e in enumerate(exprs) for s in e.free_symbols if s.name in results}
        if len(rows) == len(exprs) > 1:
            return rows
    return {}


def _used_outside(kernel: Kernel, step: str) -> set[str]:
    """Names that the kernel needs from a step: later, for its gauge, or for its limit."""
    later = [a.expr for a in kernel.body if a.step != step] + [o.expr for o in kernel.outputs]
    used = {s.name for expr in later for s in expr.free_symbols}
    used |= {kernel.limit.quantity} if kernel.limit else set()
    return used | ({kernel.gauge.square} if kernel.gauge else set())


def step_function(step: Step, scene: Scene) -> str:
    """A step as a private function that returns a tuple, its last result being the square."""
    taken = f"{rows_name(step.inputs)}: Rows" if step.rows else f"{step.inputs[0]}: Array"
    single = len(step.results) == 1 and not step.rows
    kind = "Array" if single else "Rows"
    lines = [f"def _{step.name}({taken}, c: Constants, s: Rows) -> {kind}:"]
    lines += [f'{INDENT}"""{step_text(step.name, scene)}"""']
    if step.rows:
        comma = "," if len(step.inputs) == 1 else ""
        lines += [f"{INDENT}{', '.join(step.inputs)}{comma} = {rows_name(step.inputs)}"]
    used = {s.name for a in step.body for s in a.expr.free_symbols}
    for limit in sorted({"tiny", "log_max"} & used):
        lines += [f"{INDENT}{limit} = {limit.upper()}[{step.inputs[0]}.dtype]"]
    lines += [INDENT + line for line in step.printed.lines]
    one_row = step.rows and len(step.results) == 1
    results = f"({step.results[0]},)" if one_row else ", ".join(step.results)
    return "\n".join([*lines, f"{INDENT}return {results}"])


def rows_name(inputs: tuple[str, ...]) -> str:
    """What rows are called: loads, strains, or strains from rest."""
    return "loads" if inputs[0] in LOAD_NAMES else "rest" if "stretch" in inputs else "strains"


def _call(step: Step, kernel: Kernel, base: int) -> list[str]:
    """The call of a step, with the limit's guard where its quantity comes out of it."""
    needed = _used_outside(replace(kernel, gauge=None), step.name)
    gauge = kernel.gauge if kernel.gauge and kernel.gauge.step == step.name else None
    names = [name if name in needed else "_" for name in step.results]
    given = rows_name(step.inputs) if step.rows else step.inputs[0]
    scratch = f"s[{base}:]" if base else "s"
    if not gauge:
        left = f"*_, {names[-1]}" if set(names[:-1]) == {"_"} else ", ".join(names)
        left = f"({left},)" if step.rows and len(names) == 1 else left
        lines = [f"{left} = _{step.name}({given}, c, {scratch})"]
        if kernel.limit and kernel.limit.quantity in step.results:  # the guard answers for these
            lines = ['with np.errstate(over="ignore", invalid="ignore"):', INDENT + lines[0]]
    else:
        values = names[:-1]
        given_out, function = handed(kernel)
        radii = [n if n in needed else "_" for n in given_out]
        call = f"{', '.join(radii)} = {function}(_{step.name}, {given}, c, {scratch})"
        if set(values) <= {"_"}:
            lines = [f"_, {call}"]
        else:
            taken = ", ".join(values) if len(values) > 1 else f"({values[0]},)"
            lines = [f"values, {call}", f"{taken} = values"]
    if kernel.limit and kernel.limit.quantity in step.results:
        lines += [f"{kernel.limit.quantity} = _within_limit({kernel.limit.quantity})"]
    return lines


def handed(kernel: Kernel) -> tuple[tuple[str, ...], str]:
    """What comes with the values of the gauge's step, and the function that hands it out."""
    gauge = kernel.gauge
    assert gauge is not None
    if {gauge.norm, gauge.radius} & {s.name for e in kernel.expressions() for s in e.free_symbols}:
        return (gauge.norm, gauge.radius, gauge.unscale, gauge.square), "_balanced"
    return ("", gauge.unscale, gauge.square), "_rescaled"


def body(kernel: Kernel, steps: dict[str, Step], printer: Printer, text: FunctionText) -> Body:
    """The private function that works on one block."""
    packed = packed_size(kernel, text)
    own = [steps[name] for name in dict.fromkeys(a.step for a in kernel.body if a.step)]
    known = {name for step in own for name in step.inputs}
    work = arranged(kernel, printer, packed, known)
    needed = last_reads(work)
    called, held, base, most = list[str](), dict[str, int](), 0, 0
    for step in own:
        called += _before(step, kernel, printer)
        called += _call(step, kernel, base)
        most = max(most, base + step.printed.rows)
        results = {name: base + row for name, row in step.printed.row.items()}
        held |= {name: results[name] for name in step.results if name in needed}
        base += step.kept
    places = {place_of(o, packed): place_of(o, packed) for o in kernel.outputs}
    dyad = kernel.dyad
    vector = {name: f"{name[0]}[{k}]" for k, name in enumerate(dyad.vector)} if dyad else {}
    entries = list(vector or {p: p for p in places})
    inside = _stay(entries, held, work)
    start = 0 if inside else base
    fixed = {name: start + k for k, name in enumerate(entries)} if inside or dyad else {}
    opened = [place_of(o, packed) for o in kernel.outputs if dyad and o.array == dyad.array]
    printed = print_calls(work, held, places=places | vector, fixed=fixed, opened=opened)
    arrays = ", ".join(f"*{a}" if head else a for a, head in text.outputs.items())
    first = len(entries) if inside and not dyad else 0
    lines = [f"s = [{arrays}, *work]" if first else "s = [*work]"]
    lines += _rest(kernel, printer) if _shifted(kernel) else []
    lines += called
    if any(s.name == "tiny" for a in kernel.body if not a.step for s in a.expr.free_symbols):
        like = "y" if kernel.inputs[0] in LOAD_NAMES else "q"  # an array of the block's type
        lines += [f"tiny = TINY[{like}.dtype]"]
    if dyad:
        lines += [f"{dyad.vector[0][0]} = work[{start or ''}:{start + len(entries)}]"]
    lines += printed.lines
    if kernel.plain:
        arguments = ", ".join([rows_name(kernel.inputs), "c", "work", *text.outputs])
        lines = [f"if _{kernel.name}_plain({arguments}):", f"{INDENT}return", *lines]
    opening = heading(kernel, kernel.name, text, "None")
    opening += [f'{INDENT}"""{text.equation}"""']
    rows = max(most, printed.rows) - first + SPOKEN_FOR
    return Body("\n".join([*opening, *(INDENT + line for line in lines)]), rows)


def heading(kernel: Kernel, name: str, text: FunctionText, answer: str) -> list[str]:
    """The first lines of a body."""
    given = ", ".join(f"{a}: Array" for a in text.outputs)
    taken = f"{rows_name(kernel.inputs)}: Rows, c: Constants, work: Array"
    line = f"def _{name}({taken}, {given}) -> {answer}:"
    if len(line) <= WIDTH:
        return [line]
    return [f"def _{name}(", f"{INDENT}{taken}, {given}", f") -> {answer}:"]


def _before(step: Step, kernel: Kernel, printer: Printer) -> list[str]:
    """The root of the square where no gauge takes it, if the step starts from it."""
    prepared = [a for a in kernel.body if not a.step and (a.name,) == step.inputs]
    work = [call for a in prepared for call in calls(a.name, a.expr, printer)]
    return list(print_calls(work, {}, fixed={a.name: -1 for a in prepared}).lines)


def _stay(entries: list[str], held: dict[str, int], work: list[Call]) -> bool:
    """Whether each entry's row holds what is read for the last time to make the entry."""
    holder = {row: name for name, row in held.items()}
    last, opened = last_reads(work), dict[str, int]()
    for at, call in enumerate(work):
        opened.setdefault(call.to, at)
    return len(entries) > 1 and all(
        k in holder and last[holder[k]] == opened[entry] for k, entry in enumerate(entries)
    )


def packed_size(kernel: Kernel, text: FunctionText) -> int:
    """The size of a matrix whose upper rows follow on, or 0."""
    array, size = _matrix(kernel)
    return size if array and len(text.outputs[array]) == 1 else 0


def _matrix(kernel: Kernel) -> tuple[str, int]:
    """The symmetric matrix among the outputs and its size; a dyad or not, it is mirrored."""
    found = [o for o in kernel.outputs if len(o.index) == 2]
    return (found[0].array, 1 + max(o.index[0] for o in found)) if found else ("", 0)


def arranged(
    kernel: Kernel,
    printer: Printer,
    packed: int,
    known: set[str],
    after: Mapping[str, str] | None = None,
) -> list[Call]:
    """What the body computes after the steps: each output as soon as it can be, the dyad last.

    What is ``known``, the steps' inputs, is there already; text in ``after`` follows a name.
    """
    waiting = {a.name: a for a in kernel.body if not a.step and a.name not in known}
    work = list[Call]()

    def settle(exprs: Iterable[sp.Expr]) -> None:
        wanted = {s.name for expr in exprs for s in expr.free_symbols} & set(waiting)
        if not wanted:
            return
        for a in [a for a in kernel.body if a.name in wanted]:
            if a.name in waiting:
                settle([a.expr])
                del waiting[a.name]
                work.extend(_unscaled(a, kernel, printer) or calls(a.name, a.expr, printer))
                if after and a.name in after:
                    work.append(Call("", "", (after[a.name],), frozenset({a.name})))

    dyad = kernel.dyad
    for o in (o for o in kernel.outputs if not dyad or o.array != dyad.array):
        settle([o.expr])
        work.extend(calls(place_of(o, packed), o.expr, printer))
    if dyad:
        settle(map(symbol, (dyad.weight, *dyad.vector)))
        work.append(_products(kernel, packed))
        for extra, entries in _beside(kernel).items():
            settle([extra])
            work.extend(_added(extra, entries, printer, packed))
    place, size = _matrix(kernel)
    if place and not packed:
        mirror = f"for i in range(1, {size}):\n{INDENT}{place}[i, :i] = {place}[:i, i]"
        work.append(Call("", "", (mirror,), frozenset()))
    return work


def _unscaled(a: Assignment, kernel: Kernel, printer: Printer) -> list[Call]:
    """A product with the scale's inverse, which is left out where there is no scale."""
    found = {s.name: s for s in a.expr.free_symbols}
    unscale = kernel.gauge.unscale if kernel.gauge else ""
    if unscale not in found:
        return []
    same = a.expr.xreplace({found[unscale]: sp.S.One})
    text = f"{printer.text(same)} if {unscale} is None else {printer.text(a.expr)}"
    return [Call(a.name, "", (text,), frozenset(found) - set(printer.spelling))]


def _products(kernel: Kernel, packed: int) -> Call:
    """Rank one, a row at a time; a row of scratch, here ``@``, takes weight times entry."""
    dyad = kernel.dyad
    assert dyad is not None
    letter, place, n = dyad.vector[0][0], dyad.array, len(dyad.vector)
    lines = ["first = 0"] if packed else []
    lines += [f"for i in range({n}):"]
    lines += [f"{INDENT}np.multiply({dyad.weight}, {letter}[i], out=s[@])"]
    target = f"{place}[first : first + {n} - i]" if packed else f"{place}[i, i:]"
    lines += [f"{INDENT}np.multiply(s[@], {letter}[i:], out={target})"]
    lines += [f"{INDENT}first += {n} - i"] if packed else []
    return Call("", "", ("\n".join(lines),), frozenset({dyad.weight, *dyad.vector}))


def _beside(kernel: Kernel) -> dict[sp.Expr, list[tuple[Output, bool]]]:
    """What the entries hold beside the dyad: outputs by it, and whether it is to be added."""
    dyad = kernel.dyad
    assert dyad is not None
    found = dict[sp.Expr, list[tuple[Output, bool]]]()
    for o in (o for o in kernel.outputs if o.array == dyad.array):
        extra = o.expr - dyad.term(o.index[0], o.index[1])
        if extra:
            added = bool(o.expr.is_Add and not extra.is_Add)
            found.setdefault(extra if added else o.expr, []).append((o, added))
    return found


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


def _shifted(kernel: Kernel) -> bool:
    """Whether v3 is among the inputs, and v3 - 1 is to be formed."""
    return any(a.name == "stretch" for a in kernel.body)


def _rest(kernel: Kernel, printer: Printer, out: str = "s[-2]") -> list[str]:
    """``rest``, the strains from rest, in place of the assignment to ``stretch``."""
    place = len(kernel.inputs) - 1
    before = f"*strains[:{place}], " if place else ""
    return [f"rest = [{before}np.subtract(strains[{place}], 1, out={out})]"]


def form_again(kernel: Kernel, steps: dict[str, Step], printer: Printer) -> list[str]:
    """Lines that form the limit's quantity for whole rows ``strains``, beyond the limit too."""
    assert kernel.limit is not None
    step = next(s for s in steps.values() if kernel.limit.quantity in s.results)
    rows = step.printed.rows + SPOKEN_FOR
    lines = [f"s = [*np.empty(({rows}, strains[0].size), strains[0].dtype)]"]
    lines += _rest(kernel, printer) if _shifted(kernel) else []
    lines += ['with np.errstate(over="ignore", invalid="ignore"):']
    lines += [f"{INDENT}*_, {kernel.limit.quantity} = _{step.name}({rows_name(step.inputs)}, c, s)"]
    return [INDENT + line for line in lines]


def place_of(o: Output, packed: int = 0) -> str:
    """Where an output goes; ``packed`` is the size of a matrix whose upper rows follow on."""
    if packed and len(o.index) == 2:
        i, j = o.index
        return f"{o.array}[{i * packed - i * (i - 1) // 2 + j - i}]"
    return f"{o.array}[{', '.join(map(str, o.index))}]" if o.index else o.array
