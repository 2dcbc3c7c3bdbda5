"""The functions in ball arithmetic (Arb), at exact inputs, to a certified relative accuracy.

A strain is given from rest, eps = (u1, u2, u3, v1, v2, v3 - 1), a load as sigma = (m, n). With the
Cholesky factor K = L L^T the whitened strain L^T eps has the length x = Q^{1/2} and the whitened
load L^{-1} sigma the length y = (Q*)^{1/2}; in these coordinates the law is radial:

    eps = f K^{-1} sigma,   f = (gamma^p + y^p)^{-1/p}
    sigma = gamma g K eps,  g = (1 - x^p)^{-1/p}
    W  = gamma x^2/2 2F1(1/p, 2/p; 1 + 2/p; x^p)
    W* = y^2/(2 gamma) 2F1(1/p, 2/p; 1 + 2/p; -(y/gamma)^p)

A constrained rod is this one without the loads that are reactions (`theory.constrained`): its law
does not hold the constants that went to infinity, which may have any value here.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import wraps
from typing import ParamSpec, TypeVar

from flint import arb, ctx

Vector = list[arb]
Whitener = Callable[[Sequence[arb]], Vector]

#: Bits of its largest component that every component of an answer is certain to. Fifty digits
#: are 166 bits; the rest is for components of other units and for whitening near D = 0.
ACCURACY = 280
#: The same for an answer that only serves to see what moving an input by an ulp does.
MOVED = 170
#: Bits to work with, beyond those wanted, before giving up.
SPARE = (120, 1320, 6120, 25320)


Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")


def exactly(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Run a function at 400 bits, where sums and products of doubles leave no trace of rounding."""

    @wraps(function)
    def wrapped(*args: Parameters.args, **kwargs: Parameters.kwargs) -> Result:
        with ctx.workprec(ACCURACY + SPARE[0]):
            return function(*args, **kwargs)

    return wrapped


@dataclass(frozen=True)
class Constants:
    """The seven constants, in the order of the generated module's record, as exact balls."""

    alpha: arb
    beta: arb
    zeta: arb
    eta: arb
    iota: arb
    gamma: arb
    p: arb

    @property
    def entries(self) -> tuple[arb, ...]:
        """The seven values in order."""
        return (self.alpha, self.beta, self.zeta, self.eta, self.iota, self.gamma, self.p)

    @property
    def gap(self) -> arb:
        """The determinant of the block that couples twist and dilatation."""
        return (self.beta * self.eta) ** 2 - self.iota**2


def whitened_strain(c: Constants, e: Sequence[arb]) -> Vector:
    """L^T eps."""
    return whitener_of_strains(c)(e)


def whitened_load(c: Constants, s: Sequence[arb]) -> Vector:
    """L^{-1} sigma."""
    return whitener_of_loads(c)(s)


def whitener_of_strains(c: Constants, *, worst: bool = False) -> Whitener:
    """L^T, with what depends on the constants alone done once; entrywise positive for ``worst``."""
    coupling, stretch = c.iota / c.beta, c.gap.sqrt() / c.beta
    coupling = abs(coupling) if worst else coupling

    def whiten(e: Sequence[arb]) -> Vector:
        third, sixth = c.beta * e[2] + coupling * e[5], stretch * e[5]
        return [c.alpha * e[0], c.alpha * e[1], third, c.zeta * e[3], c.zeta * e[4], sixth]

    return whiten


def whitener_of_loads(c: Constants, *, worst: bool = False) -> Whitener:
    """L^{-1}, likewise."""
    root = c.gap.sqrt()
    own, other = c.beta / root, c.iota / (c.beta * root)
    other = -abs(other) if worst else other

    def whiten(s: Sequence[arb]) -> Vector:
        third, sixth = s[2] / c.beta, own * s[5] - other * s[2]
        return [s[0] / c.alpha, s[1] / c.alpha, third, s[3] / c.zeta, s[4] / c.zeta, sixth]

    return whiten


def norm(vector: Sequence[arb]) -> arb:
    """The Euclidean length."""
    return sum((entry * entry for entry in vector), arb(0)).nonnegative_part().sqrt()


def apply(c: Constants, e: Sequence[arb]) -> Vector:
    """K eps."""
    a, b, z, h = c.alpha**2, c.beta**2, c.zeta**2, c.eta**2
    third, sixth = b * e[2] + c.iota * e[5], c.iota * e[2] + h * e[5]
    return [a * e[0], a * e[1], third, z * e[3], z * e[4], sixth]


def solve(c: Constants, s: Sequence[arb]) -> Vector:
    """K^{-1} sigma."""
    a, b, z, h, gap = c.alpha**2, c.beta**2, c.zeta**2, c.eta**2, c.gap
    third, sixth = (h * s[2] - c.iota * s[5]) / gap, (b * s[5] - c.iota * s[2]) / gap
    return [s[0] / a, s[1] / a, third, s[3] / z, s[4] / z, sixth]


