"""The commands as a user calls them: output, exit codes, and one sentence for bad input."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from rodproof.codegen.cli import app

COMMANDS = (
    *("run", "derive", "check", "errata", "scenes"),
    *("generate", "document", "open", "equilibria", "measure", "report"),
)


def rodproof(*arguments: str) -> Result:
    return CliRunner().invoke(app, arguments, catch_exceptions=False)


def one_sentence(result: Result) -> str:
    """What a refused command says: one line on standard error, nothing on standard output."""
    assert result.exit_code == 2
    assert result.stdout == ""
    (line,) = result.stderr.strip().splitlines()
    return line


def test_help_names_every_command() -> None:
    shown = rodproof("--help").stdout
    assert all(f" {command} " in shown for command in COMMANDS)


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys; from rodproof.codegen import cli; "
        "print(sorted({'sympy', 'numpy', 'mpmath', 'matplotlib', 'flint'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--atlas", "--peers"), "--atlas and --peers do not go together"),
        (("--integrators", "--replay", "x"), "--integrators and --replay do not go together"),
        (("--peers", "--scheduler", "tcp://127.0.0.1:1"), "they take no --scheduler"),
    ],
)
def test_measure_does_one_thing_at_a_time(options: tuple[str, ...], said: str) -> None:
    assert said in one_sentence(rodproof("measure", *options))


def test_the_console_script_is_installed() -> None:
    script = Path(sys.executable).with_name("rodproof")
    done = subprocess.run([script, "--help"], capture_output=True, text=True)
    assert done.returncode == 0
    assert "Cosserat" in done.stdout


def test_check_one_tells_its_story() -> None:
    result = rodproof("check", "const-u-3")
    assert result.exit_code == 0
    assert "const-u-3" in result.stdout
    assert "eq:u3const" in result.stdout
    assert "proved" in result.stdout


def test_check_json_has_a_row_each() -> None:
    result = rodproof("check", "const-u-3", "constants-hypothesis", "--json", "--jobs", "1")
    rows = json.loads(result.stdout)["statements"]
    assert [row["id"] for row in rows] == ["const-u-3", "constants-hypothesis"]
    assert [row["verdict"] for row in rows] == ["proved", "refuted"]
    assert rows[0]["mutants_tried"] is None
    assert rows[1]["counterexample"]
    assert rows[1]["correction_latex"]


def test_check_with_mutants_counts_them() -> None:
    found = json.loads(rodproof("check", "small-strain-m-3", "--mutants", "--json").stdout)
    (row,) = found["statements"]
    assert found["totals"]["mutants_tried"] == row["mutants_tried"]
    assert row["mutants_tried"] > 0
    assert row["mutants_killed"] + row["mutants_equivalent"] == row["mutants_tried"]


def test_check_fails_on_another_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    from rodproof.derivations import ledger

    monkeypatch.setattr(ledger, "recorded", lambda: {"small-strain-m-3": "refuted"})
    result = rodproof("check", "small-strain-m-3")
    assert result.exit_code == 1
    assert "small-strain-m-3: proved, recorded as refuted" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("check", "qstr-form"), ("'qstr-form'", "qstar-form")),
        (("check", "--section", "9.9"), ("'9.9'",)),
        (("errata", "--section", "9.9"), ("'9.9'",)),
        (("derive", "no-such-object"), ("no-such-object",)),
        (("generate", "ful_rod"), ("'ful_rod'", "full_rod")),
        (("generate", "--scene", "a.toml"), ("--scene", "--out")),
        (("generate", "--scene", "no-such.toml", "--out", "x.py"), ("no-such.toml",)),
        (("report", "--data", "no-such.json"), ("no-such.json", "rodproof measure")),
        (("measure", "--replay", "full_rod.strains"), ("full_rod.strains", "SCENE.FUNCTION")),
    ],
)
def test_bad_input_is_one_sentence(
    arguments: tuple[str, ...],
    named: tuple[str, ...],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    line = one_sentence(rodproof(*arguments))
    assert all(name in line for name in named)
    assert list(tmp_path.iterdir()) == []


def test_scenes_lists_full_rod() -> None:
    assert "full_rod" in rodproof("scenes").stdout
    (scene, *_) = json.loads(rodproof("scenes", "--json").stdout)
    assert scene["name"] == "full_rod"
    assert "compliance" in scene["functions"]


def test_scenes_gives_the_account_of_one() -> None:
    said = rodproof("scenes", "dsdna").stdout
    assert "Constants left out: zeta." in said
    assert "ns a point: on this machine, now" in said
    (found,) = json.loads(rodproof("scenes", "dsdna", "--json").stdout)
    assert found["constants_left_out"] == ["zeta"]
    for row in found["lines"]:
        own, full = (row[side]["arithmetic"] for side in ("own", "full"))
        assert 0 < own < full
        assert f" {own} of {full} " in said
    times = found["times"]["functions"]
    assert [row["function"] for row in times] == [row["function"] for row in found["lines"]]
    assert all(row["own"] > 0 and row["full"] > 0 for row in times)
    assert found["times"]["points"] == 10_000
    assert "did you mean 'dsdna'" in one_sentence(rodproof("scenes", "dnsa"))


def test_generate_own_scene(tmp_path: Path) -> None:
    own, out = tmp_path / "my.toml", tmp_path / "deep" / "my_law.py"
    own.write_text('name = "my_law"\nfunctions = ["strains"]\n')
    result = rodproof("generate", "--scene", str(own), "--out", str(out))
    assert result.exit_code == 0
    assert "def strains(" in out.read_text()
    assert "def stiffness(" not in out.read_text()
    assert [path.name for path in out.parent.iterdir()] == ["my_law.py"]


def test_generate_own_scene_says_what_was_left_out(tmp_path: Path) -> None:
    """Loads, constants and guards that are gone, and what is left of the operations."""
    own, out = tmp_path / "my.toml", tmp_path / "my_law.py"
    own.write_text(
        'name = "my_law"\nfunctions = ["loads"]\nconstraints = ["planar"]\n[fixed]\np = 2\n'
        "[ranges]\nu2 = [-0.1, 0.1]\nv1 = [-0.1, 0.1]\nv3 = [0.9, 1.1]\n"
        "alpha = [0.5, 2]\nzeta = [0.5, 2]\neta = [0.5, 2]\ngamma = [1, 10]\n"
    )
    said = rodproof("generate", "--scene", str(own), "--out", str(out)).stdout
    for words in ("m1, m3, n2 must be zero", "left out: beta, iota", "Fixed: p = 2"):
        assert words in said
    assert "Guards proved needless by interval arithmetic" in said
    assert "the strain limit (loads)" in said
    (row,) = (line for line in said.splitlines() if line.startswith("loads"))
    left, whole = map(int, re.search(r"(\d+) of (\d+)", row).groups())
    assert 0 < left < whole
    assert json.loads(rodproof("generate", "--scene", str(own), "--out", str(out), "--json").stdout)


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    result = rodproof("errata", "--section", "2.1", "--out", str(tmp_path / "file" / "e.md"))
    assert one_sentence(result) == f"{tmp_path / 'file'}: File exists"


def test_generate_own_scene_with_an_unknown_key(tmp_path: Path) -> None:
    own, out = tmp_path / "my.toml", tmp_path / "my_law.py"
    own.write_text('name = "my_law"\nfunctoins = ["strains"]\n')
    line = one_sentence(rodproof("generate", "--scene", str(own), "--out", str(out)))
    assert "'functoins'" in line
    assert "functions" in line
    assert not out.exists()


def test_generate_check_shows_what_differs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A touched module and a stray one are shown, not repaired: exit code 3."""
    from rodproof.codegen import generate, places
    from rodproof.derivations import ledger

    monkeypatch.setattr(places, "checkout", lambda: places.Places(tmp_path))
    generate.write(tmp_path / "generated", verdicts=ledger.recorded())
    assert rodproof("generate", "--check").exit_code == 0
    module = tmp_path / "generated" / "scenes" / "full_rod.py"
    module.write_text(module.read_text().replace("import numpy as np", "import numpy"))
    (module.parent / "left_over.py").write_text("")
    result = rodproof("generate", "--check")
    assert result.exit_code == 3
    assert "-import numpy\n" in result.stdout
    assert "left_over.py: stray" in result.stdout
    assert "rodproof generate" in result.stderr
    assert "import numpy\n" in module.read_text()


