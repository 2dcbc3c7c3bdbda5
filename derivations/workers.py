"""Tasks on workers: the same results whoever computes them, and none lost when a worker dies.

    tasks --run--> (index, result), ...    in the order in which they finish

The workers are local processes, a dask.distributed cluster, or any concurrent.futures executor.
A task whose worker dies is computed again; what is finished is kept. A task that kills its worker
twice is given up, by name. Which worker computes a task must not matter: tasks share nothing.
"""

from __future__ import annotations

import hashlib
import importlib.util
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    as_completed,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, Generic, TypeVar

Result = TypeVar("Result")

#: Seconds until an address counts as one that nobody answers at.
PATIENCE = 10.0

#: What else decides a result, besides the project's own code.
LIBRARIES = ("sympy", "mpmath", "python-flint", "numpy", "scipy")
PORTIONS = ("rodproof.derivations", "rodproof.codegen", "rodproof.generated")
DIFFERENT = "another version of rodproof, or of what it computes with, than is here"

#: What every worker of a cluster is asked first: in words that it needs no rodproof to read.
PROBE = "__import__('rodproof.derivations.workers').derivations.workers.fingerprint()"


class NoWorkers(OSError):
    """Nobody answers at the address, or none who can compute."""


class WorkerLost(RuntimeError):
    """A task killed its worker twice, or those who should compute it are gone."""


class OtherCode(RuntimeError):
    """A worker has another version of the code: its results would be those of another project."""


#: What a user is told in a sentence.
ERRORS = (NoWorkers, WorkerLost, OtherCode)


@dataclass(frozen=True)
class Task(Generic[Result]):
    """``call(*arguments)``: a module's function and plain values, so that it can travel.

    name: for people, in errors and progress.
    """

    name: str
    call: Callable[..., Result]
    arguments: tuple[Any, ...] = ()


def run(
    tasks: Iterable[Task[Result]],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    executor: Executor | None = None,
) -> Iterator[tuple[int, Result]]:
    """Each task's index and result, as they finish.

    Computed by ``executor`` if there is one, else by the dask.distributed cluster at the address
    ``scheduler``, else by ``jobs`` processes; here and one after the other if that is 1.

    Raises what a task raises; NoWorkers, WorkerLost, OtherCode.
    """
    todo = tuple(tasks)
    if executor is not None:
        yield from _elsewhere(todo, executor)
    elif scheduler is not None:
        with cluster(scheduler) as found:
            yield from _elsewhere(todo, found)
    elif min(jobs, len(todo)) > 1:
        yield from _processes(todo, min(jobs, len(todo)))
    else:
        for index, task in enumerate(todo):
            yield index, task.call(*task.arguments)


# -- processes of this machine ------------------------------------------------------------------


def _processes(tasks: Sequence[Task[Result]], jobs: int) -> Iterator[tuple[int, Result]]:
    """One pool until a worker dies; then the tasks it had are tried each in a process of its own.

    A pool does not say which of its processes died: alone, a task cannot be mistaken.
    """
    waiting = list(reversed(range(len(tasks))))
    while waiting:
        suspects: list[int] = []
        with _pool(jobs) as pool:
            running: dict[Future[Result], int] = {}
            while (waiting and not suspects) or running:
                while waiting and not suspects and len(running) < jobs:
                    index = waiting.pop()
                    try:
                        running[_submit(pool, tasks[index])] = index
                    except BrokenExecutor:
                        suspects.append(index)
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    index = running.pop(future)
                    if isinstance(future.exception(), BrokenExecutor):
                        suspects.append(index)
                    else:
                        yield index, future.result()
        for index in sorted(suspects):
            yield index, _alone(tasks[index])


def _alone(task: Task[Result]) -> Result:
    """The second try of a task whose worker died."""
    with _pool(1) as pool:
        try:
            return _submit(pool, task).result()
        except BrokenExecutor:
            raise WorkerLost(f"{task.name}: its worker died twice, the second time alone") from None


@contextmanager
def _pool(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """A pool that waits for its processes to end, and starts nothing more once left."""
    pool = ProcessPoolExecutor(jobs)
    try:
        yield pool
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _submit(pool: Executor, task: Task[Result]) -> Future[Result]:
    return pool.submit(task.call, *task.arguments)


# -- a cluster, or any other executor -----------------------------------------------------------


@contextmanager
def cluster(address: str) -> Iterator[Executor]:
    """The dask.distributed cluster at an address as an executor.

    Raises NoWorkers within seconds, and OtherCode naming a worker that computes something else.

    The cluster itself computes the tasks of a dead worker again, as often as its option
    ``distributed.scheduler.allowed-failures`` says.
    """
    try:
        from distributed import Client
    except ImportError:
        raise NoWorkers(
            f"{address}: needs dask.distributed: pip install 'rodproof[cluster]'"
        ) from None
    try:
        _well_formed(address)
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise NoWorkers(f"{address}: no dask scheduler answers there ({error})") from None
    with client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise NoWorkers(f"{address}: the dask scheduler there has no workers") from None
        for worker, found in client.run(eval, PROBE, on_error="return").items():
            if found != fingerprint():
                raise OtherCode(f"{worker}: {_difference(found)}")
        executor = client.get_executor(pure=False)
        try:
            yield executor
        finally:
            executor.shutdown(wait=False)


def _well_formed(address: str) -> None:
    """ValueError for what is no address: a client that finds it out itself takes long."""
    from distributed.comm.addressing import parse_address, parse_host_port
    from distributed.comm.registry import get_backend

    scheme, place = parse_address(address)
    get_backend(scheme)
    if scheme != "inproc":
        parse_host_port(place)


def _difference(found: object) -> str:
    return repr(found) if isinstance(found, Exception) else DIFFERENT


def _elsewhere(tasks: Sequence[Task[Result]], executor: Executor) -> Iterator[tuple[int, Result]]:
    """The results of workers that others started, if they have this code."""
    here = fingerprint()
    futures = {
        executor.submit(same_code, here, t.call, *t.arguments): k for k, t in enumerate(tasks)
    }
    finished = 0
    try:
        for future in as_completed(futures):
            index = futures[future]
            yield index, _result(future, tasks[index], f"{finished} of {len(tasks)} tasks are done")
            finished += 1
    finally:
        for future in futures:
            future.cancel()


def _result(future: Future[Result], task: Task[Result], state: str) -> Result:
    try:
        return future.result()
    except (BrokenExecutor, CancelledError):
        raise WorkerLost(f"{task.name}: those who computed it are gone; {state}") from None
    except Exception as error:
        if type(error).__name__ != "KilledWorker":  # of distributed, which need not be installed
            raise
        raise WorkerLost(f"{task.name}: each worker that tried it died; {state}") from None


def same_code(here: str, call: Callable[..., Result], *arguments: object) -> Result:
    """What the call returns, on a worker whose code is that of the sender."""
    if fingerprint() != here:
        raise OtherCode(f"a worker has {DIFFERENT}")
    return call(*arguments)


@cache
def fingerprint() -> str:
    """A digest of the project's source and of the versions of what it computes with."""
    digest = hashlib.sha256()
    for name in LIBRARIES:
        digest.update(f"{name} {version(name)}\n".encode())
    for portion in PORTIONS:
        spec = importlib.util.find_spec(portion)
        for folder in spec.submodule_search_locations or () if spec else ():
            for path in sorted(Path(folder).rglob("*")):
                if path.suffix in {".py", ".toml"}:
                    digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()
