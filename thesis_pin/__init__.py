"""What both robots' packages share: no robot of its own, no import of either."""

__version__ = "0.1.0"
