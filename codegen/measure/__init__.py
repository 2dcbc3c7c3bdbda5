"""Error against run time, for the six functions of a generated scene and what users have today.

inputs   the sampled constants, loads and strains, by kind and precision
oracle   the six functions in ball arithmetic, to hundreds of certified bits
errors   distance to the oracle in whitened ulps, and how much of it the inputs explain
form     a way to compute a function; rivals: every one that is measured, from the textbook's
         formulas in NumPy to the compiled peers
timing   nanoseconds per point, interleaved
records  what is stored; survey fills it; table and plot draw from it alone
"""
