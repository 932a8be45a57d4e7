"""The smallest motors for a path, as it is timed and with its law of time left free."""
