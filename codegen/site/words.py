"""What the pages say in words: the verdicts, the sections, the functions of a scene."""

from __future__ import annotations

VERDICTS = {
    "definition": "Introduces notation: nothing to prove, but used by a derivation and consistent "
    "with it.",
    "proved": "True exactly as printed on its whole claimed domain, by an exact method with "
    "symbolic p.",
    "checked": "True as printed as far as 50 digits at generic points can say. Not a proof.",
    "reading": "True under a reading that the paper does not state. The reading is written down, "
    "and the statement under it is proved.",
    "refuted": "False as printed: an exact counterexample, the smallest correction, and its proof.",
    "undecided": "Not decided; this fails the run.",
}

SECTIONS = {
    "1": "Introduction",
    "2.1": "Kinematics and strains",
    "2.2": "Balance laws",
    "3.1": "Constitutive relations",
    "3.2": "Orientation",
    "3.3": "Symmetry",
    "3.4": "Monotonicity",
    "4": "Helical states",
    "4.1": "Euler angles, reduced equations",
    "4.2": "Isolated forces",
    "4.3": "Isolated couples",
    "5.1": "End conditions, dynamics, dissipation",
    "5.2": "Stiffness, DNA",
}

COUNTS = ("arithmetic", "transcendental", "energy shares", "temporaries")
