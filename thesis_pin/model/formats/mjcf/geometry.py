"""Geometry of MuJoCo's specification of a model: what no inertia is made of is taken out."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from thesis_pin.errors import ModelError

if TYPE_CHECKING:
    import mujoco

_SIMPLE = ("SPHERE", "CAPSULE", "CYLINDER", "BOX")


def strip_geometry(spec: mujoco.MjSpec, said: list[str], where: str) -> set[str]:
    """Take out geometry that no inertia is made of, but for simple shapes.

    Args:
        spec: The specification, which is changed.
        said: Warnings are added here.
        where: File name for messages.

    Returns:
        Names of the meshes that some inertia is made of.

    Raises:
        ModelError: One of these is missing.
    """
    import mujoco

    simple = [getattr(mujoco.mjtGeom, f"mjGEOM_{kind}") for kind in _SIMPLE]
    always = spec.compiler.inertiafromgeom == mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE
    files = {mesh.name: _mesh_file(spec, mesh) for mesh in spec.meshes}
    missing = {name for name, file in files.items() if file is not None and not file.is_file()}
    needed: set[str] = set()
    for body in spec.bodies:
        weighed = _moves(body) and (always or not body.explicitinertial)
        for shape in list(body.geoms):
            if weighed and _weighs(shape, spec):
                needed |= {shape.meshname} - {""}
                if shape.meshname in missing:
                    raise ModelError(
                        f"the inertia of body {body.name!r} is made of mesh {shape.meshname!r}, "
                        "which is missing",
                        where=f"{where}:{line_of(body)}",
                        remedy=f"Put it at {files[shape.meshname]}, or give the body an <inertial>",
                    )
            elif body.name == "world" or shape.meshname or shape.type not in simple:
                spec.delete(shape)
    if missing:
        names = ", ".join(sorted(missing)[:5]) + (" …" if len(missing) > 5 else "")
        said.append(
            f"{where}: missing meshes are left out, which is harmless as no inertia is made of "
            f"them: {names}"
        )
    return needed


def _moves(body: mujoco.MjsBody) -> bool:
    """Whether a joint stands between a body and the world."""
    while body is not None and body.name != "world":
        if len(list(body.joints)):
            return True
        body = body.parent
    return False


def _weighs(shape: mujoco.MjsGeom, spec: mujoco.MjSpec) -> bool:
    """Whether a shape adds to its body's mass."""
    first, last = spec.compiler.inertiagrouprange
    weightless = shape.mass == 0.0 or (shape.mass != shape.mass and shape.density == 0.0)
    return bool(first <= shape.group <= last and not weightless)


def _mesh_file(spec: mujoco.MjSpec, mesh: mujoco.MjsMesh) -> Path | None:
    if not mesh.file:
        return None
    name = Path(mesh.file).name if spec.strippath else mesh.file
    return Path(spec.modelfiledir, spec.meshdir, name)


def line_of(element: object) -> int:
    """Line of an element of MuJoCo's specification in its file; 0 if it isn't known."""
    found = re.search(r"line (\d+)", str(getattr(element, "info", "")))
    return int(found.group(1)) if found else 0
