"""Error against run time of integrators on a rod in equilibrium: which equations, which method.

    problems -> reference (two independent routes at 30 digits)  \
    problems -> runs (equations x method x tolerance)             > records -> page, plots
"""
