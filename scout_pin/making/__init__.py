"""Specifications and gaits made: from other descriptions, from a template, from neutral soles."""
