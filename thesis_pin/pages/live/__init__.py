"""Robots that are moved by sliders in the browser: what is drawn, what moves, who answers."""
