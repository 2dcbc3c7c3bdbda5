"""Dimensions are solved from the law, not declared."""

from __future__ import annotations

import pytest

from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory.dimensions import dimension, force, length, of_constants


def test_of_constants() -> None:
    assert of_constants() == {
        alpha: (1, 0), beta: (1, 0), iota: (1, 0), gamma: (0, 1),
        zeta: (0, 0), eta: (0, 0), p: (0, 0),
    }  # fmt: skip


def test_the_printed_coupling_inequality_is_not_homogeneous() -> None:
    """alpha^2 beta^2 - iota^2 adds length^4 to length^2; beta^2 eta^2 - iota^2 does not."""
    assert dimension(alpha**2 * beta**2) != dimension(iota**2)
    assert dimension(beta**2 * eta**2) == dimension(iota**2)


def test_products() -> None:
    assert dimension(gamma * alpha**2 / (force * length**2)) == (0, 0)
    with pytest.raises(ValueError, match="no known dimension"):
        dimension(alpha.func("mass"))
