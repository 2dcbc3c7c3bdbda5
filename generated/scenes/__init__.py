"""One module a scene; every byte is written by rodproof.codegen."""
