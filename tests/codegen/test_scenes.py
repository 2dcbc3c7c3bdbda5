"""Each scene is the full rod restricted to it, exactly, and holds nothing that it does not need."""

from __future__ import annotations

import importlib
import io
import itertools
import sys
import tokenize
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from rodproof.codegen import generate, lower, scene
from rodproof.codegen.kernel import Kernel
from rodproof.codegen.live import live, substitution
from rodproof.codegen.passes.specialise import specialise
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import LOADS, STRAINS, chiral_gap
from rodproof.derivations.theory import constitutive as theory
from rodproof.derivations.theory import constrained
from rodproof.generated.scenes import full_rod

SCENES = {name: scene.committed(name) for name in scene.committed_names()}
NAIVE = {kernel.name: kernel for kernel in lower.lower(Scene("full"))}
CALLS = [(name, f) for name, s in SCENES.items() for f in s.functions]
TEXTS = {name: generate.render(s) for name, s in SCENES.items()}


def unfolded(kernel: Kernel) -> list[sp.Expr]:
    """The outputs with every assignment put in, v3 - 1 included."""
    defined = {a.symbol: a.expr for a in kernel.body}
    square = "q_star" if kernel.inputs[0] in LOAD_NAMES else "q"
    radius = theory.y if square == "q_star" else theory.x
    defined[radius] = sp.sqrt(sp.Symbol(square, positive=True))
    defined[sp.Symbol(square, positive=True)] = defined.pop(sp.Symbol(square, real=True))
    found = [o.expr for o in kernel.outputs]
    for _ in range(8):
        found = [expr.xreplace(defined) for expr in found]
    return found


def form(expr: sp.Expr) -> sp.Expr:
    """Energies by the upper limit of their integral, which says all: the integrand is fixed."""
    integrals = list(expr.atoms(sp.Integral))
    return integrals[0].limits[0][2] if integrals else expr


@pytest.mark.parametrize(("own", "name"), CALLS)
def test_scene_is_the_full_rod_restricted(own: str, name: str) -> None:
    """Exactly: the scene's lowered kernel, unfolded, and the full one with the restriction put in.

    The lost loads are zero in both; `test_constrained` proves that the limit of a stiff rod does
    not depend on reactions, so that zero stands for any value of these.
    """
    at, known = live(SCENES[own]), substitution(SCENES[own])
    forms = (theory.dual_form().xreplace(known), theory.quadratic_form().xreplace(known))
    field = Field([chiral_gap.xreplace(known), *forms])
    own_outputs = unfolded(specialise(NAIVE[name], SCENES[own]))
    whole = [e.xreplace(known) for e in unfolded(NAIVE[name])]
    kept = at.strains if name.startswith("strains") else at.loads
    indices = [
        (3 * (o.array in "vn") + o.index[0],) if len(o.index) == 1 else o.index
        for o in NAIVE[name].outputs
    ]
    whole = [e for e, index in zip(whole, indices, strict=True) if set(index) <= set(kept)]
    assert len(own_outputs) == len(whole)
    for mine, full in zip(own_outputs, whole, strict=True):
        assert field.equal(form(mine), form(full))


CONSTRAINED = [n for n, s in SCENES.items() if s.constraints and not s.loads]


@pytest.mark.parametrize("own", CONSTRAINED)
def test_constrained_scene_is_the_derived_limit(own: str) -> None:
    """Strains and loads against the exact limits of the theory, on all loads, reactions too."""
    names, at = SCENES[own].constraints, live(SCENES[own])
    field = Field([constrained.dual_form(*names), constrained.quadratic_form(*names)])
    rest = (0, 0, 0, 0, 0, 1)
    strains = unfolded(specialise(NAIVE["strains"], SCENES[own]))
    zero = {LOADS[i]: 0 for i in range(6) if i not in at.loads}
    reactions = constrained.reactions(names)
    for i, got in zip(at.strains, strains, strict=True):
        want = constrained.strains(*names)[i]
        assert not {LOADS[k] for k in reactions} & want.free_symbols
        assert field.equal(got - rest[i], want.subs(zero))
    loads = unfolded(specialise(NAIVE["loads"], SCENES[own]))
    for got, want in zip(loads, constrained.loads(*names), strict=True):
        lost = {STRAINS[k]: rest[k] for k in range(6) if k not in at.loads}
        assert field.equal(got, want.subs(lost))


