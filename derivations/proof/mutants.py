"""Broken twins of a transcription: each differs from it in one small way.

Signs, terms, factors, coefficients, exponents (p against 1/p among them), swapped symbols,
indices, sines and cosines, dropped derivatives, derivative variables, limits of integrals,
directions of inequalities. A check must reject every mutant or prove that it says the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp

from rodproof.derivations.notation import GREEK, Chain, LimitOf, Partial, Prime
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory.frames import phi, psi, theta

#: A symbol is swapped for the one that a tired author or typesetter would write in its place.
_SIBLINGS = {
    alpha: (beta, eta),
    beta: (eta, alpha),
    eta: (zeta, beta),
    zeta: (eta, alpha),
    gamma: (alpha, eta),
    iota: (beta,),
    phi: (theta,),
    theta: (psi,),
    psi: (phi,),
}
_BASES = {"u": "v", "v": "n", "m": "n", "n": "v"}
_FLIPPED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


@dataclass(frozen=True)
class Mutant:
    """A broken twin, and what was done to it."""

    change: str
    tree: sp.Basic


def mutants(tree: sp.Basic) -> tuple[Mutant, ...]:
    """All broken twins of a transcription, without repetition, in the order of the tree."""
    found: dict[sp.Basic, str] = {}
    for change, mutant in _mutate(tree):
        if mutant != tree and mutant not in found:
            found[mutant] = change
    return tuple(Mutant(change, mutant) for mutant, change in found.items())


def _mutate(node: sp.Basic) -> Iterator[tuple[str, sp.Basic]]:
    yield from _here(node)
    if isinstance(node, sp.Indexed | sp.IndexedBase | sp.Symbol):
        return
    for position, child in enumerate(node.args):
        if _skipped(node, position):
            continue
        for change, mutant in _mutate(child):
            args = (*node.args[:position], mutant, *node.args[position + 1 :])
            try:
                yield change, node.func(*args)
            except (ValueError, TypeError):
                continue  # the notation itself refuses this twin


def _skipped(node: sp.Basic, position: int) -> bool:
    if isinstance(node, LimitOf) and position > 0:
        return True
    relations = isinstance(node, Chain) and position == 1
    variable = isinstance(node, sp.Tuple) and len(node) == 3 and node[0].is_Symbol
    return relations or (variable and position == 0 and not isinstance(node[0], sp.Indexed))


def _here(node: sp.Basic) -> Iterator[tuple[str, sp.Basic]]:
    if isinstance(node, Chain):
        yield from _relations(node)
    elif isinstance(node, sp.Add):
        for term in node.args:
            rest = sp.Add(*(a for a in node.args if a != term))
            yield f"term {term} dropped", rest
            yield f"sign of {term} changed", rest - term
    elif isinstance(node, sp.Mul):
        for factor in node.args:
            yield f"factor {factor} dropped", sp.Mul(*(a for a in node.args if a != factor))
    elif isinstance(node, sp.Pow):
        yield from _exponents(node)
    elif isinstance(node, sp.Indexed):
        yield from _indices(node)
    elif isinstance(node, Partial):
        function, variable = node.args
        if isinstance(variable, sp.Indexed):
            for change, other in _indices(variable):
                yield f"differentiated by {other} ({change})", Partial(function, other)
    elif isinstance(node, sp.Symbol) and node in _SIBLINGS:
        for sibling in _SIBLINGS[node]:
            yield f"{node} replaced by {sibling}", sibling
    elif isinstance(node, sp.sin | sp.cos):
        other = sp.cos if isinstance(node, sp.sin) else sp.sin
        yield f"{node} replaced by {other.__name__}", other(node.args[0])
    elif isinstance(node, Prime):
        yield f"derivative of {node.args[0]} dropped", node.args[0]
    elif isinstance(node, LimitOf):
        function, variable, target = node.args
        other = -target if target in (sp.oo, -sp.oo) else sp.oo
        yield f"limit at {other} in place of {target}", LimitOf(function, variable, other)
    elif isinstance(node, sp.Integral):
        integrand, (variable, lower, upper) = node.args
        yield "lower limit raised by 1", sp.Integral(integrand, (variable, lower + 1, upper))
        yield "upper limit doubled", sp.Integral(integrand, (variable, lower, 2 * upper))
        yield "integral halved", node / 2


def _relations(node: Chain) -> Iterator[tuple[str, sp.Basic]]:
    sides, relations = node.sides, node.relations
    for i, relation in enumerate(relations):
        if relation in _FLIPPED:
            other = (*relations[:i], _FLIPPED[relation], *relations[i + 1 :])
            marks = sp.Tuple(*(sp.Symbol(r) for r in other))
            yield f"{relation} turned round", Chain(sp.Tuple(*sides), marks)
    for i, side in enumerate(sides):
        if side.is_number:
            continue
        twins = ((f"{side} with the sign changed", -side), (f"{side} doubled", 2 * side))
        for change, other in twins:
            yield change, Chain(sp.Tuple(*sides[:i], other, *sides[i + 1 :]), node.args[1])


def _exponents(node: sp.Pow) -> Iterator[tuple[str, sp.Basic]]:
    base, exponent = node.as_base_exp() if not node.base.is_Rational else node.args
    yield f"exponent of {base} negated", base**-exponent
    yield f"exponent of {base} raised by 1", base ** (exponent + 1)
    if exponent.has(p):
        yield f"p turned into 1/p in the exponent of {base}", base ** exponent.subs(p, 1 / p)
        yield f"exponent of {base} doubled", base ** (2 * exponent)


def _indices(node: sp.Indexed) -> Iterator[tuple[str, sp.Basic]]:
    index = node.indices[0]
    others: tuple[sp.Basic, ...]
    if index in GREEK:
        others = (sp.Integer(3), *(g for g in GREEK if g != index))
    else:
        others = (sp.Integer(1 if index == 3 else 3), sp.Integer(2 if index != 2 else 1))
    for other in others:
        yield f"{node} replaced by {node.base[other]}", node.base[other]
    name = str(node.base.label)
    if name in _BASES:
        base = sp.IndexedBase(_BASES[name], real=True)
        yield f"{node} replaced by {base[index]}", base[index]
