"""Motions of any robot: some joints from a file, all others from the loops."""
