"""Writes the modules of equilibria: right-hand sides with their Jacobians."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rodproof.codegen.equilibria import (
    directors,
    euler_angles,
    law,
    states,
    states_template,
    template,
    text,
)
from rodproof.codegen.scene import Scene

FOLDER = "equilibria"
INIT = '"""Rods in equilibrium as numbers; every byte is written by rodproof.codegen."""\n'
FIELD = "Field = ArrayLike | Callable[[Any], ArrayLike]  # constant, at every s, or of s"

#: The law that the states need: strains and energy by loads.
STATES = Scene(name="states", functions=("strains", "complementary_energy"))


def scene(name: str) -> Scene:
    """The law that the equations need: the full rod, by loads."""
    return Scene(name=name, functions=("strains", "compliance"))


def files(render: Callable[[Scene], str], verdicts: Mapping[str, str]) -> dict[str, str]:
    """The folder's files, relative path to text; ``render`` makes a scene's module."""
    return {
        f"{FOLDER}/__init__.py": INIT,
        f"{FOLDER}/directors.py": _directors(render(scene("directors")), verdicts),
        f"{FOLDER}/euler_angles.py": _euler_angles(render(scene("euler_angles")), verdicts),
        f"{FOLDER}/states.py": _states(render(STATES), verdicts),
    }


def _directors(module: str, verdicts: Mapping[str, str]) -> str:
    heading = [
        "A rod in equilibrium, by its directors: rates and Jacobian for any integrator.",
        *text.paragraphs(
            "Made by: rodproof generate",
            "The frame is a quaternion, the couple is in the directors, the center line and the "
            "force are in the fixed basis; no angle, so no place where the equations are singular. "
            "The strains come from the loads, so that no load is too large.",
            text.cited(
                (
                    "darboux-formula", "darboux-components", "force-balance", "moment-balance",
                    "extra-balance-in-directors", "const-u-mu", "const-u-3", "const-v-mu",
                    "const-v-3", "wstar-gradient",
                ),
                verdicts,
            ),
        ),
    ]  # fmt: skip
    parts = [
        template.TYPES + FIELD,
        *(text.function(piece) for piece in (*law.pieces(), *directors.pieces())),
        template.STACK,
        template.COMMON,
        template.DIRECTORS,
    ]
    return text.module(heading, module, parts)


def _euler_angles(module: str, verdicts: Mapping[str, str]) -> str:
    heading = [
        "A rod in equilibrium under the force N g_3, by Euler angles: rates and Jacobian.",
        *text.paragraphs(
            "Made by: rodproof generate",
            "The reduced system of the paper, for any gamma. The angles are singular where "
            "sin(theta) = 0, and slow near it; the module directors is not.",
            text.cited(
                (
                    "euler-n", "euler-u1", "euler-u2", "euler-u3", "ode-phi", "ode-theta",
                    "ode-psi", "ode-M1", "ode-M2", "ode-M3", "const-u-mu", "const-u-3",
                    "const-v-mu", "const-v-3", "wstar-gradient",
                ),
                verdicts,
            ),
        ),
    ]  # fmt: skip
    parts = [
        template.TYPES,
        *(text.function(piece) for piece in (*law.pieces(), *euler_angles.pieces())),
        template.STACK,
        template.COMMON,
        template.EULER_ANGLES,
    ]
    return text.module(heading, module, parts)


def _states(module: str, verdicts: Mapping[str, str]) -> str:
    heading = [
        "Rods in equilibrium in closed form: straight, sheared, twisted, helical and circular.",
        *text.paragraphs(
            "Made by: rodproof generate",
            "Under a thrust N g_3 or a couple M g_3 these are the states whose strains do not "
            "change along the rod: their angle, strains, directors and center line, the threshold "
            "of the sheared states and their limit. `equilibria` lists what a thrust allows.",
            text.cited(
                (
                    "moduli-condition-1", "moduli-condition-2", "n-thresh", "sheared-existence",
                    "extra-threshold-sharp", "extra-helix-axis", "helix-phi", "helix-psi",
                    "const-u-mu", "const-u-3", "const-v-mu", "const-v-3", "wstar-definition",
                ),
                verdicts,
            ),
        ),
    ]  # fmt: skip
    fields = states.fields()
    parts = [
        template.TYPES,
        *(text.function(piece) for piece in states.pieces()),
        template.STACK,
        *(
            part.substitute({name: fields[name] for name in part.get_identifiers()})
            for part in (states_template.STATE, states_template.BRANCH, states_template.LISTED)
        ),
    ]
    return text.module(heading, module, parts, IMPORTS)


#: What the branch of sheared states needs beyond the law: exact threshold, once a rod.
IMPORTS = {
    "from dataclasses import": "from contextlib import suppress\nfrom dataclasses import",
    "from fractions import Fraction\n": "from decimal import MAX_EMAX, MIN_EMIN, Decimal, "
    "localcontext\nfrom fractions import Fraction\n",
    "from functools import cached_property\n": "from functools import cache, cached_property\n",
}
