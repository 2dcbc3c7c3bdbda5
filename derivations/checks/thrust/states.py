"""The checks of Section 4.2 for claims about all states."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.checks.equilibrium import (
    balance_residual,
    curve,
    frame,
)  # fmt: skip
from rodproof.derivations.checks.thrust import domains, points
from rodproof.derivations.exact.evaluate import context, number
from rodproof.derivations.notation import Chain, Every, Implies, instances
from rodproof.derivations.proof.meaning import Meaning, Point
from rodproof.derivations.proof.prover import (
    DIGITS,
    Identity,
    claims,
)
from rodproof.derivations.records import Check, Confirmation, Decision
from rodproof.derivations.symbols import u3, v1, v2, v3
from rodproof.derivations.theory.frames import euler_frame, phi, theta
from rodproof.derivations.theory.thrust import N, s

REJECTED = Decision(False, False, "rejected")


def all_of(checks: Iterable[Check], printed: sp.Basic, explain: bool) -> Decision:
    """The first failure, or a proof from every check."""
    methods: list[str] = []
    for check in checks:
        found = check.decide(printed, explain=explain)
        if not (found.holds and found.exact):
            return found
        methods.append(found.method)
    return Decision(True, True, "; ".join(dict.fromkeys(methods)))


def _named(printed: sp.Basic) -> set[sp.Basic]:
    return set().union(*(tree.free_symbols for tree in instances(printed)))


# -- claims about states ----------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class InAllStates:
    """The claim holds in every one of the states.

    `Implies(Ne(N, 0), claim)` leaves out the states without load, and `Implies(f > 0, claim)`
    those where the quantity `orientation` is not positive, if that is what f is. named: symbols
    that the claim has to mention (else u_2 = u_2 = 0 would pass for u_1 = u_2 = 0).
    """

    states: tuple[Meaning, ...]
    orientation: sp.Expr | None = None
    named: frozenset[sp.Symbol] = frozenset()

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not self.named <= _named(printed):
            return REJECTED
        narrowed = self._narrowed(printed)
        if narrowed is None:
            return REJECTED
        states, claim = narrowed
        return all_of((Identity(state) for state in states), claim, explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        narrowed = self._narrowed(printed)
        assert narrowed is not None
        states, claim = narrowed
        found = [Identity(state).confirm(claim) for state in states]
        return worst_of([f for f in found if f is not None])

    def _narrowed(self, printed: sp.Basic) -> tuple[tuple[Meaning, ...], sp.Basic] | None:
        if not isinstance(printed, Implies):
            return self.states, printed
        hypothesis, claim = printed.args
        if hypothesis == sp.Ne(N, 0):
            return tuple(m for m in self.states if m.interpret(N) != 0), claim
        if self.orientation is None or not isinstance(hypothesis, Chain):
            return None
        if hypothesis.relations != (">",):
            return None
        greater, smaller = hypothesis.sides
        ratio = sp.cancel(instances(greater - smaller)[0] / self.orientation)
        if not (ratio.is_number and ratio > 0):
            return None
        return tuple(narrowed_to(m, self.orientation) for m in self.states), claim


@cache
def narrowed_to(meaning: Meaning, quantity: sp.Expr) -> Meaning:
    """The part of a domain where a quantity is positive."""
    fact = meaning.interpret(quantity)

    def positive(point: Point) -> bool:
        return bool(meaning.evaluator(context(30), point)(quantity) > 0)

    found = tuple(filter(positive, map(meaning.sample, range(9))))

    def sample(seed: int) -> Point:
        return found[seed % len(found)]

    return Meaning(
        name=f"{meaning.name}, {quantity} > 0", free=meaning.free, sample=sample,
        simple=lambda: tuple(filter(positive, meaning.simple())), components=meaning.components,
        functions=meaning.functions, positive=(*meaning.positive, fact),
        route=meaning.route, route_name=meaning.route_name,
    )  # fmt: skip


def worst_of(found: list[Confirmation]) -> Confirmation | None:
    """One confirmation for several."""
    if not found:
        return None
    routes = "; ".join(dict.fromkeys(f.route for f in found))
    worst, points = max(f.residual for f in found), sum(f.points for f in found)
    return Confirmation(worst, points, DIGITS, routes)


@dataclass(frozen=True, eq=False)
class InEquilibrium(InAllStates):
    """As above; the second route builds the state from what is stated and weighs its balance."""

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        first = super().confirm(printed)
        narrowed = self._narrowed(printed)
        assert narrowed is not None and first is not None
        states, claim = narrowed
        second = [Confirmation(_balance(state, claim), 1, DIGITS, _ROUTE) for state in states]
        return worst_of([first, *second])


@dataclass(frozen=True, eq=False)
class NamesStretch:
    """The one right side that is not 0 is |r'| in every state, sheared or not."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        claim = printed.args[1] if isinstance(printed, Implies) else printed
        right = [single.sides[1] for single in claims(claim)]
        (size,) = (value for value in right if value != 0)
        square = sp.Add(*(points.tangent[i] ** 2 for i in (1, 2, 3)))
        squares = Chain(sp.Tuple(size**2, square), sp.Tuple(sp.Symbol("=")))
        return InAllStates(domains.PUSHED_OR_PULLED).decide(squares, explain=explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


_ROUTE = "r and directors built as stated, differentiated numerically; n' and m' + r' x n; n, m"


def _balance(state: Meaning, claim: sp.Basic) -> float:
    """The state with every stated component in place of the derived one: is it in equilibrium?

    r = s r', so that an r' which is not constant shows too. What must vanish: n', m' + r' x n,
    m, n - N g_3 and the differences between the strains found and those put in.
    """
    point, ctx = state.sample(0), context(DIGITS + 15)
    parts = _configuration(state, claim)
    values = {**point, N: state.evaluator(ctx, point)(N)}
    at = values[s]
    directors = frame([[parts[sp.Symbol(f"d{k}{i}", real=True)] for i in (1, 2, 3)]
                       for k in (1, 2, 3)], s, values, ctx)  # fmt: skip
    r = curve([s * parts[sp.Symbol(f"r'{i}", real=True)] for i in (1, 2, 3)], s, values, ctx)
    found = balance_residual(r, directors, point, ctx, [at])
    misses = [found.force_slope, found.couple_slope, *(abs(e) for m in found.couples for e in m)]
    (force,), ((u, v),) = found.forces, found.strains
    misses += [abs(f - g) for f, g in zip(force, (0, 0, values[N]), strict=True)]
    stated = curve([parts[u3], parts[v1], parts[v2], parts[v3]], s, values, ctx)(number(ctx, at))
    misses += [abs(a - b) for a, b in zip((*u, *v), (0, 0, *stated), strict=True)]
    return float(max(misses))


def _configuration(state: Meaning, claim: sp.Basic) -> dict[sp.Symbol, sp.Expr]:
    """u_3, v_k, d_k and r' as expressions: as stated, else from what is stated, else derived."""
    stated: dict[sp.Symbol, sp.Expr] = {}
    for single in claims(claim):
        for left, relation, right in single.links():
            symbol = next((x for x in sp.Add.make_args(left) if x.is_Symbol), None)
            if relation == "=" and symbol is not None:
                stated[symbol] = state.interpret(right - (left - symbol))
    parts = {k: stated.get(k, state.components[k]) for k in (u3, v1, v2, v3)}
    twist = parts[u3] * s + points.psi0 - state.interpret(phi) * sp.cos(state.interpret(theta))
    turned = euler_frame(state.interpret(phi), state.interpret(theta), twist)
    for k in range(3):
        for i in range(3):
            symbol = sp.Symbol(f"d{k + 1}{i + 1}", real=True)
            parts[symbol] = stated.get(symbol, turned[k][i])
    for i in range(1, 4):
        symbol = sp.Symbol(f"r'{i}", real=True)
        along = (parts[v] * parts[sp.Symbol(f"d{k}{i}", real=True)]
                 for k, v in enumerate((v1, v2, v3), 1))  # fmt: skip
        parts[symbol] = stated.get(symbol, sp.Add(*along))
    return parts


@dataclass(frozen=True, eq=False)
class Jointly:
    """One claim, held against several checks."""

    checks: tuple[Check, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        return all_of(self.checks, printed, explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        found = [check.confirm(printed) for check in self.checks]
        return worst_of([f for f in found if f is not None])


@dataclass(frozen=True, eq=False)
class Both:
    """Every of several claims, each with its own check."""

    checks: tuple[Check, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Every) or len(printed.args) != len(self.checks):
            return REJECTED
        methods = []
        for check, part in zip(self.checks, printed.args, strict=True):
            found = check.decide(part, explain=explain)
            if not (found.holds and found.exact):
                return found
            methods.append(found.method)
        return Decision(True, True, "; ".join(dict.fromkeys(methods)))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        found = [c.confirm(q) for c, q in zip(self.checks, printed.args, strict=True)]
        return worst_of([f for f in found if f is not None])
