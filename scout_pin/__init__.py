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
    "BRANCHES": "kinematics.solutions",
    "LegSolutions": "kinematics.solutions",
    "leg_rates": "kinematics.rates",
    "Gait": "motion.gait",
    "load_gait": "motion.files",
    "Contact": "model",
    "joint_trajectory": "motion.trajectory",
    "inverse_dynamics": "dynamics.inverse",
    "torque_blocks": "dynamics.stream",
    "touchdown_impact": "dynamics.impact",
    "zero_moment_point": "dynamics.stability",
    "pressure_point": "dynamics.stability",
    "support_margin": "dynamics.stability",
    "gait_report": "report.document",
}

__all__ = [*_HOMES, "__version__"]
__getattr__, __dir__ = lazy_names(__name__, _HOMES)
