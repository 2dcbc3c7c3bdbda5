"""Every example in a docstring runs, on the imported name of its module."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

PORTIONS = ("rodproof.derivations", "rodproof.codegen", "rodproof.generated")


def modules() -> list[str]:
    return [
        name
        for portion in PORTIONS
        for package in [importlib.import_module(portion)]
        for name in [
            portion,
            *(m.name for m in pkgutil.walk_packages(package.__path__, portion + ".")),
        ]
    ]


@pytest.mark.parametrize("name", modules())
def test_examples(name: str) -> None:
    if name.startswith("rodproof.generated.numba."):
        pytest.importorskip("numba", reason="numba is not installed")
    module = importlib.import_module(name)
    assert module.__name__ == name
    assert doctest.testmod(module).failed == 0
