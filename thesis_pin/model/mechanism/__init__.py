"""What a description says of a mechanism, and whether such a one can be."""
