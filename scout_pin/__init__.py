"""Scout: an 18-DoF biped with closed-form kinematics and floor contacts, on Pinocchio."""

from importlib import import_module

from thesis_pin import __version__

# Public name → module that defines it, imported on first use: `scout-pin --help`
# and users who only read a specification don't wait for Pinocchio.
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


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
