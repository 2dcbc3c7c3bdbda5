"""Second routes to claims on the constants of the rod: moduli, forms, units, conditions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import sympy as sp

from rodproof.derivations.checks.constitutive import Y, constants_of_all_signs, dim
from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.routes import law
from rodproof.derivations.checks.routes.law import Values
from rodproof.derivations.exact.evaluate import Evaluator, context, numbers
from rodproof.derivations.notation import Every, Iff, PositiveDefinite, instances
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import IllTyped
from rodproof.derivations.proof.prover import ROUTE_POINTS, claims
from rodproof.derivations.proof.routed import ZERO, Route, at_odds, differ, excess, short
from rodproof.derivations.symbols import (
    CONSTANTS,
    LOADS,
    STRAINS,
    alpha,
    beta,
    eta,
    gamma,
    iota,
    p,
)
from rodproof.derivations.theory import dimensions
from rodproof.derivations.theory.orientation import a

# -- moduli ------------------------------------------------------------------------------------


def measured_moduli(values: Values, ctx: Any) -> list[Any]:
    """The 21 entries of the stiffness at rest on and above the diagonal."""
    tangent = law.stiffness_at_rest(values, ctx)
    return [tangent[i, j] for i in range(6) for j in range(i, 6)]


def _moduli(printed: sp.Basic, _: Any) -> Iterator[Any]:
    """Each is an entry of the stiffness; together they move with every constant but p, rank 5."""
    ctx, where = context(law.SPARE), []
    for seed in range(ROUTE_POINTS):
        values = numbers(ctx, sampling.constants(seed))
        entries, evaluate = measured_moduli(values, ctx), Evaluator(ctx, values)
        for modulus in printed.args:
            misses = [differ(entry, evaluate(modulus)) for entry in entries]
            where.append(misses.index(min(misses)))
            yield min(misses)

    def stated(at: Values) -> list[Any]:
        return [measured_moduli(at, ctx)[k] for k in where[: len(printed.args)]]

    jacobian = law.logarithmic_jacobian(stated, values, CONSTANTS, ctx)
    moved = [ctx.norm(jacobian[:, k]) for k in range(len(CONSTANTS))]
    independent = min(law.singular_values(jacobian, ctx)) > 1e-10
    involved = all(size > 1e-10 for size, c in zip(moved, CONSTANTS, strict=True) if c != p)
    yield moved[CONSTANTS.index(p)] if independent and involved else math.inf


MODULI = Route(
    "strains under loads of size 1e-200, inverted, differentiated by the constants; "
    "singular values",
    _moduli,
)

# -- forms -------------------------------------------------------------------------------------


def _least(form: Callable[[list[Any]], Any], ctx: Any) -> Any:
    """The least eigenvalue of a form, from its second differences at zero."""
    at_zero, alone = form([ctx.mpf(0)] * 6), [form(law.unit(i)) for i in range(6)]
    hessian = ctx.matrix(6)
    for i in range(6):
        hessian[i, i] = alone[i] - at_zero
        for j in range(i):
            both = form([int(k in (i, j)) for k in range(6)])
            hessian[i, j] = hessian[j, i] = (both - alone[i] - alone[j] + at_zero) / 2
    return min(ctx.eigsy(hessian, eigvals_only=True))


def _gap(values: Values, ctx: Any) -> Any:
    """The least eigenvalue of Q."""
    return _least(NumericLaw(values, ctx).form, ctx)


def _all_sorts(ctx: Any) -> Iterator[dict[sp.Symbol, Any]]:
    """Small constants and generic ones, these on both sides of where Q degenerates."""
    for point in constants_of_all_signs():
        yield numbers(ctx, point)
    for seed in range(ROUTE_POINTS):
        values = numbers(ctx, sampling.constants(seed))
        beyond = 2 * values[beta] * values[eta] * (-1) ** seed
        yield from law.border(
            lambda at: _gap(at, ctx), values, iota, ctx, (values[iota], beyond)
        )  # fmt: skip


def _coupling(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    (claim,) = claims(printed)
    for values in _all_sorts(ctx):
        gap = _gap(values, ctx)
        if abs(gap) > 1e-30:  # a small point may lie on the border itself
            yield at_odds(excess(claim, Evaluator(ctx, values)), gap)


COUPLING = Route("least eigenvalue of the second differences of Q, on both sides", _coupling)


def _stated_form(
    form: sp.Basic, symbols: tuple[sp.Symbol, ...], rest: tuple[int, ...], values: Values, ctx: Any
) -> Callable[[list[Any]], Any]:
    """A transcribed form as a function of six numbers; what it has no business with is generic."""
    if not isinstance(form, PositiveDefinite):
        raise IllTyped("a definite form is needed here")
    generic = numbers(ctx, sampling.with_strains(0) | sampling.with_loads(0))
    others = {x: generic[x] for x in (*STRAINS, *LOADS)}

    def at(shift: list[Any]) -> Any:
        place = dict(zip(symbols, (x + r for x, r in zip(shift, rest, strict=True)), strict=True))
        return Evaluator(ctx, {**values, **others, **place})(form.args[0])

    return at


def _forms(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Where the hypothesis holds: each form is the measured one, and its least eigenvalue > 0."""
    (claim,) = instances(printed)
    hypotheses, stated = (x.args if isinstance(x, Every) else (x,) for x in claim.args)
    held, load = 0, [(3 - k) * ctx.mpf(2 + k) / 7 for k in range(6)]
    for values in _all_sorts(ctx):
        if not all(excess(h, Evaluator(ctx, values)) > 0 for h in hypotheses):
            continue
        held += 1
        measured = NumericLaw(values, ctx)
        known = (STRAINS, (0, 0, 0, 0, 0, 1), measured.form), (LOADS, (0,) * 6, measured.dual)
        for form, (symbols, rest, wanted) in zip(stated, known, strict=True):
            at = _stated_form(form, symbols, rest, values, ctx)
            try:
                yield differ(at(load), wanted(load))
                yield short(_least(at, ctx))
            except ZeroDivisionError:
                yield math.inf
    if not held:
        yield math.inf


