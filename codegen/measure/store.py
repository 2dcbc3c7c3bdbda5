"""What is finished of a measurement, cell by cell, so that a run that breaks off loses at most one.

Beside the target lies a file with one line of JSON a cell: its key, which holds all that decides
the result, and the result. A line is on the disk before the next cell is counted as done; a last
line that was cut off is not read.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


def digest(*parts: Any) -> str:
    """A key: the digest of all that decides a result, as JSON."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


@dataclass
class Store:
    """Results by key, on the disk."""

    path: Path
    known: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.known |= dict(_read(self.path))

    def __contains__(self, key: str) -> bool:
        return key in self.known

    def __getitem__(self, key: str) -> Any:
        return self.known[key]

    def add(self, key: str, result: Any) -> None:
        """Keep a result; it is on the disk when this returns."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a+b") as file:
            if file.tell() and not _ends_a_line(self.path):
                file.write(b"\n")  # what a broken-off run left of its last line
            file.write(json.dumps([key, result]).encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())
        self.known[key] = result

    def forget(self) -> None:
        """All is stored elsewhere now."""
        self.path.unlink(missing_ok=True)


def kept(done: int) -> str:
    """What is said when a run begins with so many results of one that broke off."""
    return f"{done} kept from the run that broke off" if done else ""


def _ends_a_line(path: Path) -> bool:
    with path.open("rb") as file:
        file.seek(-1, os.SEEK_END)
        return file.read(1) == b"\n"


def _read(path: Path) -> Iterator[tuple[str, Any]]:
    if not path.is_file():
        return
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        try:
            key, result = json.loads(line)
        except ValueError:
            continue
        yield key, result
