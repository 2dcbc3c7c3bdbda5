"""Prints kernels as a numba module: compiled functions of one point, and loops over points.

For each function there are ``NAME_at``, for other compiled code, and ``NAME``, for arrays, with the
arguments and answers of the NumPy module. The loop does every point without branches, so that it
may be vectorised, and a block again with care where squares or the limit ask for it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.scene import Scene
from rodproof.codegen.targets import numba_plain, numpy_template, scalar
from rodproof.codegen.targets import numba_template as template
from rodproof.codegen.targets.lines import INDENT, called, needed, wrapped
from rodproof.codegen.targets.numpy_body import upper
from rodproof.codegen.targets.numpy_constants import (
    all_have_values,
    derived_constants,
    needs_work_share,
    print_constants,
    used_constants,
)
from rodproof.codegen.targets.numpy_header import header
from rodproof.codegen.targets.numpy_plain import plain_kernels, plain_record
from rodproof.codegen.texts import FunctionText, function_text


def print_module(
    scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str] | None = None
) -> str:
    """The module's text; ``verdicts`` adds a verdict to each statement of the header."""
    words = {kernel.name: function_text(kernel, scene) for kernel in kernels}
    heads = {n: h for text in words.values() for n, h in (text.inputs | text.outputs).items()}
    first = scene.layout == "first"
    flat = "*HEADS[name], points" if first else "points, *HEADS[name]"
    parts = [
        _constants(scene, kernels),
        *([template.WORK_SHARE] if needs_work_share(kernels) else []),
        *([template.SCALES] if any(kernel.gauge for kernel in kernels) else []),
        *_rows(words, scene),
        *(
            part
            for kernel in kernels
            for part in _compiled(kernel, words[kernel.name], kernels, scene)
        ),
        numpy_template.arguments(scene.layout, scene.precision),
        template.APPLY.substitute(
            flat=flat,
            turned="" if first else ".T",
            shape="HEADS[name] + shape" if first else "shape + HEADS[name]",
            trailing="-1:" if first else ":1",
        ),
        *(_public(kernel, words[kernel.name], scene, kernels) for kernel in kernels),
    ]
    parts[1:1] = called(template.FUNCTIONS, "\n".join(parts))
    text = _fitted("\n\n\n".join(part.strip("\n") for part in parts) + "\n")
    top = header(scene, kernels, verdicts or {}, target="numba")
    opening = needed(_imports(scene, kernels, words, heads, text), text)
    return f"{top}\n\n{opening}\n\n{text}"


def _fitted(text: str) -> str:
    """With calls and definitions that run over the line broken after their first parenthesis."""
    return "\n".join(
        broken
        for line in text.split("\n")
        for broken in _fitting(line, line[: len(line) - len(line.lstrip())])
    )


def _imports(
    scene: Scene,
    kernels: tuple[Kernel, ...],
    words: Mapping[str, FunctionText],
    heads: Mapping[str, tuple[int, ...]],
    text: str,
) -> str:
    """Imports, names of types, and numbers."""
    plain = plain_kernels(kernels)
    standard = ["from fractions import Fraction"] if derived_constants(kernels) or plain else []
    standard += ["from functools import cached_property"]
    functions = ("frexp", "ldexp", "sqrt")
    used = [name for name in functions if re.search(rf"(?<![\w.]){name}\(", text)]
    fields = derived_constants(kernels) or set(scene.fixed) & set(used_constants(kernels))
    return template.IMPORTS.substitute(
        field_import=", field" if fields else "",
        standard_imports="\n".join(standard),
        functions=", ".join(used),
        streams=max(
            sum(math.prod(head) for head in text.outputs.values()) for text in words.values()
        ),
        heads="HEADS: dict[str, tuple[int, ...]] = {\n"
        + "".join(f'    "{name}": {head},\n' for name, head in heads.items())
        + "}",
    )


