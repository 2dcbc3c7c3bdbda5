"""Leaves out what a scene does not have: dead loads and strains, and whatever only they needed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Gauge, Kernel, Output
from rodproof.codegen.live import Group, Live, groups, live, substitution
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.derivations.symbols import STRAINS

STRAIN_NAMES = tuple(s.name for s in STRAINS)


def specialise(kernel: Kernel, scene: Scene) -> Kernel:
    """The kernel of the scene: lost components and fixed constants put in, lost outputs gone."""
    known = substitution(scene)
    if not known:
        return kernel
    components = live(scene).loads
    names = LOAD_NAMES if kernel.inputs[0] == LOAD_NAMES[0] else STRAIN_NAMES
    kernel = replace(
        propagate(kernel, known),
        inputs=tuple(names[i] for i in components),
        gauge=_gauge(kernel.gauge, components),
    )
    return _outputs(kernel, scene)


def propagate(kernel: Kernel, known: Mapping[sp.Expr, sp.Expr]) -> Kernel:
    """With ``known`` put in, and every assignment that became a number or a modulus, too."""
    found = dict(known)
    while found:
        constants = tuple(replace(a, expr=a.expr.xreplace(found)) for a in kernel.constants)
        kernel = replace(kernel.rewrite(found), constants=constants)
        found = {a.symbol: a.expr for a in kernel.body if a.expr.is_number}
        known_by_name = kernel.region is not None  # a plain kernel's constants: their sizes count
        found |= {
            a.symbol: a.expr
            for a in constants
            if a.expr.is_number or (_simple(a.expr) and not known_by_name)
        }
        kernel = replace(
            kernel,
            body=tuple(a for a in kernel.body if a.symbol not in found),
            constants=tuple(a for a in constants if a.symbol not in found),
        )
    return kernel


def _simple(expr: sp.Expr) -> bool:
    """A modulus or its reciprocal, which needs no name of its own."""
    return bool(expr.as_base_exp()[0].is_Symbol)


def _gauge(gauge: Gauge | None, components: tuple[int, ...]) -> Gauge | None:
    if gauge is None:
        return None
    return replace(gauge, inputs=tuple(gauge.inputs[i] for i in components))


def _outputs(kernel: Kernel, scene: Scene) -> Kernel:
    """Outputs of live components, at their places in the scene's arrays."""
    at = live(scene)
    outputs = tuple(new for o in kernel.outputs for new in _kept(o, at))
    dyad = kernel.dyad
    if dyad is not None:
        dyad = replace(dyad, vector=tuple(dyad.vector[i] for i in at.loads))
    form = kernel.form
    if form is not None:
        answer = at.strains if kernel.inputs[0] in LOAD_NAMES else at.loads
        form = replace(form, vector=tuple(form.vector[i] for i in answer))
    return replace(kernel, outputs=outputs, dyad=dyad if len(at.loads) > 1 else None, form=form)


def _kept(o: Output, at: Live) -> list[Output]:
    """The output at its new place, or nothing."""
    if len(o.index) == 2:
        if not set(o.index) <= set(at.loads):
            return []
        places = tuple(at.loads.index(i) for i in o.index)
        return [replace(o, index=places if len(at.loads) > 1 else ())]
    if not o.index:
        return [o]
    letters, kept = ("uv", at.strains) if o.array in "uv" else ("mn", at.loads)
    component = 3 * letters.index(o.array) + o.index[0]
    return [_placed(o, component, groups(letters, kept))] if component in kept else []


def _placed(o: Output, component: int, parts: tuple[Group, ...]) -> Output:
    (group,) = (g for g in parts if component in g.components)
    return replace(o, array=group.array, index=group.place(component))


def drop_dead(kernel: Kernel) -> Kernel:
    """Without the assignments that no output, no limit and no form needs, constants included."""
    needed = {s.name for o in kernel.outputs for s in o.expr.free_symbols}
    if kernel.form is not None:
        needed |= {*kernel.form.vector}
    if kernel.limit is not None:
        needed.add(kernel.limit.quantity)
    if kernel.gauge is not None:
        needed.add(kernel.gauge.square)
    if kernel.region is not None:
        needed.add(kernel.region.quantity)
    defined = {a.name: a for a in (*kernel.constants, *kernel.body)}
    todo = sorted(needed)
    while todo:
        a = defined.get(todo.pop())
        new = {s.name for s in a.expr.free_symbols} - needed if a else set()
        needed |= new
        todo.extend(sorted(new))

    def kept(assignments: tuple[Assignment, ...]) -> tuple[Assignment, ...]:
        return tuple(a for a in assignments if a.name in needed)

    body, constants, dyad = kept(kernel.body), kept(kernel.constants), kernel.dyad
    if dyad and not {dyad.weight, *dyad.vector} <= {a.name for a in body}:
        dyad = None  # every entry has another form: with two components none is the product alone
    return replace(kernel, body=body, constants=constants, dyad=dyad)
