"""Gaits planned: curves that a biped can walk, from a request for a step."""
