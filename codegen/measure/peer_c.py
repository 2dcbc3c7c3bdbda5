"""The law in C, compiled at run time and called by ctypes, where a compiler is there."""

from __future__ import annotations

import ctypes
import math
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rodproof.codegen.measure.form import NotHere
from rodproof.codegen.measure.inputs import Array

SOURCE = Path(__file__).with_name("peer_kernel.c")
FLAGS = ("-O3", "-march=native", "-ffast-math", "-fopenmp-simd", "-fPIC")
#: The kernel's POWER: p = 2, powers by exp and log, powers by pow.
SQUARE, EXP_LOG, POW = 0, 1, 2


def compiler(*, plus: bool = False) -> str | None:
    """The C compiler, or that of C++, if there is one."""
    names = ("g++", "c++", "clang++") if plus else ("gcc", "cc", "clang")
    return next(filter(None, map(shutil.which, names)), None)


def build(power: int, folder: Path) -> ctypes.CDLL:
    """The kernel as a library in the folder; NotHere says what the compiler answered."""
    part, target, found = folder / f"{power}.o", folder / f"kernel_{power}.so", compiler()
    if found is None:
        raise NotHere("no C compiler (gcc, cc, clang)")
    # Linked without -ffast-math, with which gcc makes loading flush the process's subnormals.
    for command in (
        [found, *FLAGS, "-c", f"-DPOWER={power}", str(SOURCE), "-o", str(part)],
        [found, "-shared", str(part), "-o", str(target), "-lm"],
    ):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise NotHere(f"{found}: {(done.stderr.splitlines() or ['failed'])[0]}")
    return ctypes.CDLL(str(target))


def aligned(shape: tuple[int, ...]) -> Array:
    """An array of doubles that begins a cache line, as the results of a generated module do."""
    size = math.prod(shape) * 8
    memory = np.empty(size + 64, np.uint8)
    return np.ndarray(shape, np.float64, memory, -memory.ctypes.data % 64)


def bound(library: ctypes.CDLL, function: str, arrays: Sequence[Any], points: int) -> Any:
    """The call with its pointers fixed; the arrays must outlive it."""
    law = getattr(library, function)
    law.restype = None
    pointers = [ctypes.c_void_p(array.ctypes.data) for array in arrays]
    return lambda: law(*pointers, ctypes.c_ssize_t(points))
