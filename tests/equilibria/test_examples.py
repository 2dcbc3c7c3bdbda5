"""The examples of real use: a boundary-value problem from a copied module, and a simulator."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest


def test_clamped_rod_from_a_copied_module(root: Path, tmp_path: Path) -> None:
    """In a folder with the two files alone, where the project cannot be imported; the assertions
    are the example's own. With the exact Jacobian the solver makes fewer calls."""
    shutil.copy(root / "generated" / "equilibria" / "directors.py", tmp_path)
    shutil.copy(root / "docs" / "examples" / "clamped_rod.py", tmp_path)
    program = (
        "import runpy, sys\n"
        "sys.modules['rodproof'] = None\n"
        "sys.path.insert(0, '.')\n"
        "runpy.run_path('clamped_rod.py', run_name='__main__')\n"
    )
    done = subprocess.run(
        [sys.executable, "-I", "-c", program], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == 5
    for line in lines:
        calls, without = line.split(" nodes, ")[1].split(" calls (")
        assert int(calls) < int(without.split()[0])


def test_elastica_rod_rests_at_the_closed_form(root: Path) -> None:
    """Its assertions: stretch and twist of every element to 1e-9 of the closed form."""
    pytest.importorskip("elastica", reason="the extra elastica is not installed: make extras")
    path = root / "docs" / "examples" / "elastica_rod.py"
    done = subprocess.run([sys.executable, path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.splitlines()) == 3
