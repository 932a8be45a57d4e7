"""A walk from rest to rest: the start that leads to a cycle, its steps, the stop."""
