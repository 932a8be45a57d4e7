"""How objects show themselves: one line in a console, a short table in a notebook."""
