"""From a scene to its module: every arrow of the code generator in one place.

scene --lower--> naive kernels --passes--> kernels --print_module--> text --write--> file

The modules of equilibria hold such a text and the equations around it (`codegen.equilibria`).
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from rodproof.codegen import equilibria
from rodproof.codegen import files as disk
from rodproof.codegen import scene as toml
from rodproof.codegen.kernel import Kernel, validate
from rodproof.codegen.lower import lower
from rodproof.codegen.passes.choose import case, stabilise
from rodproof.codegen.passes.drop_guards import alone, drop_guards
from rodproof.codegen.passes.name import name
from rodproof.codegen.passes.order import order
from rodproof.codegen.passes.plain import plain, uncouple
from rodproof.codegen.passes.share import share
from rodproof.codegen.passes.specialise import drop_dead, specialise
from rodproof.codegen.scene import TARGETS, Scene
from rodproof.codegen.targets import numba_target, numpy_target
from rodproof.derivations.symbols import CONSTANTS

Pass = Callable[[Kernel], Kernel]

PRINTERS = {"numpy": numpy_target.print_module, "numba": numba_target.print_module}
FOLDERS = (*TARGETS.values(), equilibria.FOLDER)
INIT = {
    "numpy": '"""One module a scene; every byte is written by rodproof.codegen."""\n',
    "numba": '"""Modules that need numba, one a scene; written by rodproof.codegen."""\n',
}


@dataclass(frozen=True)
class Difference:
    """A generated file that is not what the source gives: ``kind`` is changed, missing or stray."""

    path: str
    kind: str
    diff: str


def passes(scene: Scene) -> tuple[Pass, ...]:
    """In this order; each takes a kernel and returns one that means the same in the scene."""
    chosen = case(scene)
    return (
        lambda kernel: stabilise(kernel, chosen),
        lambda kernel: specialise(kernel, scene),
        lambda kernel: drop_guards(kernel, scene),
        *TIDY,
    )


#: The last passes, which know nothing of the scene.
TIDY: tuple[Pass, ...] = (share, drop_dead, order, name)


def kernels(scene: Scene) -> tuple[Kernel, ...]:
    """The scene's kernels after all passes, with their plain kernels beside them.

    Where the scene's ranges prove that every point is in a plain kernel's region, that is all.
    """
    done = []
    for lowered in lower(scene):
        kernel = lowered
        for step in passes(scene):
            kernel = step(kernel)
        plain = plain_kernel(lowered, scene)
        if plain is not None:
            proved = alone(kernel, plain, scene)
            kernel = proved or replace(kernel, plain=plain)
        validate(kernel, frozenset(s.name for s in CONSTANTS))
        done.append(kernel)
    return tuple(done)


def plain_kernel(lowered: Kernel, scene: Scene) -> Kernel | None:
    """The plain kernel of the scene, if the function has one."""
    kernel = plain(lowered, square=case(scene).square)
    if kernel is None:
        return None
    for step in (lambda whole: specialise(whole, scene), uncouple, drop_dead, *TIDY):
        kernel = step(kernel)
    return kernel


def render(
    scene: Scene,
    verdicts: Mapping[str, str] | None = None,
    target: str = "numpy",
    done: tuple[Kernel, ...] | None = None,
) -> str:
    """The text of the scene's module; ``verdicts`` maps statement ids to what the header says.

    ``done`` are its kernels, where they are known already.
    """
    return PRINTERS[target](scene, done or kernels(scene), verdicts)


def files(scenes: Iterable[Scene], verdicts: Mapping[str, str] | None = None) -> dict[str, str]:
    """What the folder ``generated`` holds for these scenes: relative path to text."""
    texts = {}
    for s in scenes:
        for target in s.targets:
            texts[f"{TARGETS[target]}/__init__.py"] = INIT[target]
            texts[f"{TARGETS[target]}/{s.name}.py"] = render(s, verdicts, target)
    return texts


def everything(verdicts: Mapping[str, str] | None = None) -> dict[str, str]:
    """All that the folder ``generated`` holds: the committed scenes and the equilibria."""
    said = verdicts or {}
    return files(committed_scenes(), said) | equilibria.files(lambda s: render(s, said), said)


def committed_scenes() -> tuple[Scene, ...]:
    """Every scene that comes with the project."""
    return tuple(toml.committed(name) for name in toml.committed_names())


def write(
    root: Path, scenes: Iterable[Scene] | None = None, verdicts: Mapping[str, str] | None = None
) -> list[Path]:
    """Writes what ``root`` (the folder ``generated``) holds, or the scenes named; returns paths.

    Everything is rendered before anything is written, and each file is replaced in one step.
    """
    wanted = everything(verdicts) if scenes is None else files(scenes, verdicts)
    texts = {root / path: text for path, text in wanted.items()}
    for path, text in texts.items():
        disk.write_text(path, text)
    return list(texts)


def check(
    root: Path, scenes: Iterable[Scene] | None = None, verdicts: Mapping[str, str] | None = None
) -> list[Difference]:
    """How ``root`` differs from what the source gives; an empty list says it does not.

    With ``scenes`` only these are compared, and stray files are not looked for.
    """
    wanted = everything(verdicts) if scenes is None else files(scenes, verdicts)
    found = []
    for path, text in wanted.items():
        present = (root / path).is_file()
        old = (root / path).read_text("utf-8") if present else ""
        if not present or old != text:
            lines = difflib.unified_diff(
                old.splitlines(keepends=True),
                text.splitlines(keepends=True),
                f"{path} (on disk)",
                f"{path} (from the source)",
            )
            found.append(Difference(path, "changed" if present else "missing", "".join(lines)))
    if scenes is None:
        strays = (stray for folder in FOLDERS for stray in sorted((root / folder).glob("*.py")))
        names = (f"{stray.parent.name}/{stray.name}" for stray in strays)
        found += [Difference(name, "stray", "") for name in names if name not in wanted]
    return found
