"""Pollard: a three-chain parallel spray robot with closed-form kinematics, on Pinocchio."""

from thesis_pin import __version__
from thesis_pin.lazy import lazy_names

# Public name → module that defines it.
_HOMES = {
    "Specification": "specification",
    "JOINT_NAMES": "specification",
    "JOINT_SYMBOLS": "specification",
    "ACTUATOR_NAMES": "specification",
    "load": "model",
    "Pollard": "model",
    "URDF_PATH": "model",
    "PACKAGE_PATH": "model",
    "CLOSURE_PATH": "model",
    "Branch": "kinematics.geometry",
    "DEFAULT_BRANCH": "kinematics.geometry",
    "USEFUL_BRANCHES": "kinematics.geometry",
    "ALL_BRANCHES": "kinematics.geometry",
    "Path": "motion.path",
    "load_path": "motion.files",
    "appendix_b": "motion.path",
    "torque_blocks": "dynamics.stream",
    "trajectory_report": "report.document",
    "evaluate_workspace": "study.workspace",
}

__all__ = [*_HOMES, "__version__"]
__getattr__, __dir__ = lazy_names(__name__, _HOMES)
