"""Modules that need numba, one a scene; written by rodproof.codegen."""
