"""Rods in equilibrium as numbers; every byte is written by rodproof.codegen."""
