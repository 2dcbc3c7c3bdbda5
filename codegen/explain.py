"""A derivation for a reader: as text, as LaTeX to paste, or as data."""

from __future__ import annotations

from collections.abc import Sequence

from sympy.matrices.matrixbase import MatrixBase
from sympy.printing.str import StrPrinter

from rodproof.codegen.document.article import fragment
from rodproof.derivations.latex import latex as latex_of
from rodproof.derivations.notation import Chain, Every, Iff, Implies, Partial, PositiveDefinite
from rodproof.derivations.records import Derivation, Step


def text(derivations: Sequence[Derivation]) -> str:
    """Each step as a sentence with its formula below."""
    return "\n\n".join(
        "\n".join(
            [
                f"{derivation.title}  [{derivation.label}]",
                derivation.problem,
                *(_step_text(i, step) for i, step in enumerate(derivation.steps, start=1)),
            ]
        )
        for derivation in derivations
    )


def _step_text(number: int, step: Step) -> str:
    settles = f"  ({', '.join(step.statements)})" if step.statements else ""
    formula = _Text().doprint(step.formula).replace("\n", "\n      ")
    return f"\n{number}. {step.title}{settles}\n   {step.rule}\n      {formula}"


class _Text(StrPrinter):
    """The project's notation on one line."""

    def _print_Chain(self, chain: Chain) -> str:
        rest = (f" {relation} {self._print(right)}" for _, relation, right in chain.links())
        return str(self._print(chain.sides[0])) + "".join(rest)

    def _print_Every(self, every: Every) -> str:
        return "\n".join(self._print(part) for part in every.args)

    def _print_MatrixBase(self, matrix: MatrixBase) -> str:
        return "\n" + str(matrix.table(self, rowsep="\n"))

    def _print_Implies(self, claim: Implies) -> str:
        return " implies ".join(self._print(part) for part in claim.args)

    def _print_Iff(self, claim: Iff) -> str:
        return " if and only if ".join(self._print(part) for part in claim.args)

    def _print_PositiveDefinite(self, claim: PositiveDefinite) -> str:
        return f"{self._print(claim.args[0])} is positive definite"

    def _print_Partial(self, derivative: Partial) -> str:
        function, variable = (self._print(part) for part in derivative.args)
        return f"d {function}/d {variable}"


def latex(derivations: Sequence[Derivation]) -> str:
    """Subsections to be pasted into an article that loads amsmath and adjustbox."""
    return "\n\n".join(fragment(derivation) for derivation in derivations)


def data(derivations: Sequence[Derivation]) -> list[dict[str, object]]:
    """Plain data for JSON: formulas as LaTeX and as text."""
    return [
        {
            "label": derivation.label,
            "title": derivation.title,
            "problem": derivation.problem,
            "steps": [
                {
                    "title": step.title,
                    "rule": step.rule,
                    "statements": list(step.statements),
                    "latex": latex_of(step.formula),
                    "text": _Text().doprint(step.formula),
                }
                for step in derivation.steps
            ],
        }
        for derivation in derivations
    ]
