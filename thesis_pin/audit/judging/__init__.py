"""Whether a printed line holds, by how much it fails, which of its slips, and what that matters."""
