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
    "Branch": "geometry",
    "DEFAULT_BRANCH": "geometry",
    "USEFUL_BRANCHES": "geometry",
    "ALL_BRANCHES": "geometry",
    "Path": "path",
    "load_path": "path",
    "appendix_b": "path",
    "torque_blocks": "stream",
    "trajectory_report": "report",
    "evaluate_workspace": "workspace",
}

__all__ = [*_HOMES, "__version__"]
__getattr__, __dir__ = lazy_names(__name__, _HOMES)
