"""The page of a measurement, in Markdown, from the stored data alone."""

from __future__ import annotations

from rodproof.codegen.measure.records import FUNCTIONS, ErrorRow, Measurement

SAMPLES = ("ordinary", "extreme", "limit", "chiral")
COLUMNS = ("form", "ns/point", "ratio", "one point, µs", *SAMPLES, "beyond", "no number")
HEAD = f"| {' | '.join(COLUMNS)} |\n|---{'|---:' * (len(COLUMNS) - 1)}|"


def page(measurement: Measurement) -> str:
    """What was measured and how, then a table for each function."""
    parts = [_preface(measurement), *(_section(measurement, function) for function in FUNCTIONS)]
    return "\n\n".join(parts) + "\n"


def _preface(measurement: Measurement) -> str:
    machine, asked = measurement.machine, measurement.settings
    forms = "\n".join(f"- **{name}**: {words}" for name, words in measurement.forms.items())
    size = "a quick look" if asked.quick else "a full measurement"
    return f"""# Error and run time of the scene full_rod

Made by `rodproof report` from the stored measurement beside this page: {size} of the module
whose SHA-256 begins with {asked.digest[:8]}, with seed {asked.seed},
{asked.batches * asked.points} points for each kind of input, times as the median of
{asked.rounds} interleaved rounds. Machine: {machine.processor}, {machine.cores} cores,
one thread, {machine.system}, Python {machine.python}, NumPy {machine.numpy}, SymPy {machine.sympy},
mpmath {machine.mpmath}, python-flint {machine.flint}.

Forms:

{forms}

Errors are `worst / median` in ulps of a double, normwise in whitened coordinates, against ball
arithmetic at the exact inputs. *beyond* is the worst error over all four kinds of input that
neither the rounding of the answer nor a change of each input by one ulp explains, in ulps of the
form's own precision; *no number* counts the points answered with nan, inf or a refusal. Single
precision has its own inputs, within its own range.

![error against time, ordinary inputs](front-ordinary.svg)
![error against time, extreme inputs](front-extreme.svg)"""


def _section(measurement: Measurement, function: str) -> str:
    rows = [_row(measurement, function, form) for form in measurement.forms]
    return f"## {function}\n\n{HEAD}\n" + "\n".join(rows)


def _row(measurement: Measurement, function: str, form: str) -> str:
    block = measurement.time(function, form, measurement.settings.timed_points)
    single = measurement.time(function, form, 1)
    errors = [measurement.error(function, form, sample) for sample in SAMPLES]
    known = [error for error in errors if error]
    cells = [
        form,
        number(block.nanoseconds if block else None),
        number(block.ratio if block else None),
        number(single.nanoseconds / 1000 if single else None),
        *(_error(error) for error in errors),
        _worst_beyond(known),
        str(sum(error.failures for error in known)),
    ]
    return "| " + " | ".join(cells) + " |"


def _error(error: ErrorRow | None) -> str:
    return f"{number(error.worst)} / {number(error.median)}" if error else "–"


def _worst_beyond(errors: list[ErrorRow]) -> str:
    values = [error.beyond for error in errors]
    if any(value is None for value in values):
        return "∞"
    return number(max(value for value in values if value is not None))


def number(value: float | None) -> str:
    """Three digits, plain where that reads well; infinity where there is no number."""
    if value is None:
        return "∞"
    if value == 0 or 1e-2 <= abs(value) < 1e5:
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"
    return f"{value:.1e}"
