"""Statements of the thesis that no single identity decides."""
