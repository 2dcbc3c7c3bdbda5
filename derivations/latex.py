"""LaTeX for transcriptions and derived formulas, in the paper's notation and order of factors."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import PRECEDENCE

from rodproof.derivations.notation import Chain, Every, Implies
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta

_NAMES = {
    **{f"{a}{k}": f"{a}_{k}" for a in "uvmn" for k in (1, 2, 3)},
    "n_s": r"\boldsymbol{n}(s)",
    "norm_T": r"|\boldsymbol{T}|",
    "Q_mirror": r"Q_{\mathrm{mirror}}",
    "K_inverse": "K^{-1}",
    "k^T": r"k^{\mathsf T}",
    "e^T": r"e^{\mathsf T}",
    "D2W": r"D^2 W",
    "D2Wstar": r"D^2 W^*",
    "det_grad_chi": r"\det \nabla \boldsymbol{\chi}",
    "theta_s": r"\theta_s",
    "curvature": r"\kappa",
    "torsion": r"\tau",
    "m_vector": r"\boldsymbol{m}",
    "n_vector": r"\boldsymbol{n}",
}
#: Vectors whose components stand in a transcription: `r_s[1]` is the first component of r'.
_VECTORS = {
    "r": "r", "r_s": "r'", "d1_": "d_1", "d2_": "d_2", "d3_": "d_3", "d3_s": "d_3'",
    "r'": "r'", "m_g": "m", "m_s": "m'", "n_s": "n'",
}  # fmt: skip
_FUNCTIONS = {"W_star": "W^*", "load": r"\hat y", "dim": r"\operatorname{dim}", "Phi": r"\Phi"}
_LETTERS = frozenset(
    ("alpha", "beta", "gamma", "zeta", "iota", "theta", "varphi", "sigma", "delta", "kappa")
)
_STANDARD = frozenset(
    ("log", "hyper", "Abs", "sin", "cos", "tan", "cot", "csc", "acos", "asin", "atan", "exp")
)
_COLUMNS = frozenset("uvmnab")
_CONSTANTS = (gamma, alpha, beta, zeta, eta, iota, p)


class _Printer(LatexPrinter):
    """Sans-serif columns, p/2 in exponents, real powers before fractions, gamma first."""

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        if expr.name.startswith("bold_"):
            letter, _, at = expr.name.removeprefix("bold_").partition("_")
            bold = rf"\boldsymbol{{{_letter(letter)}}}"
            return f"{bold}({at})" if at else bold
        if expr.name in _NAMES:
            return _NAMES[expr.name]
        if expr.name.isalpha() and len(expr.name) > 3 and expr.name not in _LETTERS:
            return rf"\mathrm{{{expr.name}}}"
        return str(super()._print_Symbol(expr))

    def _print_Tuple(self, expr: sp.Tuple) -> str:
        return ", ".join(self._print(a) for a in expr)

    def _print_IndexedBase(self, expr: sp.IndexedBase) -> str:
        name = str(expr.label)
        return rf"\mathsf{{{name}}}" if name in _COLUMNS else name.replace("_", r"\_")

    def _print_Indexed(self, expr: sp.Indexed) -> str:
        indices = " ".join(self._print(i) for i in expr.indices)
        name = str(expr.base.label)
        if name in _VECTORS:
            letter, mark, _ = _VECTORS[name].partition("'")
            stem, _, number = letter.partition("_")
            bold = rf"\boldsymbol{{{stem}}}" + (f"_{number}" if number else "") + mark
            return rf"({bold})_{{{indices}}}"
        if name.endswith("_t"):
            return rf"\partial_t {name[:-2]}_{{{indices}}}"
        if name in ("d", "e", "g"):
            return rf"\boldsymbol{{{name}}}_{{{indices}}}"
        stem, _, place = name.partition("_")
        return rf"{stem}_{{{place}\,{indices}}}" if place else rf"{name}_{{{indices}}}"

    def _print_Add(self, expr: sp.Add, order: str | None = None) -> str:
        """Positive terms first, and plain numbers first among them."""
        terms = list(self._as_ordered_terms(expr, order=order))
        terms.sort(key=lambda t: (t.could_extract_minus_sign(), not t.is_number))
        text = self._print(terms[0])
        for term in terms[1:]:
            piece = self._print(term)
            minus = piece.startswith("-")
            text += " - " + piece.removeprefix("-").lstrip() if minus else " + " + piece
        return str(text)

    def _print_sin(self, expr: sp.Function, exp: str | None = None) -> str:
        return self._of_angle(r"\sin", expr.args[0], exp)

    def _print_cos(self, expr: sp.Function, exp: str | None = None) -> str:
        return self._of_angle(r"\cos", expr.args[0], exp)

    def _print_cot(self, expr: sp.Function, exp: str | None = None) -> str:
        return self._of_angle(r"\cot", expr.args[0], exp)

    def _print_csc(self, expr: sp.Function, exp: str | None = None) -> str:
        return self._of_angle(r"\csc", expr.args[0], exp)

    def _of_angle(self, name: str, angle: sp.Expr, exp: str | None) -> str:
        power = f"^{{{exp}}}" if exp else ""
        inner = self._print(angle)
        return (
            rf"{name}{power} {inner}" if angle.is_Symbol else rf"{name}{power}\left({inner}\right)"
        )

    def _print_Function(self, expr: sp.Function, exp: str | None = None) -> str:
        name = expr.func.__name__
        if name in _STANDARD:
            return str(super()._print_Function(expr, exp))
        inside = ", ".join(self._print(a) for a in expr.args)
        whole = rf"{_FUNCTIONS.get(name, name)}({inside})"
        return whole if exp is None else rf"{whole}^{{{exp}}}"

    def _print_Pow(self, expr: sp.Pow) -> str:
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and exponent > 0 and "'" in self._print(base) and base.is_Symbol:
            return rf"\left({self._print(base)}\right)^{{{exponent}}}"
        if exponent.is_Rational or exponent.free_symbols != {p}:
            return str(super()._print_Pow(expr))
        if isinstance(base, sp.Function) and type(base).__name__ not in _STANDARD:
            return rf"{self._print(base)}^{{{_inline(exponent)}}}"
        return rf"{self.parenthesize(base, PRECEDENCE['Pow'])}^{{{_inline(exponent)}}}"

    def _print_Mul(self, expr: sp.Mul) -> str:
        number, rest = expr.as_coeff_Mul()
        if number.could_extract_minus_sign():
            return f"- {self._print(-expr)}"
        integrals = [f for f in sp.Mul.make_args(rest) if isinstance(f, sp.Integral)]
        if integrals:
            scale = number * sp.Mul(*(f for f in sp.Mul.make_args(rest) if f not in integrals))
            before = self._print(scale) + " " if scale != 1 else ""
            return before + " ".join(map(self._print, integrals))
        above, below, front = [], [], []
        for factor in sorted(sp.Mul.make_args(rest), key=_order):
            exponent = factor.as_base_exp()[1]
            if exponent.is_Rational and exponent < 0:
                below.append(1 / factor)
            elif _is_heavy(factor):
                front.append(factor)
            elif factor != 1:
                above.append(factor)
        above = [sp.Integer(number.p)] * (number.p != 1) + above
        below = [sp.Integer(number.q)] * (number.q != 1) + below
        top = " ".join(map(self._factor, above)) or "1"
        pieces = [self._factor(f) for f in front]
        if below:
            denominator = (
                " ".join(map(self._factor, below)) if len(below) > 1 else self._print(below[0])
            )
            numerator = self._print(above[0]) if len(above) == 1 else top
            pieces.insert(
                0 if not above else len(pieces), rf"\frac{{{numerator}}}{{{denominator}}}"
            )
        elif above:
            position = 0 if above[0].is_number or above[0] == gamma else len(pieces)
            pieces.insert(position, top)
        return " ".join(pieces)

    def _factor(self, expr: sp.Expr) -> str:
        return str(self.parenthesize(expr, PRECEDENCE["Mul"]))

    def _print_Chain(self, chain: Chain) -> str:
        return str(chain._latex(self))


def _letter(name: str) -> str:
    return rf"\{name}" if len(name) > 1 else name


def _is_heavy(factor: sp.Expr) -> bool:
    """Real powers read better beside a fraction than in it."""
    return isinstance(factor, sp.hyper) or not factor.as_base_exp()[1].is_Rational


def _inline(exponent: sp.Expr) -> str:
    """p/2, -1/p - 1: exponents on one line."""
    return str(exponent).replace("**", "^").replace("*", " ")


def _order(factor: sp.Expr) -> tuple[int, int, str]:
    base = factor.as_base_exp()[0]
    if base in _CONSTANTS:
        return (0, _CONSTANTS.index(base), "")
    kind = 1 if isinstance(base, sp.Add) else 2 if isinstance(base, sp.Indexed | sp.Symbol) else 3
    return (kind, 0, str(factor))


def latex(expr: Any) -> str:
    """One formula as LaTeX, without delimiters; same input, same text."""
    settings = {"fold_frac_powers": True, "mul_symbol": None}
    return str(_Printer(settings).doprint(expr))


def rows(tree: sp.Basic) -> tuple[str, ...]:
    """A formula as the rows of an `aligned` block, broken where claims and relations begin."""
    if isinstance(tree, Every | sp.Tuple) and all(isinstance(a, Chain) for a in tree.args):
        return tuple(row for claim in tree.args for row in rows(claim))
    if isinstance(tree, Implies):
        hypothesis, conclusion = tree.args
        inner = rows(conclusion) if isinstance(conclusion, Every) else (latex(conclusion),)
        return (
            rf"&{latex(hypothesis)} \implies",
            *(row if "&" in row else rf"&\quad {row}" for row in inner),
        )
    if isinstance(tree, Every):
        return tuple(row if "&" in row else "&" + row for a in tree.args for row in rows(a))
    if isinstance(tree, Chain) and len(latex(tree)) > 90:
        printer = _Printer({"fold_frac_powers": True})
        marks = {"=": "=", "<": "<", "<=": r"\leq", ">": ">", ">=": r"\geq"}
        lines = [
            rf"&{marks[relation]} {printer.doprint(right)}" for _, relation, right in tree.links()
        ]
        return (rf"{printer.doprint(tree.sides[0])} {lines[0]}", *lines[1:])
    if isinstance(tree, Chain):
        left, _, right = latex(tree).partition(" " + _mark(tree) + " ")
        return (rf"{left} &{_mark(tree)} {right}",)
    return (latex(tree),)


def block(tree: sp.Basic) -> str:
    """A formula of one or several rows, to stand between display delimiters."""
    lines = rows(tree)
    if len(lines) == 1:
        return latex(tree)
    return r"\begin{aligned}" + r" \\ ".join(lines) + r"\end{aligned}"


def _mark(chain: Chain) -> str:
    return {"<=": r"\leq", ">=": r"\geq"}.get(chain.relations[0], chain.relations[0])
