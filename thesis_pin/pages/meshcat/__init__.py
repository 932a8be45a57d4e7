"""Scenes and robots in meshcat, on a server of ours that no other machine or page can reach."""
