"""Exact identities between rational functions of symbols and of real powers of positive quantities.

The theory is full of Q^{p/2}, (1 - Q^{p/2})^{-1/p}, (gamma^p + Q*^{p/2})^{-1/p}, |N|^p with a
symbolic exponent p. `Field` turns such an expression into a quotient of two polynomials: every
power of a positive base with a non-integer exponent becomes a generator, and the rules

    (a b)^e = a^e b^e   (a, b > 0),     (b^e)^f = b^{e f}   (b > 0),     b^{e+k} = b^e b^k

are applied until only integer powers of generators are left. Two expressions are equal where
both are defined if the numerator of their difference is the zero polynomial. Polynomials are
FLINT's, so a proof takes milliseconds and nothing hangs on `simplify`.

Soundness: each rewriting is an identity of real numbers wherever the bases are positive, which
the caller asserts by listing `positive` quantities or by positive symbols; a base whose sign is
not known is kept whole. A zero numerator is a proof. A nonzero numerator is *not* a disproof
(generators might be related in a way not listed here); disproof is a counterexample's job.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly_ctx
from sympy.functions.elementary.trigonometric import TrigonometricFunction

Poly = Any  # flint.fmpq_mpoly, which ships no type hints

_POOL = 40  # generators of one field; asking for more is an error with a clear message


class OutOfReach(ValueError):
    """The expression is outside the field: what stops it is in the message."""


@dataclass(frozen=True)
class Fraction:
    """A quotient of polynomials; the denominator is nonzero on the domain of the claim."""

    num: Poly
    den: Poly

    def __add__(self, other: Fraction) -> Fraction:
        g = self.den.gcd(other.den)
        left, right = other.den / g, self.den / g
        return Fraction(self.num * left + other.num * right, self.den * left)

    def __mul__(self, other: Fraction) -> Fraction:
        g, h = self.num.gcd(other.den), other.num.gcd(self.den)
        g, h = (g if not g.is_zero() else 1 + 0 * g), (h if not h.is_zero() else 1 + 0 * h)
        return Fraction((self.num / g) * (other.num / h), (self.den / h) * (other.den / g))

    def inverse(self) -> Fraction:
        if self.num.is_zero():
            raise OutOfReach("division by an expression that is identically zero")
        return Fraction(self.den, self.num)

    def power(self, k: int) -> Fraction:
        if k < 0:
            return self.inverse().power(-k)
        return Fraction(self.num**k, self.den**k)


@dataclass(frozen=True)
class _Power:
    """What a generator stands for: `base ** exponent`, base itself a positive SymPy expression."""

    base: sp.Expr
    exponent: sp.Expr


class Field:
    """One set of generators; expressions proved against each other share an instance.

    positive: quantities known to be positive on the domain of the claim.
    """

    def __init__(self, positive: Iterable[sp.Expr] = ()) -> None:
        names = [f"x{i}" for i in range(_POOL)]
        self._ctx = fmpq_mpoly_ctx.get(names, Ordering.degrevlex)
        self._gens = self._ctx.gens()
        self._slots: dict[object, int] = {}
        self._powers: dict[int, _Power] = {}
        self._meaning: list[sp.Expr] = []
        self._reductions: dict[int, tuple[int, Poly]] = {}  # gen**k = polynomial
        self._positive_slots: set[int] = set()
        self._nonnegative_slots: set[int] = set()  # |x| and its powers, which may vanish
        self._unreal: set[int] = set()  # not known to be real: its square may be negative
        self._positive_factors: set[str] = set()
        self._cache: dict[sp.Expr, Fraction] = {}
        self._angles: list[sp.Expr] = []
        for fact in positive:
            self.assume_positive(fact)

    # -- what a caller asks ---------------------------------------------------------------

    def is_zero(self, expr: sp.Expr) -> bool:
        """True if `expr` vanishes identically wherever it is defined (a proof)."""
        return bool(self._reduce(self.fraction(expr).num).is_zero())

    def equal(self, left: sp.Expr, right: sp.Expr) -> bool:
        """True if both sides agree identically (a proof)."""
        return self.is_zero(sp.Add(left, -right, evaluate=False))

    def sign(self, expr: sp.Expr) -> int | None:
        """+1, -1 or 0 if a factorisation into quantities of known sign proves it, else None.

        Where the factors do not tell, the expression as written may: a product of factors or a
        sum of terms whose signs are proved one by one.
        """
        f = self.fraction(expr)
        num = self._reduce(f.num)
        if num.is_zero():
            return 0
        signs = self._sign_of_poly(num), self._sign_of_poly(f.den)
        if None in signs:
            return self._sign_as_written(expr)
        return signs[0] * signs[1]  # type: ignore[operator]

    def _sign_as_written(self, expr: sp.Expr) -> int | None:
        if isinstance(expr, sp.Pow) and expr.exp.is_Integer:
            base = self.sign(expr.base)
            return None if not base else base ** int(abs(expr.exp))
        if isinstance(expr, sp.Mul):
            product = 1
            for arg in expr.args:
                s = self.sign(arg)
                if not s:
                    return None
                product *= s
            return product
        if isinstance(expr, sp.Add):
            found = {self.sign(arg) for arg in expr.args} - {0}
            return found.pop() if len(found) == 1 else None
        return None

    def _sign_of_poly(self, poly: Poly) -> int | None:
        content, factors = poly.factor()
        sign = 1 if content > 0 else -1
        for factor, k in factors:
            s = self._sign_of_factor(factor)
            if s is None:
                return None
            sign *= s if k % 2 else 1
        return sign

    def assume_positive(self, fact: sp.Expr) -> None:
        """Record that `fact` > 0 on the domain.

        One factor of unknown sign gets its sign from the fact. Two get theirs if their sum is
        positive, as in (beta eta - iota)(beta eta + iota) > 0.
        """
        f = self.fraction(fact)
        unknown: list[Poly] = []
        sign = 1
        for poly in (self._reduce(f.num), f.den):
            content, factors = poly.factor()
            sign *= 1 if content > 0 else -1
            for factor, k in factors:
                s = self._sign_of_factor(factor)
                if s is None:
                    unknown += [factor] * (k % 2)
                elif k % 2:
                    sign *= s
        if len(unknown) == 1:
            self._positive_factors.add(str(unknown[0] * sign))
        elif not unknown and sign < 0:
            raise OutOfReach(f"{fact} is assumed to be positive and is negative")
        elif len(unknown) == 2:
            for orientation in (1, -1):
                pair = (unknown[0] * orientation, unknown[1] * (sign * orientation))
                if self._sign_of_poly(pair[0] + pair[1]) == 1:
                    self._positive_factors.update(map(str, pair))
                    return

    def fraction(self, expr: sp.Expr) -> Fraction:
        """The quotient of polynomials in generators that `expr` is equal to."""
        found = self._cache.get(expr)
        if found is None:
            found = self._cache[expr] = self._fraction(expr)
        return found

    # -- from expressions to polynomials --------------------------------------------------

    def _fraction(self, expr: sp.Expr) -> Fraction:
        if isinstance(expr, sp.Rational):
            return self._constant(fmpq(int(expr.p), int(expr.q)))
        if isinstance(expr, sp.Symbol):
            return self._of(self._slot(expr, positive=bool(expr.is_positive)))
        if isinstance(expr, sp.Add):
            total = self._constant(fmpq(0))
            for arg in expr.args:
                total = total + self.fraction(arg)
            return total
        if isinstance(expr, sp.Mul):
            total = self._constant(fmpq(1))
            for arg in expr.args:
                total = total * self.fraction(arg)
            return total
        if isinstance(expr, sp.Pow):
            base, exponent = expr.as_base_exp()
            if exponent.is_Integer:
                found = self.fraction(base)
                if exponent < 0 and self._reduce(found.num).is_zero():
                    raise OutOfReach(f"division by {base}, which is identically zero")
                return found.power(int(exponent))
            if isinstance(base, sp.Pow) and base.exp.is_Integer and self.sign(base.base) == 1:
                return self.fraction(base.base ** (base.exp * exponent))  # (b^k)^e with b > 0
            return self._power(self.fraction(base), exponent)
        if isinstance(expr, sp.exp):
            return self._power(self._of(self._slot(sp.E, positive=True)), expr.args[0])
        if isinstance(expr, sp.Abs):
            return self._absolute(expr)
        if isinstance(expr, TrigonometricFunction):
            return self._trigonometric(expr)
        if expr.has(sp.oo, sp.zoo, sp.nan):
            raise OutOfReach(f"{expr} is not a finite expression")
        return self._of(self._slot(expr, positive=bool(expr.is_positive)))

    def _constant(self, value: fmpq) -> Fraction:
        one = self._ctx.constant(1)
        return Fraction(one * value, one)

    def _of(self, slot: int) -> Fraction:
        return Fraction(self._gens[slot], self._ctx.constant(1))

    def _slot(self, key: object, *, positive: bool) -> int:
        slot = self._slots.get(key)
        if slot is None:
            slot = len(self._slots)
            if slot == _POOL:
                raise OutOfReach(f"more than {_POOL} independent quantities in one identity")
            self._slots[key] = slot
            self._meaning.append(key if isinstance(key, sp.Expr) else sp.Dummy())
            if isinstance(key, sp.Expr) and not key.is_extended_real:
                self._unreal.add(slot)
            if positive:
                self._positive_slots.add(slot)
        return slot

    def _absolute(self, expr: sp.Abs) -> Fraction:
        known = self.sign(expr.args[0])
        if known is not None:
            return self.fraction(known * expr.args[0])
        slot = self._slot(expr, positive=bool(expr.is_positive))
        self._nonnegative_slots.add(slot)
        square = self.fraction(expr.args[0]).power(2)
        real = expr.args[0].is_extended_real
        if real and square.den.is_one() and slot not in self._reductions:
            self._reductions[slot] = (2, square.num)
        return self._of(slot)

    def _trigonometric(self, expr: sp.Expr) -> Fraction:
        angle = expr.args[0]
        terms = sp.Add.make_args(sp.expand(angle))
        if len(terms) > 1:
            return self.fraction(sp.expand_trig(expr.func(sp.Add(*terms))))
        if not isinstance(expr, sp.sin | sp.cos):
            return self.fraction(_by_sin_and_cos(expr))
        for known in self._angles:  # the same angle in another form, or its opposite
            if angle != known and self.equal(angle, known):
                return self.fraction(expr.func(known))
            if angle != -known and self.equal(angle, -known):
                return self.fraction(expr.func(-known))
        if angle not in self._angles:
            self._angles.append(angle)
        slot = self._slot(expr, positive=bool(expr.is_positive))
        if isinstance(expr, sp.sin) and slot not in self._reductions:
            cosine = self.fraction(sp.cos(angle))
            self._reductions[slot] = (2, 1 - cosine.num**2)
        return self._of(slot)

    # -- powers ---------------------------------------------------------------------------

    def _power(self, base: Fraction, exponent: sp.Expr) -> Fraction:
        """`base ** exponent` for a positive base: split into factors of known sign."""
        g = base.num.gcd(base.den)
        num, den = self._reduce(base.num / g), base.den / g
        if num.is_zero():
            if exponent.is_positive:
                return self._constant(fmpq(0))
            raise OutOfReach(f"zero to the power {exponent}")
        result = self._constant(fmpq(1))
        rest: list[tuple[Poly, int]] = []
        sign = 1
        content = fmpq(1)
        for poly, orientation in ((num, 1), (den, -1)):
            c, factors = poly.factor()
            content *= c**orientation
            for factor, k in factors:
                s = self._sign_of_factor(factor)
                if s is None:
                    rest.append((factor, orientation * k))
                else:
                    sign *= s if k % 2 else 1
                    result *= self._power_of_factor(factor * s, exponent * orientation * k)
        if content < 0:
            content, sign = -content, -sign
        result *= self._power_of_rational(content, exponent)
        # A base whose sign is not known is not negative where its power is defined, but may vanish.
        if len(rest) == 1 and rest[0][1] % 2:
            factor, k = rest[0]
            return result * self._power_of_factor(factor * sign, exponent * k, positive=False)
        if rest:
            whole = sp.Mul(sign, *(self._expression(f) ** k for f, k in rest))
            result *= self._atom(whole, exponent, positive=False)
        elif sign < 0:
            raise OutOfReach(f"a negative number to the power {exponent}")
        return result

    def _power_of_rational(self, value: fmpq, exponent: sp.Expr) -> Fraction:
        result = self._constant(fmpq(1))
        for integer, orientation in ((int(value.p), 1), (int(value.q), -1)):
            for prime, k in sp.factorint(integer).items():
                result *= self._atom(sp.Integer(prime), exponent * orientation * k)
        return result

    def _power_of_factor(
        self, factor: Poly, exponent: sp.Expr, *, positive: bool = True
    ) -> Fraction:
        slot = self._single(factor)
        if slot is not None and slot in self._powers:  # (b^e)^f = b^{e f}
            power = self._powers[slot]
            return self._atom(power.base, power.exponent * exponent, positive=positive)
        return self._atom(self._expression(factor), exponent, positive=positive)

    def _atom(self, base: sp.Expr, exponent: sp.Expr, *, positive: bool = True) -> Fraction:
        """`base ** exponent` as integer powers of generators `base ** unit`.

        positive: the base is known not to vanish; else its powers are only not negative.
        """
        result = self._constant(fmpq(1))
        for term in sp.Add.make_args(sp.expand(exponent)):
            number, unit = term.as_coeff_Mul()
            if not isinstance(number, sp.Rational):
                raise OutOfReach(f"the exponent {exponent} is not a rational combination")
            if unit == 1:
                result *= self._rational_power(base, number, positive=positive)
                continue
            halves = 2 * number
            if not halves.is_Integer:
                raise OutOfReach(f"the exponent {term} is not a half-integer multiple of {unit}")
            slot = self._root((base, unit / 2), positive=positive)
            self._powers[slot] = _Power(base, unit / 2)
            self._meaning[slot] = sp.Pow(base, unit / 2, evaluate=False)
            result *= self._of(slot).power(int(halves))
        return result

    def _root(self, key: object, *, positive: bool) -> int:
        """The slot of a real power, which vanishes with its base if that is not known positive."""
        slot = self._slot(key, positive=positive)
        (self._positive_slots if positive else self._nonnegative_slots).add(slot)
        return slot

    def _rational_power(self, base: sp.Expr, exponent: sp.Rational, *, positive: bool) -> Fraction:
        if exponent.is_Integer:
            return self.fraction(base).power(int(exponent))
        order = int(exponent.q)
        slot = self._root((base, sp.Rational(1, order)), positive=positive)
        if slot not in self._powers:
            self._powers[slot] = _Power(base, sp.Rational(1, order))
            self._meaning[slot] = sp.Pow(base, sp.Rational(1, order), evaluate=False)
            polynomial = self.fraction(base)
            if not polynomial.den.is_one():
                raise OutOfReach(f"the root of {base} has a denominator")
            self._reductions[slot] = (order, polynomial.num)
        return self._of(slot).power(int(exponent.p))

    # -- polynomials ----------------------------------------------------------------------

    def _single(self, poly: Poly) -> int | None:
        """The slot if `poly` is one generator, else None."""
        if len(poly) != 1 or poly.total_degree() != 1 or poly.leading_coefficient() != 1:
            return None
        return int(next(i for i, d in enumerate(poly.degrees()) if d))

    def _sign_of_factor(self, factor: Poly) -> int | None:
        """+1 or -1 if the sign of an irreducible factor is known on the domain."""
        if str(factor) in self._positive_factors:
            return 1
        if str(-factor) in self._positive_factors:
            return -1
        used = {i for i, d in enumerate(factor.degrees()) if d}
        signed = used - self._positive_slots - self._nonnegative_slots
        if any(m[i] % 2 or (m[i] and i in self._unreal) for m in factor.monoms() for i in signed):
            return None
        # A sum of terms that are never negative could still vanish with its variables: one term
        # must be free of those that may be zero.
        strictly = any(
            all(m[i] == 0 or i in self._positive_slots for i in used) for m in factor.monoms()
        )
        if not strictly:
            return None
        coefficients = list(factor.coeffs())
        if all(c > 0 for c in coefficients):
            return 1
        return -1 if all(c < 0 for c in coefficients) else None

    def _reduce(self, poly: Poly) -> Poly:
        """Apply sin^2 = 1 - cos^2, |x|^2 = x^2 and (b^{1/k})^k = b, the latest generator first."""
        for slot in sorted(self._reductions, reverse=True):
            order, value = self._reductions[slot]
            if poly.degrees()[slot] >= order:
                poly = self._rewrite(poly, slot, order, value)
        if any(poly.degrees()[s] >= self._reductions[s][0] for s in self._reductions):
            return self._reduce(poly)
        return poly

    def _rewrite(self, poly: Poly, slot: int, order: int, value: Poly) -> Poly:
        parts: dict[int, dict[tuple[int, ...], fmpq]] = {}
        for monom, coefficient in poly.to_dict().items():
            k, r = divmod(monom[slot], order)
            key = (*monom[:slot], r, *monom[slot + 1 :])
            parts.setdefault(k, {})[key] = coefficient
        total = self._ctx.constant(0)
        for k, terms in parts.items():
            total += self._ctx.from_dict(terms) * value**k
        return total

    def _expression(self, poly: Poly) -> sp.Expr:
        """The SymPy expression that a polynomial in generators stands for."""
        terms = []
        for monom, coefficient in sorted(poly.to_dict().items()):
            factors = [self._meaning[i] ** int(d) for i, d in enumerate(monom) if d]
            terms.append(sp.Mul(sp.Rational(int(coefficient.p), int(coefficient.q)), *factors))
        return sp.Add(*terms)


def _by_sin_and_cos(expr: sp.Expr) -> sp.Expr:
    angle = expr.args[0]
    sine, cosine = sp.sin(angle), sp.cos(angle)
    forms = {sp.tan: sine / cosine, sp.cot: cosine / sine, sp.sec: 1 / cosine, sp.csc: 1 / sine}
    return forms[expr.func]
