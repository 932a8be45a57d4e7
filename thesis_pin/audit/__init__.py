"""Verdicts on printed equations, computed from their texts, and the documents that say them."""
