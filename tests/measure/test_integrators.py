"""Integrators: the reference is right and sees what is wrong; failures are results; runs go on."""

from __future__ import annotations

import dataclasses
import json
import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import flint
import numpy as np
import pytest
import sympy as sp
from typer.testing import CliRunner

from rodproof.codegen.cli import app
from rodproof.codegen.measure.integrators import (
    extrapolation,
    page,
    records,
    reference,
    report,
    survey,
    taylor,
)
from rodproof.codegen.measure.integrators.precision import digits
from rodproof.codegen.measure.integrators.problems import CONSTANTS, PHI, PSI, Problem, grid
from rodproof.codegen.measure.integrators.reference import Reference
from rodproof.codegen.measure.integrators.runs import (
    EQUATIONS,
    GAVE_UP,
    METHODS,
    REFUSED,
    SKIPPED,
    STALLED,
    Run,
    equations,
    errors,
    integrate,
    runs,
)
from rodproof.derivations.symbols import CONSTANTS as SYMBOLS
from rodproof.derivations.symbols import LOADS
from rodproof.derivations.theory import constitutive, couple, euler, frames

ROD = Problem(1.0, 1.0, 1.0, 3.0)
POLE = Problem(1.0, 1.0, 0.0, 3.0)
STEPS = 100


@pytest.fixture(scope="module")
def known() -> Reference:
    return reference.reference(ROD)


def exact(expression: sp.Expr, at: dict[sp.Symbol, Any]) -> float:
    """A formula of the theory at 30 digits; floats stand for the rationals that they are."""
    rational = {name: sp.Rational(value) for name, value in at.items()}
    return float(sp.N(expression.xreplace(rational), 30))


def numbers(p: float) -> dict[sp.Symbol, Any]:
    return {c: {**CONSTANTS, "p": p}[c.name] for c in SYMBOLS}


# -- the reference ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "rod",
    [
        ROD,
        Problem(1.0, 1e6, 1e-3, 3.0),
        Problem(1.0, 1e-3, 1e-6, 0.5),
        Problem(1.0, 1.0, 1.0, 50.0),
        Problem(1.0, 1.0, 0.5, 3.0, linear=True),
    ],
    ids=lambda rod: rod.name,
)
def test_two_routes_agree(rod: Problem) -> None:
    found = reference.reference(rod)
    assert found.bound is not None
    assert found.bound < 1e-20
    frame = np.array(found.frame).reshape(3, 3)
    assert np.abs(frame @ frame.T - np.eye(3)).max() < 1e-15


