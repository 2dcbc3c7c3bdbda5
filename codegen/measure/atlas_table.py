"""The page of a stability atlas, and what a replayed spot says; from the data alone."""

from __future__ import annotations

from rodproof.codegen.measure.atlas import BOOK, OURS, Atlas, Look, Mark, Summary
from rodproof.codegen.measure.form import Answer
from rodproof.codegen.measure.spots import Axis, Spot, axes
from rodproof.codegen.measure.subjects import subject
from rodproof.codegen.measure.table import number
from rodproof.codegen.scene import CONSTANT_NAMES, LOAD_NAMES
from rodproof.derivations.symbols import STRAINS

HEAD = (
    "| function | spots | ours wrong | worst | median | single: worst | refused | out of range "
    "| textbook wrong | worst spot |\n|---" + "|---:" * 8 + "|---|"
)


def page(atlas: Atlas) -> str:
    """What was looked at and how, the named cases, then a table and a picture for each scene."""
    sections = [_scene(atlas, scene) for scene in atlas.scenes]
    return "\n\n".join([_preface(atlas), _cases(atlas), *sections]) + "\n"


def _preface(atlas: Atlas) -> str:
    spots = sum(row.spots for row in atlas.summaries)
    wrong = sum(row.wrong for row in atlas.summaries)
    size = "a quick look" if atlas.settings.quick else "all of it"
    machine = atlas.machine
    return f"""# Stability atlas

Made by `rodproof report` from the stored atlas beside this page: {size}, {spots:,} spots.
Ours is wrong at {wrong} of them. Machine: {machine.processor}, {machine.system}, Python
{machine.python}, NumPy {machine.numpy}, python-flint {machine.flint}.

Each function of each scene is held against ball arithmetic over three maps: the exponent p and the
distance to the strain limit (Q from 1e-300 to 1 - 1e-15, y/gamma from 1e-160 to 1e160); gamma from
1e-100 to 1e100 and the size of the load from zero and the subnormal numbers to 1e160; the coupling
up to a relative gap of 1e-15 from its bound and the moduli scaled by 1e-100 to 1e100. What a map
leaves open is drawn at random, with the same seed each time. In single precision the exponents are
divided by eight.

An answer is right if its error is at most 8 ulps beyond what is inherent: what the rounding of the
answer and one ulp of each input explain. *Worst* and *median* are in ulps beyond that, *refused*
counts the spots without an answer where ours refuses (strains at or past the limit), *out of range*
those whose answer no number of the precision holds. `rodproof measure --replay SPOT` computes a
spot again and shows the answer, the truth and the error. `loads_and_stiffness` is measured by its
stiffness and `strains_and_gap` by its gap: the rest is that of the other functions to the bit."""


def _cases(atlas: Atlas) -> str:
    rows = [f"| {c.title} | {c.function} | {c.what} | {c.detail} |" for c in atlas.cases]
    head = "| case | function | what happens | detail |\n|---|---|---|---|"
    return "## Stiff and extreme cases, full_rod\n\n" + "\n".join([head, *rows])


def _scene(atlas: Atlas, scene: str) -> str:
    rows = [row for row in atlas.summaries if row.scene == scene]
    functions = dict.fromkeys(row.function for row in rows)
    lines = [_row([row for row in rows if row.function == function]) for function in functions]
    picture = f"![where {scene} is right, and where the textbook is](atlas-{scene}.png)"
    return f"## {scene}\n\n{HEAD}\n" + "\n".join(lines) + f"\n\n{picture}"


def _row(rows: list[Summary]) -> str:
    double = next(row for row in rows if row.precision == "float64")
    single = next(row for row in rows if row.precision == "float32")
    cells = [
        double.function,
        str(double.spots + single.spots),
        str(double.wrong + single.wrong),
        number(double.worst),
        number(double.median),
        number(single.worst),
        str(double.refused + single.refused),
        str(double.beyond_range + single.beyond_range),
        f"{double.book_wrong} of {double.spots}",
        f"`{double.worst_spot}`",
    ]
    return "| " + " | ".join(cells) + " |"


def story(look: Look) -> list[tuple[str, str]]:
    """What happens at a spot, as rows of two columns."""
    spot, one = look.spot, subject(look.spot.scene)
    across, up = axes(one, spot.function, spot.precision, spot.chart)
    point = spot.point
    names = LOAD_NAMES if one.side(spot.function) == "loads" else tuple(s.name for s in STRAINS)
    constants = zip(CONSTANT_NAMES, point.constants, strict=True)
    values = zip(names, (*point.first[:, 0], *point.second[:, 0]), strict=True)
    rows = [
        ("spot", spot.name),
        ("map", f"{spot.chart}: " + _place(spot, across, up)),
        (
            "constants",
            ", ".join(f"{name} = {value!r}" for name, value in constants if name in one.constants),
        ),
        ("point", ", ".join(f"{name} = {float(value)!r}" for name, value in values)),
    ]
    if look.truth is None:
        rows += [("truth", "none: the strain is at the limit or past it")]
    else:
        at = one.places(spot.function)
        exact = [look.truth.value[k] for k in at]
        shift = look.truth.part == "strains" and 5 in one.strains
        exact = [*exact[:-1], exact[-1] + 1] if shift else exact
        rows += [("truth", ", ".join(entry.str(20, radius=False) for entry in exact))]
    rows += [("generated", _answer(look.ours))]
    rows += [("textbook", _answer(look.textbook))] if spot.precision == "float64" else []
    if look.truth is not None and look.truth.representable:
        error = look.truth.error(look.ours)
        rows += [("error", f"{error:.4g} ulps"), ("inherent", f"{look.truth.inherent:.4g} ulps")]
    rows += [(f"mark of {OURS[spot.precision]}", _mark(look.mark))]
    rows += [(f"mark of {BOOK}", _mark(look.book_mark))] if spot.precision == "float64" else []
    return rows


def _place(spot: Spot, across: Axis, up: Axis) -> str:
    column, row = across.labels[spot.column], up.labels[spot.row]
    return f"{across.name} {column}, {up.name} {row}"


def _mark(mark: Mark) -> str:
    if isinstance(mark, float):
        return f"{mark:.4g} ulps beyond the inherent error"
    said = {"nan": "no number", "refused": "refused, as it should be"}
    return said.get(mark, "no number of the precision holds the answer")


def _answer(answer: Answer) -> str:
    if answer is None:
        return "refused or failed"
    return ", ".join(repr(float(entry)) for entry in answer)
