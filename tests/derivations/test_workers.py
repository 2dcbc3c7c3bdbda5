"""Whoever computes the tasks and whoever dies meanwhile: the results are the serial ones."""

from __future__ import annotations

import importlib
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
from typer.testing import CliRunner

from rodproof.codegen.cli import app
from rodproof.derivations import ledger, workers
from rodproof.derivations.records import Evidence
from rodproof.derivations.workers import NoWorkers, OtherCode, Task, WorkerLost, run

#: Some short checks and some longer ones.
CHOSEN = ledger.statements("3.1")[8:14]


def rows(evidence: Iterable[Evidence]) -> str:
    """The JSON of an answer, without the seconds."""
    kept = [{k: v for k, v in row.as_row().items() if k != "seconds"} for row in evidence]
    return json.dumps(kept, indent=2)


@pytest.fixture(scope="module")
def serial() -> str:
    return rows(ledger.check(CHOSEN))


@pytest.fixture(scope="module")
def deaths() -> Iterator[ModuleType]:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(Path(__file__).parent)
        yield importlib.import_module("deaths")


def squares(deaths: ModuleType, count: int) -> list[Task[int]]:
    return [Task(f"square {k}", deaths.square, (k,)) for k in range(count)]


def collected(tasks: list[Task[int]], **options: object) -> list[int]:
    found = dict(run(tasks, **options))  # type: ignore[arg-type]
    return [found[index] for index in range(len(tasks))]


class Killer:
    """A progress callback that kills one process as soon as the first result is there."""

    def __init__(self, candidates: Callable[[], Iterable[int]]) -> None:
        self.candidates, self.victim = candidates, 0

    def __call__(self, name: str, done: int, total: int) -> None:
        if not self.victim:
            self.victim = min(self.candidates())
            os.kill(self.victim, signal.SIGKILL)


# -- processes ----------------------------------------------------------------------------------


@pytest.mark.parametrize("jobs", [1, 2, 5])
def test_processes_give_what_the_serial_run_gives(deaths: ModuleType, jobs: int) -> None:
    assert collected(squares(deaths, 20), jobs=jobs) == [k * k for k in range(20)]
    assert collected([], jobs=jobs) == []


def test_a_worker_that_dies_loses_nothing(deaths: ModuleType, tmp_path: Path) -> None:
    tasks = squares(deaths, 12)
    tasks[4] = Task("unlucky", deaths.die_once, (str(tmp_path / "mark"), 16))
    assert collected(tasks, jobs=2) == [k * k for k in range(12)]
    assert (tmp_path / "mark").exists()


def test_a_task_that_kills_its_worker_twice_is_named(deaths: ModuleType) -> None:
    """And what is finished by then has been handed over."""
    tasks = [*squares(deaths, 5), Task("poison", deaths.die, (0,))]
    found: list[tuple[int, int]] = []
    with pytest.raises(WorkerLost, match=r"^poison: its worker died twice"):
        found.extend(run(tasks, jobs=2))
    assert sorted(found) == [(k, k * k) for k in range(5)]


def test_what_a_task_raises_is_raised(deaths: ModuleType) -> None:
    tasks = [*squares(deaths, 2), Task("wrong", deaths.fail, (3,))]
    for jobs in (1, 2):
        with pytest.raises(ZeroDivisionError):
            collected(tasks, jobs=jobs)


def test_a_check_whose_worker_is_killed_is_the_serial_check(serial: str) -> None:
    kill = Killer(lambda: [p.pid for p in multiprocessing.active_children() if p.pid])
    assert rows(ledger.check(CHOSEN, jobs=2, progress=kill)) == serial
    assert kill.victim


# -- any executor -------------------------------------------------------------------------------


def test_any_executor_gives_what_the_serial_run_gives(serial: str) -> None:
    with ThreadPoolExecutor(1) as executor:
        assert rows(ledger.check(CHOSEN, executor=executor)) == serial


def test_an_executor_that_breaks_is_said_to(deaths: ModuleType) -> None:
    tasks = [Task("poison", deaths.die, (1,)), *squares(deaths, 2)]
    with ProcessPoolExecutor(1) as executor, pytest.raises(WorkerLost, match="are gone; 0 of 3"):
        collected(tasks, executor=executor)


def test_workers_of_other_code_are_refused(deaths: ModuleType) -> None:
    assert workers.same_code(workers.fingerprint(), deaths.square, 3) == 9
    with pytest.raises(OtherCode, match="another version"):
        workers.same_code("0" * 64, deaths.square, 3)


# -- a cluster ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cluster(deaths: ModuleType) -> Iterator[SimpleNamespace]:
    """Two worker processes, and a client of the test's own to look at them."""
    distributed = pytest.importorskip("distributed", reason="needs the extra `cluster`")
    import dask

    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 1}),
        local_cluster(distributed, n_workers=2) as found,
        distributed.Client(found, set_as_default=False) as client,
    ):
        yield SimpleNamespace(address=found.scheduler_address, client=client)


