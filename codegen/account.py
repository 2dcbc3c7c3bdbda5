"""What a scene needs and leaves out, and what that saves: ``rodproof scenes NAME``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from rodproof.codegen import generate
from rodproof.codegen.count import Cost, cost
from rodproof.codegen.kernel import Kernel
from rodproof.codegen.scene import CONSTANT_NAMES, Scene
from rodproof.codegen.targets.numpy_constants import used_constants
from rodproof.codegen.targets.numpy_header import ranges, scope
from rodproof.codegen.texts import function_text, shape_text

if TYPE_CHECKING:
    from rodproof.codegen.measure.beside import Beside


@dataclass(frozen=True)
class Line:
    """A function: how it is called, what a point costs, and what it costs in the full rod."""

    function: str
    call: str
    own: Cost
    full: Cost


@dataclass(frozen=True)
class Account:
    """What a scene takes, leaves out and costs."""

    scene: str
    summary: str
    restrictions: tuple[str, ...]
    guards: tuple[str, ...]
    constants: tuple[str, ...]
    constants_left_out: tuple[str, ...]
    lines: tuple[Line, ...]


def account(scene: Scene, done: tuple[Kernel, ...] | None = None) -> Account:
    """The account of a scene beside the full rod with the same functions.

    ``done`` are the scene's kernels, where they are known already.
    """
    kernels = done or generate.kernels(scene)
    whole = {k.name: k for k in generate.kernels(Scene("full", functions=scene.functions))}
    used = used_constants(kernels)
    return Account(
        scene.name,
        scene.summary,
        tuple(scope(scene)) or ("Nothing is left out.",),
        tuple(ranges(scene, kernels)),
        tuple(_constant(name, scene) for name in used),
        tuple(name for name in CONSTANT_NAMES if name not in used),
        tuple(Line(k.name, _call(k, scene), cost(k), cost(whole[k.name])) for k in kernels),
    )


def _constant(name: str, scene: Scene) -> str:
    if name in scene.fixed:
        return f"{name} = {scene.fixed[name]:g} always"
    return f"{name} = {scene.defaults[name]:g}" if name in scene.defaults else name


def _call(kernel: Kernel, scene: Scene) -> str:
    """``m (3, ...), n3 (...) -> u (3, ...), v3 (...)``."""
    text = function_text(kernel, scene)
    given, made = (
        ", ".join(f"{name} {shape_text(head, scene.layout)}" for name, head in arrays.items())
        for arrays in (text.inputs, text.outputs)
    )
    return f"{given} -> {made}"


COLUMNS = (
    "function",
    "arrays",
    "arithmetic",
    "transcendental",
    "energy shares",
    "temporaries",
)
TIMED = (*COLUMNS, "ns a point")


def table(found: Account) -> list[tuple[str, ...]]:
    """A row a function, its counts as ``own of the full rod's``: under `COLUMNS`."""
    return [
        (
            line.function,
            line.call,
            *(
                f"{mine} of {theirs}"
                for mine, theirs in (
                    (line.own.arithmetic, line.full.arithmetic),
                    (line.own.transcendental, line.full.transcendental),
                    (line.own.special, line.full.special),
                    (line.own.temporaries, line.full.temporaries),
                )
            ),
        )
        for line in found.lines
    ]


def timed(found: Account, times: Sequence[Beside]) -> list[tuple[str, ...]]:
    """The same with the time of one point: under `TIMED`."""
    taken = {time.function: f"{time.own:.3g} of {time.full:.3g}" for time in times}
    return [(*row, taken[row[0]]) for row in table(found)]


def data(found: Account) -> dict[str, Any]:
    """The account for JSON."""
    return asdict(found)


def sentences(found: Account) -> list[str]:
    """What stands above the table."""
    said = [found.summary] if found.summary else []
    said += [*found.restrictions, *found.guards, f"Constants: {', '.join(found.constants)}."]
    if found.constants_left_out:
        said.append(f"Constants left out: {', '.join(found.constants_left_out)}.")
    return said


def title(found: Account) -> str:
    """The same as lines."""
    return "\n".join([*sentences(found), "Operations a point, of how many in the full rod:"])
