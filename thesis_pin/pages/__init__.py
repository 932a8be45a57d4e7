"""Scenes and reports as pages that play offline, and the server that shows them."""
