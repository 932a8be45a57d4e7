"""Closed-form kinematics, both ways, with rates, accelerations and singularities."""
