"""The whole flow of ``rodproof run``: five calls in a row, each handing a record to the next.

derive    ()                 -> Derivation ...   what is true, step by step
check     (statements)       -> Evidence ...     the verdict on each printed statement
generate  (scenes)           -> files            generated/, from the derivation
document  (evidence)         -> files            the derivation with its verdicts: LaTeX, site
measure   (generated module) -> files            error against run time, JSON first, then pages
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from rodproof.codegen import document, generate, site
from rodproof.codegen.places import Places
from rodproof.codegen.show import Tell
from rodproof.derivations import chapters, ledger
from rodproof.derivations.records import Derivation, Evidence


@dataclass(frozen=True)
class Outcome:
    """What a run did and where it lies."""

    derived: tuple[Derivation, ...]
    evidence: tuple[Evidence, ...]
    generated: tuple[Path, ...]
    documents: tuple[Path, ...]
    reports: tuple[Path, ...]


#: Opens the progress of a stage by its name.
Stage = Callable[[str], AbstractContextManager[Tell]]


def run(places: Places, jobs: int, stage: Stage) -> Outcome:
    """Derive, check, generate, document, measure."""
    derived = derive(stage)
    evidence = check(jobs, stage)
    generated = write_modules(places, stage)
    documents = write_documents(places, evidence, stage)
    reports = measure(places, jobs, stage)
    return Outcome(derived, evidence, generated, documents, reports)


def derive(stage: Stage) -> tuple[Derivation, ...]:
    """Every derivation of the theory."""
    labels = chapters.labels()
    with stage("derive") as tell:
        derived = []
        for done, label in enumerate(labels):
            tell(label, done, len(labels))
            derived.append(chapters.derive(label))
        tell("", len(labels), len(labels))
    return tuple(derived)


def check(jobs: int, stage: Stage) -> tuple[Evidence, ...]:
    """The verdict on every printed statement; mutants are the tests' business."""
    with stage("check") as tell:
        return ledger.check(ledger.statements(), mutants=False, jobs=jobs, progress=tell)


def write_modules(places: Places, stage: Stage) -> tuple[Path, ...]:
    """Rewrite ``generated/``."""
    with stage("generate") as tell:
        tell("modules", 0, 1)
        written = tuple(generate.write(places.generated, verdicts=ledger.recorded()))
        tell("", 1, 1)
    return written


def write_documents(
    places: Places, evidence: tuple[Evidence, ...], stage: Stage
) -> tuple[Path, ...]:
    """The derivation with its verdicts, and the first page of the site."""
    with stage("document") as tell:
        tell("derivation", 0, 2)
        written = document.write(places.documents, evidence)
        tell("site", 1, 2)
        written.append(site.write(places.site, evidence))
        tell("", 2, 2)
    return tuple(written)


def measure(places: Places, jobs: int, stage: Stage) -> tuple[Path, ...]:
    """A quick measurement to JSON, the report drawn from it, and pictures of the rod."""
    from rodproof.codegen import pictures  # what is drawn and measured is new just now
    from rodproof.codegen.measure import report, survey

    data = places.measurement(quick=True)
    with stage("measure") as tell:
        survey.measure(data, survey.settings(quick=True), tell, jobs=jobs)
    return (data, *report.report(data, data.parent), *pictures.draw(data.parent))
