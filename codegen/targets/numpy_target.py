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
from rodproof.codegen.targets.lines import INDENT, WIDTH, called, needed, wrapped
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
    step_function,
    steps_of,
)
from rodproof.codegen.targets.numpy_constants import (
    all_have_values,
    derived_constants,
    print_constants,
    used_constants,
)
from rodproof.codegen.targets.numpy_form import Square, square_function, squares_of
from rodproof.codegen.targets.numpy_header import header
from rodproof.codegen.targets.numpy_plain import INSIDE, SCRATCH, alone, plain_body, plain_record
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.texts import FunctionText, function_text

#: Functions of the module math that one point may call.
MATH = ("exp", "expm1", "log", "log1p", "sqrt")


#: What bodies and points may call, by name; what they do not call is left out.
SHARED = {
    "_rescaled": gauge.RESCALED,
    "_balanced": gauge.BALANCED,
    "_work_share": template.WORK_SHARE,
    "_work_share_at": one.WORK_SHARE,
}
PLAIN = {"_scratch": SCRATCH, "_inside": INSIDE}


def print_module(
    scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str] | None = None
) -> str:
    """The module's text; ``verdicts`` adds a verdict to each statement of the header."""
    words = {kernel.name: function_text(kernel, scene) for kernel in kernels}
    named = spelling(kernels)
    printer = Printer(named)
    steps, squares = steps_of(kernels, printer), squares_of(kernels, words, named, scene)
    bodies = {k.name: _bodies(k, steps, squares, words[k.name], named, scene) for k in kernels}
    for k in kernels:
        bodies[k.name].append(one.point(k, words[k.name], scene, named, kernels))
    own = "\n".join(body for several in bodies.values() for body in several)
    limited = [kernel for kernel in kernels if kernel.limit]
    raising = bool(limited) and scene.at_limit == "raise"
    parts = [
        print_constants(scene, kernels, one.point_constants(kernels)),
        *filter(None, [plain_record(kernels, one.point_values(kernels))]),
        *(step_function(step, scene, printer) for step in steps.values()),
        *called(SHARED, own),
    ]
    if limited:
        parts.append(template.RAISE if raising else template.NAN)
    if raising:
        parts.append(_past_limit(limited[0], steps))
    parts += [*_plumbing(scene, raising=raising), *called(PLAIN, own)]
    parts += [square_function(square) for square in squares.values()]
    spread = SPREAD_PACKED if scene.matrix == "packed" else SPREAD
    parts += called({"_spread": spread, "_mirror": MIRROR}, own)
    default = " = ROD" if all_have_values(scene, kernels) else ""
    for kernel in kernels:
        parts += [*bodies[kernel.name], _public(kernel, words[kernel.name], default)]
    text = "\n\n\n".join(part.strip("\n") for part in parts) + "\n"
    opening = needed(_imports(scene, kernels, words, text), text)
    return f"{header(scene, kernels, verdicts or {})}\n\n{opening}\n\n{text}"


def _bodies(
    kernel: Kernel,
    steps: dict[str, Step],
    squares: Mapping[str, Square],
    text: FunctionText,
    named: dict[str, str],
    scene: Scene,
) -> list[str]:
    """The private functions of a kernel: a plain one, and one that always holds."""
    if alone(kernel):
        return [plain_body(kernel, text, named, squares, scene)]
    plain = [plain_body(kernel.plain, text, named, squares, scene)] if kernel.plain else []
    return [*plain, careful_body(kernel, steps, named, text)]


def _imports(
    scene: Scene, kernels: tuple[Kernel, ...], words: Mapping[str, FunctionText], text: str
) -> str:
    """Imports, names of types, and the tables that the functions look things up in."""
    derived = derived_constants(kernels)
    heads = {n: h for found in words.values() for n, h in (found.inputs | found.outputs).items()}
    standard = ["from fractions import Fraction"] if "Fraction(" in text else []
    standard += ["from functools import cached_property"]
    functions = [name for name in MATH if re.search(rf"(?<![\w.]){name}\(", text)]
    standard += [f"from math import {', '.join(functions)}"] if functions else []
    fields = derived or set(scene.fixed) & set(used_constants(kernels))
    return template.IMPORTS.substitute(
        threading="\nimport threading" if "KEPT" in text else "",
        field_import=", field" if fields else "",
        standard_imports="\n".join(standard),
        heads=_table("HEADS", {f'"{name}"': str(head) for name, head in heads.items()}),
    )


def _table(name: str, entries: Mapping[str, str]) -> str:
    """A dictionary, on as few lines as hold it."""
    pieces = [f"{key}: {value}," for key, value in entries.items()]
    line = f"{name} = {{{' '.join(pieces)[:-1]}}}"
    if len(line) <= WIDTH:
        return line
    lines = [INDENT]
    for piece in pieces:
        if len(lines[-1] + piece) > WIDTH:
            lines.append(INDENT)
        lines[-1] += piece + " "
    return "\n".join([f"{name} = {{", *(line.rstrip() for line in lines), "}"])


def _plumbing(scene: Scene, *, raising: bool) -> list[str]:
    """The functions that take arrays in, run a body over blocks, and hand results out."""
    first = scene.layout == "first"
    run = template.RUN_RAISE if raising else template.RUN
    whole = template.APPLY_FIRST if first else template.APPLY_LAST
    return [
        template.arguments(scene.layout, scene.precision),
        whole.substitute(run=run.substitute(outputs=template.OUTPUTS[scene.layout])),
        one.EXTREME,
        one.ONE,
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