def test_committed_modules_are_what_the_source_gives() -> None:
    result = rodproof("generate", "--check")
    assert result.exit_code == 0, result.stdout


def test_replay_shows_one_spot_of_the_atlas() -> None:
    spot = "full_rod.strains.float64.limit.9.15.0"
    shown = rodproof("measure", "--replay", spot).stdout
    assert "limit: p 1.5, y/gamma 1e160" in shown
    found = json.loads(rodproof("measure", "--replay", spot, "--json").stdout)
    assert found["spot"] == spot
    assert set(found) >= {"constants", "point", "truth", "generated", "textbook", "error"}
    assert float(found["error"].split()[0]) < 8
    assert found["mark of textbook"] != found["mark of stable float64"]


def test_atlas_of_one_scene_and_its_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from rodproof.codegen.measure import atlas
    from rodproof.codegen.measure.subjects import subject

    monkeypatch.setattr(atlas, "subjects", lambda: (subject("thrust"),))
    monkeypatch.setattr(atlas, "settings", lambda *, quick: atlas.Settings(quick, 6, 1))
    path = tmp_path / "atlas.json"
    made = rodproof("measure", "--atlas", "--quick", "--out", str(path), "--jobs", "1")
    assert made.stdout == f"wrote {path}\n"
    pages = rodproof("report", "--data", str(path), "--json")
    names = {Path(name).name for name in json.loads(pages.stdout)}
    assert names >= {"atlas.md", "atlas-thrust.png"}
    worst = atlas.load(path).summaries[0].worst_spot
    assert rodproof("measure", "--replay", worst).exit_code == 0