def _constants(scene: Scene, kernels: tuple[Kernel, ...]) -> str:
    """The record of constants, and the tuple of their values."""
    names = [*used_constants(kernels), *derived_constants(kernels)]
    share = needs_work_share(kernels)
    fields = [f"    {name}: float" for name in names]
    fields += ["    work_share: tuple[Array, Array, float, float, float]"] if share else []
    values = [f"            self.{name}," for name in names]
    values += [template.WORK_SHARE_VALUES] if share else []
    properties = (
        template.VALUES_PROPERTY.substitute(values="\n".join(values)).strip("\n"),
        numba_plain.numbers(kernels),
    )
    parts = [
        template.VALUES.substitute(fields="\n".join(fields)),
        *numba_plain.ordinary(kernels),
        *filter(None, [plain_record(kernels, [])]),
        print_constants(scene, kernels, properties),
    ]
    return "\n\n\n".join(part.strip("\n") for part in parts)


def _rows(words: Mapping[str, FunctionText], scene: Scene) -> list[str]:
    """The functions that read and write points, and those that make matrices whole."""
    first = scene.layout == "first"
    moved = template.ROWS.substitute(
        axis="kind.ndim - 1" if first else "0",
        index="builder.add(builder.mul(points, points.type(k)), i)"
        if first
        else "builder.add(builder.mul(i, i.type(count)), i.type(k))",
    )
    sizes = {_matrix(text)[0] for text in words.values() if len(_matrix(text)) == 2}
    return [*(_whole(size) for size in sorted(sizes)), moved]


def _whole(size: int) -> str:
    rows = (", ".join(f"k[{k}]" for k in row) for row in _places(size))
    entries = "\n".join(f"{INDENT * 2}{row}," for row in rows)
    return template.WHOLE.substitute(size=size, entries=entries)


def _places(size: int) -> list[list[int]]:
    """The place of each entry of a matrix among those on and above the diagonal."""
    return [[upper(size, min(j, k), max(j, k)) for k in range(size)] for j in range(size)]


def _matrix(text: FunctionText) -> tuple[int, ...]:
    """The shape of the matrix among the outputs, or nothing."""
    return next((head for name, head in text.outputs.items() if _is_matrix(name, head)), ())


def _is_matrix(name: str, head: tuple[int, ...]) -> bool:
    return bool(head) and name in scalar.LETTERS


def _entries(head: tuple[int, ...]) -> int:
    """How many numbers an output has, a matrix on and above its diagonal."""
    return math.prod(head) if len(head) < 2 else head[0] * (head[0] + 1) // 2


def _compiled(
    kernel: Kernel, text: FunctionText, kernels: tuple[Kernel, ...], scene: Scene
) -> list[str]:
    """The functions of one point and the loop over points."""
    known = [*used_constants(kernels), *derived_constants(kernels)]
    spelling = {name: f"c.{name}" for name in known}
    square = scalar.square(kernel, scalar.NUMBA)
    quantity = kernel.limit.quantity if kernel.limit else ""
    nan = scene.at_limit == "nan"
    guards = {quantity: [f"{INDENT}{quantity} = {quantity} if {quantity} < 1 else math.nan"]}
    packed = scene.matrix == "packed"
    at_limit = guards if quantity and nan else {}
    body = scalar.body(kernel, scalar.NUMBA, spelling, at_limit, packed=packed)
    watched = [name for name in (square, "" if nan else quantity) if name]
    arguments = ", ".join(f"{name}: float" for name in kernel.inputs)
    scale = ", scale: float" if square else ""
    lines = [
        "@at_point",
        *wrapped(f"def _{kernel.name}(", [f"{arguments}, c: Values{scale}"], ") -> Any:", "", ""),
        f'{INDENT}"""{text.equation}"""',
        *body.lines,
    ]
    returned = [*scalar.returned(body.answer, ", ".join(watched))]
    parts = ["\n".join([*lines, *returned]), *numba_plain.function(kernel, known, packed=packed)]
    if square:
        parts.append(_careful(kernel, watched))
    parts.append(_at_one(kernel, text, watched))
    parts.append(_over(kernel, text, watched, scene, kernels))
    return parts


