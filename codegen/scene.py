"""Scenes: what to generate, as data.

A scene is a TOML file; its keys are the fields of `Scene`, all of them optional but the name.
`rodproof.codegen.schema` publishes them as a JSON schema for editors.
"""

from __future__ import annotations

import difflib
import keyword
import math
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from fractions import Fraction
from importlib import resources
from pathlib import Path
from typing import Any

from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS
from rodproof.derivations.theory import constrained

FUNCTIONS_OF_LOADS = (
    "strains",
    "strains_and_gap",
    "complementary_energy",
    "compliance",
    "stiffness_at_loads",
)
FUNCTIONS = (
    "strains",
    "loads",
    "stored_energy",
    "complementary_energy",
    "stiffness",
    "loads_and_stiffness",
    "compliance",
    "strains_and_gap",
    "stiffness_at_loads",
)
#: Where loads are declared zero the strains are not free, and nothing is a derivative by them.
BY_STRAINS = ("loads", "stored_energy", "stiffness", "loads_and_stiffness", "stiffness_at_loads")
#: What a module is written for, and the folder of ``generated`` that holds the committed ones.
TARGETS = {"numpy": "scenes", "numba": "numba"}
CONSTANT_NAMES = ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p")
LOAD_NAMES = tuple(s.name for s in LOADS)
STRAIN_NAMES = tuple(s.name for s in STRAINS)
#: A modulus of the linear rod, in the user's unit of force, by its name: gamma times the second.
MODULI = {
    "bending": "alpha",
    "twisting": "beta",
    "shearing": "zeta",
    "dilating": "eta",
    "coupling": "iota",
}
assert {s.name for s in CONSTANTS} == set(CONSTANT_NAMES)


class SceneError(ValueError):
    """A scene that cannot be read; the message is one sentence naming the thing and the rule."""


@dataclass(frozen=True)
class Key:
    """A key of a scene file: its kind and what it may say.

    Kinds are text, choice, names, numbers and ranges.
    """

    kind: str
    doc: str
    allowed: tuple[str, ...] = ()


def _key(kind: str, doc: str, allowed: Iterable[str] = ()) -> Mapping[str, Key]:
    return {"key": Key(kind, doc, tuple(allowed))}


