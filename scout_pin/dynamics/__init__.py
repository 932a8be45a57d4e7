"""Torques and floor wrenches of a motion, landings, stability."""
