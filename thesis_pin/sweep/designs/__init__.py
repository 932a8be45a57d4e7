"""What is tried: keys of a file that vary, their values, and the designs that these make."""
