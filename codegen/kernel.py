"""Kernels: what a public function computes, as straight-line mathematics.

A kernel is a list of named assignments in exact real arithmetic, each a SymPy expression in the
inputs, the constants and the names before it. Targets print it (`numpy_target`) or evaluate it at
any precision (`mpmath_target`); passes turn one kernel into another.

Not supported, on purpose: loops, branches other than a ``Piecewise`` value, calls between kernels,
reassignment, arrays, types, storage and blocks. Whoever needs one of these puts it into a target.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import sympy as sp

from rodproof.derivations.symbols import CONSTANTS

#: Properties of the number format, filled in by the target: the smallest normal number, and a
#: number whose exponential is near the largest one. In exact arithmetic they are 0 and infinity.
tiny = sp.Symbol("tiny", positive=True)
log_max = sp.Symbol("log_max", positive=True)
#: tiny^(-1/4): products of three or four such numbers, and their inverses, are in range.
span = sp.Symbol("span", positive=True)
SPAN_POWER = 0.25


class KernelError(ValueError):
    """A kernel breaks a rule of its type; the message names the kernel and the assignment."""


@dataclass(frozen=True)
class Assignment:
    """``name = expr``, the statements it rests on and the step of the function it belongs to.

    Assignments with the same non-empty ``step`` stand together; kernels that share a step hold
    the same assignments there, so a target may print the step once.
    """

    name: str
    expr: sp.Expr
    statements: tuple[str, ...] = ()
    step: str = ""

    @property
    def symbol(self) -> sp.Symbol:
        return symbol(self.name)


@dataclass(frozen=True)
class Gauge:
    """Freedom of scale: ``step`` may be evaluated with its ``inputs`` times any scale > 0.

    The step ends in ``square``, homogeneous of degree two in the inputs. After the step ``norm``
    is its square root, ``unscale`` is one over the scale, ``radius`` is ``norm*unscale`` and
    ``square`` is ``radius^2``; what follows is exact for any scale. A target uses the scale one,
    and another, a power of two, where squares would overflow or underflow. What the inputs made
    is brought back by ``unscale``: it loses nothing where the radius is subnormal and rounds.
    """

    step: str
    inputs: tuple[str, ...]
    square: str
    norm: str
    radius: str
    unscale: str = "unscale"


@dataclass(frozen=True)
class Region:
    """Where a plain kernel holds: ``low < quantity < high``, a name of the kernel.

    The bounds are in p and `span`. Besides, every constant of the kernel must be
    nought or lie between 1/span and span in magnitude: then no square leaves the range of numbers
    without the quantity leaving the region.
    """

    quantity: str
    low: sp.Expr
    high: sp.Expr


@dataclass(frozen=True)
class Limit:
    """The kernel is defined where ``quantity < 1``; ``quantity`` is a name of the kernel."""

    quantity: str
    sentence: str


@dataclass(frozen=True)
class Dyad:
    """A hint: entry (i, j) of ``array`` is ``weight*vector[i]*vector[j]``, alone or plus a term.

    Entries may also be free of it. The outputs say everything; a target may use the hint to
    compute a row at a time.
    """

    array: str
    weight: str
    vector: tuple[str, ...]

    def term(self, i: int, j: int) -> sp.Expr:
        return symbol(self.weight) * symbol(self.vector[i]) * symbol(self.vector[j])


@dataclass(frozen=True)
class Form:
    """A hint: ``quantity`` is the quadratic form of the inputs, ``vector`` the linear rod's answer.

    The one is a sum of products of the inputs and the other, for the most; a target may work on
    several rows of them at a time.
    """

    quantity: str
    vector: tuple[str, ...]


@dataclass(frozen=True)
class Output:
    """Entry ``index`` of the output array ``array``; an empty index is the whole array."""

    array: str
    index: tuple[int, ...]
    expr: sp.Expr
    statements: tuple[str, ...] = ()


@dataclass(frozen=True)
class Kernel:
    """One public function: inputs, assignments in order, outputs, gauge, limit, dyad, form.

    ``constants`` are assignments in the constants alone, evaluated once per set of constants.
    ``dropped`` names the guards that the scene's ranges made needless. ``plain`` is the same
    function in fewer operations and without guards, for points where nothing is extreme; it says
    itself in which ``region``. A target may leave it aside.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Assignment, ...]
    outputs: tuple[Output, ...]
    gauge: Gauge | None = None
    limit: Limit | None = None
    constants: tuple[Assignment, ...] = ()
    dyad: Dyad | None = None
    form: Form | None = None
    dropped: tuple[str, ...] = ()
    region: Region | None = None
    plain: Kernel | None = None

    def expressions(self) -> Iterator[sp.Expr]:
        """Every expression evaluated per point."""
        yield from (a.expr for a in self.body)
        yield from (o.expr for o in self.outputs)

    def rewrite(self, changed: dict[sp.Expr, sp.Expr]) -> Kernel:
        """The kernel with every expression's subexpressions replaced as ``changed`` says."""
        return replace(
            self,
            body=tuple(replace(a, expr=a.expr.xreplace(changed)) for a in self.body),
            outputs=tuple(replace(o, expr=o.expr.xreplace(changed)) for o in self.outputs),
        )

    def down_to(self, name: str) -> tuple[Assignment, ...]:
        """The assignments that the name needs, its own the last, in order."""
        wanted, body = {name}, list[Assignment]()
        for a in reversed(self.body):
            if a.name in wanted:
                body.insert(0, a)
                wanted |= {s.name for s in a.expr.free_symbols}
        return tuple(body)

    def vectors(self) -> frozenset[str]:
        """The names in vectors of hints: passes leave them as they are."""
        hints = (self.dyad, self.form)
        return frozenset(name for hint in hints if hint for name in hint.vector)

    def sizes(self) -> tuple[str, ...]:
        """The constants, given and derived, whose sizes count for a `Region`: all but p."""
        raw = {s.name for expr in self.expressions() for s in expr.free_symbols}
        given = (c.name for c in CONSTANTS if c.name in raw and c.name != "p")
        return (*given, *(a.name for a in self.constants))

    def statements(self) -> tuple[str, ...]:
        """The statements the kernel rests on, each once, in order of use."""
        every = [a.statements for a in self.body] + [o.statements for o in self.outputs]
        return tuple(dict.fromkeys(s for statements in every for s in statements))


