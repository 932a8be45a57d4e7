"""``size``: which servos of a list carry a motion, and the smallest that there could be."""