@dataclass(frozen=True)
class Scene:
    """What a generated module holds; `keys` says what each field means."""

    name: str = field(metadata=_key("text", "The module's name, a Python identifier."))
    summary: str = field(
        default="A strain-limiting special Cosserat rod.",
        metadata=_key("text", "One line for the module's first line."),
    )
    functions: tuple[str, ...] = field(
        default=FUNCTIONS,
        metadata=_key("names", "The public functions, in the order of printing.", FUNCTIONS),
    )
    constraints: tuple[str, ...] = field(
        default=(),
        metadata=_key(
            "names",
            "Strains held at rest (their loads become reactions), or symmetries: achiral is "
            "iota = 0; planar is achiral, with loads in the plane of d1 and d3.",
            constrained.CONSTRAINTS,
        ),
    )
    loads: tuple[str, ...] = field(
        default=(),
        metadata=_key(
            "names",
            "The loads that are not zero; all that the constraints leave if empty.",
            LOAD_NAMES,
        ),
    )
    fixed: Mapping[str, float] = field(
        default_factory=dict,
        metadata=_key(
            "numbers",
            "Constants that are always these numbers; p = 2 has its own formulas.",
            CONSTANT_NAMES,
        ),
    )
    defaults: Mapping[str, float] = field(
        default_factory=dict,
        metadata=_key(
            "numbers", "Constants given at run time that have a default.", CONSTANT_NAMES
        ),
    )
    moduli: Mapping[str, float] = field(
        default_factory=dict,
        metadata=_key(
            "numbers",
            "Moduli of the linear rod, gamma alpha^2, gamma beta^2, gamma zeta^2, gamma eta^2 and "
            "gamma iota, as defaults from which the constants follow once gamma is known.",
            MODULI,
        ),
    )
    matrix: str = field(
        default="full",
        metadata=_key(
            "choice",
            "Stiffness and compliance whole, or packed: the entries on and above the diagonal, "
            "row by row.",
            ("full", "packed"),
        ),
    )
    ranges: Mapping[str, tuple[float, float]] = field(
        default_factory=dict,
        metadata=_key(
            "ranges",
            "Smallest and largest value of constants, which are checked, and of loads and strains, "
            "which the caller promises; guards go where the ranges prove them needless.",
            (*CONSTANT_NAMES, *LOAD_NAMES, *STRAIN_NAMES),
        ),
    )
    targets: tuple[str, ...] = field(
        default=("numpy",),
        metadata=_key(
            "names",
            "What to write: a NumPy module, a module of functions that numba compiles, or both.",
            TARGETS,
        ),
    )
    layout: str = field(
        default="first",
        metadata=_key("choice", "Components on the first or the last axes.", ("first", "last")),
    )
    precision: str = field(
        default="input",
        metadata=_key(
            "choice",
            "Type of the results; input keeps float32 and makes the rest float64.",
            ("input", "float64", "float32"),
        ),
    )
    at_limit: str = field(
        default="raise",
        metadata=_key(
            "choice",
            "What functions of the strains do at and past the limit, Q >= 1.",
            ("raise", "nan"),
        ),
    )

    def __post_init__(self) -> None:
        if not self.name.isidentifier() or keyword.iskeyword(self.name):
            raise SceneError(f"scene name {self.name!r} is not a Python identifier")
        if '"' in self.summary or "\\" in self.summary or "\n" in self.summary:
            raise SceneError(f"scene {self.name}: summary must be one line without quotes")
        if not self.targets:
            raise SceneError(f"scene {self.name}: targets must name at least one target")
        if not self.functions:
            raise SceneError(f"scene {self.name}: functions must name at least one function")
        for name, key in keys().items():
            self._check(name, key)
        self._check_loads()
        self._check_constants()
        self._check_ranges()

    def _check(self, name: str, key: Key) -> None:
        value = getattr(self, name)
        what = f"scene {self.name}: {name.removesuffix('s')}"
        if key.kind == "choice":
            known(f"scene {self.name}: {name}", value, key.allowed)
        elif key.kind != "text":
            for entry in value:
                known(what, entry, key.allowed)
            if len(set(value)) < len(value):
                raise SceneError(f"scene {self.name}: {name} names a {name[:-1]} twice")

    def _check_loads(self) -> None:
        kept = constrained.kept(self.constraints)
        left = [LOAD_NAMES[i] for i in kept]
        for load in self.loads:
            if load not in left:
                why = f"is none of what {' and '.join(self.constraints)} leaves, {', '.join(left)}"
                raise SceneError(f"scene {self.name}: load {load} {why}")
        if not kept:
            raise SceneError(f"scene {self.name}: the constraints leave nothing that moves")
        of_strains = [f for f in self.functions if f in BY_STRAINS]
        if of_strains and self.loads and set(self.loads) != set(left):
            kind = "derivative by" if of_strains[0] in FUNCTIONS_OF_LOADS else "function of"
            raise SceneError(
                f"scene {self.name}: {of_strains[0]} is a {kind} the strains, which are not "
                f"free where loads are zero; leave out loads, or ask for {FUNCTIONS_OF_LOADS[0]}"
            )

    def _check_constants(self) -> None:
        """Each constant is of this rod, is set once, and the numbers make a rod."""
        gone = {c.rigid.name for c in map(_constraint, self.constraints) if c.rigid is not None}
        gone |= {"iota"} if constrained.achiral(self.constraints) else set()
        derived = {MODULI[name]: value for name, value in self.moduli.items()}
        for group in (self.fixed, self.defaults, derived):
            for name, value in group.items():
                if name in gone:
                    rule = f"is no constant of a rod that is {' and '.join(self.constraints)}"
                    raise SceneError(f"scene {self.name}: {name} {rule}")
                if not math.isfinite(value) or (value <= 0 and name != "iota"):
                    rule = "a finite number" if name == "iota" else "positive and finite"
                    raise SceneError(f"scene {self.name}: {name} must be {rule}, not {value}")
        if self.fixed.get("iota") == 0:
            raise SceneError(f"scene {self.name}: for iota = 0 say constraints = ['achiral']")
        for name in CONSTANT_NAMES:
            if sum(name in group for group in (self.fixed, self.defaults, derived)) > 1:
                raise SceneError(f"scene {self.name}: {name} is set twice")
        for values in ({**self.fixed, **self.defaults}, derived):
            if {"beta", "eta", "iota"} <= set(values):
                beta, eta, iota = (Fraction(values[name]) for name in ("beta", "eta", "iota"))
                if not (beta * eta > iota**2 if values is derived else beta * eta > abs(iota)):
                    raise SceneError(f"scene {self.name}: beta^2 eta^2 - iota^2 > 0 fails")
        needed = {name for name, constant in MODULI.items() if constant not in gone}
        missing = [name for name in MODULI if name in needed - set(self.moduli)]
        if self.moduli and missing:
            raise SceneError(f"scene {self.name}: moduli lacks {', '.join(missing)}")

    def _check_ranges(self) -> None:
        for name, (low, high) in self.ranges.items():
            if not (math.isfinite(low) and math.isfinite(high) and low <= high):
                rule = "must be two finite numbers in order"
                raise SceneError(f"scene {self.name}: range {name} {rule}, not {low}, {high}")
            if name in CONSTANT_NAMES and name != "iota" and low <= 0:
                raise SceneError(f"scene {self.name}: range {name} must be positive, not {low}")
            if name in self.fixed:
                raise SceneError(f"scene {self.name}: {name} is fixed and has a range")
            if not low <= self.defaults.get(name, low) <= high:
                raise SceneError(f"scene {self.name}: the default of {name} is not in its range")


