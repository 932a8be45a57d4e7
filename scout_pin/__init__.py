"""Scout: an 18-DoF biped with closed-form kinematics and floor contacts, on Pinocchio."""

from thesis_pin import __version__
from thesis_pin.lazy import lazy_names

# Public name → module that defines it.
_HOMES = {
    "Specification": "specification",
    "JOINT_NAMES": "specification",
    "JOINT_SYMBOLS": "specification",
    "load": "model",
    "Scout": "model",
    "URDF_PATH": "model",
    "PACKAGE_PATH": "model",
    "BRANCHES": "solutions",
    "LegSolutions": "solutions",
    "leg_rates": "rates",
    "Gait": "gait",
    "load_gait": "gait_files",
    "Contact": "contact",
    "joint_trajectory": "dynamics",
    "inverse_dynamics": "dynamics",
    "torque_blocks": "stream",
    "touchdown_impact": "impact",
    "zero_moment_point": "stability",
    "pressure_point": "stability",
    "support_margin": "stability",
    "gait_report": "report",
}

__all__ = [*_HOMES, "__version__"]
__getattr__, __dir__ = lazy_names(__name__, _HOMES)
