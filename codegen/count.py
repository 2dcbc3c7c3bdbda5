"""Counts what a kernel costs per point."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen.kernel import Kernel, symbol
from rodproof.codegen.primitives import WorkShare

TRANSCENDENTAL = (sp.exp, sp.log, log1p, expm1)


@dataclass(frozen=True)
class Cost:
    """Operations a point; a square root counts as arithmetic, a special function apart."""

    arithmetic: int
    transcendental: int
    special: int
    temporaries: int


def cost(kernel: Kernel) -> Cost:
    """The cost of one point where nothing is extreme: of the plain kernel, if there is one.

    The gauge's square root is counted, its scaled path is not.
    """
    kernel = kernel.plain or kernel
    arithmetic = transcendental = special = 0
    gauge = kernel.gauge
    plain = kernel.rewrite({symbol(gauge.unscale): sp.S.One}) if gauge else kernel
    used = {s.name for expr in plain.expressions() for s in expr.free_symbols}
    root = gauge is not None and bool({gauge.norm, gauge.radius} & used)
    for expr in plain.expressions():
        for node in sp.preorder_traversal(expr):
            if isinstance(node, TRANSCENDENTAL):
                transcendental += 1
            elif isinstance(node, WorkShare):
                special += 1
            elif isinstance(node, (sp.Add, sp.Mul, sp.Max, sp.Min)):
                arithmetic += len(node.args) - 1
            elif isinstance(node, (sp.Pow, sp.Piecewise)):
                arithmetic += 1
    named = sum(not a.expr.is_Symbol for a in plain.body)
    return Cost(arithmetic + root, transcendental, special, named)