def symbol(name: str) -> sp.Symbol:
    """The symbol of a temporary; targets and `validate` tell symbols apart by name alone."""
    return sp.Symbol(name, real=True)


def validate(kernel: Kernel, known: frozenset[str]) -> None:
    """Raises `KernelError` unless every name is set once, before use; ``known`` are constants."""
    defined = set(kernel.inputs) | known | {tiny.name, log_max.name}
    if kernel.plain is not None:
        validate(kernel.plain, known)

    def check(where: str, expr: sp.Expr) -> None:
        missing = sorted({s.name for s in expr.free_symbols} - defined)
        if missing:
            raise KernelError(f"kernel {kernel.name}: {where} uses {missing[0]!r} before it is set")

    for a in (*kernel.constants, *kernel.body):
        check(a.name, a.expr)
        if a.name in defined:
            raise KernelError(f"kernel {kernel.name}: {a.name!r} is set twice")
        defined.add(a.name)
        if kernel.gauge is not None and a.name == kernel.gauge.square:
            defined |= {kernel.gauge.norm, kernel.gauge.radius, kernel.gauge.unscale}
    if kernel.region is not None:
        defined.add(span.name)
        check("region", kernel.region.low + kernel.region.high + symbol(kernel.region.quantity))
    if kernel.form is not None:
        check("form", sp.Add(*map(symbol, (kernel.form.quantity, *kernel.form.vector))))
    for o in kernel.outputs:
        check(f"output {o.array}{list(o.index)}", o.expr)
