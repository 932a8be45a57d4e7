"""Gaits from samples of finite resolution: curves through them, and where they stand."""
