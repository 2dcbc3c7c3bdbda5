"""The words of a generated module: docstrings, labels, and the shapes that they speak of."""

from __future__ import annotations

from dataclasses import dataclass

#: The paper's label of each statement that a kernel rests on, where it has one.
STATEMENT_LABELS = {
    "q-form": "eq:quadraticform",
    "qstar-form": "Section 3.1",
    "const-u-mu": "eq:uconst",
    "const-u-3": "eq:u3const",
    "const-v-mu": "eq:vconst",
    "const-v-3": "eq:v3const",
    "strain-limit": "eq:strainlimiting",
    "wstar-gradient": "Section 3.1",
    "wstar-definition": "eq:compenergy",
    "const-m-mu": "eq:mconst",
    "const-m-3": "eq:m3const",
    "const-n-mu": "eq:nconst",
    "const-n-3": "eq:n3const",
    "w-definition": "eq:stenergy",
}

STEP_TEXTS = {
    "reduce_loads": "Loads over their moduli, the linear rod's strains, and Q*(m, n) in squares.",
    "reduce_strains": "Strains times their moduli, the linear rod's loads, and Q(u, v) in squares.",
    "soften": "Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y.",
    "stiffen": "Load over strain, gamma (1 - x^p)^(-1/p), by the growth x^p/(1 - x^p), x^2 = Q.",
}


@dataclass(frozen=True)
class FunctionText:
    """Inputs, outputs with their leading shapes, and the two docstrings of a function."""

    inputs: tuple[str, str]
    outputs: dict[str, tuple[int, ...]]
    equation: str
    doc: str


_LOADS_IN = "m (3, ...) in force times length, n (3, ...) in force, with Q*(m, n)^(1/2) finite."
_STRAINS_IN = "u (3, ...) in 1/length and v (3, ...) plain, with Q(u, v) < 1 (eq:strainlimiting)."

TEXTS = {
    "strains": FunctionText(
        ("m", "n"),
        {"u": (3,), "v": (3,)},
        "u = (gamma^p + Q*^(p/2))^(-1/p) (K^-1 (m, n))_u, v - e3 likewise (eq:uconst, eq:vconst).",
        f"""Strains u, v (3, ...) under the contact couple m and force n (eq:uconst to eq:v3const).

    {_LOADS_IN}
    u comes in 1/length, v is plain; at rest u = 0, v = (0, 0, 1).""",
    ),
    "loads": FunctionText(
        ("u", "v"),
        {"m": (3,), "n": (3,)},
        "m = gamma (1 - Q^(p/2))^(-1/p) (K (u, v - e3))_m, n likewise (eq:mconst, eq:nconst).",
        f"""Contact couple m and force n (3, ...) at the strains u, v (eq:mconst to eq:n3const).

    {_STRAINS_IN}
    Near the limit the strains hardly determine the loads.""",
    ),
    "stored_energy": FunctionText(
        ("u", "v"),
        {"w": ()},
        "W = gamma/2 int_0^Q (1 - t^(p/2))^(-1/p) dt, as its share of load times strain.",
        f"""Stored energy W per length, in force (eq:stenergy), with the trailing shape.

    {_STRAINS_IN}""",
    ),
    "complementary_energy": FunctionText(
        ("m", "n"),
        {"w_star": ()},
        "W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of load times strain.",
        f"""Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    {_LOADS_IN}""",
    ),
    "stiffness": FunctionText(
        ("u", "v"),
        {"stiff": (6, 6)},
        "D^2 W = factor (K + growth t t^T), t = K (u, v - e3)/x.",
        f"""Stiffness d(m, n)/d(u, v), (6, 6, ...), symmetric positive definite (Section 3.4).

    {_STRAINS_IN}
    Rows and columns are ordered (m1, m2, m3, n1, n2, n3) and (u1, u2, u3, v1, v2, v3).""",
    ),
    "compliance": FunctionText(
        ("m", "n"),
        {"soft": (6, 6)},
        """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 (m, n)/y.

    With (a, b) the reduced load as a unit vector and (c3, c6) the linear rod's reduced strains,
    the entries that would cancel are sums of squares.
    """,
        f"""Compliance d(u, v)/d(m, n), (6, 6, ...), the inverse of the stiffness at these loads.

    {_LOADS_IN}
    Rows and columns are ordered (u1, u2, u3, v1, v2, v3) and (m1, m2, m3, n1, n2, n3).""",
    ),
}
