"""Which rules make a function's kernel stable, by what the scene fixes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from rodproof.codegen.kernel import Assignment, Kernel
from rodproof.codegen.live import live, substitution
from rodproof.codegen.passes import stabilise as general
from rodproof.codegen.passes import stabilise_at_loads as at_loads
from rodproof.codegen.passes import stabilise_p2 as square
from rodproof.codegen.passes.stabilise import Rule, apply
from rodproof.codegen.scene import Scene
from rodproof.derivations.symbols import iota, p


@dataclass(frozen=True)
class Case:
    """What the choice depends on: p = 2, iota = 0, and the first live load."""

    square: bool = False
    achiral: bool = False
    first: int = 0


GENERAL = Case()


def case(scene: Scene) -> Case:
    """The case of a scene."""
    known = substitution(scene)
    return Case(p in known, iota in known, live(scene).loads[0])


def stabilise(kernel: Kernel, case: Case) -> Kernel:
    """The kernel with its rules applied in order."""
    for rule in rules(kernel.name, case):
        kernel = apply(rule, kernel)
    return kernel


def rules(function: str, case: Case = GENERAL) -> tuple[Rule, ...]:
    """The rules for a function, in the order in which they apply."""
    return CHAINS[function](case)


def _soften(case: Case) -> tuple[Assignment, ...]:
    return square.SOFTEN_DEFINITIONS if case.square else general.SOFTEN_DEFINITIONS


def _strains(case: Case) -> tuple[Rule, ...]:
    scale = square.SCALE_RADIAL_FACTOR if case.square else general.SCALE_RADIAL_FACTOR
    return (general.COMPLETE_DUAL_FORM, scale, general.REDUCE_STRAINS)


def _strains_and_gap(case: Case) -> tuple[Rule, ...]:
    return (at_loads.KEEP_GAP_SQUARE if case.square else at_loads.KEEP_GAP, *_strains(case))


def _loads(case: Case) -> tuple[Rule, ...]:
    grow = square.GROW_LOAD_FACTOR if case.square else general.GROW_LOAD_FACTOR
    return (general.COMPLETE_FORM, grow, general.REDUCE_LOADS)


def _stored_energy(case: Case) -> tuple[Rule, ...]:
    energy = square.CLOSE_STORED_ENERGY if case.square else general.SHARE_STORED_ENERGY
    return (energy, general.COMPLETE_FORM)


def _complementary_energy(case: Case) -> tuple[Rule, ...]:
    closed, share = square.CLOSE_COMPLEMENTARY_ENERGY, general.SHARE_COMPLEMENTARY_ENERGY
    return (closed if case.square else share, general.COMPLETE_DUAL_FORM)


def _compliance(case: Case) -> tuple[Rule, ...]:
    form = square if case.square else general
    coupling = not case.achiral
    return (
        general.COMPLETE_DUAL_FORM,
        form.SCALE_RADIAL_FACTOR,
        form.SPLIT_STRAIN_WEIGHT,
        general.complement_compliance(_soften(case), case.first, coupling=coupling),
        general.DIRECT_COMPLIANCE,
        general.RANK_ONE_COMPLIANCE if coupling else general.RANK_ONE_ACHIRAL,
    )


def _stiffness(case: Case) -> tuple[Rule, ...]:
    form = square if case.square else general
    return (
        general.COMPLETE_FORM,
        form.GROW_LOAD_FACTOR,
        form.GROW_LOAD_WEIGHT,
        general.FLOOR_STRAIN_RADIUS,
        general.DIRECT_STIFFNESS,
        general.RANK_ONE_STIFFNESS,
    )


def _stiffness_at_loads(case: Case) -> tuple[Rule, ...]:
    return (
        general.COMPLETE_DUAL_FORM,
        at_loads.GROW_BY_SQUARE if case.square else at_loads.GROW_WITH_LOAD,
        at_loads.SCALE_LOAD_ROOT if case.square else at_loads.SCALE_LOAD_FACTOR,
        at_loads.SPREAD_WEIGHT,
    )


def _loads_and_stiffness(case: Case) -> tuple[Rule, ...]:
    by_norm = {general.DIRECT_STIFFNESS: general.DIRECT_SCALED_STIFFNESS}
    complete, *rest = (rule for rule in _stiffness(case) if rule != general.FLOOR_STRAIN_RADIUS)
    return (complete, general.REDUCE_LOADS, *(by_norm.get(rule, rule) for rule in rest))


CHAINS: dict[str, Callable[[Case], tuple[Rule, ...]]] = {
    "strains": _strains,
    "loads": _loads,
    "stored_energy": _stored_energy,
    "complementary_energy": _complementary_energy,
    "stiffness": _stiffness,
    "loads_and_stiffness": _loads_and_stiffness,
    "compliance": _compliance,
    "strains_and_gap": _strains_and_gap,
    "stiffness_at_loads": _stiffness_at_loads,
}
