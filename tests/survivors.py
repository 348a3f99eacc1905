"""Broken shaders that no test can tell from whole ones, and why: see test_mutations.py."""

# File: {the place as it then reads: why nothing changes}.
EXPECTED_SURVIVORS: dict[str, dict[str, str]] = {}
