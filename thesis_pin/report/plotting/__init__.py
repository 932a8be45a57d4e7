"""Plots as drawings: where panels, axes and legends stand, and what draws them."""