FORMS = Route(
    "least eigenvalues of the second differences of both forms; K solved numerically", _forms
)

# -- saturation --------------------------------------------------------------------------------


def _saturation(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The strain under a tension that counts up to Y only, at the two loads of the claim."""
    (claim,) = claims(printed)
    for seed in range(ROUTE_POINTS):
        values = numbers(ctx, {**sampling.constants(seed), Y: sp.Rational(7 + 4 * seed, 5)})
        loads = [Evaluator(ctx, values)(side.args[0]) for side in claim.sides]
        reached = [law.strains(values, law.unit(5, min(load, values[Y])), ctx)[5] for load in loads]
        yield differ(*reached) if abs(loads[0] - loads[1]) > ZERO else math.inf


SATURATION = Route("the law with K solved numerically, cut off at Y, at both loads", _saturation)

# -- units -------------------------------------------------------------------------------------

_UNITS = {dimensions.length: sp.Rational(17, 6), dimensions.force: sp.Rational(5, 13)}


def _other_units(
    values: Values, factors: dict[sp.Symbol, Any], ctx: Any
) -> Iterator[Any]:  # fmt: skip
    """The law in other units of length and force: how far the strains are from scaling."""
    factor = numbers(ctx, _UNITS)
    size, force = factor[dimensions.length], factor[dimensions.force]
    load = [values[x] for x in LOADS]
    moved = [force * size * f for f in load[:3]] + [force * f for f in load[3:]]
    before = law.strains(values, load, ctx)
    after = law.strains({c: values[c] * factors.get(c, 1) for c in CONSTANTS}, moved, ctx)
    for k, (x, y) in enumerate(zip(before, after, strict=True)):
        yield differ(y * size if k < 3 else y, x)


def _dimensions(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Each constant multiplied by its stated unit."""
    factors = {}
    for claim in printed.args:
        constant, scale = claim.sides
        if constant.func != dim:
            raise IllTyped("a dimension is needed here")
        factors[constant.args[0]] = Evaluator(ctx, _UNITS)(scale)
    for seed in range(ROUTE_POINTS):
        yield from _other_units(numbers(ctx, sampling.with_loads(seed)), factors, ctx)


DIMENSIONS = Route("the law with K solved numerically, in other units of both kinds", _dimensions)


def _factors(ctx: Any) -> dict[sp.Symbol, Any]:
    """What the derived dimensions make of each constant in other units."""
    size, force = (Evaluator(ctx, _UNITS)(x) for x in (dimensions.length, dimensions.force))
    return {c: size**i * force**j for c, (i, j) in dimensions.of_constants().items()}


def _groups(printed: sp.Basic, _: Any) -> Iterator[Any]:
    """The groups do not notice other units, are independent, and there are all of them."""
    ctx = context(law.SPARE)
    factors = {**_factors(ctx), **numbers(ctx, _UNITS)}
    quantities = tuple(factors)
    for seed in range(ROUTE_POINTS):
        values = numbers(ctx, sampling.with_loads(seed))
        yield from _other_units(values, factors, ctx)
        values |= {dimensions.length: ctx.mpf(19) / 7, dimensions.force: ctx.mpf(23) / 9}

        def groups(at: Values) -> list[Any]:
            return [Evaluator(ctx, at)(group) for group in printed.args]

        moved = groups({x: values[x] * f for x, f in factors.items()})
        for here, there in zip(groups(values), moved, strict=True):
            yield differ(here, there)
        jacobian = law.logarithmic_jacobian(groups, values, quantities, ctx)
        independent = min(law.singular_values(jacobian, ctx)) > 1e-10
        yield 0 if independent and len(printed.args) == len(quantities) - len(_UNITS) else math.inf


GROUPS = Route("the law and the groups in other units; singular values of the exponents", _groups)


def _units(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """In units in which the chosen quantities are 1 they are, and the law is the same."""
    for seed in range(ROUTE_POINTS):
        values = numbers(ctx, sampling.with_loads(seed))
        values |= {dimensions.length: ctx.mpf(19) / 7}
        chosen = {dimensions.length: 1 / values[dimensions.length], gamma: 1 / values[gamma]}
        for claim in claims(printed):
            scale, one = claim.sides
            yield differ(values[scale] * chosen.get(scale, 1), Evaluator(ctx, {})(one))
        load = [values[x] for x in LOADS]
        size, force = values[dimensions.length], values[gamma]
        units = {c: size**i * force**j for c, (i, j) in dimensions.of_constants().items()}
        moved = [f / size / force for f in load[:3]] + [f / force for f in load[3:]]
        before = law.strains(values, load, ctx)
        after = law.strains({c: values[c] / units[c] for c in CONSTANTS}, moved, ctx)
        for k, (x, y) in enumerate(zip(before, after, strict=True)):
            yield differ(y / size if k < 3 else y, x)


UNITS = Route("the law with K solved numerically, in units of L and gamma", _units)

# -- conditions of Section 3.2 -------------------------------------------------------------------


def least_v3(values: Values, ctx: Any) -> Any:
    """The infimum of v_3 over the strains within the limit."""
    return 1 - law.reach(values, law.unit(5), ctx)


def _least_apart(values: Values, ctx: Any) -> Any:
    """Least v_3 less a times the largest flexure, each by itself."""
    return least_v3(values, ctx) - values[a] * law.reach(values, law.unit(0), ctx)


def _on_the_strains(measure: Callable[[Values, Any], Any], symbol: sp.Symbol) -> Route:
    def misses(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
        (claim,) = instances(printed)
        parts = claim.args if isinstance(claim, Iff) else (claim,)
        for seed in range(ROUTE_POINTS):
            values = numbers(ctx, {**sampling.constants(seed), a: sp.Rational(1, 7)})
            values[eta] += 3  # far above the border, that of the radius included
            values[alpha] += seed
            low = 1.01 * abs(values[iota]) / values[beta] if symbol == eta else 1e-3
            pair = law.border(lambda at: measure(at, ctx), values, symbol, ctx, (low, 90))
            for at in (values, *pair):
                evaluate = Evaluator(ctx, at)
                yield at_odds(measure(at, ctx), *(excess(part, evaluate) for part in parts))

    return Route("least value over Q < 1 by a numerical linear solve, on both sides", misses)


V3_POSITIVE = _on_the_strains(least_v3, eta)
RADIUS = _on_the_strains(_least_apart, a)
