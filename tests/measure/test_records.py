"""What is stored comes back, and what cannot be read is said in one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from rodproof.codegen.files import write_bytes, write_text
from rodproof.codegen.measure import records
from rodproof.codegen.measure.records import ErrorRow, Measurement, Settings, TimeRow, finite


def sample(*, worst: float | None = 1.5) -> Measurement:
    asked = Settings(1, True, batches=2, points=3, rounds=7, timed_points=64)
    error = ErrorRow("planar", "loads", "textbook", "ordinary", 6, 0, worst, 0.5, None, 1)
    time = TimeRow("planar", "loads", "textbook", 64, 12.5, 2.0)
    forms, scenes = {"textbook": "by hand"}, {"planar": "d"}
    return Measurement(records.this_machine(), asked, forms, scenes, (error,), (time,))


def test_round_trip(tmp_path: Path) -> None:
    path = tmp_path / "new" / "measurement.json"
    records.save(sample(), path)
    assert records.load(path) == sample()
    assert records.load(path) != sample(worst=None)
    assert sample().functions("planar") == ("loads",)
    assert sample().samples("planar") == ("ordinary",)


@pytest.mark.parametrize("content", ["{", "[]", '{"machine": {}}', '{"machine": {"cpu": 1}}'])
def test_a_file_that_is_none_is_named(tmp_path: Path, content: str) -> None:
    path = tmp_path / "x.json"
    path.write_text(content)
    with pytest.raises(ValueError, match=r"x\.json: not a measurement"):
        records.load(path)


def test_a_missing_file_names_the_command(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"none\.json: cannot be read .*rodproof measure"):
        records.load(tmp_path / "none.json")


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    write_text(path, "old")
    with pytest.raises(TypeError):
        write_bytes(path, "not bytes")  # type: ignore[arg-type]
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_no_infinity_reaches_the_file() -> None:
    assert finite(float("inf")) is None
    assert finite(float("nan")) is None
    assert finite(1.23456e-7) == 1.235e-7


def test_the_machine_is_described_without_its_name() -> None:
    import platform

    machine = records.this_machine()
    assert machine.cores >= 1
    assert platform.node() not in (machine.processor, machine.system)
