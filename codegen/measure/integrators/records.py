"""What a study of integrators stores: JSON to draw from; and what its parts are kept under."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, astuple, dataclass, fields
from importlib.metadata import version
from pathlib import Path
from typing import Any

from rodproof.codegen.files import write_text
from rodproof.codegen.measure.integrators import extrapolation, problems, reference, runs, taylor
from rodproof.codegen.measure.integrators.problems import Problem, grid
from rodproof.codegen.measure.integrators.reference import Reference
from rodproof.codegen.measure.integrators.runs import BUDGET, TOLERANCES, Run
from rodproof.codegen.measure.records import this_machine
from rodproof.codegen.measure.store import digest
from rodproof.generated.equilibria import directors, euler_angles

#: What decides a result: another digest, another study.
SOURCES = (directors, euler_angles, problems, taylor, extrapolation, reference, runs)
COLUMNS = tuple(field.name for field in fields(Run))


@dataclass(frozen=True)
class Settings:
    """What was asked for, of which code, and where."""

    quick: bool
    tolerances: tuple[float, ...]
    budget: int
    digest: str
    scipy: str
    machine: dict[str, Any]


@dataclass(frozen=True)
class Study:
    """A whole study: the rods, what is known of their far ends, and every integration."""

    settings: Settings
    problems: tuple[Problem, ...]
    references: tuple[Reference, ...]
    runs: tuple[Run, ...]

    def of(self, problem: Problem, equations: str, method: str) -> list[Run]:
        """The runs of a cell, from the loosest tolerance on."""
        wanted = (problem.name, equations, method)
        return [run for run in self.runs if (run.problem, run.equations, run.method) == wanted]


def settings(*, quick: bool) -> Settings:
    """A quick look (under half a minute), or the full study."""
    code = hashlib.sha256()
    for module in SOURCES:
        code.update(Path(str(module.__file__)).read_bytes())
    return Settings(
        quick=quick,
        tolerances=(1e-3, 1e-6, 1e-9) if quick else TOLERANCES,
        budget=2000 if quick else BUDGET,
        digest=code.hexdigest()[:16],
        scipy=version("scipy"),
        machine=asdict(this_machine()),
    )


def key(asked: Settings, *what: str) -> str:
    """What decides a result that is kept: the settings, with the code, and what it is of."""
    return digest("integrators", asdict(asked), *what)


def reference_of(row: dict[str, Any]) -> Reference:
    """A reference from its stored row."""
    return Reference(**_tuples(row))


def save(study: Study, path: Path) -> None:
    """Store as JSON, one row a line."""
    place = {problem.name: k for k, problem in enumerate(study.problems)}
    rows: dict[str, list[Any]] = {
        "problems": [asdict(problem) for problem in study.problems],
        "references": [asdict(known) for known in study.references],
        "runs": [[place[run.problem], *astuple(run)[1:]] for run in study.runs],
    }
    lines = [
        f'"settings": {json.dumps(asdict(study.settings))}',
        f'"columns": {json.dumps(COLUMNS)}',
        *(f'"{name}": [\n{_rows(found)}\n]' for name, found in rows.items()),
    ]
    write_text(path, "{\n" + ",\n".join(lines) + "\n}\n")


def load(path: Path) -> Study:
    """Read what ``save`` wrote; a ValueError says which file is no study of integrators."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        found = tuple(Problem(**row) for row in record["problems"])
        return Study(
            Settings(**_tuples(record["settings"])),
            found,
            tuple(map(reference_of, record["references"])),
            tuple(Run(found[place].name, *values) for place, *values in record["runs"]),
        )
    except OSError as error:
        raise ValueError(
            f"{path}: cannot be read ({error.strerror}); run `rodproof measure --integrators`"
        ) from None
    except (KeyError, TypeError, IndexError, json.JSONDecodeError) as error:
        raise ValueError(f"{path}: not a study of integrators ({error!r})") from None


def rods(asked: Settings) -> tuple[Problem, ...]:
    """The rods of a quick look or of the full study."""
    return grid(quick=asked.quick)


def _rows(found: list[Any]) -> str:
    return ",\n".join("  " + json.dumps(row) for row in found)


def _tuples(row: dict[str, Any]) -> dict[str, Any]:
    return {name: tuple(x) if isinstance(x, list) else x for name, x in row.items()}
