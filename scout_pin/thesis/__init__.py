"""The Scout thesis: its printed equations and tables as data, and what evaluates them.

``ExplicitModel`` gives D, V, C, A_τ, Φ, ∂Φ/∂q, Γ and the solution of (4.23), in
the corrected or the printed edition.
"""

from scout_pin.thesis.catalogue import catalogue
from scout_pin.thesis.explicit import ExplicitModel, Interval, Solution

__all__ = ["ExplicitModel", "Interval", "Solution", "catalogue"]
