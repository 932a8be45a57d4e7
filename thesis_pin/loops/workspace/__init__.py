"""Where any robot can go: a grid of what leads it, closed from cell to cell."""
