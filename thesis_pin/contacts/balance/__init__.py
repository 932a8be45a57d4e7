"""Torques and contact forces of any robot on its feet, and whether it keeps its balance."""
