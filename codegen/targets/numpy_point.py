"""Prints the way of one point in a NumPy module: tuples of numbers in, tuples of floats out."""

from __future__ import annotations

from collections.abc import Mapping

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.scene import Scene
from rodproof.codegen.targets import scalar
from rodproof.codegen.texts import FunctionText

INDENT = "    "
#: Functions that have text of their own for one point; the others answer by way of arrays.
OWN = ("strains", "loads", "stiffness", "loads_and_stiffness")

FUNCTIONS = ("exp", "expm1", "log", "log1p", "sqrt")
LOW = "LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing"
LEAST = "LEAST = 2.0**-1022  # the smallest normal number, for one point"
LOG_MOST = "LOG_MOST = 0.99 * 1022 * math.log(2)  # its exponential is near the largest number"

ONE = '''\
def _one(law: Callable[..., Any], inputs: Inputs, c: Constants) -> Any:
    """``law`` of one point by way of arrays, or again in floats if it was given other numbers."""
    arrays, shape = _arguments(inputs)
    if shape:  # tuples of arrays
        return law(*map(np.asarray, inputs.values()), c)
    floats = [a.astype(float).tolist() for a in arrays]
    again = tuple(tuple(f) if isinstance(f, list) else f for f in floats)
    if repr(again) != repr((*inputs.values(),)):
        return law(*again, c)
    answer = law(*map(np.array, floats), c)
    if not isinstance(answer, tuple):
        return _numbers(answer)
    return tuple(_numbers(array) for array in answer)


def _numbers(array: Array) -> Any:
    """The array as a float, a tuple of floats, or a tuple of rows."""
    values = array.astype(float).tolist()
    if array.ndim == 2:
        return tuple(map(tuple, values))
    return tuple(values) if array.ndim else values
'''


def is_own(kernel: Kernel) -> bool:
    """Whether the function has text for one point."""
    return kernel.name in OWN and not any(e.has(WorkShare) for e in kernel.expressions())


def point(
    kernel: Kernel,
    text: FunctionText,
    scene: Scene,
    spelling: Mapping[str, str],
    kernels: tuple[Kernel, ...],
) -> str:
    """The private function of one point of floats; it answers None where it must not be used."""
    given = ", ".join(f"{name}: Any" for name in text.inputs)
    lines = [f"def _{kernel.name}_at({given}, c: Constants) -> Any:"]
    lines += [f'{INDENT}"""`{kernel.name}` of floats; None where it is left to arrays."""']
    if kernel.name == "stiffness" and any(k.name == "loads_and_stiffness" for k in kernels):
        whole = f"_loads_and_stiffness_at({', '.join(text.inputs)}, c)"
        lines += [f"{INDENT}whole = {whole}", f"{INDENT}return whole and whole[-1]"]
        return "\n".join(lines)
    left = list(kernel.inputs)
    for name, head in text.inputs.items():
        if head:
            lines.append(f"{INDENT}{', '.join(left[: head[0]])} = {name}")
        left = left[head[0] if head else 1 :]
    lines += _if_not(" is ".join([*(f"type({name})" for name in kernel.inputs), "float"]))
    guards = _guards(kernel)
    body = scalar.body(kernel, scalar.PYTHON, spelling, guards, packed=scene.matrix == "packed")
    return "\n".join([*lines, *body.lines, *scalar.returned(body.answer)])


def _guards(kernel: Kernel) -> dict[str, list[str]]:
    """Where arrays take over: past the limit, and where squares lose digits but at rest."""
    if kernel.gauge:
        inputs = kernel.gauge.inputs
        moved = f"any(({', '.join(inputs)}))" if len(inputs) > 1 else f"{inputs[0]} != 0"
        within = f"LOW < {kernel.gauge.square} < {'1' if kernel.limit else 'HIGH'}"
        return {kernel.gauge.square: _if_not(f"{within} and {moved}")}
    return {q.quantity: _if_not(f"{q.quantity} < 1") for q in (kernel.limit,) if q}


def _if_not(test: str) -> list[str]:
    return [f"{INDENT}if not {test}:", f"{INDENT * 2}return None"]


def opening(kernel: Kernel, text: FunctionText, kind: str) -> list[str]:
    """The lines of a public function that see to one point."""
    tuples = [f"type({name})" for name, head in text.inputs.items() if head]
    numbers = [f"type({name})" for name, head in text.inputs.items() if not head]
    kinds = ((tuples, "tuple"), (numbers, "float"))
    tests = [" is ".join([*some, what]) for some, what in kinds if some]
    inputs = "{" + ", ".join(f'"{name}": {name}' for name in text.inputs) + "}"
    lines = [f"{INDENT}if out is None and {' and '.join(tests)}:"]
    one = f"_one({kernel.name}, {inputs}, constants)"
    if not is_own(kernel):
        return [*lines, f"{INDENT * 2}answer: {kind} = {one}", f"{INDENT * 2}return answer"]
    own = f"_{kernel.name}_at({', '.join(text.inputs)}, constants)"
    return [
        *lines,
        f"{INDENT * 2}try:",
        f"{INDENT * 3}answer: {kind} | None = {own}",
        f"{INDENT * 2}except (ArithmeticError, TypeError, ValueError):",
        f"{INDENT * 3}answer = None",
        f"{INDENT * 2}return answer or {one}",
    ]
