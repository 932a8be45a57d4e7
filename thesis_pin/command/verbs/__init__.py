"""The verbs of the commands: what they do once their words are read."""
