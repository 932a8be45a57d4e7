"""Slips put into lines that hold, to see whether the audit notices them."""