def at_rest(c: Constants) -> list[Vector]:
    """K."""
    return _coupled((c.alpha**2, c.beta**2, c.zeta**2, c.eta**2), c.iota)


def inverse_at_rest(c: Constants) -> list[Vector]:
    """K^{-1}."""
    gap = c.gap
    own = (1 / c.alpha**2, c.eta**2 / gap, 1 / c.zeta**2, c.beta**2 / gap)
    return _coupled(own, -c.iota / gap)


def _coupled(own: Sequence[arb], coupling: arb) -> list[Vector]:
    """A symmetric matrix that couples the third and the sixth component."""
    rows = [[arb(0)] * 6 for _ in range(6)]
    for i, k in enumerate((0, 0, 1, 2, 2, 3)):
        rows[i][i] = own[k]
    rows[2][5] = rows[5][2] = coupling
    return rows


def strains(c: Constants, s: Sequence[arb]) -> Vector:
    """The strain from rest under a load."""
    y = norm(whitened_load(c, s))
    f = (c.gamma**c.p + _power(y, c.p)) ** (-1 / c.p)
    return [f * z for z in solve(c, s)]


def loads(c: Constants, e: Sequence[arb]) -> Vector:
    """The load at a strain from rest."""
    x = norm(whitened_strain(c, e))
    g = (1 - _power(x, c.p)) ** (-1 / c.p)
    return [c.gamma * g * k for k in apply(c, e)]


def stored_energy(c: Constants, e: Sequence[arb]) -> Vector:
    """W, by its hypergeometric closed form."""
    x = norm(whitened_strain(c, e))
    return [c.gamma * x * x / 2 * _hypergeometric(_power(x, c.p), c.p)]


def complementary_energy(c: Constants, s: Sequence[arb]) -> Vector:
    """W*, by its hypergeometric closed form."""
    y = norm(whitened_load(c, s))
    return [y * y / (2 * c.gamma) * _hypergeometric(-_power(y / c.gamma, c.p), c.p)]


def stiffness(c: Constants, e: Sequence[arb]) -> Vector:
    """d sigma/d eps by rows: gamma g (K + x^p/(1 - x^p) k k^T), k = K eps/x."""
    x = norm(whitened_strain(c, e))
    power = _power(x, c.p)
    g = c.gamma * (1 - power) ** (-1 / c.p)
    ratio = power / (1 - power)
    k = [arb(0)] * 6 if x == 0 else [entry / x for entry in apply(c, e)]
    K = at_rest(c)
    return [g * (K[i][j] + ratio * k[i] * k[j]) for i in range(6) for j in range(6)]


def compliance(c: Constants, s: Sequence[arb]) -> Vector:
    """d eps/d sigma by rows: f (K^{-1} - y^p/(gamma^p + y^p) z z^T), z = K^{-1} sigma/y."""
    y = norm(whitened_load(c, s))
    power = _power(y, c.p)
    whole = c.gamma**c.p + power
    f, ratio = whole ** (-1 / c.p), power / whole
    z = [arb(0)] * 6 if y == 0 else [entry / y for entry in solve(c, s)]
    C = inverse_at_rest(c)
    return [f * (C[i][j] - ratio * z[i] * z[j]) for i in range(6) for j in range(6)]


def stiffness_at_loads(c: Constants, s: Sequence[arb]) -> Vector:
    """d sigma/d eps by rows at the strain of a load: (K + (y/gamma)^p k k^T)/f, k = sigma/y."""
    y = norm(whitened_load(c, s))
    power = _power(y, c.p)
    g = (c.gamma**c.p + power) ** (1 / c.p)
    ratio = power / c.gamma**c.p
    k = [arb(0)] * 6 if y == 0 else [entry / y for entry in s]
    K = at_rest(c)
    return [g * (K[i][j] + ratio * k[i] * k[j]) for i in range(6) for j in range(6)]


def limit_gap(c: Constants, s: Sequence[arb]) -> Vector:
    """1 - x^p at the strain of a load."""
    whole = c.gamma**c.p
    return [whole / (whole + _power(norm(whitened_load(c, s)), c.p))]


Function = Callable[[Constants, Sequence[arb]], Vector]


def certain(
    function: Function, c: Constants, argument: Sequence[arb], accuracy: int = ACCURACY
) -> Vector:
    """The function's components, known to ``accuracy`` bits of the largest."""
    for spare in SPARE:
        with ctx.workprec(accuracy + spare):
            answer = function(c, argument)
            allowed = max(abs(entry) for entry in answer) * arb(2) ** -accuracy
            if all(entry.is_finite() and entry.rad() <= allowed for entry in answer):
                return answer
    raise ArithmeticError(
        f"{accuracy + SPARE[-1]} bits are not enough for {function.__name__} at {c}"
    )


def _power(base: arb, exponent: arb) -> arb:
    return arb(0) if base == 0 else base**exponent


def _hypergeometric(z: arb, p: arb) -> arb:
    return z.hypgeom_2f1(1 / p, 2 / p, 1 + 2 / p)
