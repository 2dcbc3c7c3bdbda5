"""The page of a measurement, in Markdown, from the stored data alone."""

from __future__ import annotations

from rodproof.codegen.measure.fronts import WANTED, Mark, marks, winner
from rodproof.codegen.measure.records import ErrorRow, Measurement

SAMPLES = ("ordinary", "extreme", "limit", "chiral")
COLUMNS = ("form", "ns/point", "ratio", "one point, µs", *SAMPLES, "beyond", "no number")
HEAD = f"| {' | '.join(COLUMNS)} |\n|---{'|---:' * (len(COLUMNS) - 1)}|"


def page(measurement: Measurement) -> str:
    """What was measured and how, then for each scene its front, its winners and its tables."""
    parts = [_preface(measurement)]
    for scene in measurement.scenes:
        parts += [f"## {scene}", f"![error against time, {scene}](front-{scene}.svg)"]
        parts += [_winners(measurement, scene)]
        parts += [
            _section(measurement, scene, function) for function in measurement.functions(scene)
        ]
    return "\n\n".join(parts) + "\n"


def _preface(measurement: Measurement) -> str:
    machine, asked = measurement.machine, measurement.settings
    forms = "\n".join(f"- **{name}**: {words}" for name, words in measurement.forms.items())
    size = "a quick look without the peers" if asked.quick else "a full measurement"
    absent = "".join(
        f"\n- {row.form}{f', {row.where}' if row.where else ''}: {row.why}"
        for row in measurement.missing
    )
    forms += f"\n\nNot measured here:\n{absent}" if absent else ""
    return f"""# Error and run time of every scene and function

Made by `rodproof report` from the stored measurement beside this page: {size}, with seed
{asked.seed}, {asked.batches * asked.points} points for each kind of input, times as the median of
{asked.rounds} interleaved rounds on blocks of {asked.timed_points} points, taken alone. Machine:
{machine.processor}, {machine.cores} cores, one thread, {machine.system}, Python {machine.python},
NumPy {machine.numpy}, SymPy {machine.sympy}, mpmath {machine.mpmath}, python-flint {machine.flint}.

Forms, each given the scene as it is (lost components, fixed constants, the constrained law):

{forms}

Errors are `worst / median` in ulps of a double, normwise in whitened coordinates, against ball
arithmetic at the exact inputs. *beyond* is the worst error over all kinds of input that neither the
rounding of the answer nor a change of each input by one ulp explains, in ulps of the form's own
precision; *no number* counts the points answered with nan, inf or a refusal. Single precision has
its own inputs, within its own range. `loads_and_stiffness` is measured by its stiffness and
`strains_and_gap` by its gap; the rest of what they return is that of the other functions to the
bit. Where the front says *all inputs*, it is of the error beyond what is inherent."""


def _winners(measurement: Measurement, scene: str) -> str:
    """The cheapest form for a given accuracy, on ordinary inputs and on all."""
    kinds = [("ordinary", wanted) for wanted in WANTED] + [("all", wanted) for wanted in WANTED]
    names = [f"{kind}, {wanted:.0e}" if wanted > 8 else f"{kind}, 8" for kind, wanted in kinds]
    lines = [f"| function | {' | '.join(names)} |", "|---" * (len(names) + 1) + "|"]
    for function in measurement.functions(scene):
        found = {
            "ordinary": marks(measurement, scene, function, "ordinary"),
            "all": marks(measurement, scene, function, "all"),
        }
        cells = [_winner(found[kind], wanted) for kind, wanted in kinds]
        lines.append(f"| {function} | {' | '.join(cells)} |")
    said = (
        "The cheapest form whose worst error is at most so many ulps, with its ns a point; after "
        "a stroke\nthe cheapest that needs neither a compiler nor another library:"
    )
    return said + "\n\n" + "\n".join(lines)


def _winner(found: list[Mark], wanted: float) -> str:
    marks = (winner(found, wanted), winner(found, wanted, plain=True))
    said = [f"{mark.form} ({number(mark.time)})" if mark else "none" for mark in marks]
    return " / ".join(dict.fromkeys(said))


def _section(measurement: Measurement, scene: str, function: str) -> str:
    known = [f for f in measurement.forms if measurement.time(scene, function, f, 1)]
    rows = [_row(measurement, scene, function, form) for form in known]
    return f"### {scene}.{function}\n\n{HEAD}\n" + "\n".join(rows)


def _row(measurement: Measurement, scene: str, function: str, form: str) -> str:
    block = measurement.time(scene, function, form, measurement.settings.timed_points)
    single = measurement.time(scene, function, form, 1)
    errors = [measurement.error(scene, function, form, sample) for sample in SAMPLES]
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
