"""Prints the plain kernels of a numba module: a function of one point, and what it takes.

A loop does a block of points by the plain function first. Where the region does not hold one of
them it does the block again.
"""

from __future__ import annotations

from collections.abc import Sequence

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.targets import scalar
from rodproof.codegen.targets.lines import INDENT, filled, wrapped
from rodproof.codegen.targets.numba_template import NUMBERS, ORDINARY
from rodproof.codegen.targets.numpy_plain import plain_kernels


def ordinary(kernels: tuple[Kernel, ...]) -> list[str]:
    """The tuple of what the plain functions take; nothing without any."""
    names = [*_constants(kernels), *_bounds(kernels)]
    fields = "\n".join(f"{INDENT}{name}: float" for name in names)
    return [ORDINARY.substitute(fields=fields)] if names else []


def numbers(kernels: tuple[Kernel, ...]) -> str:
    """The property of the record with all that a loop takes."""
    own = [f"k.{name}" for name in _constants(kernels)]
    own += [f"*k.within_{quantity}[DOUBLE]" for quantity in _quantities(kernels)]
    lines = [f"{INDENT * 2}k = self.plain"] if own else []
    held = filled(["*self.values", *own], INDENT * 3)
    lines += [f"{INDENT * 2}return (", *held, f"{INDENT * 2})"]
    return NUMBERS.substitute(lines="\n".join(lines))


def taken(kernels: tuple[Kernel, ...], kernel: Kernel, values: int) -> str:
    """The statement that names a loop's numbers, the first of which are ``values``."""
    if not plain_kernels(kernels):
        return "c = Values(*numbers)"
    c = f"c = Values(*numbers[:{values}])"
    return f"{c}\n{INDENT}k = Ordinary(*numbers[{values}:])" if kernel.plain else c


def function(kernel: Kernel, known: Sequence[str], *, packed: bool) -> list[str]:
    """The plain function of one point; nothing without a plain kernel."""
    plain = scalar.formless(kernel.plain) if kernel.plain else None
    if plain is None:
        return []
    spelling = {name: f"c.{name}" for name in known}
    spelling |= {a.name: f"k.{a.name}" for a in plain.constants}
    body = scalar.body(plain, scalar.NUMBA, spelling, {}, packed=packed)
    arguments = ", ".join(f"{name}: float" for name in plain.inputs)
    lines = [
        "@at_point",
        *wrapped(
            f"def _{plain.name}_plain(",
            [arguments, "c: Values, k: Ordinary"],
            ") -> Any:",
            ", ",
            "",
        ),
        f'{INDENT}"""`_{plain.name}` where nothing is extreme."""',
        *body.lines,
        *scalar.returned(body.answer, _quantity(plain)),
    ]
    return ["\n".join(lines)]


def first(kernel: Kernel, reads: list[str], stores: list[str]) -> list[str]:
    """The lines of a loop that do a block by the plain function."""
    if kernel.plain is None:
        return []
    quantity = _quantity(kernel.plain)
    point = [
        *reads,
        f"values, {quantity} = _{kernel.name}_plain({', '.join(kernel.inputs)}, c, k)",
        *stores,
        f"fine &= ({quantity} > k.least_{quantity}) & ({quantity} < k.most_{quantity})",
    ]
    return [
        "fine = True",
        "for i in range(begin, end):",
        *(INDENT + line for line in point),
        "if fine:",
        f"{INDENT}continue",
    ]


def _constants(kernels: tuple[Kernel, ...]) -> list[str]:
    return list(dict.fromkeys(a.name for k in plain_kernels(kernels) for a in k.constants))


def _quantities(kernels: tuple[Kernel, ...]) -> list[str]:
    return list(dict.fromkeys(_quantity(plain) for plain in plain_kernels(kernels)))


def _quantity(plain: Kernel) -> str:
    """What must stay in the region."""
    assert plain.region is not None
    return plain.region.quantity


def _bounds(kernels: tuple[Kernel, ...]) -> list[str]:
    return [f"{end}_{q}" for q in _quantities(kernels) for end in ("least", "most")]
