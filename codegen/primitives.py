"""The one special function a kernel may hold, with its definition; each target implements it."""

from __future__ import annotations

import sympy as sp


class WorkShare(sp.Function):
    """Stored energy over work, W/(sigma . eps), as a function of the depth and of p.

    ``WorkShare(depth, p)`` with ``depth = -log(1 - x^p) >= 0`` is

        int_0^x s (1 - s^p)^{-1/p} ds / (x^2 (1 - x^p)^{-1/p}).

    It falls from 1/2 at rest to 0 at the strain limit. With s^p = z/(1 + z) in the integral it is
    an Euler integral, hence 1/2 2F1(1, 1/p; 1 + 2/p; -h) with h = x^p/(1 - x^p) = (y/gamma)^p.
    """

    nargs = 2

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """d/d depth, from the definition by the product rule; not differentiated by p."""
        if argindex != 1:
            raise sp.ArgumentIndexError(self, argindex)
        depth, p = self.args
        left = sp.exp(-depth)  # 1 - x^p
        return (left - self * (1 + left)) / (p * (1 - left))
