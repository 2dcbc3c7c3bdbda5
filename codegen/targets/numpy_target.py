"""Prints kernels as a NumPy module that stands alone.

A function comes out as a private body, which works on one block of points in the order of the
kernel, and a public function that checks, broadcasts and runs the body over blocks. A step that
kernels share is printed once, as a private function of its own; steps that a gauge governs are
called through `_rescaled` or `_balanced`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.scene import Scene
from rodproof.codegen.targets import numpy_gauge as gauge
from rodproof.codegen.targets import numpy_point as one
from rodproof.codegen.targets import numpy_template as template
from rodproof.codegen.targets.numpy_body import (
    MIRROR,
    SPREAD,
    SPREAD_PACKED,
    spelling,
)
from rodproof.codegen.targets.numpy_careful import (
    Step,
    careful_body,
    form_again,
    handed,
    step_function,
    steps_of,
)
from rodproof.codegen.targets.numpy_constants import (
    all_have_values,
    derived_constants,
    needs_work_share,
    print_constants,
    used_constants,
)
from rodproof.codegen.targets.numpy_header import header
from rodproof.codegen.targets.numpy_plain import (
    INSIDE,
    SCRATCH,
    Square,
    alone,
    in_place,
    plain_body,
    plain_kernels,
    plain_record,
    square_function,
    squares_of,
)
from rodproof.codegen.targets.printer import Printer, wrapped
from rodproof.codegen.texts import FunctionText, function_text

INDENT = "    "


def print_module(
    scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str] | None = None
) -> str:
    """The module's text; ``verdicts`` adds a verdict to each statement of the header."""
    words = {kernel.name: function_text(kernel, scene) for kernel in kernels}
    named = spelling(kernels)
    printer = Printer(named)
    steps, squares = steps_of(kernels, printer), squares_of(kernels, named)
    points = {k.name: one.point(k, words[k.name], scene, named, kernels) for k in kernels}
    bodies = {k.name: _bodies(k, steps, squares, words[k.name], named) for k in kernels}
    limited = [kernel for kernel in kernels if kernel.limit]
    raising = bool(limited) and scene.at_limit == "raise"
    parts = [
        header(scene, kernels, verdicts or {}) + "\n\n" + _imports(scene, kernels, words, points),
        print_constants(scene, kernels, one.point_constants(kernels)),
        *filter(None, [plain_record(kernels, one.point_values(kernels))]),
        *(step_function(step, scene, printer) for step in steps.values()),
    ]
    gauges = {handed(kernel)[1] for kernel in kernels if kernel.gauge}
    parts += [gauge.RESCALED] if gauges else []
    parts += [gauge.BALANCED] if "_balanced" in gauges else []
    parts += [template.WORK_SHARE, one.WORK_SHARE] if needs_work_share(kernels) else []
    if limited:
        parts.append(template.RAISE if raising else template.NAN)
    if raising:
        parts.append(_past_limit(limited[0], steps))
    parts += _plumbing(scene, kernels, raising=raising)
    parts += [square_function(square) for square in squares.values()]
    parts += _matrices(scene, bodies)
    default = " = ROD" if all_have_values(scene, kernels) else ""
    for kernel in kernels:
        parts += [*bodies[kernel.name], points[kernel.name]]
        parts.append(_public(kernel, words[kernel.name], default))
    return "\n\n\n".join(part.strip("\n") for part in parts) + "\n"


def _bodies(
    kernel: Kernel,
    steps: dict[str, Step],
    squares: Mapping[str, Square],
    text: FunctionText,
    named: dict[str, str],
) -> list[str]:
    """The private functions of a kernel: a plain one, and one that always holds."""
    if alone(kernel):
        return [plain_body(kernel, text, named, squares)]
    plain = [plain_body(kernel.plain, text, named, squares)] if kernel.plain else []
    return [*plain, careful_body(kernel, steps, named, text)]


