"""What ``view`` shows besides motions, and where besides the browser's own page."""
