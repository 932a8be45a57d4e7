"""Flags and words of the verbs: what they are called, what they take, how they are refused."""
