"""Scenes as films and pictures: drawn by a headless Chromium, frame by frame."""