def _careful(kernel: Kernel, watched: list[str]) -> str:
    sizes = [f"abs({name} - 1)" if name == "v3" else f"abs({name})" for name in kernel.inputs]
    kept = ["values", *watched[1:]]
    return template.CAREFUL.substitute(
        name=kernel.name,
        arguments=", ".join(kernel.inputs),
        result=", ".join(["values", *watched]),
        largest=f"max({', '.join(sizes)})" if len(sizes) > 1 else sizes[0],
        kept=", ".join(kept),
    )


def _at_one(kernel: Kernel, text: FunctionText, watched: list[str]) -> str:
    """The function of one point for other compiled code."""
    square = scalar.square(kernel, scalar.NUMBA)
    call = f"{'_careful' if square else ''}_{kernel.name}({', '.join(kernel.inputs)}, c)"
    quantity = watched[-1] if watched and watched[-1] != square else ""
    lines = [f"{INDENT}{', '.join(['values', *([quantity] if quantity else [])])} = {call}"]
    if quantity:
        assert kernel.limit is not None
        lines += [
            f"{INDENT}if not {quantity} < 1:",
            f'{INDENT * 2}raise ValueError("{kernel.limit.sentence}")',
        ]
    lines += _nested(text)
    if len(lines) == 2 and lines[1] == f"{INDENT}return values":
        lines = [f"{INDENT}return {call}"]
    made = ", ".join(f"{name} {head or 'a number'}" for name, head in text.outputs.items())
    return template.AT.substitute(
        name=kernel.name,
        arguments=", ".join(kernel.inputs),
        doc=f"`{kernel.name}` at one point: {made}; for compiled code.",
        lines="\n".join(lines),
    )


def _nested(text: FunctionText) -> list[str]:
    """The return of a tuple for each array, and of a tuple of rows for a matrix."""
    lines: list[str] = []
    pieces: list[str] = []
    first = 0
    for name, head in text.outputs.items():
        count = _entries(head)
        if len(head) == 2:
            texts = [", ".join(f"values[{first + k}]" for k in r) for r in _places(head[0])]
            alone = len(text.outputs) == 1
            opening = "return (" if alone else f"{name} = ("
            lines += [INDENT + opening, *(f"{INDENT * 2}({r})," for r in texts), f"{INDENT})"]
            pieces += [] if alone else [name]
        else:
            pieces.append(f"values[{first}:{first + count}]" if head else f"values[{first}]")
        first += count
    if first == 1:
        pieces = ["values"]
    return [*lines, f"{INDENT}return {', '.join(pieces)}"] if pieces else lines


def _over(
    kernel: Kernel,
    text: FunctionText,
    watched: list[str],
    scene: Scene,
    kernels: tuple[Kernel, ...],
) -> str:
    """The loop over points."""
    square = scalar.square(kernel, scalar.NUMBA)
    quantity = watched[-1] if watched and watched[-1] != square else ""
    names = iter(kernel.inputs)
    reads = []
    for name, head in text.inputs.items():
        count = math.prod(head)
        point = "".join(f"{next(names)}, " for _ in range(count)).removesuffix(" " * (count > 1))
        reads.append(f"{point.rstrip(', ') if count > 1 else point} = _get({name}, {count}, i)")
    arguments = ", ".join(kernel.inputs)
    call = f"_{kernel.name}({arguments}, c{', 1.0' if square else ''})"
    stores = _stores(text)
    plainly = numba_plain.first(kernel, reads, stores)
    quick = [*reads, f"{', '.join(['values', *watched])} = {call}", *stores]
    quick += ["fine &= (square > LOW) & (square < HIGH)"] if square else []
    quick += [f"fine &= {quantity} < 1"] if quantity else []
    again = []
    if square:
        result = ", ".join(["values", *watched[1:]])
        again += [*reads, f"{result} = _careful_{kernel.name}({arguments}, c)", *stores]
    elif quantity:
        again += [*reads, f"_, {quantity} = {call}"]
    if quantity:
        again += [
            f"if not {quantity} < 1:",
            f"{INDENT}first, worst = (np.int64(i), {quantity}) if past == 0 else (first, worst)",
            f"{INDENT}past += 1",
        ]
    careful = template.CAREFULLY.substitute(lines="\n".join(_indented(again, 4))) if again else ""
    whole = template.OVER.substitute(
        name=kernel.name,
        about=template.ABOUT_PAST if quantity else "",
        given=", ".join(f"{name}: Array" for name in text.inputs),
        taken=", ".join(f"{name}: Array" for name in text.outputs),
        points=f"{next(iter(text.inputs))}.shape[{-1 if scene.layout == 'first' else 0}]",
        constants=numba_plain.taken(kernels, kernel, _count(kernels)),
        plainly="".join(f"{line}\n" for line in _indented(plainly, 2)),
        spans=_spans(text),
        fine="fine = True" if again else "$",
        quick="\n".join(_indented(quick, 3)),
        careful=careful,
    )
    return whole.replace(f"{INDENT * 2}$\n", "")


