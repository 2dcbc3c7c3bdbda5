"""Prints the way of one point in a NumPy module: tuples of numbers in, tuples of floats out."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen.kernel import Kernel, symbol
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.scene import CONSTANT_NAMES, Scene
from rodproof.codegen.targets import scalar
from rodproof.codegen.targets.lines import INDENT, WIDTH, filled
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.texts import FunctionText

EXTREME = '''\
class _Extreme(ArithmeticError):
    """A point that plain Python leaves to arrays."""
'''

ONE = '''\
def _one(law: Callable[..., Any], inputs: Inputs, c: Constants) -> Any:
    """``law`` of one point by way of arrays, or again in floats if it was given other numbers."""
    try:
        arrays, shape = _arguments(inputs)
    except ValueError as wrong:
        raise wrong from None
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


WORK_SHARE = '''\
def _work_share_at(depth: float, c: Constants) -> float:
    """`_work_share` of one point."""
    fraction, powers, start, slope, single = c.work_share
    beyond = depth - log(9)
    if beyond <= 0:
        growth, value = expm1(depth), 1.0
        for term in reversed(fraction):
            value = growth / value * term + 1
        return 0.5 / value
    left, rest = exp(-beyond), 0.0
    for coefficient in reversed(powers):
        rest = rest * left + coefficient
    turns = -expm1(min(-slope * beyond, 80)) / slope if slope else beyond
    inner = exp(-beyond / c.p) * (start + single * turns) - left * rest
    return inner * exp(-2 / c.p * log1p(-left / 9))
'''


def point(
    kernel: Kernel,
    text: FunctionText,
    scene: Scene,
    spelling: Mapping[str, str],
    kernels: tuple[Kernel, ...],
) -> str:
    """The private function of one point of floats; it raises where it must not be used."""
    given = ", ".join(f"{name}: Any" for name in text.inputs)
    lines = [f"def _{kernel.name}_at({given}, c: Constants) -> Any:"]
    lines += [f'{INDENT}"""`{kernel.name}` of floats, where nothing is extreme."""']
    if is_part(kernel, kernels):
        whole = f"_loads_and_stiffness_at({', '.join(text.inputs)}, c)"
        return "\n".join([*lines, f"{INDENT}return {whole}[-1]"])
    hoisted = _hoisted(kernel)
    lines += _taken(kernel)
    left = list(kernel.inputs)
    for name, head in text.inputs.items():
        if head:
            lines.append(f"{INDENT}{', '.join(left[: head[0]])} = {name}")
        left = left[head[0] if head else 1 :]
    guards = _guards(kernel)
    if not guards:
        lines += _left(f"not {' is '.join([*(f'type({n})' for n in kernel.inputs), 'float'])}")
    spelling = {name: name for name in (*spelling, *(a.name for a in hoisted.constants))}
    body = scalar.body(hoisted, scalar.PYTHON, spelling, guards, packed=scene.matrix == "packed")
    return "\n".join([*lines, *body.lines, *scalar.returned(body.answer)])


def is_part(kernel: Kernel, kernels: tuple[Kernel, ...]) -> bool:
    """Whether its one point is a part of what another function answers."""
    return kernel.name == "stiffness" and any(k.name == "loads_and_stiffness" for k in kernels)


def constants_taken(kernel: Kernel) -> tuple[str, ...]:
    """The numbers that the function of one point takes, hoisted ones included, in its order.

    `_work_share_at` has p from the record.
    """
    hoisted = _hoisted(kernel)
    made = {a.name for a in hoisted.constants}
    read = (e.replace(WorkShare, lambda depth, _: depth) for e in hoisted.expressions())
    used = [s.name for e in read for s in sorted(e.free_symbols, key=str)]
    return tuple(n for n in dict.fromkeys(used) if n in made | set(CONSTANT_NAMES))


@cache
def _hoisted(kernel: Kernel) -> Kernel:
    """The kernel that is printed, with its products of constants: the plain one, if there is one.

    It holds further than on arrays, for any large load: a power of Python does not multiply the
    rounding of a logarithm.
    """
    if kernel.plain is None:
        return scalar.hoisted(kernel)
    changed: dict[sp.Expr, sp.Expr] = {}
    for node in (node for e in kernel.plain.expressions() for node in e.atoms(sp.exp)):
        rate, log = node.args[0].as_independent(log1p)
        if isinstance(log, log1p):
            changed[node] = (1 + log.args[0]) ** rate
    return scalar.hoisted(scalar.formless(kernel.plain.rewrite(changed)))


def point_constants(kernels: tuple[Kernel, ...]) -> list[str]:
    """The properties of the constants that hand these numbers out, without a plain kernel."""
    return [
        "\n".join(
            [
                f"{INDENT}@cached_property",
                f"{INDENT}def of_{kernel.name}(self) -> tuple[float, ...]:",
                f'{INDENT * 2}"""What `{kernel.name}` of one point takes."""',
                *_tuple("return ", _values(kernel, "self")),
            ]
        )
        for kernel in kernels
        if not kernel.plain and not is_part(kernel, kernels) and constants_taken(kernel)
    ]


def point_values(kernels: tuple[Kernel, ...]) -> list[str]:
    """The lines of the plain kernels' constants that collect these numbers, alike ones once."""
    found: dict[tuple[str, ...], str] = {}
    lines: list[str] = []
    for kernel in (k for k in kernels if k.plain and not is_part(k, kernels)):
        values = tuple(_values(kernel, "c"))
        same = found.setdefault(values, name := f"self.of_{kernel.name}")
        lines += (
            _tuple(f"{name} = ", [*values]) if same == name else [f"{INDENT * 2}{name} = {same}"]
        )
    return lines


