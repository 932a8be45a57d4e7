"""SDF file → description.

Read as far as files of versions 1.4 to 1.11 describe one rigid robot: poses, frames,
``relative_to`` and ``expressed_in``, links, joints, springs, gearboxes. A robot that no
joint ties to the world flies freely.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.cutting import Cutter
from thesis_pin.model.formats.graph import cut_loops
from thesis_pin.model.formats.sdf.elements import children, flag, number, only, pose_of, text_of
from thesis_pin.model.formats.sdf.frames import WORLD, Frames
from thesis_pin.model.formats.sdf.joints import Joints
from thesis_pin.model.formats.sdf.shapes import shapes_of
from thesis_pin.model.formats.writer import write_urdf
from thesis_pin.model.formats.xml import Element, parse_xml
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Array, Description, Inertial, Joint, Link
from thesis_pin.model.mechanism.supplement import Coupling, Motor, Supplement
from thesis_pin.model.source import read_bytes
from thesis_pin.numeric.rotations import quaternions

KIND = "SDF"
_PASSED_OVER = ("include", "plugin", "gripper")
_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def read_sdf(
    path: str | Path, content: bytes | None = None, *, motors: Sequence[str] = ()
) -> Description:
    """Read the one model of an SDF file, and cut its loops.

    Args:
        path: The file.
        content: Its bytes, if they are read already.
        motors: Joints, or parts of their names, that aren't cut if a loop has others.

    Raises:
        BadInput: It can't be read.
        UnknownName: It names a link, frame or type of joint that isn't there.
        ModelError: It isn't SDF, holds no or several models or one within another, or
            something in it makes no sense.
    """
    where = str(path)
    content = read_bytes(KIND, path, LIMITS.urdf_bytes) if content is None else content
    root, _ = parse_xml(KIND, content, where=where, texts=True)
    model = _model(root, where)
    return _read(model, _version(root, where), where, motors)


def _read(
    model: Element, version: tuple[int, ...], where: str, motors: Sequence[str]
) -> Description:
    name = model.get("name", "") or "robot"
    passed_over = []
    for item in children(model, *_PASSED_OVER):
        called = item.get("name") or item.findtext("uri") or ""
        passed_over.append(f"{where}:{item.line}: <{item.tag}> {called}".strip())
    warnings: list[str] = []
    elements = _named(model, where)
    frames = Frames(model, elements, where)
    of_tag = {tag: {n: e for n, e in elements.items() if e.tag == tag} for tag in ("link", "joint")}
    links = {n: _link(n, e, where, warnings) for n, e in of_tag["link"].items()}
    ends = {text_of(e, end, where) for e in of_tag["joint"].values() for end in ("parent", "child")}
    static = flag(model, "static", f"{where}:{model.line}")
    if WORLD in ends or static:
        links = {WORLD: Link(WORLD, 0), **links}
    made = Cutter(links, {}, set(elements), where)
    joints = Joints(frames, made, version, passed_over)
    for joint, element in of_tag["joint"].items():
        joints.read(joint, element)
    if static:
        for link in of_tag["link"]:
            if not any(joint.child == link for joint in joints.joints.values()):
                fixed = made.new(f"{link}_fixed")
                place = frames.model_in_world() @ frames.placement(link)
                joints.joints[fixed] = Joint(
                    fixed, links[link].line, "fixed", WORLD, link, place, np.eye(3)[0]
                )
    couplings = [*joints.couplings, *joints.gears(passed_over.append)]
    keep = {spring.joint for spring in joints.springs}
    keep |= {joint for coupling in couplings for joint in coupling.coefficients}
    keep |= {name for name in joints.joints if any(part in name for part in motors)}
    first = WORLD if WORLD in links else _canonical(model, links)
    types, moved = joints.types, joints.joints
    tree = cut_loops(links, moved, types, root=first, keep=keep, meant=made.meant, where=where)
    free = tree.root != WORLD
    kept = list(_kept(couplings, tree.joints, passed_over, where))
    springs = [spring for spring in joints.springs if spring.joint in tree.joints]
    passed_over += [
        f"{where}: the spring of joint {spring.joint!r}, where a loop is cut"
        for spring in joints.springs
        if spring not in springs
    ]
    supplement = Supplement(
        closures=tree.closures,
        couplings=tuple(kept),
        motors=() if tree.closures else _motors(tree.joints, joints.types, kept),
        joint_types={n: kind for n, kind in joints.types.items() if n in tree.joints},
        springs=tuple(springs),
        damping={n: value for n, value in joints.damping.items() if n in tree.joints},
        friction={n: value for n, value in joints.friction.items() if n in tree.joints},
        poses={"initial": {"root_joint": _pose(frames, tree.root)}} if free else {},
        free_root=free,
    )
    shapes = {n: list(shapes_of(e, f"{where}:{e.line}")) for n, e in of_tag["link"].items()}
    return Description(
        name,
        tree.links,
        tree.joints,
        write_urdf(name, tree.links.values(), tree.joints.values(), shapes),
        where=where,
        supplement=supplement,
        warnings=(*warnings, *tree.notes),
        passed_over=tuple(passed_over),
    )


def _model(root: Element, where: str) -> Element:
    if root.tag != "sdf":
        raise ModelError(
            f"the root element is <{root.tag}>", where=f"{where}:{root.line}", allowed="<sdf>"
        )
    models = list(children(root, "model"))
    for world in children(root, "world"):
        models += children(world, "model")
    if len(models) != 1:
        names = ", ".join(model.get("name", "") for model in models)
        raise ModelError(
            f"it holds {len(models)} models{': ' if names else ''}{names}",
            where=where,
            allowed="one",
            remedy="Write the robot's model to a file of its own",
        )
    if (nested := next(children(models[0], "model"), None)) is not None:
        raise ModelError(
            f"model {nested.get('name', '')!r} stands within another, which isn't read",
            where=f"{where}:{nested.line}",
            remedy="Write its links and joints into the outer model",
        )
    return models[0]


def _version(root: Element, where: str) -> tuple[int, ...]:
    parts = root.get("version", "").split(".")
    if not all(part.isdecimal() for part in parts):
        raise ModelError(
            f"its version is {root.get('version', '')!r}",
            where=f"{where}:{root.line}",
            allowed="a version such as 1.6",
        )
    return tuple(int(part) for part in parts)


def _named(model: Element, where: str) -> dict[str, Element]:
    """Links, joints and frames by name."""
    found: dict[str, Element] = {}
    for element in children(model, "link", "joint", "frame"):
        name, here = element.get("name", ""), f"{where}:{element.line}"
        if not name or len(name) > LIMITS.key:
            raise ModelError(f"the name of a {element.tag} is {name[:40]!r}", where=here)
        if name in found:
            # Links and joints may share a name in old versions; poses then say which.
            kinds = {found[name].tag, element.tag}
            what = f"two {element.tag}s" if len(kinds) == 1 else " and ".join(sorted(kinds))
            raise ModelError(f"{what} are called {name!r}", where=here, allowed="unlike names")
        found[name] = element
    counts = {tag: sum(e.tag == tag for e in found.values()) for tag in ("link", "joint")}
    if not counts["link"]:
        raise ModelError("there is no <link>", where=f"{where}:{model.line}")
    for tag, most in (("link", LIMITS.links), ("joint", LIMITS.links)):
        if counts[tag] > most:
            raise ModelError(f"there are {counts[tag]:,} {tag}s", where=where, allowed=f"{most:,}")
    moving = sum(e.tag == "joint" and e.get("type") != "fixed" for e in found.values())
    if moving > LIMITS.joints:
        raise ModelError(
            f"{moving:,} joints move", where=where, allowed=f"at most {LIMITS.joints:,}"
        )
    return found


def _link(name: str, element: Element, where: str, warnings: list[str]) -> Link:
    here = f"{where}:{element.line}: link {name!r}"
    inertial = only(element, "inertial", here)
    if inertial is None:
        warnings.append(f"{here}: no <inertial>: SDF takes 1 kg and 1 kg·m² then")
    elif inertial.get("auto", "false").lower() in ("true", "1"):
        raise ModelError(
            "its inertia is to be made of its geometry, which isn't read",
            where=here,
            remedy="Write the numbers into its <inertial>",
        )
    mass = number(inertial, "mass", here, 1.0)
    entries = None if inertial is None else only(inertial, "inertia", here)
    xx, xy, xz, yy, yz, zz = (
        number(entries, key, here, float(key[1] == key[2])) for key in _INERTIA
    )
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    place, relative = (np.eye(4), "") if inertial is None else pose_of(inertial, here)
    if relative not in ("", name):
        raise ModelError(f"its inertial is placed in frame {relative!r}", where=here, allowed=name)
    if flag(element, "kinematic", here):
        warnings.append(f"{here}: <kinematic>, which is taken as a body like any other")
    return Link(name, element.line, Inertial(mass, place, tensor))


def _canonical(model: Element, links: dict[str, Link]) -> str:
    named = model.get("canonical_link", "")
    return named if named in links else next(iter(links))


def _kept(
    couplings: list[Coupling], joints: dict[str, Joint], passed_over: list[str], where: str
) -> Iterator[Coupling]:
    for coupling in couplings:
        if lost := [name for name in coupling.coefficients if name not in joints]:
            passed_over.append(
                f"{where}: coupling {coupling.name!r}: no joint {lost[0]!r} in the tree"
            )
        else:
            yield coupling


def _motors(
    joints: Mapping[str, Joint], types: Mapping[str, str], couplings: Sequence[Coupling]
) -> tuple[Motor, ...]:
    """Without loops every hinge and slide that no other moves is taken as a motor."""
    follow = {next(iter(coupling.coefficients)) for coupling in couplings}
    return tuple(
        Motor(name, name)
        for name, joint in joints.items()
        if joint.kind in ("revolute", "prismatic") and name not in follow and name not in types
    )


def _pose(frames: Frames, root: str) -> tuple[float, ...]:
    place: Array = frames.model_in_world() @ frames.placement(root)
    return tuple(float(value) for value in (*place[:3, 3], *quaternions(place[:3, :3])))
