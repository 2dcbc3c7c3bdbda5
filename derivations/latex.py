"""LaTeX for transcriptions and derived formulas, in the paper's notation."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.printing.latex import LatexPrinter

_NAMES = {
    **{f"{a}{k}": f"{a}_{k}" for a in "uvmn" for k in (1, 2, 3)},
    "norm_T": r"|\boldsymbol{T}|",
    "varphi": r"\varphi",
    "Q_mirror": r"Q_{\mathrm{mirror}}",
}
_COLUMNS = dict.fromkeys("uvmn")


class _Printer(LatexPrinter):
    """The paper's conventions: sans-serif columns, fractions for 1/x, powers kept visible."""

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        return _NAMES.get(expr.name) or str(super()._print_Symbol(expr))

    def _print_IndexedBase(self, expr: sp.IndexedBase) -> str:
        name = str(expr.label)
        return rf"\mathsf{{{name}}}" if name in _COLUMNS else name.replace("_", r"\_")

    def _print_Indexed(self, expr: sp.Indexed) -> str:
        indices = " ".join(self._print(i) for i in expr.indices)
        return rf"{expr.base.label}_{{{indices}}}"


def latex(expr: Any) -> str:
    """One formula as LaTeX, without delimiters; same input, same text."""
    return str(_Printer({"fold_short_frac": False, "mul_symbol": None}).doprint(expr))
