"""Closed-form kinematics of a leg, both ways, with rates, accelerations and singularities."""
