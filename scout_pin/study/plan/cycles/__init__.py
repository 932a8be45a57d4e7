"""Cycles of a walk: curves that come back to where they began, a step or two further."""