@pytest.mark.parametrize("route", [taylor, extrapolation])
def test_a_straight_rod_is_its_closed_form(route: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """theta = 0 and a couple about the rod: it stays straight, r = v_3 s g_3, turning by u_3 s."""
    monkeypatch.setattr(route, "COUPLE", (0.0, 0.0, 0.4))
    rod = Problem(3.0, 2.0, 0.0, 3.3)
    load = dict(zip(LOADS, (0, 0, 0.4, 0, 0, 2.0), strict=True))
    law = [exact(e, numbers(3.3) | load) for e in constitutive.law_of_strains()]
    end = route.end(rod, STEPS)
    assert [float(a.mid()) for a in end.r] == pytest.approx((0, 0, 3 * (1 + law[5])), abs=1e-15)
    turn = PHI + PSI + 3 * law[2]
    d1 = [float(a.mid()) for a in end.frame[:3]]
    assert d1 == pytest.approx((math.cos(turn), math.sin(turn), 0), abs=1e-15)


@pytest.mark.parametrize("route", [taylor, extrapolation])
def test_a_helix_is_its_closed_form(route: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """No force and M_3 = -M_1 cot(theta): the derived center line of Section 4.3."""
    rod, M1, theta = Problem(2.0, 0.0, 0.8, 3.3), 0.5, sp.Rational(0.8)
    at = numbers(3.3) | {euler.M1: M1, frames.theta: theta}
    M3 = sp.N(couple.axial_couple().xreplace({euler.M1: sp.Rational(M1), frames.theta: theta}), 30)
    monkeypatch.setattr(route, "COUPLE", (M1, 0.0, float(M3)))
    state = couple.helix()
    bend = exact(state.rates[0].xreplace({euler.M3: M3}), at)
    v3 = 1 + exact(state.strains[5] - 1, at)
    line = couple.center_line().xreplace({sp.Symbol("v3", real=True): v3, euler.phi_s: bend})
    wanted = line.xreplace({frames.theta: theta})
    at_end, at_start = (
        [float(sp.N(e.subs(couple.s, s + PHI / bend))) for e in wanted] for s in (2.0, 0.0)
    )
    r = [float(a.mid()) for a in route.end(rod, STEPS).r]
    assert r == pytest.approx([a - b for a, b in zip(at_end, at_start, strict=True)], abs=1e-14)


#: Rates of q, m_1, m_2 and r; m_3 has none, whatever its sign: a first integral.
SIGNED = (0, 1, 2, 3, 4, 5, 7, 8, 9)


@pytest.mark.parametrize("component", SIGNED)
def test_a_wrong_sign_in_one_route_leaves_no_reference(component: int) -> None:
    with digits(extrapolation.DIGITS):
        right = extrapolation.equations(ROD)

    def wrong(x: Any) -> list[Any]:
        rates = right(x)
        rates[component] = -rates[component]
        return rates

    found = reference.compared(ROD, taylor.end(ROD, STEPS), extrapolation.end(ROD, STEPS, wrong))
    assert found.bound is None
    assert found.why.startswith("the routes differ by")


def test_what_is_out_of_reach_is_said_soon() -> None:
    found = reference.reference(Problem(100.0, 1e6, 1.0, 3.0, linear=True))
    assert found.bound is None
    assert "steps do not reach the end" in found.why


def test_precision_is_given_back() -> None:
    before = flint.ctx.prec, flint.ctx.cap
    with pytest.raises(ZeroDivisionError), digits(50, 7):
        1 // (flint.ctx.cap - 7)
    assert (flint.ctx.prec, flint.ctx.cap) == before


# -- one integration ----------------------------------------------------------------------------


@pytest.mark.parametrize("name", EQUATIONS)
@pytest.mark.parametrize("method", METHODS)
def test_every_method_comes_near(known: Reference, name: str, method: str) -> None:
    loose, tight = runs(ROD, name, method, known, (1e-3, 1e-9))
    assert loose.error is not None
    assert tight.error is not None
    assert tight.error < 1e-7
    assert 100 * tight.error < loose.error < 0.1
    assert tight.calls > loose.calls > 0
    assert (tight.jacobians > 0) <= (method in ("LSODA", "Radau", "BDF"))
    assert tight.drift is not None
    assert tight.drift < 1e-6


@pytest.mark.parametrize("component", SIGNED)
def test_a_wrong_right_hand_side_is_caught(known: Reference, component: int) -> None:
    """A broken twin: one sign of the generated equations turned."""
    form = equations("directors", ROD)
    sign = np.where(np.arange(10) == component, -1.0, 1.0)
    twin = replace(form, rates=lambda s, x: sign * form.rates(s, x))
    right, wrong = (
        integrate(ROD, "directors", each, "DOP853", 1e-12, known) for each in (form, twin)
    )
    assert right.error is not None
    assert right.error < 1e-10
    assert wrong.error is None or wrong.error > 1e-3
    assert (component > 6) or wrong.drift is None or wrong.drift > 1e-3  # r is in no integral


def test_a_run_that_needs_too_much_has_stalled(known: Reference) -> None:
    first, second, third = runs(ROD, "directors", "RK45", known, (1e-3, 1e-7, 1e-9), budget=40)
    assert first.outcome == "done"
    assert (second.outcome, second.why) == (STALLED, "40 calls")
    assert second.error is None
    assert second.seconds is not None
    assert third.outcome == SKIPPED


def test_lsoda_can_be_stopped(known: Reference) -> None:
    assert runs(ROD, "directors", "LSODA", known, (1e-9,), budget=40)[0].outcome == STALLED


def test_the_pole_is_refused_by_angles_alone() -> None:
    found = reference.reference(POLE)
    angles, frame = (runs(POLE, name, "DOP853", found, (1e-9,))[0] for name in reversed(EQUATIONS))
    assert angles.outcome == REFUSED
    assert "singular at sin(theta) = 0" in angles.why
    assert frame.error is not None
    assert frame.error < 1e-8


@pytest.mark.parametrize(("torn", "why"), [(math.nan, "step size"), (1e300, "the quaternion")])
def test_a_method_that_gives_up_is_a_result(known: Reference, torn: float, why: str) -> None:
    """No step is small enough, or one led to a state that the equations refuse."""
    form = equations("directors", ROD)
    twin = replace(form, rates=lambda s, x: form.rates(s, x) + (torn if s > 0.5 else 0.0))
    found = integrate(ROD, "directors", twin, "RK45", 1e-6, known)
    assert found.outcome == GAVE_UP
    assert why in found.why
    assert found.error is None


def test_errors_are_a_distance_and_an_angle(known: Reference) -> None:
    """A state turned by a known angle about d_3 and moved by a known vector."""
    form, angle = equations("euler angles", ROD), 1e-3
    frame = np.array(known.frame).reshape(3, 3).T
    theta, phi = math.acos(frame[2, 2]), math.atan2(frame[1, 2], frame[0, 2])
    psi = math.atan2(frame[2, 1], -frame[2, 0]) + angle
    state = np.array([phi, theta, psi, 0, 0, 0, *np.add(known.r, [0, 1e-5, 0])])
    away, turned = errors(form, state, known, ROD)
    assert turned == pytest.approx(angle, rel=1e-3)
    assert away == pytest.approx(1e-5 / max(1, *map(abs, known.r)), rel=1e-3)


# -- a whole study ------------------------------------------------------------------------------


ASKED = records.settings(quick=True)
RODS = (ROD, POLE)


def silent(name: str, done: int, total: int) -> None:
    pass


def untimed(study: records.Study) -> records.Study:
    return replace(study, runs=tuple(replace(run, seconds=None) for run in study.runs))


@pytest.fixture(scope="module")
def studied(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, records.Study]:
    path = tmp_path_factory.mktemp("study") / "integrators.json"
    return path, survey.measure(path, ASKED, silent, chosen=RODS, jobs=2)


def test_every_cell_is_there(studied: tuple[Path, records.Study]) -> None:
    path, study = studied
    assert records.load(path) == study
    assert [found.name for found in path.parent.iterdir()] == [path.name]
    for rod in RODS:
        for name in EQUATIONS:
            for method in METHODS:
                found = study.of(rod, name, method)
                assert [run.tolerance for run in found] == list(ASKED.tolerances)


def test_a_study_that_broke_off_goes_on(
    studied: tuple[Path, records.Study], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Interrupted in a cell, and what was kept cut in the middle of a line: only that is lost."""
    path = tmp_path / "integrators.json"
    integrated: list[tuple[str, ...]] = []

    def counted(*arguments: Any) -> Any:
        if len(integrated) == 5:
            integrated.append(("interrupted",))
            raise KeyboardInterrupt
        integrated.append((arguments[0].name, *arguments[1:3]))
        return runs(*arguments)

    monkeypatch.setattr(survey, "runs", counted)
    with pytest.raises(KeyboardInterrupt):
        survey.measure(path, ASKED, silent, chosen=RODS)
    journal = path.with_suffix(".cells")
    journal.write_text(journal.read_text()[:-30])
    again: list[tuple[str, int, int]] = []
    study = survey.measure(path, ASKED, lambda *told: again.append(told), chosen=RODS)
    cells = [cell for cell in integrated if len(cell) == 3]
    assert len(cells) == 2 * len(EQUATIONS) * len(METHODS) + 1
    assert len(set(cells)) == len(cells) - 1
    assert untimed(study) == untimed(studied[1])
    assert not journal.exists()
    kept = len(RODS) + 4  # the references, and of five cells the last is cut
    assert again[0][:2] == (f"{kept} kept from the run that broke off", kept)
    counts = [done for _, done, _ in again]
    assert all(after - before in (0, 1) for before, after in pairwise(counts))
    assert again[-1] == ("done", counts[-1], counts[-1])


def test_what_other_code_or_settings_found_is_not_taken_over() -> None:
    others = (
        records.key(ASKED, POLE.name, "directors", "RK45"),
        records.key(replace(ASKED, digest="another"), ROD.name, "directors", "RK45"),
        records.key(replace(ASKED, scipy="another"), ROD.name, "directors", "RK45"),
        records.key(replace(ASKED, budget=7), ROD.name, "directors", "RK45"),
    )
    assert records.key(ASKED, ROD.name, "directors", "RK45") not in others
    assert len(set(others)) == len(others)


def test_what_is_kept_of_a_rod_is_what_was_found(known: Reference) -> None:
    """To the bit and of the same kind, by way of JSON."""
    stored = json.loads(json.dumps(dataclasses.asdict(known)))
    assert records.reference_of(stored) == known
    found = runs(ROD, "directors", "RK45", known, (1e-3,))
    rows = json.loads(json.dumps([dataclasses.astuple(run) for run in found]))
    assert [Run(*row) for row in rows] == found


def test_the_command_and_the_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`measure --integrators --quick` on one rod, then page and pictures from its data."""
    monkeypatch.setattr(records, "rods", lambda asked: (ROD,))
    data = tmp_path / "integrators.json"
    for command in (["measure", "--integrators", "--quick", "--out"], ["report", "--data"]):
        result = CliRunner().invoke(app, [*command, str(data), "--json"], catch_exceptions=False)
        assert result.exit_code == 0, result.stderr
    shown = [Path(name) for name in json.loads(result.stdout)]
    written = [path for path in shown if path.name.startswith("integrators")]
    assert {path.suffix for path in written} == {".md", ".svg", ".png"}
    text = (tmp_path / "integrators.md").read_text()
    assert "They agree for 1 of 1 rods" in text
    assert "DOP853" in text
    pictures = {path: path.read_bytes() for path in written if path.suffix != ".md"}
    assert report.report(data, tmp_path) == written
    assert {path: path.read_bytes() for path in pictures} == pictures
    for name in (part.partition(")")[0] for part in text.split("](")[1:]):
        assert (tmp_path / name).is_file()


def test_a_file_that_is_no_study_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"cannot be read .* `rodproof measure --integrators"):
        records.load(tmp_path / "none.json")
    (tmp_path / "other.json").write_text("{}")
    with pytest.raises(ValueError, match="not a study of integrators"):
        records.load(tmp_path / "other.json")


def test_the_page_names_what_is_bad(studied: tuple[Path, records.Study]) -> None:
    """A run that says success and is wrong, a stall, and a rod without reference are shown."""
    study = studied[1]
    run = study.of(ROD, "directors", "BDF")[-1]
    lie = replace(run, error=0.5)
    lost = dataclasses.replace(study.references[1], bound=None, r=(), frame=(), why="too long")
    changed = replace(
        study,
        runs=tuple(lie if each == run else each for each in study.runs),
        references=(study.references[0], lost),
    )
    text = page.page(changed)
    assert f"| {ROD.name} | directors | BDF | 1e-09 | 5.0e-01 |" in text
    assert f"No reference, as a rod of the linear law turns too often for it ({POLE.name})" in text
    assert "1 of " in text


def test_the_page_in_the_report_is_what_its_data_give(root: Path) -> None:
    folder = root / "docs" / "report"
    study = records.load(folder / "integrators.json")
    assert (folder / "integrators.md").read_text("utf-8") == page.page(study)
    assert not study.settings.quick
    assert study.problems == grid(quick=False)


def test_the_grid_has_what_was_asked_for() -> None:
    rods = grid(quick=False)
    limited = [rod for rod in rods if not rod.linear]
    for values, name in (
        ({1.0, 100.0}, "length"),
        ({1.0, 1e-3, 1e-6, 0.0}, "tilt"),
        ({0.5, 3.0, 50.0}, "p"),
    ):
        assert {getattr(rod, name) for rod in limited} == values
    thrusts = {rod.thrust for rod in rods}
    assert (min(thrusts), max(thrusts)) == (1e-3, 1e6)
    assert {r.thrust for r in rods if r.linear and r.length == 1} == thrusts
    assert len({rod.name for rod in rods}) == len(rods)
