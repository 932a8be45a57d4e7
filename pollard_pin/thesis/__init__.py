"""The Pollard thesis: its printed equations as data, and what evaluates them."""

from pollard_pin.thesis.catalogue import catalogue
from pollard_pin.thesis.explicit import ExplicitModel

__all__ = ["ExplicitModel", "catalogue"]
