"""Drops what a scene does not want: outputs, and whatever only they needed."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel


def specialise(kernel: Kernel, fixed: dict[sp.Expr, sp.Expr]) -> Kernel:
    """The kernel with constants, loads or strains set to ``fixed`` values, and dead code gone."""
    return drop_dead(kernel.rewrite(fixed) if fixed else kernel)


def drop_dead(kernel: Kernel) -> Kernel:
    """Without the assignments that no output and no limit needs, constants included."""
    needed = {s.name for o in kernel.outputs for s in o.expr.free_symbols}
    if kernel.limit is not None:
        needed.add(kernel.limit.quantity)
    if kernel.gauge is not None:
        needed.add(kernel.gauge.square)
    defined = {a.name: a for a in (*kernel.constants, *kernel.body)}
    todo = sorted(needed)
    while todo:
        a = defined.get(todo.pop())
        new = {s.name for s in a.expr.free_symbols} - needed if a else set()
        needed |= new
        todo.extend(sorted(new))

    def live(assignments: tuple[Assignment, ...]) -> tuple[Assignment, ...]:
        return tuple(a for a in assignments if a.name in needed)

    return replace(kernel, body=live(kernel.body), constants=live(kernel.constants))
