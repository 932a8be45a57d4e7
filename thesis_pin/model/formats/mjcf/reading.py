"""MJCF → description, through MuJoCo's own compiler.

The compiler resolves defaults, angles, frames, includes and inertias from geometry;
what it compiles is read by :mod:`thesis_pin.model.formats.mjcf.compiled`. Whatever
doesn't move bodies (meshes and geometry of bodies that have inertials, textures,
sensors, cameras) is taken out before, so that files without their meshes load.
"""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.mjcf.compiled import describe
from thesis_pin.model.formats.mjcf.geometry import line_of, strip_geometry
from thesis_pin.model.formats.mjcf.without_mujoco import read_with_pinocchio
from thesis_pin.model.formats.xml import Element, parse_xml
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Description
from thesis_pin.model.source import read_bytes
from thesis_pin.numeric.checks import shown

if TYPE_CHECKING:
    import mujoco

KIND = "MJCF"

_UNSEEN = ("sensors", "pairs", "excludes", "skins", "cameras", "lights", "texts", "numerics")
_MOST_FILES = 100
_NAMES = (
    *("name", "class", "childclass", "file", "mesh", "material", "joint", "joint1", "joint2"),
    *("body", "body1", "body2", "site", "site1", "site2", "tendon", "model"),
)
_ELEMENTS_THAT_COPY = ("replicate", "composite", "flexcomp")


def read_mjcf(path: str | Path, content: bytes | None = None) -> Description:
    """Read an MJCF file.

    Args:
        path: The file; files that it includes and meshes are looked for beside it.
        content: Its bytes, if they are read already.

    Raises:
        BadInput: It can't be read, or holds what is read through MuJoCo alone, which isn't
            installed.
        ModelError: It isn't MJCF, MuJoCo can't compile it, it has flexible bodies, or
            the mesh that a body's inertia is made of is missing.
    """
    where = str(path)
    content = read_bytes(KIND, path, LIMITS.urdf_bytes) if content is None else content
    root, text = parse_xml(KIND, content, where=where, nesting=LIMITS.bodies_nesting)
    if root.tag != "mujoco":
        raise ModelError(
            f"the root element is <{root.tag}>", where=f"{where}:{root.line}", allowed="<mujoco>"
        )
    if not has_mujoco():
        return read_with_pinocchio(path, root)
    folder = Path(path).resolve().parent
    included = _included(root, folder, where)
    said: list[str] = []
    spec = _spec(text, included, folder, where, said)
    passed_over = _strip(spec, where, said)
    with _listening(where, said):
        model = spec.compile()
    lines = (
        {body.name: line_of(body) for body in spec.bodies},
        {joint.name: line_of(joint) for joint in spec.joints},
    )
    return describe(model, where, said, passed_over, lines)


def has_mujoco() -> bool:
    """Whether MuJoCo can be imported here."""
    try:
        import mujoco
    except ImportError:
        return False
    return hasattr(mujoco, "MjSpec") and hasattr(mujoco.MjSpec, "delete")


def _spec(
    text: str, included: dict[str, bytes], folder: Path, where: str, said: list[str]
) -> mujoco.MjSpec:
    import mujoco

    with _listening(where, said):
        spec = mujoco.MjSpec.from_string(text, include=included)
    spec.modelfiledir = f"{folder}/"
    if len(spec.flexes):
        raise ModelError("it has flexible bodies", where=where, allowed="rigid bodies")
    return spec


@contextmanager
def _listening(where: str, said: list[str]) -> Iterator[None]:
    """Take what MuJoCo says as warnings; it would write to standard error and a log file."""
    import mujoco

    def hear(message: object) -> None:
        line = f"{where}: MuJoCo: {_one_line(message)}"
        if line not in said:
            said.append(line)

    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(hear)
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            yield
        for one in caught:
            hear(one.message)
    except (ValueError, RuntimeError, OSError) as error:
        raise _refused(error, where) from None
    finally:
        mujoco.set_mju_user_warning(before)


