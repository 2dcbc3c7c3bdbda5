"""Puts assignments into the order in which they are computed, each step in one piece."""

from __future__ import annotations

from dataclasses import replace

from rodproof.codegen.kernel import Assignment, Kernel, KernelError

#: Steps of a function in the order in which they run; assignments without a step come around them
#: as their definitions demand.
STEPS = ("reduce_loads", "reduce_strains", "soften", "stiffen", "harden")


def order(kernel: Kernel) -> Kernel:
    """The kernel with every name set before it is used, and otherwise in the rules' order."""
    return replace(
        kernel,
        body=_sorted(kernel.body, kernel),
        constants=_sorted(kernel.constants, kernel),
    )


def _sorted(assignments: tuple[Assignment, ...], kernel: Kernel) -> tuple[Assignment, ...]:
    waiting = list(assignments)
    unset = {a.name for a in waiting}
    gauge = kernel.gauge
    done: list[Assignment] = []
    while waiting:
        hidden = {gauge.norm, gauge.radius, gauge.unscale} if gauge else set[str]()
        hidden = hidden if gauge and gauge.square in unset else set()
        ready = [a for a in waiting if not {s.name for s in a.expr.free_symbols} & (unset | hidden)]
        if not ready:
            raise KernelError(f"kernel {kernel.name}: {waiting[0].name!r} depends on itself")
        square = gauge.square if gauge else kernel.limit.quantity if kernel.limit else ""
        chosen = min(ready, key=lambda a: (_rank(a, kernel), a.name == square))
        waiting.remove(chosen)
        unset.discard(chosen.name)
        done.append(chosen)
    return tuple(done)


def _rank(a: Assignment, kernel: Kernel) -> int:
    """The preparation of the inputs first (v3 - 1), then the steps, then the rest."""
    if a.step:
        return STEPS.index(a.step) + 1
    inputs_only = {s.name for s in a.expr.free_symbols} <= set(kernel.inputs)
    return 0 if inputs_only else len(STEPS) + 1