def keys() -> dict[str, Key]:
    """The keys of a scene file, in order."""
    return {f.name: f.metadata["key"] for f in fields(Scene)}


def committed_names() -> tuple[str, ...]:
    """Names of the scenes that come with the project, the full rod first."""
    folder = resources.files("rodproof.codegen").joinpath("scenes")
    names = (entry.name for entry in folder.iterdir())
    found = (name.removesuffix(".toml") for name in names if name.endswith(".toml"))
    return tuple(sorted(found, key=lambda name: (name != "full_rod", name)))


def committed(name: str) -> Scene:
    """A scene that comes with the project; raises `SceneError` with the nearest name."""
    known("scene", name, committed_names())
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
    for key in data:
        known(f"{source}: key", key, tuple(keys()))
    if "name" not in data:
        raise SceneError(f"{source}: key 'name' is missing")
    return Scene(**{key: _value(f"{source}: {key}", keys()[key], data[key]) for key in data})


def _value(what: str, key: Key, value: Any) -> Any:
    """The value as `Scene` wants it, after a look at its type."""
    if key.kind == "names":
        if not isinstance(value, list) or not all(isinstance(entry, str) for entry in value):
            raise SceneError(f"{what} must be a list of strings, not {value!r}")
        return tuple(value)
    if key.kind == "ranges":
        pairs = value.values() if isinstance(value, dict) else [None]
        if not all(isinstance(pair, list) and len(pair) == 2 for pair in pairs):
            raise SceneError(f"{what} must be a table of pairs of numbers, not {value!r}")
        ends = [
            _value(what, Key("numbers", ""), {n: pair[k] for n, pair in value.items()})
            for k in (0, 1)
        ]
        return {name: (ends[0][name], ends[1][name]) for name in value}
    if key.kind == "numbers":
        entries = value.values() if isinstance(value, dict) else [None]
        if not all(isinstance(e, (int, float)) and not isinstance(e, bool) for e in entries):
            raise SceneError(f"{what} must be a table of numbers, not {value!r}")
        return {name: float(number) for name, number in value.items()}
    if not isinstance(value, str):
        raise SceneError(f"{what} must be a string, not {value!r}")
    return value


def _constraint(name: str) -> constrained.Constraint:
    return constrained.CONSTRAINTS[name]


def known(what: str, value: str, allowed: tuple[str, ...]) -> None:
    """Raises `SceneError` with the nearest allowed value unless ``value`` is one."""
    if value in allowed:
        return
    near = difflib.get_close_matches(value, allowed, n=1, cutoff=0.5)
    hint = f"; did you mean {near[0]!r}?" if near else f"; known: {', '.join(allowed)}"
    raise SceneError(f"{what} {value!r} is unknown{hint}")