def _refused(error: Exception, where: str) -> ModelError:
    return ModelError(f"MuJoCo can't compile it ({_one_line(error)})", where=where)


def _one_line(message: object) -> str:
    return re.sub(r"\s+", " ", str(message)).strip()


def _included(root: Element, folder: Path, where: str) -> dict[str, bytes]:
    """Files that the file includes, by name; each is bounded as the file itself is."""
    found: dict[str, bytes] = {}
    waiting = [(root, where)]
    while waiting:
        element, source = waiting.pop()
        _check_elements(element, source)
        for include in element.iter("include"):
            assert isinstance(include, Element)
            name, here = include.get("file", ""), f"{source}:{include.line}"
            if name in found:
                raise ModelError(f"it includes the file {name!r} twice", where=here)
            if len(found) == _MOST_FILES:
                raise ModelError("it includes more files", where=here, allowed=f"{_MOST_FILES}")
            content = read_bytes(KIND, folder / name, LIMITS.urdf_bytes)
            found[name] = content
            nesting = LIMITS.bodies_nesting
            waiting.append((parse_xml(KIND, content, where=name, nesting=nesting)[0], name))
    return found


def _check_elements(root: Element, where: str) -> None:
    """Refuse NaN, which MuJoCo takes for "not given", and what makes millions of copies."""
    waiting = [(root, 1.0)]
    while waiting:
        element, times = waiting.pop()
        if element.tag in _ELEMENTS_THAT_COPY:
            counts = (element.get("count") or "1").split()
            try:
                times *= math.prod(float(count) for count in counts)
            except ValueError:
                times = math.inf
            if not times <= LIMITS.links:
                raise ModelError(
                    f"<{element.tag}> makes {times:g} copies",
                    where=f"{where}:{element.line}",
                    allowed=f"at most {LIMITS.links:,}",
                )
        for key, value in element.attrib.items():
            if key not in _NAMES and "nan" in value.lower().split():
                raise ModelError(
                    f"<{element.tag} {key}={shown(value)}> isn't finite",
                    where=f"{where}:{element.line}",
                    allowed="finite numbers",
                )
        waiting += [(child, times) for child in element if isinstance(child, Element)]


def _strip(spec: mujoco.MjSpec, where: str, said: list[str]) -> list[str]:
    """Take out what doesn't move bodies; what acts and is passed over is returned."""
    import mujoco

    passed = [f"{where}: tendon {item.name!r}" for item in spec.tendons]
    passed += [f"{where}: plugin {item.name or item.plugin_name!r}" for item in spec.plugins]
    on_joints = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
    for actuator in list(spec.actuators):
        if actuator.trntype not in on_joints:
            kind = str(actuator.trntype).rpartition("mjTRN_")[2].lower()
            passed.append(
                f"{where}:{line_of(actuator)}: actuator {actuator.name!r}, which acts on a {kind}"
            )
            spec.delete(actuator)
    known = (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD, mujoco.mjtEq.mjEQ_JOINT)
    for equality in list(spec.equalities):
        if equality.type not in known:
            kind = str(equality.type).rpartition("mjEQ_")[2].lower()
            passed.append(f"{where}:{line_of(equality)}: equality {equality.name!r} of a {kind}")
            spec.delete(equality)
    for kind in _UNSEEN:
        for item in list(getattr(spec, kind)):
            spec.delete(item)
    for item in list(spec.tendons):
        spec.delete(item)
    needed = strip_geometry(spec, said, where)
    for mesh in list(spec.meshes):
        if mesh.name not in needed:
            spec.delete(mesh)
    fields = {shape.hfieldname for shape in spec.geoms}
    for field in list(spec.hfields):
        if field.name not in fields:
            spec.delete(field)
    for shape in (*spec.geoms, *spec.sites):
        shape.material = ""
    for item in (*spec.materials, *spec.textures):
        spec.delete(item)
    return passed
