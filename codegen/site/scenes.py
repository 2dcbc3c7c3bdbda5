"""The generated scenes for a page: what each holds, what it costs, and its source."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, fields
from importlib import resources

from markupsafe import Markup
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer, TOMLLexer

from rodproof.codegen import scene as toml
from rodproof.codegen.scene import Scene

_COUNTS = re.compile(r"^ +(\w+) +((?:\d+ *)+)$", re.MULTILINE)
#: Fields of a scene that are not choices, or are said elsewhere on its page.
_SAID = ("name", "summary", "functions")


@dataclass(frozen=True)
class Count:
    """A function of a scene and its operations a point."""

    function: str
    counts: tuple[int, ...]


@dataclass(frozen=True)
class Shown:
    """A scene with its module; `choices` are the settings that are not the default ones."""

    scene: Scene
    choices: tuple[tuple[str, str], ...]
    missing: tuple[str, ...]
    header: str
    counts: tuple[Count, ...]
    lines: int
    definition: Markup
    source: Markup

    def of(self, function: str) -> int | None:
        """Arithmetic and transcendental operations of a function, or None without it."""
        return next((sum(c.counts[:2]) for c in self.counts if c.function == function), None)


def shown() -> tuple[Shown, ...]:
    """Every scene whose module is generated; the full rod first, as what others leave out of."""
    names = sorted(toml.committed_names(), key=lambda name: (not name.startswith("full"), name))
    folder = resources.files("rodproof.generated.scenes")
    return tuple(
        _show(toml.committed(name), folder.joinpath(f"{name}.py").read_text("utf-8"))
        for name in names
        if folder.joinpath(f"{name}.py").is_file()
    )


def _show(scene: Scene, source: str) -> Shown:
    header = ast.get_docstring(ast.parse(source)) or ""
    definition = resources.files("rodproof.codegen").joinpath("scenes", f"{scene.name}.toml")
    return Shown(
        scene,
        _choices(scene),
        tuple(name for name in toml.FUNCTIONS if name not in scene.functions),
        header,
        tuple(
            Count(name, tuple(map(int, numbers.split())))
            for name, numbers in _COUNTS.findall(header)
            if name in scene.functions
        ),
        source.count("\n"),
        _coloured(definition.read_text("utf-8"), TOMLLexer()),
        _coloured(source, PythonLexer()),
    )


def _choices(scene: Scene) -> tuple[tuple[str, str], ...]:
    plain = Scene(scene.name)
    return tuple(
        (f.name, _said(getattr(scene, f.name)))
        for f in fields(Scene)
        if f.name not in _SAID and getattr(scene, f.name) != getattr(plain, f.name)
    )


def _said(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} = {number:g}" for name, number in value.items())
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def _coloured(text: str, lexer: object) -> Markup:
    return Markup(highlight(text, lexer, HtmlFormatter(nowrap=True)))
