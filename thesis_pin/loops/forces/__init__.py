"""What a motion of a looped robot needs and what carries it, sample by sample."""
