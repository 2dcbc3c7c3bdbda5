"""The derivation as a LaTeX article: chapters, then every printed statement with its verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby

from rodproof.codegen.document.tex import display, escape, prose
from rodproof.derivations import chapters
from rodproof.derivations.latex import rows
from rodproof.derivations.records import VERDICTS, Derivation, Evidence, Step

_MARKS = {
    "definition": r"\verdict{gray}{definition}",
    "proved": r"\verdict{OliveGreen}{proved}",
    "checked": r"\verdict{Cerulean}{checked}",
    "reading": r"\verdict{BurntOrange}{reading}",
    "refuted": r"\verdict{BrickRed}{refuted}",
    "undecided": r"\verdict{black}{undecided}",
}

_PREAMBLE = r"""% Written by `rodproof document`; do not edit.
\documentclass[11pt]{article}
\usepackage[T1]{fontenc}
\usepackage[utf8]{inputenc}
\usepackage{lmodern}
\usepackage[a4paper,margin=27mm]{geometry}
\usepackage{amsmath,amssymb}
\usepackage{adjustbox}
\usepackage{booktabs}
\usepackage[dvipsnames]{xcolor}
\usepackage{microtype}
\usepackage[hidelinks]{hyperref}
\newcommand{\verdict}[2]{{\footnotesize\sffamily\bfseries\textcolor{#1}{#2}}}
\newcommand{\sid}[1]{{\small\ttfamily #1}}
\setlength{\parindent}{0pt}
\setlength{\parskip}{4pt plus 1pt}
\emergencystretch=3em
\title{A strain-limiting special Cosserat rod:\\derivation and proof check}
\author{Written by rodproof}
\date{}
\begin{document}
\maketitle
"""

_SYMBOLS = (
    (r"\alpha", "length", "bounds the flexure by $1/\\alpha$; bending modulus $\\gamma\\alpha^2$"),
    (r"\beta", "length", "twisting modulus $\\gamma\\beta^2$"),
    (r"\gamma", "force", "scale of force at which the law leaves its linear range"),
    (r"\zeta", "1", "bounds the shear by $1/\\zeta$; shearing modulus $\\gamma\\zeta^2$"),
    (r"\eta", "1", "dilatational modulus $\\gamma\\eta^2$"),
    (r"\iota", "length", "coupling of twist and dilatation; its sign is the chirality"),
    (r"p", "1", "sharpness of the passage to the limit"),
    (r"u_1, u_2, u_3", "1/length", "flexural strains and twist, in the directors"),
    (r"v_1, v_2, v_3", "1", "shear strains and dilatation strain, in the directors"),
    (r"m_1, m_2, m_3", "force $\\times$ length", "bending couples and twisting couple"),
    (r"n_1, n_2, n_3", "force", "shear forces and tension"),
    (r"Q, Q^*", r"1, force$^2$", "quadratic forms of strains and of loads"),
    (r"x, y", "1, force", "their roots, the strain radius and the load radius"),
    (r"W, W^*", "force", "stored and complementary energy per reference length"),
)

_BIBLIOGRAPHY = r"""
\begin{thebibliography}{9}
\bibitem{paper} K.~R. Rajagopal and C.~Rodriguez.
  \emph{On an elastic strain-limiting special Cosserat rod model}.
\bibitem{antman} S.~S. Antman. \emph{Nonlinear Problems of Elasticity}, 2nd ed.
  Springer, 2005. Chapter 8.
\end{thebibliography}
"""


def render(evidence: Sequence[Evidence]) -> str:
    """The whole article."""
    verdicts = {e.id: e for e in evidence}
    parts = [
        _PREAMBLE,
        _summary(evidence),
        r"\tableofcontents",
        _symbols(),
        r"\section{Derivation}",
        *(derivation(chapters.derive(label), verdicts) for label in chapters.labels()),
        r"\section{The printed statements}",
        *_sections(evidence),
        r"\appendix",
        r"\section{Errata}",
        *(_statement(e) for e in evidence if e.verdict == "refuted"),
        r"\section{Readings}",
        *(_statement(e) for e in evidence if e.verdict == "reading"),
        _BIBLIOGRAPHY,
        r"\end{document}",
    ]
    return "\n\n".join(parts) + "\n"


def fragment(found: Derivation) -> str:
    """One derivation as LaTeX to paste (needs amsmath and adjustbox)."""
    return derivation(found, {})


def _summary(evidence: Sequence[Evidence]) -> str:
    counts = Counter(e.verdict for e in evidence)
    listed = ", ".join(f"{counts[v]} {v}" for v in VERDICTS if counts[v])
    return (
        r"\begin{abstract}" + "\n"
        f"{len(evidence)} statements of the paper~\\cite{{paper}} are held against a derivation "
        f"from first principles: {listed}. Every step of the derivation is proved exactly, with "
        "symbolic $p$ and symbolic constants, and confirmed by a second, numerical route at 50 "
        "digits where it has one. What is false as printed stands beside its correction in the "
        "text and is collected, with counterexamples, in the appendix.\n" + r"\end{abstract}"
    )


def _symbols() -> str:
    lines = [rf"${symbol}$ & {unit} & {meaning} \\" for symbol, unit, meaning in _SYMBOLS]
    return (
        "\\section{Symbols}\n\\begin{tabular}{@{}lll@{}}\n\\toprule\nsymbol & unit & meaning \\\\\n"
        "\\midrule\n" + "\n".join(lines) + "\n\\bottomrule\n\\end{tabular}"
    )


def derivation(found: Derivation, verdicts: dict[str, Evidence]) -> str:
    """One derivation: the problem, then its steps as numbered displays."""
    steps = "\n\n".join(
        _step(step, f"{found.label}-{k}", verdicts) for k, step in enumerate(found.steps, 1)
    )
    return (
        rf"\subsection{{{prose(found.title)}}}\label{{{found.label}}}" + "\n"
        rf"\emph{{Problem.}} {prose(found.problem)}" + "\n\n" + steps
    )


def _step(step: Step, label: str, verdicts: dict[str, Evidence]) -> str:
    settled = ", ".join(_reference(name, verdicts.get(name)) for name in step.statements)
    return "\n".join(
        (
            rf"\textbf{{{prose(step.title)}.}} {prose(step.rule)}",
            display(rows(step.formula), label),
            rf"{{\small\raggedright Settles {settled}.\par}}" if settled else "",
        )
    )


def _reference(name: str, evidence: Evidence | None) -> str:
    label = f" ({escape(evidence.label)})" if evidence and evidence.label != "-" else ""
    mark = f" {_MARKS[evidence.verdict]}" if evidence else ""
    return rf"\sid{{{escape(name)}}}{label}{mark}"


def _sections(evidence: Sequence[Evidence]) -> Iterable[str]:
    for section, found in groupby(evidence, key=lambda e: e.section):
        yield rf"\subsection*{{Section {section} of the paper}}"
        yield from (_statement(e) for e in found)


def _statement(e: Evidence) -> str:
    """As printed, the verdict, what it rests on, and what is to be corrected or read."""
    lines = [rf"\textbf{{{_reference(e.id, e)}}} {prose(e.claim)}"]
    if e.latex:
        lines.append(display((e.latex,)))
    if e.verdict != "definition" or e.residual is not None:
        lines.append(rf"{{\small {_rests_on(e)}}}" + "\n")
    if e.counterexample:
        lines.append(rf"\emph{{False}} {prose(e.counterexample)}." + "\n")
    if e.correction_latex:
        lines += [r"\emph{Corrected:}", display((e.correction_latex,))]
    if e.reading:
        lines.append(rf"\emph{{Reading.}} {prose(e.reading)}" + "\n")
    if e.note:
        lines.append(rf"\emph{{Note.}} {prose(e.note)}" + "\n")
    return "\n".join(lines)


def _rests_on(e: Evidence) -> str:
    text = f"Rests on: {prose(e.method)}."
    if e.residual is not None:
        size = "0" if e.residual == 0 else rf"{e.residual:.0e}"
        text += f" Second route ({prose(e.route or '')}): largest relative residual {size}."
    return text
