"""The notation in which the paper's statements are transcribed, symbol by symbol.

Strains and loads are indexed (`u[1]`, `v[3]`, `m[mu]`), Greek indices range over {1, 2}, Latin
ones over {1, 2, 3}, and stand for every value; energies and forms are applied functions
(`Q(u, v)`), and relations may be chained. Nothing here knows what is true; `proof` gives the
notation its meaning.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import sympy as sp

u, v, m, n = (sp.IndexedBase(name, real=True) for name in "uvmn")
mu, nu = sp.symbols("mu nu", cls=sp.Idx)
GREEK = (mu, nu)
k = sp.symbols("k", cls=sp.Idx)
#: The values that a free or summed index takes: Greek ones 1 and 2, Latin ones 1, 2 and 3.
RANGES = {mu: (1, 2), nu: (1, 2), k: (1, 2, 3)}
t = sp.Symbol("t", positive=True)


class Q(sp.Function):
    """The quadratic form of the strains, `Q(u, v)`."""

    nargs = 2


class Qstar(sp.Function):
    """The dual quadratic form of the loads, `Qstar(m, n)`."""

    nargs = 2

    def _latex(self, printer: object, exp: str | None = None) -> str:
        return _applied(printer, "Q^*", self.args, exp)


class W(sp.Function):
    """The stored energy, `W(u, v)`."""

    nargs = 2


class Wstar(sp.Function):
    """The complementary energy, `Wstar(m, n)`."""

    nargs = 2

    def _latex(self, printer: object, exp: str | None = None) -> str:
        return _applied(printer, "W^*", self.args, exp)


class FormQ(sp.Function):
    """Q as a form, with no component shifted: `FormQ(a, b)` is Q(a, b + (0, 0, 1))."""

    nargs = 2

    def _latex(self, printer: object, exp: str | None = None) -> str:
        a, b = (printer._print(x) for x in self.args)  # type: ignore[attr-defined]
        whole = rf"Q({a}, {b} + (0, 0, 1)^T)"
        return whole if exp is None else rf"{whole}^{{{exp}}}"


class HessianForm(sp.Function):
    """The quadratic form of D^2 W(u, v) at (a, b): `HessianForm(u, v, a, b)`."""

    nargs = 4

    def _latex(self, printer: object, exp: str | None = None) -> str:
        u, v, a, b = (printer._print(x) for x in self.args)  # type: ignore[attr-defined]
        column = rf"\begin{{bmatrix}} {a} \\ {b} \end{{bmatrix}}"
        whole = rf"{column} \cdot D^2 W({u}, {v}) {column}"
        return whole if exp is None else rf"\left({whole}\right)^{{{exp}}}"


class Prime(sp.Function):
    """The derivative along the rod, `Prime(theta)`; printed as theta'."""

    nargs = 1

    def _latex(self, printer: object, exp: str | None = None) -> str:
        inner = printer._print(self.args[0])  # type: ignore[attr-defined]
        plain = isinstance(self.args[0], sp.Symbol | sp.Indexed)
        marked = f"{inner}'" if plain else rf"\left({inner}\right)'"
        return marked if exp is None else rf"\left({marked}\right)^{{{exp}}}"


class Cross(sp.Function):
    """The vector product of two vectors, `Cross(e[2], e[3])`."""

    nargs = 2

    def _latex(self, printer: object, exp: str | None = None) -> str:
        return r" \times ".join(_factor(printer, a) for a in self.args)


class Dot(sp.Function):
    """The inner product of two vectors, `Dot(d[3], g[3])`."""

    nargs = 2

    def _latex(self, printer: object, exp: str | None = None) -> str:
        inner = r" \cdot ".join(_factor(printer, a) for a in self.args)
        return inner if exp is None else rf"({inner})^{{{exp}}}"


class Partial(sp.Expr):
    """A partial derivative as printed, `Partial(W(u, v), u[1])`; never evaluated on its own."""

    def _latex(self, printer: object) -> str:
        function, variable = (printer._print(a) for a in self.args)  # type: ignore[attr-defined]
        return rf"\frac{{\partial {function}}}{{\partial {variable}}}"


class Summed(sp.Expr):
    """The summation convention over an index, `Summed(a[mu]*u[mu], mu)`."""

    def _latex(self, printer: object) -> str:
        return str(printer._print(self.args[0]))  # type: ignore[attr-defined]


class LimitOf(sp.Expr):
    """A limit as printed, `LimitOf(f, N, oo)`; the target may be -oo or a number."""

    def _latex(self, printer: object) -> str:
        x, a = (printer._print(arg) for arg in self.args[1:])  # type: ignore[attr-defined]
        return rf"\lim_{{{x} \to {a}}} {_factor(printer, self.args[0])}"


def _factor(printer: object, arg: sp.Basic) -> str:
    text = str(printer._print(arg))  # type: ignore[attr-defined]
    return rf"\left({text}\right)" if isinstance(arg, sp.Add | Cross) else text


