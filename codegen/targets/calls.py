"""Takes expressions apart into calls of NumPy's functions, one operation each.

A call writes into a slot: a name, an output, or a temporary of the expression. The first call of a
slot opens it, the later ones work on it in place. `rodproof.codegen.targets.rows` gives the slots
their rows and prints the calls.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import sympy as sp

from rodproof.codegen.targets.printer import FUNCTIONS, Printer


@dataclass(frozen=True)
class Call:
    """``function(*operands)`` into the slot ``to``; an empty function takes the operand over.

    Operands are slots or text; ``reads`` are the slots among them.
    """

    to: str
    function: str
    operands: tuple[str, ...]
    reads: frozenset[str]


def calls(to: str, expr: sp.Expr, printer: Printer) -> tuple[Call, ...]:
    """The calls that leave the value of the expression in ``to``."""
    tape = _Tape(printer, to)
    tape.into(to, expr)
    return tuple(tape.calls)


@dataclass
class _Tape:
    printer: Printer
    name: str
    calls: list[Call] = field(default_factory=list)
    reads: dict[str, frozenset[str]] = field(default_factory=dict)
    temporaries: int = 0

    def into(self, to: str, expr: sp.Expr) -> None:
        """Calls that leave the value in the slot."""
        if self.plain(expr):
            self.call(to, "", expr)
        elif expr.is_Add:
            self.sum(to, expr)
        elif expr.is_Mul:
            self.product(to, expr)
        elif isinstance(expr, sp.Pow):
            self.power(to, *expr.args)
        elif type(expr) in FUNCTIONS:
            args = sorted(expr.args, key=lambda a: (self.printer.scalar(a), self.plain(a)))
            self.call(to, FUNCTIONS[type(expr)], *args)
        else:
            raise TypeError(f"no NumPy function for {type(expr).__name__}: {expr}")

    def plain(self, expr: sp.Expr) -> bool:
        """Whether its text is an operand: a name or a number."""
        return expr.is_Symbol or self.printer.scalar(expr)

    def call(self, to: str, function: str, *args: sp.Expr | str) -> None:
        """One call; its first compound operand is made in the slot of the result."""
        made = next((a for a in args if isinstance(a, sp.Expr) and not self.plain(a)), None)
        if made is not None:
            self.into(to, made)
        operands = tuple(to if a is made else self.operand(a) for a in args)
        reads = frozenset().union(*(self.reads.get(o, frozenset()) for o in operands))
        reads |= {to} & set(operands)
        self.calls.append(Call(to, function, operands, reads))

    def operand(self, expr: sp.Expr | str) -> str:
        """A slot or text; a compound operand is made in a temporary."""
        if isinstance(expr, str):
            return expr
        if self.plain(expr):
            text = self.printer.text(expr)
            arrays = {s.name for s in expr.free_symbols if not self.printer.scalar(s)}
            self.reads[text] = frozenset(arrays)
            return text
        self.temporaries += 1
        slot = f"{self.name}.{self.temporaries}"
        self.reads[slot] = frozenset({slot})
        self.into(slot, expr)
        return slot

    def power(self, to: str, base: sp.Expr, exponent: sp.Expr) -> None:
        if exponent == 2:
            self.call(to, "np.square", base)
        elif exponent == sp.Rational(1, 2):
            self.call(to, "np.sqrt", base)
        elif exponent.is_negative:
            self.call(to, "np.divide", sp.S.One, base ** (-exponent))
        else:
            raise TypeError(f"no NumPy function for the power {base}**{exponent}; use exp and log")

    def product(self, to: str, expr: sp.Expr) -> None:
        """The first factor in the slot, times a scalar, times and over the others."""
        scalar, above, below = self.factors(expr)
        first = above.pop(0) if above else None
        if first is None:
            self.call(to, "np.divide", scalar, below.pop(0))
        elif scalar != 1:
            self.scale(to, scalar, first)
        elif above:
            self.call(to, "np.multiply", first, above.pop(0))
        else:
            self.call(to, "np.divide", first, below.pop(0))
        for factor in above:
            self.call(to, "np.multiply", to, self.operand(factor))
        for factor in below:
            self.call(to, "np.divide", to, self.operand(factor))

    def factors(self, expr: sp.Expr) -> tuple[sp.Expr, list[sp.Expr], list[sp.Expr]]:
        """The scalar factor, and the arrays above (compound first) and below."""
        above, below = self.printer.factors(expr)
        scalar = self.printer.scalar
        number = sp.Mul(*(f for f in above if scalar(f)), *(1 / f for f in below if scalar(f)))
        arrays = [f for f in above if not scalar(f)]
        arrays.sort(key=self.plain)
        return number, arrays, [f for f in below if not scalar(f)]

    def scale(self, to: str, scalar: sp.Expr, factor: sp.Expr) -> None:
        """Times a scalar."""
        if scalar == -1:
            self.call(to, "np.negative", factor)
        elif self.plain(factor):
            self.call(to, "np.multiply", scalar, factor)
        else:
            self.call(to, "np.multiply", factor, scalar)

    def sum(self, to: str, expr: sp.Expr) -> None:
        """The first compound term in the slot; then the others, numbers last."""
        signed = [(t, bool(t.as_coeff_Mul()[0].is_negative)) for t in expr.as_ordered_terms()]
        terms = [(-t if minus else t, minus) for t, minus in signed]
        terms.sort(key=lambda t: (t[1], self.printer.scalar(t[0])))
        (first, minus), *rest = terms
        if minus:
            raise TypeError(f"no NumPy function for the sum {expr} of negative terms")
        if self.plain(first):
            (second, minus), *rest = rest
            self.call(to, "np.subtract" if minus else "np.add", first, second)
        else:
            self.into(to, first)
        for term, minus in rest:
            self.call(to, "np.subtract" if minus else "np.add", to, self.operand(term))
