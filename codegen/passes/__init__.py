"""Passes, each a file named by its verb and a function from kernel to kernel.

The order is that of `rodproof.codegen.generate.passes`: stabilise, specialise,
drop_guards, share, order, name.
"""
