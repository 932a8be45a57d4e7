"""Laws of motion along a path: the fastest, those of a constant speed, the least loading."""
