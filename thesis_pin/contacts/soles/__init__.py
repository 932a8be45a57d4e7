"""Feet of any robot: which links they are, and what of them meets the floor."""
