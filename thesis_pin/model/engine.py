"""Which Pinocchio is imported: other packages and other builds bear the same name."""

from __future__ import annotations

import sys
from importlib.machinery import PathFinder

from thesis_pin.errors import BadInput
from thesis_pin.numeric.workers import ctrl_c_later

OLDEST, NEWEST = (4, 1), (5, 0)
"""Versions of Pinocchio from which and below which everything here works."""


def require_pinocchio() -> None:
    """Find out whether ``import pinocchio`` gives the Pinocchio that everything here stands on.

    PyPI's ``pinocchio`` is a plug-in of nose, and a ROS build for another Python
    may stand first on the path.

    Raises:
        BadInput: It doesn't; says which file it gives, and what to do.
    """
    try:
        with ctrl_c_later():  # compiled modules would take it for a failure of what they import
            import pinocchio as pin
    except Exception as error:  # what another build fails with is up to it
        if not (place := _place()):
            raise BadInput("Pinocchio isn't installed", remedy="pip install pin") from None
        raise _another(place, f"can't be imported ({type(error).__name__}: {error})") from None
    if not hasattr(pin, "buildModelFromUrdf"):
        raise _another(_place(), "isn't the library of rigid-body dynamics")
    version = str(pin.__version__)
    if not OLDEST <= tuple(map(int, version.split(".")[:2])) < NEWEST:
        raise _another(_place(), f"has version {version}")


def _another(place: str, what: str) -> BadInput:
    return BadInput(
        f"the module pinocchio that Python finds here {what}",
        where=place,
        allowed="the one of the package pin, from {}.{} to below {}".format(*OLDEST, NEWEST[0]),
        remedy="pip uninstall pinocchio, pip install pin; "
        "if PYTHONPATH names its folder (ROS sets it), leave it out",
    )


def _place() -> str:
    """The file that ``import pinocchio`` finds; empty if there is none."""
    if place := getattr(sys.modules.get("pinocchio"), "__file__", None):
        return str(place)
    spec = PathFinder.find_spec("pinocchio")
    folders = list(spec.submodule_search_locations or ()) if spec else []
    return str(spec.origin or "".join(folders[:1])) if spec else ""
