"""Section 2.2, balance laws: every printed statement, transcribed as printed."""

from __future__ import annotations

from rodproof.derivations.checks import balance as rules
from rodproof.derivations.checks import kinematics
from rodproof.derivations.checks.balance import (
    AT_ENDS,
    body_couple,
    body_force,
    couple_on_segment,
    f_vector,
    force_on_segment,
    l_vector,
    m_vector,
    n_vector,
    o_vector,
    r_vector,
)
from rodproof.derivations.checks.kinematics import d
from rodproof.derivations.notation import Cross, Every, Prime, Summed, equal, k, m, n, u, v
from rodproof.derivations.records import Statement

SECTION = "2.2"
_TURNS = ((1, 2, 3), (2, 3, 1), (3, 1, 2))


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (*_resultants(), *_local(), *_components())


def _resultants() -> tuple[Statement, ...]:
    r, n, m = (AT_ENDS[name] for name in "rnm")
    return (
        Statement(
            id="resultant-force", section=SECTION, label="-", introduces=True,
            claim="Contact force that the rest of the rod exerts on the segment [a, b].",
            latex=r"\boldsymbol n(b) - \boldsymbol n(a)",
            printed=equal(force_on_segment, n["b"] - n["a"]), check=rules.SEGMENT,
            note="So n(s) is what the part beyond s exerts on the part before s. The sentence has "
            "'be' where 'by' [0,a) and (b,L] belongs.",
        ),
        Statement(
            id="resultant-couple", section=SECTION, label="-", introduces=True,
            claim="Contact couple about o that the rest of the rod exerts on the segment [a, b].",
            latex=r"\boldsymbol m(b) + (\boldsymbol r(b) - \boldsymbol o) \times \boldsymbol n(b)"
            r" - \boldsymbol m(a) - (\boldsymbol r(a) - \boldsymbol o) \times \boldsymbol n(a)",
            printed=equal(
                couple_on_segment,
                m["b"] + Cross(r["b"] - o_vector, n["b"])
                - m["a"] - Cross(r["a"] - o_vector, n["a"]),
            ),
            check=rules.SEGMENT,
        ),
    )  # fmt: skip


def _local() -> tuple[Statement, ...]:
    return (
        Statement(
            id="force-balance",
            section=SECTION,
            label="eq:neq",
            claim="Local balance of forces.",
            latex=r"\boldsymbol n'(s) + \boldsymbol f(s) = \boldsymbol 0",
            printed=equal(Prime(n_vector) + f_vector, 0),
            check=rules.LOCAL,
            note="Equivalent to the balance of every segment where f is continuous.",
        ),
        Statement(
            id="moment-balance",
            section=SECTION,
            label="eq:meq",
            claim="Local balance of couples.",
            latex=r"\boldsymbol m'(s) + \boldsymbol r'(s) \times \boldsymbol n(s)"
            r" + \boldsymbol l(s) = \boldsymbol 0",
            printed=equal(Prime(m_vector) + Cross(Prime(r_vector), n_vector) + l_vector, 0),
            check=rules.LOCAL,
            note="The balance of forces has been used; the point o drops out by it.",
        ),
    )


def _components() -> tuple[Statement, ...]:
    on_frames = kinematics.ON_FRAMES
    force, couple = kinematics.n_vector, kinematics.m_vector
    return (
        Statement(
            id="nm-components", section=SECTION, label="-", introduces=True,
            claim="Components of contact force and contact couple in the directors.",
            latex=r"\boldsymbol n(s) = n_k(s) \boldsymbol d_k(s), \quad "
            r"\boldsymbol m(s) = m_k(s) \boldsymbol d_k(s)",
            printed=Every(
                equal(force, Summed(n[k] * d[k], k)), equal(couple, Summed(m[k] * d[k], k))
            ),
            check=on_frames,
        ),
        Statement(
            id="extra-balance-in-directors", section=SECTION, label="-",
            claim="Both balance laws in components, ready for a solver.",
            latex=r"\mathsf n' + \mathsf u \times \mathsf n + \mathsf f = 0, \quad "
            r"\mathsf m' + \mathsf u \times \mathsf m + \mathsf v \times \mathsf n + \mathsf l = 0",
            printed=Every(
                *(
                    equal(Prime(n[i]) + u[j] * n[h] - u[h] * n[j] + body_force[i], 0)
                    for i, j, h in _TURNS
                ),
                *(
                    equal(
                        Prime(m[i]) + u[j] * m[h] - u[h] * m[j]
                        + v[j] * n[h] - v[h] * n[j] + body_couple[i], 0,
                    )
                    for i, j, h in _TURNS
                ),
            ),
            check=rules.IN_DIRECTORS,
            note="Six equations for (m, n) once the law gives (u, v); no angles, nothing singular.",
        ),
    )  # fmt: skip
