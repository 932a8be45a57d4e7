"""A robot put on the floor, and when its feet are on it."""
