"""Gaits: planned curves of torso and feet, their files, and the joints that follow them."""
