"""Gives names of the field to temporaries that passes made, once, after the last of them."""

from __future__ import annotations

import re
from dataclasses import replace

import sympy as sp

from rodproof.codegen.kernel import Kernel, symbol
from rodproof.derivations.symbols import gamma
from rodproof.derivations.theory.constitutive import y

#: What an expression is called; a square is called after its root, the rest keeps its number.
NAMES: dict[sp.Expr, str] = {sp.Max(y, gamma): "larger", sp.Max(y, 1): "larger"}


def name(kernel: Kernel) -> Kernel:
    """The kernel with known expressions renamed."""
    new = {a.name: _name(a.name, a.expr) for a in kernel.body}
    kernel = kernel.rewrite({symbol(old): symbol(fresh) for old, fresh in new.items()})
    return replace(kernel, body=tuple(replace(a, name=new[a.name]) for a in kernel.body))


def _name(old: str, expr: sp.Expr) -> str:
    if expr in NAMES:
        return NAMES[expr]
    numbered = re.fullmatch(r"t\d+(_\w+)?", old)
    if numbered and isinstance(expr, sp.Pow) and expr.exp == 2 and expr.base.is_Symbol:
        return f"{expr.base.name[0]}{expr.base}"  # aa1 for the square of a1
    return old
