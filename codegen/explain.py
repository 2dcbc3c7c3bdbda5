"""A derivation for a reader: as text, as LaTeX to paste, or as data."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp

from rodproof.derivations.latex import latex as latex_of
from rodproof.derivations.records import Derivation, Step

Format = Callable[[Sequence[Derivation]], str]


def text(derivations: Sequence[Derivation]) -> str:
    """Each step as a sentence with its formulas below."""
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
    formulas = (sp.pretty(formula, wrap_line=False) for formula in step.formulas)
    lines = "\n\n".join(formulas).splitlines()
    return "\n".join(
        [
            f"\n{number}. {step.title}{settles}",
            f"   {step.rule}",
            *(f"      {line}" for line in lines),
        ]
    )


def latex(derivations: Sequence[Derivation]) -> str:
    """Sections with numbered steps, to be pasted into an article that loads amsmath."""
    return "\n\n".join(_section_latex(derivation) for derivation in derivations)


def _section_latex(derivation: Derivation) -> str:
    steps = [
        "\n".join(
            [
                rf"\item {step.title}: {step.rule}",
                *(rf"\[ {latex_of(formula)} \]" for formula in step.formulas),
            ]
        )
        for step in derivation.steps
    ]
    listed = "\n".join([r"\begin{enumerate}", *steps, r"\end{enumerate}"])
    return f"\\subsection*{{{derivation.title}}}\n{derivation.problem}\n{listed}"


def data(derivations: Sequence[Derivation]) -> list[dict[str, object]]:
    """Plain data for JSON: formulas as LaTeX and as SymPy text."""
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
                    "latex": [latex_of(formula) for formula in step.formulas],
                    "sympy": [str(formula) for formula in step.formulas],
                }
                for step in derivation.steps
            ],
        }
        for derivation in derivations
    ]
