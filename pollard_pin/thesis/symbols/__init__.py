"""What each symbol of the thesis must equal, worked out without its formulas."""