def _applied(printer: object, name: str, args: tuple[sp.Basic, ...], exp: str | None) -> str:
    inside = ", ".join(printer._print(a) for a in args)  # type: ignore[attr-defined]
    whole = rf"{name}({inside})"
    return whole if exp is None else rf"{whole}^{{{exp}}}"


class Chain(sp.Basic):
    """`a = b < c ...`: sides, and the relations between neighbours as symbols."""

    @property
    def sides(self) -> tuple[sp.Expr, ...]:
        return tuple(self.args[0])

    @property
    def relations(self) -> tuple[str, ...]:
        return tuple(str(r) for r in self.args[1])

    def links(self) -> Iterator[tuple[sp.Expr, str, sp.Expr]]:
        """Neighbouring sides with the relation between them."""
        yield from zip(self.sides, self.relations, self.sides[1:], strict=False)

    def _latex(self, printer: object) -> str:
        marks = {"=": "=", "<": "<", "<=": r"\leq", ">": ">", ">=": r"\geq"}
        text = printer._print(self.sides[0])  # type: ignore[attr-defined]
        for _, relation, right in self.links():
            text += f" {marks[relation]} {printer._print(right)}"  # type: ignore[attr-defined]
        return str(text)


class Every(sp.Basic):
    """All of the statements."""

    def _latex(self, printer: object) -> str:
        return r",\quad ".join(printer._print(a) for a in self.args)  # type: ignore[attr-defined]


class Implies(sp.Basic):
    """If the first statement, then the second."""

    def _latex(self, printer: object) -> str:
        a, b = (printer._print(x) for x in self.args)  # type: ignore[attr-defined]
        return rf"{a} \implies {b}"


class Either(sp.Basic):
    """At least one of the statements."""

    def _latex(self, printer: object) -> str:
        return r" \text{ or } ".join(printer._print(a) for a in self.args)  # type: ignore[attr-defined]


class Iff(sp.Basic):
    """The statements are equivalent."""

    def _latex(self, printer: object) -> str:
        return r" \iff ".join(printer._print(a) for a in self.args)  # type: ignore[attr-defined]


class ForAll(sp.Basic):
    """For all variables of a domain the claim holds, `ForAll(domain, claim)`.

    The domain is a relation between the variables, or a tuple of variables without one.
    """

    def _latex(self, printer: object) -> str:
        domain, claim = (printer._print(a) for a in self.args)  # type: ignore[attr-defined]
        return rf"{claim} \quad \text{{for all }} {domain}"


class PositiveDefinite(sp.Basic):
    """The quadratic form is positive definite in the variables, `PositiveDefinite(Q, (u, v))`."""

    def _latex(self, printer: object) -> str:
        form = printer._print(self.args[0])  # type: ignore[attr-defined]
        return rf"{form} \text{{ is positive definite}}"


def equal(*sides: object) -> Chain:
    """`a = b = ...`"""
    return chain(*itertools.chain.from_iterable((s, "=") for s in sides), last="=")


def chain(*parts: object, last: str = "") -> Chain:
    """`chain(a, "<", b, "=", c)`; a trailing relation `last` is dropped."""
    if last:
        parts = parts[:-1]
    sides = sp.Tuple(*(sp.sympify(side) for side in parts[0::2]))
    return Chain(sides, sp.Tuple(*(sp.Symbol(str(r)) for r in parts[1::2])))


def positive(expr: sp.Expr) -> Chain:
    """`expr > 0`"""
    return chain(expr, ">", 0)


def component(indexed: sp.Indexed) -> sp.Basic:
    """`u[3]` as the plain symbol `u3`, once its index is a number."""
    return sp.Symbol(f"{indexed.base.label}{''.join(map(str, indexed.indices))}", real=True)


def instances(tree: sp.Basic) -> tuple[sp.Basic, ...]:
    """The statement for every value of its free indices, in component symbols."""
    tree = _expand_sums(tree)
    free = [i for i in RANGES if tree.has(i)]
    found = []
    for values in itertools.product(*(RANGES[i] for i in free)):
        concrete = tree.xreplace(dict(zip(free, map(sp.Integer, values), strict=True)))
        found.append(_plain(concrete))
    return tuple(found)


def _expand_sums(tree: sp.Basic) -> sp.Basic:
    sums = tree.atoms(Summed)
    if not sums:
        return tree
    return tree.xreplace(
        {
            s: sp.Add(*(s.args[0].xreplace({s.args[1]: sp.Integer(i)}) for i in RANGES[s.args[1]]))
            for s in sums
        }
    )


def _plain(tree: sp.Basic) -> sp.Basic:
    deltas = {d: d.doit() for d in tree.atoms(sp.KroneckerDelta)}
    tree = tree.xreplace(deltas)
    return tree.xreplace({i: component(i) for i in tree.atoms(sp.Indexed)})
