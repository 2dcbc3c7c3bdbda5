"""What a measurement stores, as JSON that can be drawn again without measuring again."""

from __future__ import annotations

import json
import math
import os
import platform
from dataclasses import asdict, dataclass, replace
from importlib.metadata import version
from pathlib import Path

from rodproof.codegen.files import write_text

FUNCTIONS = (
    "strains",
    "loads",
    "stored_energy",
    "complementary_energy",
    "stiffness",
    "compliance",
)


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
    """What was asked for: the same settings on the same code give the same errors."""

    seed: int
    quick: bool
    batches: int
    points: int
    rounds: int
    timed_points: int
    digest: str  # of the generated module that was measured


@dataclass(frozen=True)
class ErrorRow:
    """The error of one form of one function over one sample.

    Errors are in ulps of a double whatever the form's own precision; ``beyond`` is in ulps of the
    form's own precision: the worst error less what rounding its inputs and its output explains.
    None stands for an error that is not finite.
    """

    function: str
    form: str
    sample: str
    points: int
    failures: int
    worst: float | None
    median: float | None
    beyond: float | None
    over_eight: int
    inherent: float | None


@dataclass(frozen=True)
class TimeRow:
    """Time per point of one form of one function, and its ratio to the stable double form."""

    function: str
    form: str
    points: int
    nanoseconds: float
    ratio: float


@dataclass(frozen=True)
class Measurement:
    """A whole run; ``forms`` says in words what each form is."""

    machine: Machine
    settings: Settings
    forms: dict[str, str]
    errors: tuple[ErrorRow, ...] = ()
    times: tuple[TimeRow, ...] = ()

    def done(self) -> frozenset[str]:
        """The functions that need not be measured again."""
        return frozenset(row.function for row in self.times)

    def extended(self, errors: list[ErrorRow], times: list[TimeRow]) -> Measurement:
        return replace(self, errors=(*self.errors, *errors), times=(*self.times, *times))

    def error(self, function: str, form: str, sample: str) -> ErrorRow | None:
        keys = (function, form, sample)
        return next((e for e in self.errors if (e.function, e.form, e.sample) == keys), None)

    def time(self, function: str, form: str, points: int) -> TimeRow | None:
        keys = (function, form, points)
        return next((t for t in self.times if (t.function, t.form, t.points) == keys), None)


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
    """Store as JSON, one row a line."""
    record = asdict(measurement)
    lines = [f'"{key}": {json.dumps(record[key])}' for key in ("machine", "settings", "forms")]
    for key in ("errors", "times"):
        rows = ",\n".join("  " + json.dumps(row) for row in record[key])
        lines.append(f'"{key}": [\n{rows}\n]')
    write_text(path, "{\n" + ",\n".join(lines) + "\n}\n")


def load(path: Path) -> Measurement:
    """Read what ``save`` wrote; a ValueError says which file is not a measurement."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        return Measurement(
            machine=Machine(**record["machine"]),
            settings=Settings(**record["settings"]),
            forms=record["forms"],
            errors=tuple(ErrorRow(**row) for row in record["errors"]),
            times=tuple(TimeRow(**row) for row in record["times"]),
        )
    except OSError as error:
        raise ValueError(
            f"{path}: cannot be read ({error.strerror}); run `rodproof measure`"
        ) from None
    except (KeyError, TypeError, json.JSONDecodeError) as error:
        raise ValueError(f"{path}: not a measurement of rodproof ({error!r})") from None
