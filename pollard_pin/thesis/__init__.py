"""The Pollard thesis: its printed equations as data, and what evaluates them."""

from pollard_pin.thesis.catalogue import catalogue

__all__ = ["catalogue"]
