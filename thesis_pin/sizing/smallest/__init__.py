"""The smallest motors of one kind for a motion, and how short it may be with which motor."""
