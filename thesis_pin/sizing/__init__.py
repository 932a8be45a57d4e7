"""Servos and motors held against what joints need: lists of them, loads, which carry what."""
