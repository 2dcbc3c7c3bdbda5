"""Targets: each prints or evaluates a kernel, and none of them changes what it means."""
