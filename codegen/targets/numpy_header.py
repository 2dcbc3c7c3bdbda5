"""The docstring of a NumPy module: scene, command, statements, domain, operation counts."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping

from rodproof.codegen.count import cost
from rodproof.codegen.kernel import Kernel
from rodproof.codegen.live import live
from rodproof.codegen.scene import FUNCTIONS_OF_LOADS, LOAD_NAMES, Scene
from rodproof.codegen.texts import STATEMENT_LABELS, STRAIN_NAMES
from rodproof.derivations.theory import constrained

WIDTH = 98


ONE_POINT = (
    "One point: tuples of numbers (a float for a single component) are answered with tuples of "
    "floats, in plain Python, where nothing is extreme. They agree with the arrays' answers within "
    "8 ulps of the largest component, or as far as the inputs determine what grows near the limit."
)


def header(
    scene: Scene, kernels: tuple[Kernel, ...], verdicts: Mapping[str, str], target: str = ""
) -> str:
    """The module's docstring; ``target`` is named unless it is NumPy."""
    statements = dict.fromkeys(s for kernel in kernels for s in kernel.statements())
    cited = "; ".join(_statement(s, verdicts) for s in statements)
    aim = f" for {target}" if target else ""
    ordinarily = " where nothing is extreme" if any(kernel.plain for kernel in kernels) else ""
    noted = "paper label, verdict; as corrected if refuted" if verdicts else "paper label"
    lines = [
        f'"""{scene.summary}',
        "",
        f"Scene {scene.name}{aim}, made by: rodproof generate {scene.name}",
        *(line for said in scope(scene) for line in ("", *textwrap.wrap(said, WIDTH))),
        *(line for said in ranges(scene, kernels) for line in ("", *textwrap.wrap(said, WIDTH))),
        "",
        *textwrap.wrap(
            f"Statements it rests on ({noted}): {cited}.", WIDTH, break_on_hyphens=False
        ),
        "",
        f"Domain: {_domain(scene, kernels)}.",
        "",
        f"Operations a point{ordinarily}: arithmetic, transcendental, energy shares, temporaries",
    ]
    if not target:
        lines[-1:-1] = [*textwrap.wrap(ONE_POINT, WIDTH), ""]
    for kernel in kernels:
        c = cost(kernel)
        counts = (c.arithmetic, c.transcendental, c.special, c.temporaries)
        lines.append(f"    {kernel.name:<20}" + "".join(f"{count:>5}" for count in counts))
    return "\n".join([*lines, '"""'])


def _statement(statement: str, verdicts: Mapping[str, str]) -> str:
    notes = [STATEMENT_LABELS.get(statement, ""), verdicts.get(statement, "")]
    return statement + "".join(f" {note}" for note in notes if note)


def ranges(scene: Scene, kernels: tuple[Kernel, ...]) -> list[str]:
    """The ranges, and the guards that they made needless, a sentence each."""
    if not scene.ranges:
        return []
    spans = ", ".join(f"{n} in [{a:g}, {b:g}]" for n, (a, b) in scene.ranges.items())
    said = [f"Ranges: {spans}. Constants are checked; loads and strains are the caller's promise."]
    every = dict.fromkeys(guard for kernel in kernels for guard in kernel.dropped)
    users = {guard: [k.name for k in kernels if guard in k.dropped] for guard in every}
    gone = "; ".join(f"{guard} ({', '.join(names)})" for guard, names in users.items())
    if gone:
        said.append(f"Guards proved needless by interval arithmetic over the ranges: {gone}.")
    return said


def _domain(scene: Scene, kernels: tuple[Kernel, ...]) -> str:
    parts = []
    if any(function in FUNCTIONS_OF_LOADS for function in scene.functions):
        parts.append("loads with finite Q*^(1/2)")
    if any(function not in FUNCTIONS_OF_LOADS for function in scene.functions):
        answer = "an error" if scene.at_limit == "raise" else "nan"
        unguarded = any("the strain limit" in kernel.dropped for kernel in kernels)
        promised = "as the ranges promise" if unguarded else f"else {answer}"
        parts.append(f"strains with Q < 1, {promised}")
    return "; ".join(parts)


def scope(scene: Scene) -> list[str]:
    """What the scene leaves out and why, a sentence each; nothing for the full rod."""
    said = []
    kept = constrained.kept(scene.constraints)
    at_rest = [_at_rest(i) for i in range(6) if i not in kept]
    reactions = [LOAD_NAMES[i] for i in constrained.reactions(scene.constraints)]
    if scene.constraints:
        parts = [f"Constraints: {', '.join(scene.constraints)}"]
        parts += [f"{', '.join(at_rest)}"] if at_rest else []
        if reactions:
            verb = "is a reaction" if len(reactions) == 1 else "are reactions"
            parts.append(f"{', '.join(reactions)} {verb}, which the law does not determine")
        zero = [LOAD_NAMES[i] for i in range(6) if i not in kept and LOAD_NAMES[i] not in reactions]
        parts += [f"{', '.join(zero)} must be zero"] if zero else []
        parts += ["iota = 0"] if _needs_achirality(scene) else []
        said.append("; ".join(parts) + ".")
    dead = [LOAD_NAMES[i] for i in kept if i not in live(scene).loads]
    if dead:
        still = [_at_rest(i) for i in kept if i not in live(scene).strains]
        follow = [STRAIN_NAMES[i] for i in live(scene).strains if i not in live(scene).loads]
        text = f"Without the loads {', '.join(dead)}"
        text += f"; so {', '.join(still)}" if still else ""
        text += f"; {', '.join(follow)} follows by the coupling" if follow else ""
        said.append(f"{text}.")
    if scene.fixed:
        said.append(f"Fixed: {', '.join(f'{n} = {v:g}' for n, v in scene.fixed.items())}.")
    return said


def _needs_achirality(scene: Scene) -> bool:
    return bool({"achiral", "planar"} & set(scene.constraints))


def _at_rest(component: int) -> str:
    return f"{STRAIN_NAMES[component]} = {int(component == 5)}"
