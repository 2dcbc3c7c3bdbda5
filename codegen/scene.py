"""Scenes: what to generate, as data.

A scene is a TOML file with these keys, all of them optional but the first:

=============  ==================================================================================
key            value
=============  ==================================================================================
``name``       the module's name, a Python identifier
``summary``    one line for the module's first line
``functions``  which of the six public functions, in the order in which they are printed
``at_limit``   ``"raise"`` (default) or ``"nan"``: what loads, stored_energy and stiffness do
               where the strains are at or past the limit, Q >= 1
=============  ==================================================================================
"""

from __future__ import annotations

import difflib
import keyword
import tomllib
from dataclasses import dataclass, fields
from importlib import resources
from pathlib import Path

FUNCTIONS = (
    "strains",
    "loads",
    "stored_energy",
    "complementary_energy",
    "stiffness",
    "compliance",
)
POLICIES = ("raise", "nan")


class SceneError(ValueError):
    """A scene that cannot be read; the message is one sentence naming the thing and the rule."""


@dataclass(frozen=True)
class Scene:
    """What a generated module holds."""

    name: str
    summary: str = "A strain-limiting special Cosserat rod."
    functions: tuple[str, ...] = FUNCTIONS
    at_limit: str = "raise"

    def __post_init__(self) -> None:
        if not self.name.isidentifier() or keyword.iskeyword(self.name):
            raise SceneError(f"scene name {self.name!r} is not a Python identifier")
        if not self.functions:
            raise SceneError(f"scene {self.name}: functions must name at least one function")
        for function in self.functions:
            _known(f"scene {self.name}: function", function, FUNCTIONS)
        if len(set(self.functions)) < len(self.functions):
            raise SceneError(f"scene {self.name}: functions names a function twice")
        if '"' in self.summary or "\\" in self.summary or "\n" in self.summary:
            raise SceneError(f"scene {self.name}: summary must be one line without quotes")
        _known(f"scene {self.name}: at_limit", self.at_limit, POLICIES)


def committed_names() -> tuple[str, ...]:
    """Names of the scenes that come with the project, sorted."""
    folder = resources.files("rodproof.codegen").joinpath("scenes")
    names = (entry.name for entry in folder.iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def committed(name: str) -> Scene:
    """A scene that comes with the project; raises `SceneError` with the nearest name."""
    _known("scene", name, committed_names())
    text = resources.files("rodproof.codegen").joinpath("scenes", f"{name}.toml").read_text("utf-8")
    scene = parse(text, f"{name}.toml")
    if scene.name != name:
        raise SceneError(f"{name}.toml: name must be {name!r}, not {scene.name!r}")
    return scene


def load(path: Path) -> Scene:
    """A user's scene file."""
    try:
        text = path.read_text("utf-8")
    except OSError as error:
        raise SceneError(f"scene file {path}: {error.strerror}") from error
    return parse(text, path.name)


def parse(text: str, source: str) -> Scene:
    """A scene from TOML text; ``source`` names the file in messages."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{source}: not TOML: {error}") from error
    keys = tuple(field.name for field in fields(Scene))
    for key in data:
        _known(f"{source}: key", key, keys)
    if "name" not in data:
        raise SceneError(f"{source}: key 'name' is missing")
    for key, value in data.items():
        wanted = "a list of strings" if key == "functions" else "a string"
        entries = value if key == "functions" and isinstance(value, list) else [value]
        if isinstance(value, list) != (key == "functions") or not all(
            isinstance(entry, str) for entry in entries
        ):
            raise SceneError(f"{source}: {key} must be {wanted}, not {value!r}")
    if "functions" in data:
        data["functions"] = tuple(data["functions"])
    return Scene(**data)


def _known(what: str, value: str, allowed: tuple[str, ...]) -> None:
    if value in allowed:
        return
    near = difflib.get_close_matches(value, allowed, n=1, cutoff=0.5)
    hint = f"; did you mean {near[0]!r}?" if near else f"; known: {', '.join(allowed)}"
    raise SceneError(f"{what} {value!r} is unknown{hint}")
