"""The errata as Markdown, written so that an author could paste them into a corrigendum."""

from __future__ import annotations

from collections.abc import Sequence

from rodproof.derivations.records import Evidence

_PREFACE = (
    "Written by `rodproof errata --out`; every entry is decided by the derivation, and each "
    "corrected statement is itself proved."
)


def render(evidence: Sequence[Evidence]) -> str:
    """Refuted statements with counterexample and correction, then the readings."""
    refuted = [e for e in evidence if e.verdict == "refuted"]
    readings = [e for e in evidence if e.verdict == "reading"]
    parts = [
        "# Errata",
        _PREFACE,
        (
            f"{len(refuted)} statements are false as printed, "
            f"{len(readings)} are true under a reading."
        ),
        "## False as printed",
        *(_refuted(e) for e in refuted),
        "## True under a reading",
        *(_reading(e) for e in readings),
    ]
    return "\n\n".join(parts) + "\n"


def _heading(e: Evidence) -> str:
    label = f", {e.label}" if e.label != "-" else ""
    return f"### `{e.id}` (Section {e.section}{label})\n\n{e.claim}"


def _refuted(e: Evidence) -> str:
    lines = [_heading(e)]
    if e.latex:
        lines.append(f"As printed:\n\n$$ {e.latex} $$")
    lines.append(f"False: {e.counterexample}.")
    lines.append(f"Corrected:\n\n$$ {e.correction_latex} $$")
    proof = f"The corrected statement is proved: {e.method}."
    if e.repaired_by:
        proof += f" The smallest repair: {e.repaired_by}."
    lines.append(proof)
    if e.note:
        lines.append(e.note)
    return "\n\n".join(lines)


def _reading(e: Evidence) -> str:
    lines = [_heading(e)]
    if e.latex:
        lines.append(f"As printed:\n\n$$ {e.latex} $$")
    lines.append(f"Reading: {e.reading}")
    if e.counterexample:
        lines.append(f"Without it: {e.counterexample}.")
    lines.append(f"Under the reading: {e.method}.")
    if e.note:
        lines.append(e.note)
    return "\n\n".join(lines)
