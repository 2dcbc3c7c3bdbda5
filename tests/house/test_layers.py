"""Who may import whom: import-linter's contracts, and generated files that stand alone."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path


def test_import_contracts_hold(root: Path) -> None:
    lint = Path(sys.executable).with_name("lint-imports")
    done = subprocess.run([lint, "--no-cache"], cwd=root, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def imported_roots(module: Path) -> set[str]:
    roots: set[str] = set()
    for node in ast.walk(ast.parse(module.read_text())):
        if isinstance(node, ast.Import):
            roots |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            roots.add("." if node.level else (node.module or "").partition(".")[0])
    return roots


def test_generated_modules_import_numpy_and_the_standard_library_only(root: Path) -> None:
    allowed = set(sys.stdlib_module_names) | {"numpy"}
    for module in sorted((root / "generated").rglob("*.py")):
        needed = {"numba"} if module.parent.name == "numba" else set()
        assert imported_roots(module) <= allowed | needed, module.name
