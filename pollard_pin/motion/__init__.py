"""Paths of the spray tip, their files, and the joints that follow them."""