def _matrices(scene: Scene, bodies: Mapping[str, list[str]]) -> list[str]:
    """What the bodies call to fill matrices."""
    text = "".join(body for several in bodies.values() for body in several)
    spread = SPREAD_PACKED if scene.matrix == "packed" else SPREAD
    found = [spread] if " _spread(" in text else []
    return [*found, MIRROR] if " _mirror(" in text else found


def _imports(
    scene: Scene,
    kernels: tuple[Kernel, ...],
    words: Mapping[str, FunctionText],
    points: Mapping[str, str],
) -> str:
    """Imports, names of types, and the tables that the functions look things up in."""
    derived, plain = derived_constants(kernels), plain_kernels(kernels)
    heads = {n: h for text in words.values() for n, h in (text.inputs | text.outputs).items()}
    standard = ["from fractions import Fraction"] if derived or plain else []
    standard += ["from functools import cached_property"]
    single = "".join(points.values())
    single += one.WORK_SHARE if needs_work_share(kernels) else ""
    functions = [name for name in one.FUNCTIONS if re.search(rf"(?<!\w){name}\(", single)]
    standard += [f"from math import {', '.join(functions)}"] if functions else []
    used = {s.name for kernel in kernels for e in kernel.expressions() for s in e.free_symbols}
    guards = [template.LOG_MAX] if "log_max" in used else []
    if guards or plain or "tiny" in used or any(kernel.gauge for kernel in kernels):
        guards = [template.TINY, *guards]
    guards += [one.LEAST] if "LEAST" in single else []
    guards += [one.LOG_MOST] if "LOG_MOST" in single else []
    guards += [one.LOW] if "LOW" in single else []
    guards += [one.NOUGHT] if "NOUGHT" in single else []
    guards += [one.DOUBLE] if plain else []
    several = sorted({len(text.outputs) for text in words.values()} - {1})
    kinds = {2: "Pair = tuple[Array, Array]", 3: "Triple = tuple[Array, Array, Array]"}
    text = template.IMPORTS.substitute(
        threading="import threading" if in_place(kernels) else "$",
        kept="KEPT = threading.local()  # scratch, from call to call" if in_place(kernels) else "$",
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


def _plumbing(scene: Scene, kernels: tuple[Kernel, ...], *, raising: bool) -> list[str]:
    """The functions that take arrays in, run a body over blocks, and hand results out."""
    first = scene.layout == "first"
    run = template.RUN_RAISE if raising else template.RUN
    whole = template.APPLY_FIRST if first else template.APPLY_LAST
    return [
        template.arguments(scene.layout, scene.precision),
        whole.substitute(run=run.substitute(outputs=template.OUTPUTS[scene.layout])),
        one.EXTREME,
        one.ONE,
        *([SCRATCH] if in_place(kernels) else []),
        *([INSIDE] if plain_kernels(kernels) else []),
    ]


def _past_limit(kernel: Kernel, steps: dict[str, Step]) -> str:
    assert kernel.limit is not None
    lines = form_again(kernel, steps)
    return template.PAST_LIMIT.substitute(reduce="\n".join(lines), sentence=kernel.limit.sentence)


def _public(kernel: Kernel, text: FunctionText, default: str) -> str:
    """The public function; ``default`` is that of the constants, if they have one."""
    single = len(text.outputs) == 1
    kind = ("Array", "Pair", "Triple")[len(text.outputs) - 1]
    names = ", ".join(text.outputs)
    given = ", ".join(
        f"{name}: Given{'' if head else ' | float'}" for name, head in text.inputs.items()
    )
    arguments = f"{given}, constants: Constants{default}"
    lines = wrapped(
        f"def {kernel.name}(", [arguments, f"out: {kind} | None = None"], f") -> {kind}:", ", ", ""
    )
    lines += [f'    """{text.doc}', '    """'] if "\n" in text.doc else [f'    """{text.doc}"""']
    lines += one.opening(kernel, text, kind)
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
