"""Robots in general position: nothing vanishes by their shape, no angle between axes is right."""
