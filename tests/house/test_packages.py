"""The list of packages in pyproject.toml is the list of folders, and the wheel holds just these."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

PORTIONS = ("derivations", "codegen", "generated")


def packages_in_folders(root: Path) -> set[str]:
    return {
        "rodproof." + ".".join(init.parent.relative_to(root).parts)
        for portion in PORTIONS
        for init in (root / portion).rglob("__init__.py")
    }


def test_listed_packages_are_the_folders(root: Path) -> None:
    project = tomllib.loads((root / "pyproject.toml").read_text())
    assert set(project["tool"]["setuptools"]["packages"]) == packages_in_folders(root)


def test_every_module_lies_in_a_package(root: Path) -> None:
    """A module in a folder without ``__init__.py`` would be left out of the wheel."""
    stray = [
        str(module.relative_to(root))
        for portion in PORTIONS
        for module in (root / portion).rglob("*.py")
        if not (module.parent / "__init__.py").exists()
    ]
    assert stray == []


def test_wheel_holds_the_modules_and_nothing_else(root: Path, tmp_path: Path) -> None:
    """Built from a copy, so that a stale ``build/`` here can neither help nor spoil."""
    source = tmp_path / "source"
    ignore = shutil.ignore_patterns("__pycache__")
    for portion in PORTIONS:
        shutil.copytree(root / portion, source / portion, ignore=ignore)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(root / name, source / name)
    build = "import setuptools.build_meta as b, sys; print(b.build_wheel(sys.argv[1]))"
    subprocess.run(
        [sys.executable, "-c", build, str(tmp_path)], cwd=source, check=True, capture_output=True
    )
    (wheel,) = tmp_path.glob("*.whl")
    shipped = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    expected = {
        "rodproof/" + str(path.relative_to(root))
        for portion in PORTIONS
        for path in (root / portion).rglob("*")
        if path.suffix in {".py", ".toml", ".json", ".html", ".css", ".js", ".c"}
        or path.name == "py.typed"
        or path.parent.name == "assets"
    }
    assert shipped == expected
