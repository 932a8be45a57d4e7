"""What a sweep varies of a Pollard-like robot or its path, and what judges it."""