def local_cluster(distributed: ModuleType, **options: object):  # type: ignore[no-untyped-def]
    quiet = {"dashboard_address": ":0", "silence_logs": "CRITICAL"}
    return distributed.LocalCluster(processes=True, threads_per_worker=1, **quiet, **options)


def test_a_cluster_gives_what_the_serial_run_gives(cluster: SimpleNamespace, serial: str) -> None:
    assert rows(ledger.check(CHOSEN, scheduler=cluster.address)) == serial


def test_a_cluster_whose_worker_is_killed_too(cluster: SimpleNamespace, serial: str) -> None:
    pids = cluster.client.run(os.getpid).values()
    assert len(set(pids)) == 2
    kill = Killer(lambda: pids)
    assert rows(ledger.check(CHOSEN, scheduler=cluster.address, progress=kill)) == serial
    cluster.client.wait_for_workers(2, timeout=30)
    assert kill.victim not in cluster.client.run(os.getpid).values()


def test_a_task_that_kills_workers_of_a_cluster(
    cluster: SimpleNamespace, deaths: ModuleType, tmp_path: Path
) -> None:
    tasks = squares(deaths, 12)
    tasks[4] = Task("unlucky", deaths.die_once, (str(tmp_path / "mark"), 16))
    assert collected(tasks, scheduler=cluster.address) == [k * k for k in range(12)]
    assert (tmp_path / "mark").exists()
    tasks[7] = Task("poison", deaths.die, (0,))
    with pytest.raises(WorkerLost, match=r"^poison: each worker that tried it died"):
        collected(tasks, scheduler=cluster.address)
    cluster.client.wait_for_workers(2, timeout=30)


def test_the_command_works_on_a_cluster(cluster: SimpleNamespace) -> None:
    ids = ("const-u-3", "constants-hypothesis")
    answers = [
        json.loads(CliRunner().invoke(app, ["check", *ids, "--json", *more]).stdout)
        for more in (["--jobs", "1"], ["--scheduler", cluster.address])
    ]
    for answer in answers:
        for row in answer["statements"]:
            del row["seconds"]
    assert answers[0] == answers[1]


def test_a_cluster_of_other_code_is_refused(
    cluster: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(workers, "fingerprint", lambda: "0" * 64)
    with pytest.raises(OtherCode, match=r"tcp://.*: another version of rodproof"):
        ledger.check(CHOSEN, scheduler=cluster.address)


def test_an_address_that_nobody_answers_at(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed", reason="needs the extra `cluster`")
    monkeypatch.setattr(workers, "PATIENCE", 0.5)
    started = time.monotonic()
    for address in ("127.0.0.1:9", "nonsense://a"):
        result = CliRunner().invoke(app, ["check", "const-u-3", "--scheduler", address])
        assert result.exit_code == 2
        assert result.stdout == ""
        (line,) = result.stderr.strip().splitlines()
        assert line.startswith(f"{address}: no dask scheduler answers there")
    assert time.monotonic() - started < 60


@pytest.mark.parametrize("address", ["nonsense", "nonsense://a", "tcp://a", "tcp://a:b"])
def test_what_is_no_address_is_said_and_no_more(address: str) -> None:
    """In a process of its own: a client that is never connected complains when it is collected."""
    pytest.importorskip("distributed", reason="needs the extra `cluster`")
    command = Path(sys.executable).with_name("rodproof")
    done = subprocess.run(
        [command, "check", "const-u-3", "--scheduler", address], capture_output=True, text=True
    )
    assert done.returncode == 2
    (line,) = done.stderr.strip().splitlines()
    assert line.startswith(f"{address}: no dask scheduler answers there")


def test_a_scheduler_without_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed", reason="needs the extra `cluster`")
    monkeypatch.setattr(workers, "PATIENCE", 0.5)
    with (
        local_cluster(distributed, n_workers=0) as empty,
        pytest.raises(NoWorkers, match="has no workers"),
    ):
        ledger.check(CHOSEN, scheduler=empty.scheduler_address)


def test_a_scheduler_that_goes_away(deaths: ModuleType) -> None:
    """What is finished by then has been handed over, and the error says where it stands."""
    distributed = pytest.importorskip("distributed", reason="needs the extra `cluster`")
    tasks = [*squares(deaths, 3), Task("long", time.sleep, (60,))]
    found: list[tuple[int, int]] = []
    with local_cluster(distributed, n_workers=1) as short:
        results = run(tasks, scheduler=short.scheduler_address)
        found += [next(results) for _ in range(3)]
        short.close()
        with pytest.raises(WorkerLost, match=r"^long: those who computed it are gone; 3 of 4"):
            next(results)
    assert sorted(found) == [(0, 0), (1, 1), (2, 4)]
