"""Torques, ball-joint forces and joint reactions of a motion."""