#: Words that must not occur in the code of a scene.
SHEAR = {"zeta", "per_zeta", "n1", "n2", "v1", "v2", "nu_1", "nu_2", "lam_1", "lam_2", "shear"}
SHEAR |= {"b1", "b2", "bb1", "bb2", "d4", "d5", "t4", "t5"}
STRETCH = {"eta", "per_eta", "n3", "v3", "nu_3", "lam_3", "extend", "dilatation", "stretch"}
CHIRAL = {"iota", "chirality", "gap", "per_gap", "n3_dilates", "m3_contracts"}
CHIRAL |= {"untwist", "m3_extends", "slack_load", "pull"}
CHIRAL |= {"dilatation", "c3", "c6", "cc6", "tau"}
POWERS = {
    "exp",
    "log",
    "log1p",
    "expm1",
    "p",
    "_work_share",
    "work_share",
    "log_max",
}
OUT_OF_PLANE = {
    "m1",
    "m3",
    "n2",
    "u1",
    "u3",
    "v2",
    "mu_1",
    "mu_3",
    "nu_2",
    "beta",
    "per_beta",
    "turn",
}
LEFT_OUT = {
    "dsdna": SHEAR,
    "kirchhoff": SHEAR | STRETCH | CHIRAL,
    "achiral": CHIRAL,
    "planar": CHIRAL | OUT_OF_PLANE,
    "full_rod_p2": POWERS | {"LOG_MAX", "log_max"},
    "thrust": {"m1", "m2", "m3", "mu_1", "mu_2", "mu_3", "alpha", "per_alpha", "u1", "u2", "bend"},
    "couple": SHEAR | {"n3", "nu_3"},
}


def names_in(text: str) -> set[str]:
    """Names of the code; words of docstrings and comments are not names."""
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return {token.string for token in tokens if token.type == tokenize.NAME}


@pytest.mark.parametrize("own", LEFT_OUT)
def test_scene_has_only_what_it_needs(own: str) -> None:
    assert not names_in(TEXTS[own]) & LEFT_OUT[own]
    assert names_in(TEXTS["full_rod"]) & LEFT_OUT[own]


@pytest.mark.parametrize("own", SCENES)
def test_nothing_is_multiplied_by_zero_or_computed_for_nobody(own: str) -> None:
    """No number but 1, 2 and 1/2 in a formula, and every assignment is used."""
    for kernel in generate.kernels(SCENES[own]):
        used = {s.name for expr in kernel.expressions() for s in expr.free_symbols}
        used |= {kernel.limit.quantity} if kernel.limit else set()
        used |= {kernel.gauge.square} if kernel.gauge else set()
        assert {a.name for a in kernel.body} <= used
        for expr in kernel.expressions():
            assert all(
                n in (-2, -1, 1, 2, sp.Rational(1, 2)) or abs(n) == sp.Rational(1, 2)
                for n in expr.atoms(sp.Number)
                if n != 0
            )


@pytest.mark.parametrize("p", [None, 2.0])
@pytest.mark.parametrize("pair", list(itertools.combinations(LOAD_NAMES, 2)), ids="-".join)
def test_two_loads_alone_have_the_compliance_of_the_full_rod(
    pair: tuple[str, str], p: float | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = Scene("pair", functions=("compliance",), loads=pair, fixed={"p": p} if p else {})
    (tmp_path / "pair.py").write_text(generate.render(own))
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "pair", raising=False)
    law = importlib.import_module("pair")
    values = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3}
    c = full_rod.Constants(**values, p=p or 3.3)
    used = {f.name for f in fields(law.Constants) if f.init}
    mine = law.Constants(**{k: v for k, v in {**values, "p": p or 3.3}.items() if k in used})
    load = np.zeros((6, 3))
    at = [LOAD_NAMES.index(name) for name in pair]
    load[at] = [[0.3, 1e-3, 40.0], [-0.2, 5.0, 7.0]]
    groups = [load[at][[i for i, k in enumerate(at) if k // 3 == part]] for part in (0, 1)]
    given = [rows if len(rows) > 1 else rows[0] for rows in groups if len(rows)]
    whole = full_rod.compliance(load[:3], load[3:], c)[np.ix_(at, at)]
    assert np.allclose(law.compliance(*given, mine), whole, rtol=1e-14, atol=1e-16)
