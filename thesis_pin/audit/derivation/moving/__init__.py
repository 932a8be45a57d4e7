"""The robot of a derivation in motion, at seeded states and in its coordinates."""
