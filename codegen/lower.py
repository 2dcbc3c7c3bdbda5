"""From derived objects to kernels: one kernel for each public function, as the derivation has it.

A lowered kernel is exact and naive. It has the structure of the theory (the form, the radius, one
radial factor, K or its inverse plus a rank-one term) and none of the arrangements that keep it
accurate: those are the business of `rodproof.codegen.passes.stabilise`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Gauge, Kernel, Limit, Output, symbol
from rodproof.codegen.scene import Scene
from rodproof.derivations.symbols import LOADS, STRAINS, p
from rodproof.derivations.theory import constitutive as theory

x, y = theory.x, theory.y
factor, q, q_star = symbol("factor"), symbol("q"), symbol("q_star")

#: The statements each array's components rest on, in the order of the components.
STRAIN_STATEMENTS = (
    "const-u-mu",
    "const-u-mu",
    "const-u-3",
    "const-v-mu",
    "const-v-mu",
    "const-v-3",
)
LOAD_STATEMENTS = ("const-m-mu", "const-m-mu", "const-m-3", "const-n-mu", "const-n-mu", "const-n-3")
HESSIAN_STATEMENTS = (
    ("hess-m-u", "hess-m-u", "hess-m-u3", "hess-m-v", "hess-m-v", "hess-m-v3"),
    ("hess-m-u", "hess-m-u", "hess-m-u3", "hess-m-v", "hess-m-v", "hess-m-v3"),
    ("hess-m-u3", "hess-m-u3", "hess-m3-u3", "hess-m3-v", "hess-m3-v", "hess-m3-v3"),
    ("hess-m-v", "hess-m-v", "hess-m3-v", "hess-n-v", "hess-n-v", "hess-n-v3"),
    ("hess-m-v", "hess-m-v", "hess-m3-v", "hess-n-v", "hess-n-v", "hess-n-v3"),
    ("hess-m-v3", "hess-m-v3", "hess-m3-v3", "hess-n-v3", "hess-n-v3", "hess-n3-v3"),
)

LOAD_NAMES = tuple(s.name for s in LOADS)
STRAIN_NAMES = tuple(s.name for s in STRAINS)

LOAD_GAUGE = Gauge("reduce_loads", LOAD_NAMES, "q_star", "size", "y")
STRAIN_GAUGE = Gauge("reduce_strains", (*STRAIN_NAMES[:5], "stretch"), "q", "size", "x")
LIMIT = Limit("q", "strains must satisfy Q(u, v) < 1")


def lower(scene: Scene) -> tuple[Kernel, ...]:
    """The naive kernels of the scene's functions, in the scene's order."""
    return tuple(LOWER[name]() for name in scene.functions)


def strains_at_loads() -> tuple[sp.Expr, ...]:
    """K^{-1} sigma, the strains from rest at small load times gamma."""
    return tuple(theory.compliance_at_rest() * sp.Matrix(LOADS))


def loads_at_strains() -> tuple[sp.Expr, ...]:
    """K eps, the loads at small strain divided by gamma, with v3 - 1 as one name."""
    return tuple(from_rest(row) for row in theory.stiffness_at_rest() * _strain_from_rest())


def from_rest(expr: sp.Expr) -> sp.Expr:
    """The expression with v3 - 1 named ``stretch``."""
    return expr.xreplace({theory.STRAIN_FROM_REST[5]: symbol("stretch")})


def strain_factor() -> sp.Expr:
    """x/y as a function of the load radius y."""
    return theory.radial_law().strain / y


def load_factor() -> sp.Expr:
    """y/x as a function of the strain radius x."""
    return theory.radial_law().load / x


def strain_weight() -> sp.Expr:
    """-d log(x/y)/d log y: the strain direction is softer by this share than those across it."""
    return sp.simplify(-y * sp.diff(sp.log(strain_factor()), y))


def load_weight() -> sp.Expr:
    """d log(y/x)/d log x: the load direction is stiffer by this share than those across it."""
    return sp.simplify(x * sp.diff(sp.log(load_factor()), x))


def load_factor_at_loads() -> sp.Expr:
    """y/x as a function of the load radius y."""
    return 1 / strain_factor()


def load_weight_at_loads() -> sp.Expr:
    """d log(y/x)/d log x, x^p/(1 - x^p), as a function of the load radius y."""
    return load_weight().subs(x, theory.radial_law().strain)


def limit_gap() -> sp.Expr:
    """1 - x^p, the distance to the strain limit, as a function of the load radius y."""
    return 1 - theory.radial_law().strain ** p


def lower_strains() -> Kernel:
    """u = dW*/dm and v = e3 + dW*/dn (eq:uconst to eq:v3const)."""
    rest = (0, 0, 0, 0, 0, 1)
    small = _named("e", strains_at_loads())
    outputs = tuple(
        Output("uv"[i // 3], (i % 3,), rest[i] + factor * row.symbol, (STRAIN_STATEMENTS[i],))
        for i, row in enumerate(small)
    )
    body = (*_load_form(), _load_factor(), *small)
    return Kernel("strains", LOAD_NAMES, body, outputs, LOAD_GAUGE)


def lower_strains_and_gap() -> Kernel:
    """The strains, and how far they are from the limit, which they say no more when near it."""
    strains = lower_strains()
    output = Output("limit_gap", (), limit_gap(), ("strain-limit",))
    return replace(strains, name="strains_and_gap", outputs=(*strains.outputs, output))


def lower_loads() -> Kernel:
    """m = dW/du and n = dW/dv (eq:mconst to eq:n3const)."""
    small = _named("s", loads_at_strains())
    outputs = tuple(
        Output("mn"[i // 3], (i % 3,), factor * row.symbol, (LOAD_STATEMENTS[i],))
        for i, row in enumerate(small)
    )
    body = (*_strain_form(), _stiff_factor(), *small)
    return Kernel("loads", STRAIN_NAMES, body, outputs, STRAIN_GAUGE, LIMIT)


def lower_complementary_energy() -> Kernel:
    """W* as its defining integral (eq:compenergy)."""
    energy = theory.complementary_energy()
    output = Output("w_star", (), energy, ("wstar-definition",))
    return Kernel("complementary_energy", LOAD_NAMES, _load_form(), (output,), LOAD_GAUGE)


def lower_stored_energy() -> Kernel:
    """W as its integral along the ray from rest (eq:stenergy)."""
    energy = theory.stored_energy()
    output = Output("w", (), energy, ("w-definition",))
    return Kernel("stored_energy", STRAIN_NAMES, _strain_form(), (output,), STRAIN_GAUGE, LIMIT)


def lower_compliance() -> Kernel:
    """D^2 W* = (x/y) (K^{-1} - weight e e^T), with d = K^{-1} sigma/y."""
    weight = Assignment("share", strain_weight())
    small = _named("e", strains_at_loads())
    along = _named("d", tuple(row.symbol / y for row in small))
    body = (*_load_form(), _load_factor(), weight, *small, *along)

    def entry(i: int, j: int) -> sp.Expr:
        rank_one = weight.symbol * along[i].symbol * along[j].symbol
        return factor * (theory.compliance_at_rest()[i, j] - rank_one)

    outputs = _symmetric("soft", entry, lambda i, j: ("wstar-gradient",))
    return Kernel("compliance", LOAD_NAMES, body, outputs, LOAD_GAUGE)


def lower_stiffness() -> Kernel:
    """D^2 W = (y/x) (K + weight t t^T), with t = K eps/x."""
    weight = Assignment("share", load_weight())
    small = _named("s", loads_at_strains())
    along = _named("t", tuple(row.symbol / x for row in small))
    body = (*_strain_form(), *_strain_radius(), _stiff_factor(), weight, *small, *along)

    def entry(i: int, j: int) -> sp.Expr:
        rank_one = weight.symbol * along[i].symbol * along[j].symbol
        return factor * (theory.stiffness_at_rest()[i, j] + rank_one)

    outputs = _symmetric("stiff", entry, lambda i, j: (HESSIAN_STATEMENTS[i][j],))
    return Kernel("stiffness", STRAIN_NAMES, body, outputs, None, LIMIT)


def lower_stiffness_at_loads() -> Kernel:
    """D^2 W at the strains of these loads, eps = (x/y) K^{-1} sigma: so K eps/x is sigma/y."""
    factor_at_loads = Assignment("factor", load_factor_at_loads(), ("strain-limit",), "harden")
    weight = Assignment("share", load_weight_at_loads())
    along = _named("t", tuple(load / y for load in LOADS))
    body = (*_load_form(), factor_at_loads, weight, *along)

    def entry(i: int, j: int) -> sp.Expr:
        rank_one = weight.symbol * along[i].symbol * along[j].symbol
        return factor * (theory.stiffness_at_rest()[i, j] + rank_one)

    outputs = _symmetric("stiff", entry, lambda i, j: (HESSIAN_STATEMENTS[i][j],))
    return Kernel("stiffness_at_loads", LOAD_NAMES, body, outputs, LOAD_GAUGE)


def lower_loads_and_stiffness() -> Kernel:
    """The loads and their derivative by the strains, from the same form and factor."""
    loads, stiffness = lower_loads(), lower_stiffness()
    return replace(
        stiffness,
        name="loads_and_stiffness",
        body=tuple(a for a in stiffness.body if a not in _strain_radius()),
        outputs=(*loads.outputs, *stiffness.outputs),
        gauge=loads.gauge,
    )


def _named(letter: str, rows: tuple[sp.Expr, ...]) -> tuple[Assignment, ...]:
    return tuple(Assignment(f"{letter}{i}", row) for i, row in enumerate(rows, start=1))


def _strain_from_rest() -> sp.Matrix:
    return sp.Matrix(theory.STRAIN_FROM_REST)


def _load_form() -> tuple[Assignment, ...]:
    return (Assignment("q_star", theory.dual_form(), ("qstar-form",), "reduce_loads"),)


def _strain_form() -> tuple[Assignment, ...]:
    return (
        Assignment("stretch", theory.STRAIN_FROM_REST[5]),
        Assignment("q", from_rest(theory.quadratic_form()), ("q-form",), "reduce_strains"),
    )


def _strain_radius() -> tuple[Assignment, ...]:
    return (Assignment("x", sp.sqrt(q)),)


def _load_factor() -> Assignment:
    return Assignment("factor", strain_factor(), (), "soften")


def _stiff_factor() -> Assignment:
    return Assignment("factor", load_factor(), ("strain-limit",), "stiffen")


def _symmetric(
    array: str,
    entry: Callable[[int, int], sp.Expr],
    statements: Callable[[int, int], tuple[str, ...]],
) -> tuple[Output, ...]:
    """The 21 entries on and above the diagonal; a target mirrors them if it writes all 36."""
    return tuple(
        Output(array, (i, j), entry(i, j), statements(i, j)) for i in range(6) for j in range(i, 6)
    )


LOWER: dict[str, Callable[[], Kernel]] = {
    "strains": lower_strains,
    "loads": lower_loads,
    "stored_energy": lower_stored_energy,
    "complementary_energy": lower_complementary_energy,
    "stiffness": lower_stiffness,
    "loads_and_stiffness": lower_loads_and_stiffness,
    "compliance": lower_compliance,
    "strains_and_gap": lower_strains_and_gap,
    "stiffness_at_loads": lower_stiffness_at_loads,
}