def _count(kernels: tuple[Kernel, ...]) -> int:
    """How many entries the tuple of values has."""
    names = {*used_constants(kernels), *derived_constants(kernels)}
    return len(names) + needs_work_share(kernels)


def _stores(text: FunctionText) -> list[str]:
    """The lines that store a point's values, each array's own."""
    lines: list[str] = []
    row = first = 0
    for name, head in text.outputs.items():
        count = _entries(head)
        values = f"values[{first}:{first + count}]" if len(text.outputs) > 1 else "values"
        if not head and len(text.outputs) == 1:
            values = "(values,)"
        if len(head) == 2:
            values = f"_whole_{head[0]}({values})"
        lines.append(f"_put({name}, {row}, i, {values})")
        row, first = row + math.prod(head), first + count
    return lines


def _spans(text: FunctionText) -> str:
    """Where inputs and results are in memory, as two tuples."""
    both = ([f"_span({name})" for name in names] for names in (text.inputs, text.outputs))
    return ", ".join(f"({', '.join(spans)}{',' * (len(spans) == 1)})" for spans in both)


def _indented(lines: list[str], depth: int) -> list[str]:
    return [
        broken for line in lines for broken in _fitting(f"{INDENT * depth}{line}", INDENT * depth)
    ]


def _fitting(line: str, indent: str) -> list[str]:
    """A line, or a call with its arguments on a line of their own."""
    if len(line) <= 100:
        return [line]
    opening, _, rest = line.partition("(")
    inside, _, closing = rest.rpartition(")")
    return [f"{opening}(", f"{indent}{INDENT}{inside}", f"{indent}){closing}"]


def _public(kernel: Kernel, text: FunctionText, scene: Scene, kernels: tuple[Kernel, ...]) -> str:
    """The public function of arrays."""
    default = " = ROD" if all_have_values(scene, kernels) else ""
    single = len(text.outputs) == 1
    kind = ("Array", "Pair", "Triple")[len(text.outputs) - 1]
    names = ", ".join(text.outputs)
    given = ", ".join(f"{name}: ArrayLike" for name in text.inputs)
    lines = wrapped(
        f"def {kernel.name}(",
        [f"{given}, constants: Constants{default}", f"out: {kind} | None = None"],
        f") -> {kind}:",
        ", ",
        "",
    )
    lines += [f'    """{text.doc}', '    """'] if "\n" in text.doc else [f'    """{text.doc}"""']
    inputs = "{" + ", ".join(f'"{name}": {name}' for name in text.inputs) + "}"
    results = ", ".join(f'"{name}"' for name in text.outputs) + ("," if single else "")
    lines += wrapped(
        f"{f'({names},)' if single else names} = _apply(",
        [f"_{kernel.name}_over", inputs, "constants", f"({results})", "out"],
        ")",
        ", ",
        INDENT,
    )
    return "\n".join([*lines, f"    return {names}"])
