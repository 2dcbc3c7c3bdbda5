"""Symmetry: what the operations do to strains, and what the energy keeps."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import introduction
from rodproof.derivations.checks import symmetry as rules
from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import STRAINS, iota, u3, v3
from rodproof.derivations.theory import loading, symmetry
from rodproof.derivations.theory.frames import psi, theta
from rodproof.derivations.theory.loading import couple, phase
from rodproof.derivations.theory.symmetry import FLIP, REFLECTION, ROTATION, Operation, action

E = sp.diag(1, -1, 1)


def test_a_flip_changes_both_strains_alike() -> None:
    assert action(FLIP).on_u == action(FLIP).on_v == E


def test_a_reflection_changes_the_axial_strain_by_the_other_sign() -> None:
    assert action(REFLECTION).on_u == -E
    assert action(REFLECTION).on_v == E


def test_the_two_half_turns_differ_by_a_rotation() -> None:
    other = Operation("flip", sp.ImmutableMatrix(sp.diag(1, -1, -1)), FLIP.space, -1)
    turned = action(ROTATION).on_v.subs(psi, sp.pi) * E
    assert action(other).on_v == action(other).on_u == turned


def test_every_operation_keeps_the_rod_at_rest() -> None:
    rest = sp.Matrix([0, 0, 1])
    assert all(action(o).on_v * rest == rest for o in (ROTATION, FLIP, REFLECTION))


def test_a_reflection_turns_the_chirality_round() -> None:
    change = rules._change((action(REFLECTION).on_u, action(REFLECTION).on_v))
    assert sp.expand(change + 4 * iota * u3 * (v3 - 1)) == 0


def test_the_printed_isotropy_moves_the_rod_at_rest() -> None:
    moved = symmetry.form_after(E, -E).subs(dict(zip(STRAINS, (0, 0, 0, 0, 0, 1), strict=True)))
    assert moved.is_positive


def test_two_parameters_and_no_more() -> None:
    accepts = introduction.FAMILY.accepts
    assert accepts(sp.Tuple(couple, theta))
    assert not accepts(sp.Tuple(couple))
    assert not accepts(sp.Tuple(couple, theta, phase))


def test_the_third_director_precesses_about_the_couple() -> None:
    """d_3' = u x d_3 equals omega (m/M) x d_3 with omega = flexure/sin theta, in the directors."""
    u = sp.Matrix(loading.strains_of_spinning_couple()[:3])
    third, at = sp.Matrix([0, 0, 1]), (sp.sin(theta) * sp.cos(phase), sp.sin(theta) * sp.sin(phase))
    direction = sp.Matrix([*at, sp.cos(theta)])
    curvature, _, stretch = loading.helix()
    omega = curvature * stretch / sp.sin(theta)
    gap = u.cross(third) - omega * direction.cross(third)
    assert all(Field().is_zero(entry) for entry in gap)
