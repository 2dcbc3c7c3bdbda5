"""Tasks for `test_workers`, in a module that worker processes can import by its name."""

from __future__ import annotations

import os
import signal
from pathlib import Path


def square(value: int) -> int:
    return value * value


def die_once(mark: str, value: int) -> int:
    """Kills its own process the first time, in the middle of its work."""
    if not Path(mark).exists():
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return value


def die(value: int) -> int:
    os.kill(os.getpid(), signal.SIGKILL)
    return value


def fail(value: int) -> int:
    raise ZeroDivisionError(value)
