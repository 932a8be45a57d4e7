"""Reading printed inertia matrices, and asking whether any body could have them.

A printed 3×3 matrix says nothing until three things are known: about which
point it is taken, and whether its off-diagonal entries are entries of the
inertia tensor (−∫xy dm) or products of inertia (+∫xy dm).
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.numeric.arrays import finite_array, vector
from thesis_pin.numeric.checks import choice, real

Convention = Literal["tensor_about_com", "tensor_about_joint", "products_about_joint"]
"""How a printed matrix is meant: see :func:`centroidal_inertia`."""

Reading = Literal["physical", "printed"]
"""``physical`` honours the convention; ``printed`` takes the digits as a
centroidal tensor, which is what both theses' kinetic energies do with them."""


def parallel_axis(mass: float, com: np.ndarray) -> np.ndarray:
    """Inertia [kg·m²] of a point mass at ``com`` about the origin, shape ``(3, 3)``."""
    # Summed term by term: a BLAS dot product rounds differently from processor to
    # processor, and these numbers are written into generated files.
    x, y, z = com
    return np.asarray(mass * ((x * x + y * y + z * z) * np.eye(3) - np.outer(com, com)))


def centroidal_inertia(
    matrix: np.ndarray,
    mass: float,
    com: np.ndarray,
    convention: Convention,
    reading: Reading = "physical",
) -> np.ndarray:
    """Inertia tensor about the centre of mass, from a printed matrix.

    Args:
        matrix: The matrix as printed [kg·m²], shape ``(3, 3)``.
        mass: Mass of the body [kg].
        com: Centre of mass in the joint frame [m], shape ``(3,)``.
        convention: ``tensor_about_com`` (nothing to do), ``tensor_about_joint``
            (shift to the centre of mass) or ``products_about_joint`` (negate
            the off-diagonal entries, then shift).
        reading: ``printed`` ignores the convention.

    Returns:
        Centroidal tensor in the joint frame's axes [kg·m²], shape ``(3, 3)``.
        It isn't checked; see :func:`check_physical`.
    """
    choice("inertia convention", convention, get_args(Convention))
    choice("inertia", reading, get_args(Reading))
    tensor = finite_array("matrix", matrix, 3, 3).copy()
    if reading == "printed" or convention == "tensor_about_com":
        return tensor
    if convention == "products_about_joint":
        tensor = 2 * np.diag(np.diag(tensor)) - tensor
    return np.asarray(tensor - parallel_axis(mass, np.asarray(com, dtype=float)))


def pseudo_inertia(mass: float, com: np.ndarray, centroidal: np.ndarray) -> np.ndarray:
    """Pseudo-inertia matrix, shape ``(4, 4)``: positive definite for physical bodies.

    Source: Wensing, Kim, Slotine, "Linear matrix inequalities for physically
    consistent inertial parameter identification", 2018, equation 17.
    """
    about_origin = centroidal + parallel_axis(mass, com)
    result = np.empty((4, 4))
    result[:3, :3] = 0.5 * np.trace(about_origin) * np.eye(3) - about_origin
    result[:3, 3] = result[3, :3] = mass * com
    result[3, 3] = mass
    return result


def check_physical(
    link: str, mass: float, com: np.ndarray, centroidal: np.ndarray, *, where: str = ""
) -> None:
    """Refuse an inertia that no distribution of positive mass can have.

    Args:
        link: Name for the message.
        mass: Mass [kg].
        com: Centre of mass [m], shape ``(3,)``.
        centroidal: Tensor about the centre of mass [kg·m²], shape ``(3, 3)``.
        where: File and line for the message.

    Raises:
        NonPhysicalInertia: With eigenvalues and principal moments.
    """
    mass, com = real("mass", mass, unit="kg"), vector("com", com, 3)
    centroidal = finite_array("centroidal", centroidal, 3, 3)
    principal = np.linalg.eigvalsh(centroidal)
    # About the centre of mass the pseudo-inertia is block diagonal, so its sign
    # is that of the mass and of the second moments ½ tr(I) − I.
    if mass > 0 and principal[0] > 0 and principal[0] + principal[1] >= principal[2]:
        return
    eigenvalues = np.linalg.eigvalsh(pseudo_inertia(mass, com, centroidal))
    raise NonPhysicalInertia(link, eigenvalues.tolist(), principal.tolist(), where=where)
