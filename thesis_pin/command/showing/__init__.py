"""What ``view`` shows besides motions."""
