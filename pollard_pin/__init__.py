"""Pollard: a three-chain parallel spray robot with closed-form kinematics, on Pinocchio."""

from importlib import import_module

from thesis_pin import __version__

# Public name → module that defines it, imported on first use: `pollard-pin --help`
# and users who only read a specification don't wait for Pinocchio.
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


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
