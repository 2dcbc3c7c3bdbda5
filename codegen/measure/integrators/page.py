"""The page of a study of integrators, in Markdown, from the stored data alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from statistics import median

from rodproof.codegen.measure.integrators import plot
from rodproof.codegen.measure.integrators.problems import CONSTANTS, COUPLE, PHI, PSI, Problem
from rodproof.codegen.measure.integrators.records import Study
from rodproof.codegen.measure.integrators.runs import (
    DONE,
    EQUATIONS,
    GAVE_UP,
    METHODS,
    REFUSED,
    SKIPPED,
    STALLED,
    Run,
)

#: Accuracies for which the fastest way is named.
WANTED = (1e-3, 1e-6, 1e-9, 1e-12)
#: An error so many times the tolerance was not controlled.
FOOLED = 1000


def page(study: Study) -> str:
    """What was integrated and how, what to use, and where it fails."""
    parts = (
        _preface(study),
        _references(study),
        _pictures(study),
        _fastest(study),
        _angles(study),
        _laws(study),
        _failures(study),
        _fooled(study),
        _drift(study),
    )
    return "\n\n".join(part for part in parts if part) + "\n"


def _preface(study: Study) -> str:
    asked, machine = study.settings, study.settings.machine
    constants = ", ".join(f"{name} = {value:g}" for name, value in CONSTANTS.items())
    tolerances = ", ".join(f"{tolerance:g}" for tolerance in asked.tolerances)
    size = "a quick look" if asked.quick else "the full study"
    couple = ", ".join(f"{M:g}" for M in COUPLE)
    return f"""# Integrators: error against run time

Made by `rodproof report` from `integrators.json` ({size}, `rodproof measure --integrators`).
A rod of length L under the dead force N g_3, from a clamped end where the couple is known,
(M_1, M_2, M_3) = ({couple}), phi = {PHI:g}, psi = {PSI:g} and theta as said; {constants}.
The right-hand sides and Jacobians are `generated/equilibria/directors.py` (a quaternion) and
`euler_angles.py`; the methods are those of SciPy's `solve_ivp`, with rtol = atol = {tolerances},
the implicit ones with the Jacobian. A run may make {asked.budget} calls; then it has stalled.

The error is the larger of that of r(L), beside the larger of L and |r(L)|, and of the angle in
radians by which the frame at the end is turned off. Time is the fastest of three rounds for short
runs. Machine: {machine["processor"]}, one thread, Python {machine["python"]},
NumPy {machine["numpy"]}, SciPy {asked.scipy}."""


def _references(study: Study) -> str:
    known = [found.bound for found in study.references if found.bound is not None]
    missing = [found for found in study.references if found.bound is None]
    text = f"""## What the errors are measured against

Each rod is integrated twice at 30 digits and more, by routes that share neither equations nor
method: Taylor series of order 26 for the directors and the couple in the fixed basis, and the
extrapolated midpoint rule for a quaternion and the couple in the directors, the law written out by
hand. They agree for {len(known)} of {len(study.references)} rods; where they are furthest apart it
is by {max(known, default=0):.1e}."""
    if missing:
        names = "; ".join(found.problem for found in missing)
        text += (
            f"\n\nNo reference, as a rod of the linear law turns too often for it ({names}): "
            "only calls and time are known there."
        )
    return text


def _pictures(study: Study) -> str:
    made = [(f"integrators-{name}", title) for name, title, _ in plot.figures(study)]
    return "\n".join(f"![work and precision, {title}]({name}.svg)" for name, title in made)


def _fastest(study: Study) -> str:
    rows = []
    for rod in study.problems:
        if rod.linear and study.references[study.problems.index(rod)].bound is None:
            continue
        done = [run for run in study.runs if run.problem == rod.name and run.outcome == DONE]
        rows.append([rod.name, *(_cheapest(done, wanted) for wanted in WANTED)])
    head = ["rod", *(f"error below {wanted:g}" for wanted in WANTED)]
    winners = Counter(
        f"{run.method} on {run.equations}"
        for rod in study.problems
        for wanted in WANTED
        if (run := _first(_right(study, rod, wanted))) is not None
    )
    first = ", ".join(f"{name} {count}" for name, count in winners.most_common(4))
    return f"""## The fastest way to an accuracy

How often each is the fastest: {first}. A dash: none of the runs got there.

