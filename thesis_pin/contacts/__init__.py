"""Feet on the floor: what they can carry, who carries what, whether a robot is balanced."""
