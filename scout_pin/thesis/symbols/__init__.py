"""References of the thesis's symbols, one subject a module."""
