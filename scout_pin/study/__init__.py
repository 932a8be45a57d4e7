"""What is worked out over many poses or motions."""
