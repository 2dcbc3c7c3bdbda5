"""The checks of Section 3.3: is each printed definition what the operation really does to strains,
and which of them the stored energy has.

A definition "Phi(A u, B v) = Phi(u, v)" is accepted if (A, B) is the derived action of its
operation. The energy has the symmetry exactly if Q has it, because W is a strictly increasing
function of Q alone (W' = gamma/2 (1 - Q^{p/2})^{-1/p} > 0), and then its domain Q < 1 is carried
to itself too. Second route: a numerical rod is turned, reversed or reflected, and its strains
are measured anew by numerical derivatives.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.exact.evaluate import context, numbers
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Every, ForAll, Iff, Q, W, chain, u, v
from rodproof.derivations.proof import curves, sampling
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values, of_matrix
from rodproof.derivations.proof.prover import DIGITS, Identity
from rodproof.derivations.proof.vectors import REJECTED
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import CONSTANTS, STRAINS, chiral_gap, gamma, p
from rodproof.derivations.theory import symmetry
from rodproof.derivations.theory.constitutive import quadratic_form, radial_law, x
from rodproof.derivations.theory.frames import psi
from rodproof.derivations.theory.symmetry import FLIP, ROTATION, Operation, action


class Phi(sp.Function):
    """The stored energy density of any hyperelastic rod, `Phi(u, v)`."""

    nargs = 2


class R(sp.Function):
    """The printed matrix R with its angle as an index, `R(psi)`."""

    nargs = 1


E = sp.Symbol("E", real=True)

#: The strains on which W is defined.
INSIDE = chain(Q(u, v), "<", 1)
_COLUMNS = {u: sp.Matrix(STRAINS[:3]), v: sp.Matrix(STRAINS[3:])}


def _printed_turn(angle: sp.Expr) -> sp.Matrix:
    """R as printed; that it is the action of a rotation is statement `symmetry-matrices`."""
    c, s = sp.cos(angle), sp.sin(angle)
    return sp.Matrix([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def _map(argument: sp.Expr, column: sp.IndexedBase) -> sp.Matrix:
    """The matrix of `-E*v` and the like, acting on the column that belongs in this place."""
    matrix, seen = sp.eye(3), 0
    for factor in sp.Mul.make_args(argument):
        if factor == column:
            seen += 1
        elif factor == E:
            matrix = sp.diag(1, -1, 1) * matrix
        elif isinstance(factor, R):
            matrix = _printed_turn(factor.args[0]) * matrix
        elif factor.is_number:
            matrix = factor * matrix
        else:
            raise IllTyped(f"{factor} acts on no strain")
    if seen != 1:
        raise IllTyped(f"{argument} is not a linear image of {column}")
    return matrix


def _maps(claim: sp.Basic, energy: type[sp.Function]) -> tuple[sp.Matrix, sp.Matrix]:
    """(A, B) of `energy(A u, B v) = energy(u, v)`."""
    if not isinstance(claim, Chain) or claim.relations != ("=",):
        raise IllTyped("a symmetry is an equation")
    left, right = claim.sides
    if not isinstance(left, energy) or right != energy(u, v):
        raise IllTyped("a symmetry compares the energy of two strains")
    return _map(left.args[0], u), _map(left.args[1], v)


def _is_action(maps: tuple[sp.Matrix, sp.Matrix], operation: Operation) -> bool:
    derived, field = action(operation), Field()
    pairs = zip(maps, (derived.on_u, derived.on_v), strict=True)
    return all(field.is_zero(e) for ours, theirs in pairs for e in ours - theirs)


# -- definitions -------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Defines:
    """The printed invariances are those under the operations, for every rotation angle."""

    operations: tuple[Operation, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        parts = printed.args if isinstance(printed, Every) else (printed,)
        if len(parts) != len(self.operations):
            return REJECTED
        for part, operation in zip(parts, self.operations, strict=True):
            found = self._one(part, operation)
            if not found.holds:
                return found
        return Decision(True, True, "the derived action on the axial u and the polar v")

    def _one(self, part: sp.Basic, operation: Operation) -> Decision:
        bound = operation.directors.free_symbols
        if bound:  # the invariance must be asked for every angle
            if not isinstance(part, ForAll):
                return REJECTED
            if not bound <= set(part.args[0]):
                return _unbound(part)
            part = part.args[1]
        try:
            maps = _maps(part, Phi)
        except IllTyped:
            return REJECTED
        if _is_action(maps, operation):
            return Decision(True, True, "")
        return Decision(False, True, "not what the operation does", _misses(maps, operation))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """Each operation carried out on a numerical rod, and the strains measured again."""
        worst, ctx = 0.0, context(DIGITS + 15)
        for seed in range(2):
            for operation in self.operations:
                point = _sample(seed)
                routed, c = _measured(operation, point, ctx), numbers(ctx, point)
                maps = action(operation)
                for matrix, old, new in ((maps.on_u, STRAINS[:3], routed[0]),
                                         (maps.on_v, STRAINS[3:], routed[1])):  # fmt: skip
                    evaluate = MATRICES_MEANING.evaluator(ctx, point)
                    for i in range(3):
                        row = sum(evaluate(matrix[i, j]) * c[old[j]] for j in range(3))
                        worst = max(worst, float(abs(row - new[i])))
        return Confirmation(worst, 2, DIGITS, "a numerical rod transformed and measured again")


def _unbound(part: ForAll) -> Decision:
    """With another letter bound, one fixed angle is enough: an energy that shows it."""
    found = Counterexample(
        (("Phi", "u1**2"), ("psi", "pi"), (str(part.args[0][0]), "any")),
        "Phi(R u, R v) = (-u1)**2 = Phi(u, v), so the words hold",
        "a turn by pi/2 gives u2**2: not hemitropic",
    )
    return Decision(False, True, "the angle in the formula is not the one bound", found)


def _misses(maps: tuple[sp.Matrix, sp.Matrix], operation: Operation) -> Counterexample | None:
    """A strain that the printed map and the operation carry to different places."""
    derived = action(operation)
    rest, bent = sp.Matrix([0, 0, 1]), sp.Matrix([1, 0, 0])
    for old, printed, really, name in (
        (rest, maps[1], derived.on_v, "v"), (bent, maps[0], derived.on_u, "u"),
    ):  # fmt: skip
        first, second = printed * old, really * old
        if first != second:
            where = ((name, str(tuple(old))),)
            return Counterexample(
                where,
                f"printed map gives {tuple(first)}",
                f"the {operation.name} gives {tuple(second)}",
            )
    return None


# -- the matrices ------------------------------------------------------------------------------


def _sample(seed: int) -> Point:
    mirror = {s: sp.Rational(2 + 3 * k - seed, 7) for k, s in enumerate(symmetry.mirror)}
    return {**sampling.with_strains(seed), **mirror, psi: sp.Rational(9 + 4 * seed, 7)}


def _measured(operation: Operation, point: Point, ctx: Any) -> tuple[list[Any], list[Any]]:
    """(u, v) of the transformed rod at s = 0, by numerical derivatives."""
    c = numbers(ctx, point)
    rod = curves.uniform_rod(ctx, [c[s] for s in STRAINS[:3]], [c[s] for s in STRAINS[3:]])
    evaluate = MATRICES_MEANING.evaluator(ctx, point)
    T, S = ([[evaluate(e) for e in row] for row in matrix.tolist()]
            for matrix in (operation.directors, operation.space))  # fmt: skip

    def moved(vector: curves.Vector) -> curves.Vector:
        return [sum(x * y for x, y in zip(row, vector, strict=True)) for row in S]

    def described(at: Any) -> tuple[curves.Vector, curves.Frame]:
        r, frame = rod(operation.sense * at)
        frame = [moved(d) for d in frame]
        new = [curves.plus(*(curves.times(T[k][j], frame[j]) for j in range(3))) for k in range(3)]
        return moved(r), new

    return curves.strains(ctx, described, ctx.mpf(0))


def _route_of_matrices(point: Point, ctx: Any) -> Values:
    """Columns of the actions, from rods that have one strain only."""
    found: dict[sp.Basic, Any] = {}
    for name, operation in (("E", FLIP), ("R", ROTATION)):
        for j in range(3):
            none = dict.fromkeys(STRAINS, sp.Integer(0))
            single = {**point, **none, STRAINS[3 + j]: sp.Integer(1)}
            column = _measured(operation, single, ctx)[1]
            found |= {sp.Symbol(f"{name}{i + 1}{j + 1}", real=True): column[i] for i in range(3)}
    return found


MATRICES_MEANING = Meaning(
    name="actions of flip and rotation on v", free=(psi,),
    components={**of_matrix("E", action(FLIP).on_v), **of_matrix("R", action(ROTATION).on_v)},
    sample=_sample, simple=lambda: ({psi: sp.pi / 2}, {psi: sp.pi}),
    route=_route_of_matrices, route_name="a numerical rod transformed and measured again",
)  # fmt: skip
MATRICES = Identity(MATRICES_MEANING)

# -- the energy --------------------------------------------------------------------------------


@cache
def _energy_increases() -> bool:
    """dW/dQ = (y/x)/2 > 0 for 0 < Q < 1, so W is a strictly increasing function of Q."""
    return Field((1 - x**p,)).sign(radial_law().load / x) == 1


def _change(maps: tuple[sp.Matrix, sp.Matrix]) -> sp.Expr:
    """Q(A u, B v) - Q(u, v)."""
    return sp.expand(symmetry.form_after(*maps) - quadratic_form())


@dataclass(frozen=True, eq=False)
class HasSymmetries:
    """`W(A u, B v) = W(u, v)` on Q < 1, (A, B) being the actions of the operations."""

    operations: tuple[Operation, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        parts = printed.args if isinstance(printed, Every) else (printed,)
        if len(parts) != len(self.operations) or not _energy_increases():
            return REJECTED
        try:
            maps = [self._maps(part) for part in parts]
        except IllTyped:
            return REJECTED
        for ours, operation in zip(maps, self.operations, strict=True):
            if not _is_action(ours, operation):
                return Decision(False, False, f"not the {operation.name}")
            if not Field().is_zero(_change(ours)):
                return Decision(False, False, f"Q changes under the {operation.name}")
        return Decision(True, True, "Q is unchanged exactly, and W is a function of Q")

    @staticmethod
    def _maps(part: sp.Basic) -> tuple[sp.Matrix, sp.Matrix]:
        """With the bound on the strains, `ForAll(Q < 1, ...)`; without it W is not defined."""
        if not isinstance(part, ForAll) or part.args[0] != INSIDE:
            raise IllTyped("W is defined for Q < 1 only")
        return _maps(part.args[1], W)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return energy_confirmed(self.operations)


def energy_confirmed(operations: tuple[Operation, ...]) -> Confirmation:
    """W of a numerical rod before and after, from the numerical law."""
    worst, ctx = 0.0, context(DIGITS + 15)
    for seed in range(2):
        point = _sample(seed)
        law = NumericLaw(point, ctx)
        old = law.form([law.c[s] for s in STRAINS[:5]] + [law.c[STRAINS[5]] - 1])
        for operation in operations:
            new_u, new_v = _measured(operation, point, ctx)
            new = law.form([*new_u, new_v[0], new_v[1], new_v[2] - 1])
            worst = max(worst, float(abs(new / old - 1)))
    return Confirmation(worst, 2, DIGITS, "Q of a numerical rod before and after")


@dataclass(frozen=True, eq=False)
class SymmetricExactlyIf:
    """`Iff(W(A u, B v) = W(u, v) on Q < 1, constant = 0)`.

    Q(A u, B v) - Q(u, v) is a polynomial in the strains; it vanishes near rest exactly if all its
    coefficients do, and these must be multiples, of one sign, of the constant.
    """

    operation: Operation

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Iff) or len(printed.args) != 2 or not _energy_increases():
            return REJECTED
        symmetric, achiral = printed.args
        if not isinstance(achiral, Chain) or achiral.relations != ("=",) or achiral.sides[1] != 0:
            return REJECTED
        try:
            maps = HasSymmetries._maps(symmetric)
        except IllTyped:
            return REJECTED
        if not _is_action(maps, self.operation):
            return Decision(False, True, f"not the {self.operation.name}", _not_at_rest(maps))
        change = sp.Poly(_change(maps), *STRAINS)
        constant = achiral.sides[0]
        ratios = [c / constant for c in change.coeffs()]
        try:
            signs = {Field((chiral_gap,)).sign(ratio) for ratio in ratios}
        except OutOfReach:
            return REJECTED
        if not ratios or not signs <= {1, -1}:
            return Decision(False, False, "the coefficients are no multiples of it")
        return Decision(True, True, "coefficients of Q(A u, B v) - Q(u, v) are multiples of it")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The change of Q for a reflected numerical rod, against -4 iota u3 (v3 - 1)."""
        worst, ctx = 0.0, context(DIGITS + 15)
        change = _change((action(self.operation).on_u, action(self.operation).on_v))
        for seed in range(2):
            point = _sample(seed)
            law = NumericLaw(point, ctx)
            old = law.form([law.c[s] for s in STRAINS[:5]] + [law.c[STRAINS[5]] - 1])
            new_u, new_v = _measured(self.operation, point, ctx)
            new = law.form([*new_u, new_v[0], new_v[1], new_v[2] - 1])
            expected = MATRICES_MEANING.evaluator(ctx, point)(change)
            worst = max(worst, float(abs(new - old - expected)))
        return Confirmation(worst, 2, DIGITS, "Q of a reflected numerical rod")


def _not_at_rest(maps: tuple[sp.Matrix, sp.Matrix]) -> Counterexample | None:
    """The rod at rest with iota = 0 and p = 2, where W = gamma (1 - (1 - Q)^{1/2})."""
    values = (1, 1, 1, 1, sp.Rational(2, 5), 0, 2)
    constants = dict(zip(CONSTANTS, map(sp.sympify, values), strict=True))
    rest = dict(zip(STRAINS, (0, 0, 0, 0, 0, 1), strict=True))
    after = symmetry.form_after(*maps).subs(constants).subs(rest)
    if after == 0:
        return None
    energy = constants[gamma] * (1 - sp.sqrt(1 - after))
    where = tuple((str(k), str(e)) for k, e in {**constants, **rest}.items())
    return Counterexample(where, f"iota = 0 and W(A u, B v) = {energy}", "W(u, v) = 0")
