"""What a measurement stores, as JSON that can be drawn again without measuring again."""

from __future__ import annotations

import json
import math
import os
import platform
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeVar

from rodproof.codegen.files import write_text

Row = TypeVar("Row")
#: The table of a file from before there was one of that name.
NONE: dict[str, Any] = {"columns": [], "rows": []}


@dataclass(frozen=True)
class Machine:
    """Where it was measured, in words that name the processor and not the host."""

    processor: str
    cores: int
    system: str
    python: str
    numpy: str
    sympy: str
    mpmath: str
    flint: str


@dataclass(frozen=True)
class Settings:
    """What was asked for: the same settings on the same code give the same errors.

    ``batches`` sets of constants with ``points`` points each for every kind of input.
    """

    seed: int
    quick: bool
    batches: int
    points: int
    rounds: int
    timed_points: int


@dataclass(frozen=True)
class ErrorRow:
    """The error of one form of one function of a scene over one sample.

    Errors are in ulps of a double whatever the form's own precision; ``beyond`` is in ulps of the
    form's own precision: the worst error less what rounding its inputs and its output explains.
    None stands for an error that is not finite.
    """

    scene: str
    function: str
    form: str
    sample: str
    points: int
    failures: int
    worst: float | None
    median: float | None
    beyond: float | None
    over_eight: int


@dataclass(frozen=True)
class TimeRow:
    """Time per point of one form of one function, and its ratio to the stable double form."""

    scene: str
    function: str
    form: str
    points: int
    nanoseconds: float
    ratio: float


@dataclass(frozen=True)
class Missing:
    """A form that could not be had, where (everywhere if that is empty), and why."""

    form: str
    where: str
    why: str


@dataclass(frozen=True)
class Measurement:
    """A whole run; ``forms`` says in words what each form is, ``scenes`` each module's digest."""

    machine: Machine
    settings: Settings
    forms: dict[str, str]
    scenes: dict[str, str]
    errors: tuple[ErrorRow, ...] = ()
    times: tuple[TimeRow, ...] = ()
    missing: tuple[Missing, ...] = ()

    def functions(self, scene: str) -> tuple[str, ...]:
        """The functions of a scene that were measured, in order."""
        return tuple(dict.fromkeys(row.function for row in self.times if row.scene == scene))

    def samples(self, scene: str) -> tuple[str, ...]:
        """The kinds of input of a scene, in order."""
        return tuple(dict.fromkeys(row.sample for row in self.errors if row.scene == scene))

    @cached_property
    def _errors(self) -> dict[tuple[str, str, str, str], ErrorRow]:
        return {(e.scene, e.function, e.form, e.sample): e for e in self.errors}

    @cached_property
    def _times(self) -> dict[tuple[str, str, str, int], TimeRow]:
        return {(t.scene, t.function, t.form, t.points): t for t in self.times}

    def error(self, scene: str, function: str, form: str, sample: str) -> ErrorRow | None:
        return self._errors.get((scene, function, form, sample))

    def time(self, scene: str, function: str, form: str, points: int) -> TimeRow | None:
        return self._times.get((scene, function, form, points))


def finite(value: float) -> float | None:
    """The value at four digits, or None (JSON has no infinity)."""
    return float(f"{value:.4g}") if math.isfinite(value) else None


def this_machine() -> Machine:
    """Processor, cores and versions."""
    return Machine(
        processor=_processor(),
        cores=os.cpu_count() or 1,
        system=f"{platform.system()} {platform.machine()}",
        python=platform.python_version(),
        numpy=version("numpy"),
        sympy=version("sympy"),
        mpmath=version("mpmath"),
        flint=version("python-flint"),
    )


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or "unknown"
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or "unknown")


def save(measurement: Measurement, path: Path) -> None:
    """Store as JSON, one row a line; the rows are lists under the names of their columns."""
    record = asdict(measurement)
    parts = [
        f'"{key}": {json.dumps(record[key])}' for key in ("machine", "settings", "forms", "scenes")
    ]
    parts += [
        table_text("errors", ErrorRow, measurement.errors),
        table_text("times", TimeRow, measurement.times),
        table_text("missing", Missing, measurement.missing),
    ]
    write_text(path, "{\n" + ",\n".join(parts) + "\n}\n")


def table_text(name: str, kind: type[Any], rows: Sequence[Any]) -> str:
    """Records as a JSON entry: columns once, then a line a record."""
    columns = [field.name for field in fields(kind)]
    lines = [json.dumps([getattr(row, column) for column in columns]) for row in rows]
    body = ",\n".join(f"  {line}" for line in lines)
    return f'"{name}": {{"columns": {json.dumps(columns)}, "rows": [\n{body}\n]}}'


def rows_of(kind: type[Row], entry: dict[str, Any]) -> tuple[Row, ...]:
    """The records of a stored table."""
    columns = entry["columns"]
    return tuple(kind(**dict(zip(columns, row, strict=True))) for row in entry["rows"])


def load(path: Path) -> Measurement:
    """Read what ``save`` wrote; a ValueError says which file is not a measurement."""
    record = read(path, "measurement", "rodproof measure")
    try:
        return Measurement(
            machine=Machine(**record["machine"]),
            settings=Settings(**record["settings"]),
            forms=record["forms"],
            scenes=record["scenes"],
            errors=rows_of(ErrorRow, record["errors"]),
            times=rows_of(TimeRow, record["times"]),
            missing=rows_of(Missing, record.get("missing", NONE)),
        )
    except KeyError as key:
        wanted = "what `rodproof measure` writes is drawn, and of `--atlas` and `--integrators`"
        raise ValueError(f"{path}: not a measurement: it holds no {key}; {wanted}") from None
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: not a measurement of rodproof ({error!r})") from None


def read(path: Path, what: str, command: str) -> Any:
    """The JSON of a file; a ValueError names the command that makes one."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror}); run `{command}`") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"{path}: not a {what} of rodproof ({error!r})") from None