{_table(head, rows)}"""


def _right(study: Study, rod: Problem, wanted: float) -> list[Run]:
    return [run for run in study.runs if run.problem == rod.name and _reaches(run, wanted)]


def _reaches(run: Run, wanted: float) -> bool:
    return run.outcome == DONE and run.error is not None and run.error <= wanted


def _first(runs: Iterable[Run]) -> Run | None:
    return min(runs, key=lambda run: run.seconds or 0.0, default=None)


def _cheapest(runs: list[Run], wanted: float) -> str:
    best = _first(run for run in runs if _reaches(run, wanted))
    if best is None:
        return "–"
    angles = "" if best.equations == EQUATIONS[0] else " (angles)"
    return f"{best.method}{angles} {_milliseconds(best.seconds or 0.0)} ms"


def _milliseconds(seconds: float) -> str:
    return f"{1e3 * seconds:.2g}" if seconds < 0.1 else f"{1e3 * seconds:.0f}"


def _angles(study: Study) -> str:
    rows = []
    for tilt in sorted({rod.tilt for rod in study.problems if not rod.linear}, reverse=True):
        ratios, refused = [], 0
        for rod in study.problems:
            if rod.linear or rod.tilt != tilt or rod.p != 3:
                continue
            for method in METHODS:
                ours, theirs = (study.of(rod, name, method) for name in EQUATIONS)
                refused += sum(run.outcome == REFUSED for run in theirs)
                ratios += [
                    b.calls / a.calls
                    for a, b in zip(ours, theirs, strict=True)
                    if a.outcome == b.outcome == DONE
                ]
        shown = [f"{f(ratios):.2g}" for f in (min, median, max)] if ratios else ["–"] * 3
        rows.append([f"{tilt:g}", *shown, str(refused)])
    head = ["theta at the start", "least", "median", "most", "refused"]
    return f"""## Euler angles against directors

Calls that Euler angles need for each call of the directors, same method, same tolerance, p = 3,
where both arrive; and the runs that they refuse, as they stand at the pole.

{_table(head, rows)}"""


def _laws(study: Study) -> str:
    if len(plot.ladder(study, linear=True)) < 2:
        return ""
    tolerance, rows = plot.laws_tolerance(study), []
    for linear in (False, True):
        for rod in plot.ladder(study, linear=linear):
            cells = [_calls(study.of(rod, EQUATIONS[0], method), tolerance) for method in METHODS]
            rows.append(["linear" if linear else "limited", f"{rod.thrust:g}", *cells])
    return f"""## The strain-limiting law and the linear one

Calls of the right-hand side at tolerance {tolerance:g}, by directors, L = 1, theta = 1. Under the
linear law the frame turns faster the larger the thrust, without bound; it oscillates, so that
implicit methods are no help. Under the strain-limiting law no load makes the rod dear.

![calls against thrust](integrators-laws.svg)

{_table(["law", "N", *METHODS], rows)}"""


def _calls(runs: list[Run], tolerance: float) -> str:
    (run,) = (run for run in runs if run.tolerance == tolerance)
    return (
        str(run.calls)
        if run.outcome == DONE
        else STALLED
        if run.outcome == SKIPPED
        else run.outcome
    )


def _failures(study: Study) -> str:
    outcomes = (DONE, STALLED, SKIPPED, REFUSED, GAVE_UP)
    rows = []
    for equations in EQUATIONS:
        for method in METHODS:
            found = Counter(
                run.outcome
                for run in study.runs
                if (run.equations, run.method) == (equations, method)
            )
            rows.append([equations, method, *(str(found[outcome]) for outcome in outcomes)])
    return f"""## Failures

Stalled: out of calls; tighter tolerances of the same cell are then skipped. Refused: Euler angles
at theta = 0. Gave up: no step small enough was found.

{_table(["equations", "method", *outcomes], rows)}"""


def _fooled(study: Study) -> str:
    bad = [r for r in study.runs if r.error is not None and r.error > FOOLED * r.tolerance]
    worst = sorted(bad, key=lambda run: -(run.error or 0) / run.tolerance)[:12]
    rows = [
        [run.problem, run.equations, run.method, f"{run.tolerance:g}", f"{run.error:.1e}"]
        for run in worst
    ]
    done = sum(run.error is not None for run in study.runs)
    text = f"""## Where success was said and the answer is far off

The tolerance is that of one step; what the steps add up to is for the user to find out.
{len(bad)} of {done} runs that ended well are off by more than {FOOLED} times their tolerance."""
    head = ["rod", "equations", "method", "tolerance", "error"]
    return f"{text} The worst:\n\n{_table(head, rows)}" if rows else text


def _drift(study: Study) -> str:
    tolerance = min(study.settings.tolerances, key=lambda tol: abs(tol / 1e-9 - 1))
    rows = []
    for equations in EQUATIONS:
        for method in METHODS:
            found = [
                run.drift
                for run in study.runs
                if (run.equations, run.method, run.tolerance) == (equations, method, tolerance)
                and run.drift is not None
            ]
            shown = [f"{median(found):.1e}", f"{max(found):.1e}"] if found else ["–", "–"]
            rows.append([equations, method, *shown, str(len(found))])
    return f"""## Drift of the first integrals

The couple about d_3, the couple about the force, and W* + n_3, the largest departure over the
steps beside their size, at tolerance {tolerance:g}.

{_table(["equations", "method", "median", "worst", "runs"], rows)}"""


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
