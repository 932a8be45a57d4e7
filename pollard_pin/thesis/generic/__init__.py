"""Robots, vectors and coefficients in general position: nothing vanishes by the robot's shape."""
