"""Configurations of robots with loops: surveyed, closed, followed, with their rates."""
