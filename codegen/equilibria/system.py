"""What an equilibrium system is to the generator: straight-line kernels around the law.

The right-hand side of a rod's equations is state -> loads -> (law) -> strains -> rates. The law has
its own kernels (`rodproof.codegen.lower`); everything else is rational in the names here, without
loops and without guards, and holds for floats and arrays alike.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel, Output, symbol, validate
from rodproof.codegen.passes.order import order
from rodproof.codegen.passes.share import share
from rodproof.codegen.passes.specialise import drop_dead
from rodproof.derivations.symbols import CONSTANTS

#: The compliance d(u, v)/d(m, n) as names, symmetric.
SOFT = sp.Matrix(6, 6, lambda i, j: symbol(f"soft{min(i, j) + 1}{max(i, j) + 1}"))
SOFT_NAMES = tuple(SOFT[i, j].name for i in range(6) for j in range(i, 6))


@dataclass(frozen=True)
class Piece:
    """A kernel printed as one private function: its arguments, each a row of names, its words."""

    kernel: Kernel
    arguments: Mapping[str, tuple[str, ...]]
    doc: str
    entries: str = ""  # the name of the table of indices, where only some entries are returned


def piece(
    name: str,
    doc: str,
    arguments: Mapping[str, tuple[str, ...]],
    body: tuple[Assignment, ...],
    outputs: Mapping[Any, sp.Expr],
    entries: str = "",
    statements: tuple[str, ...] = (),
    constants: tuple[Assignment, ...] = (),
) -> Piece:
    """A kernel after the passes that straight-line code takes, and its words."""
    inputs = tuple(n for names in arguments.values() for n in names)
    found = tuple(Output("x", index, e, statements) for index, e in outputs.items())
    kernel = order(drop_dead(share(Kernel(name, inputs, body, found, constants=constants))))
    validate(kernel, frozenset(c.name for c in CONSTANTS))
    return Piece(kernel, arguments, doc, entries)


def named(
    rows: tuple[str, ...], matrix: sp.Matrix, columns: tuple[str, ...]
) -> tuple[tuple[Assignment, ...], sp.Matrix]:
    """The entries that are not zero as assignments ``row_column``, and the matrix in them."""
    names = sp.zeros(*matrix.shape)
    body = []
    for i in range(matrix.rows):
        for j in range(matrix.cols):
            if matrix[i, j].is_Symbol or matrix[i, j].is_number:
                names[i, j] = matrix[i, j]
            else:
                body.append(Assignment(f"{rows[i]}_{columns[j]}", matrix[i, j]))
                names[i, j] = body[-1].symbol
    return tuple(body), names


def cross_matrix(a: tuple[sp.Expr, ...]) -> sp.Matrix:
    """The matrix of x -> a x x."""
    a1, a2, a3 = a
    return sp.Matrix([[0, -a3, a2], [a3, 0, -a1], [-a2, a1, 0]])