def _tuple(left: str, values: list[str]) -> list[str]:
    line = f"{INDENT * 2}{left}({', '.join(values)}{',' * (len(values) == 1)})"
    if len(line) <= WIDTH:
        return [line]
    return [f"{INDENT * 2}{left}(", *filled(values, INDENT * 3), f"{INDENT * 2})"]


def _values(kernel: Kernel, record: str) -> list[str]:
    """The numbers that one point takes, as fields of the record, or of what is plain."""
    hoisted, plain = _hoisted(kernel), kernel.plain
    own = "self" if plain else record
    fields = {name: f"{record}.{name}" for name in CONSTANT_NAMES}
    fields |= {a.name: f"{own}.{a.name}" for a in (plain or kernel).constants}
    printer = Printer(fields)
    made = {a.name: printer.text(a.expr) for a in hoisted.constants if a.name not in fields}
    values = [(fields | made)[name] for name in constants_taken(kernel)]
    return values + (["*self.room[DOUBLE]"] if plain else [])


def _taken(kernel: Kernel) -> list[str]:
    """The line that unpacks them."""
    names = [*constants_taken(kernel), *(("low", "high") if kernel.plain else ())]
    source = f"c.plain.of_{kernel.name}" if kernel.plain else f"c.of_{kernel.name}"
    if not names:
        return []
    left = ", ".join(names) if len(names) > 1 else f"({names[0]},)"
    line = f"{INDENT}{left} = {source}"
    if len(line) <= WIDTH:
        return [line]
    return [f"{INDENT}(", *filled(names, INDENT * 2), f"{INDENT}) = {source}"]


def _guards(kernel: Kernel) -> dict[str, list[str]]:
    """Where arrays take over: past the limit, and where squares lose digits but at rest.

    The square is a float if every input is a number of Python.
    """
    inputs = tuple("stretch" if name == "v3" else name for name in kernel.inputs)
    plain = kernel.plain.region if kernel.plain else None
    if kernel.gauge or plain:
        square = plain.quantity if plain else kernel.gauge.square if kernel.gauge else ""
        moved = f"any(({', '.join(inputs)}))" if len(inputs) > 1 else f"{inputs[0]} != 0"
        low, high = ("low", "high") if plain else ("LOW", "HIGH")
        out = f"not {low} < {square} < {'1' if kernel.limit else high}"
        off = f"({square} or low > high or {moved})" if plain else moved
        lines = _left(f"type({square}) is not float", f"({out} and {off})")
        lines += [f"{INDENT}{square} = {square} or NOUGHT"] if _floored(kernel) else []
        return {square: lines}
    limits = (kernel.limit,) if kernel.limit else ()
    return {
        q.quantity: _left(f"type({q.quantity}) is not float", f"not {q.quantity} < 1")
        for q in limits
    }


def _floored(kernel: Kernel) -> bool:
    """Whether the plain kernel takes the logarithm of its quantity, or divides by it."""
    region = kernel.plain.region if kernel.plain else None
    if kernel.plain is None or region is None:
        return False
    quantity = symbol(region.quantity)
    return any(e.has(1 / quantity) or e.has(expm1) for e in kernel.plain.expressions())


def _left(*tests: str) -> list[str]:
    """Lines that leave the point to arrays where one of the tests holds."""
    line = f"{INDENT}if {' or '.join(tests)}:"
    if len(line) > WIDTH:
        first, last = tests
        line = f"{INDENT}if {first} or (\n{INDENT * 2}{last[1:-1]}\n{INDENT}):"
    return [line, f"{INDENT * 2}raise _Extreme"]


def opening(kernel: Kernel, text: FunctionText, kind: str) -> list[str]:
    """The lines of a public function that see to one point."""
    tuples = [f"type({name})" for name, head in text.inputs.items() if head]
    numbers = [f"type({name})" for name, head in text.inputs.items() if not head]
    kinds = ((tuples, "tuple"), (numbers, "float"))
    tests = [" is ".join([*some, what]) for some, what in kinds if some]
    inputs = "{" + ", ".join(f'"{name}": {name}' for name in text.inputs) + "}"
    lines = [f"{INDENT}if out is None and {' and '.join(tests)}:"]
    one = f"_one({kernel.name}, {inputs}, constants)"
    own = f"_{kernel.name}_at({', '.join(text.inputs)}, constants)"
    return [
        *lines,
        f"{INDENT * 2}try:",
        f"{INDENT * 3}answer: {kind} = {own}",
        f"{INDENT * 2}except (ArithmeticError, TypeError, ValueError):",
        f"{INDENT * 3}answer = {one}",
        f"{INDENT * 2}return answer",
    ]
