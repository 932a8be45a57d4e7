"""Arrays, rotations, curves and sampled motions: mathematics that knows no robot."""
