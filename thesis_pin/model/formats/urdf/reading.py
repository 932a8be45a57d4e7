"""URDF and its dialects → description.

Beside the tree, a URDF can say that joints follow others (``<mimic>``), hang a link
on two parents, name pairs of frames that coincide, or, as URDF+, hold ``<loop>`` and
``<coupling>`` elements. Pinocchio ignores all of that; here it becomes the
description's supplement, and the text keeps the tree.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.cutting import Cutter
from thesis_pin.model.formats.graph import cut_loops, needs_cutting
from thesis_pin.model.formats.urdf.closing_frames import closing_frames
from thesis_pin.model.formats.urdf.edited import edited
from thesis_pin.model.formats.urdf.elements import joint_of, link_of, named, refuse_xacro
from thesis_pin.model.formats.urdf.mended import mend
from thesis_pin.model.formats.urdf.passed_over import passed_over
from thesis_pin.model.formats.urdf.plus import independent, read_couplings, read_loops
from thesis_pin.model.formats.xml import Element, canonical, parse_xml
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Description, Joint
from thesis_pin.model.mechanism.supplement import Coupling, Motor, Supplement
from thesis_pin.model.source import read_bytes


def read(
    path: str | Path, content: bytes | None = None, *, motors: Sequence[str] = ()
) -> Description:
    """Read a URDF file; see :func:`read_urdf`.

    Args:
        path: The file.
        content: Its bytes, if they are read already.
        motors: As for :func:`read_urdf`.

    Raises:
        BadInput: It can't be read; otherwise as :func:`read_urdf`.
    """
    content = read_bytes("URDF", path, LIMITS.urdf_bytes) if content is None else content
    found = read_urdf(content, where=str(path), motors=motors)
    return replace(found, mesh_folders=(str(Path(path).resolve().parent),))


def read_urdf(
    content: bytes | str, *, where: str = "URDF", motors: Sequence[str] = ()
) -> Description:
    """Read a URDF: its grammar, names and numbers, not yet whether they make sense.

    Args:
        content: The file's bytes, in the encoding they declare, or its text.
        where: File name for messages.
        motors: Joints, or parts of their names, that aren't cut if a loop has others.

    Raises:
        ModelError: Not XML, not a URDF, a xacro file; a name missing or given twice, an
            element repeated, a number that is none; a loop that can't be cut.
        UnknownName: A joint of an unknown type, or one that hangs on what isn't there.
    """
    root, text = parse_xml("URDF", content, where=where)
    if root.tag != "robot":
        raise ModelError(
            f"the root element is <{root.tag}>", where=f"{where}:{root.line}", allowed="<robot>"
        )
    refuse_xacro(root, where)
    links = {name: link_of(name, e, where) for name, e in named(root, "link", where).items()}
    joints = {name: joint_of(name, e, where) for name, e in named(root, "joint", where).items()}
    if not links:
        raise ModelError("there is no <link>", where=where)
    changed, said = mend(root, where)
    text = canonical(root) if changed else text
    tree = Description(root.get("name", ""), links, joints, text, where, warnings=tuple(said))
    return _closed(root, tree, motors)


def _closed(root: Element, tree: Description, motors: Sequence[str]) -> Description:
    """The tree with all that its file says beyond one."""
    where = tree.where
    mimics, odd = _mimics(tree)
    couplings = [*mimics, *read_couplings(root, tree)]
    notes = tuple(odd)
    links, joints = tree.links, tree.joints
    made = Cutter(dict(links), dict(joints), {*links, *joints}, where)
    if needs_cutting(joints.values()):
        keep = {name for name in joints if any(part in name for part in motors)}
        keep |= {name for one in couplings for name in one.coefficients} | independent(root)
        cut = cut_loops(links, joints, keep=keep, where=where)
        made = Cutter(dict(cut.links), dict(cut.joints), {*cut.links, *cut.joints}, where)
        made.closures, notes = list(cut.closures), (*notes, *cut.notes)
    read_loops(root, made)
    if not made.closures:
        frames, said = closing_frames(tree)
        made.closures, notes = list(frames), (*notes, *said)
    changed = made.links.keys() != links.keys() or any(
        joints.get(name) is not joint for name, joint in made.joints.items()
    )
    for what, listed in (("loops", made.closures), ("tied joints", couplings)):
        if len(listed) > LIMITS.entries:
            raise ModelError(
                f"there are {len(listed):,} {what}", where=where, allowed=f"{LIMITS.entries:,}"
            )
    supplement = Supplement(tuple(made.closures), tuple(couplings))
    driven = _motors(root, made.joints, supplement)
    return replace(
        tree,
        links=made.links,
        joints=made.joints,
        text=edited(root, tree, made.links, made.joints) if changed else tree.text,
        supplement=replace(supplement, motors=driven),
        warnings=(*tree.warnings, *notes),
        passed_over=passed_over(root, where),
    )


def _mimics(tree: Description) -> tuple[list[Coupling], list[str]]:
    """What ``<mimic>`` ties, q − factor·q of the other = offset; and what it can't."""
    found, odd = [], []
    for name, joint in tree.joints.items():
        if joint.mimic is None or joint.kind == "fixed":
            continue
        other, factor, offset = joint.mimic
        here = f"{tree.where}:{joint.line}: joint {name!r}"
        if other not in tree.joints:
            odd.append(f"{here}: <mimic> names joint {other!r}, which isn't there; it moves freely")
            continue
        if other == name:
            raise ModelError("it mimics itself", where=here)
        for one in (joint, tree.joints[other]):
            if one.kind in ("floating", "planar"):
                raise ModelError(
                    f"<mimic> ties joint {one.name!r}, which is {one.kind}",
                    where=here,
                    allowed="joints of one degree of freedom",
                )
        moves = tree.joints[other].kind != "fixed" and abs(factor) >= LIMITS.smallest
        factors = {name: 1.0, other: -factor} if moves else {name: 1.0}
        found.append(Coupling(f"{name} follows {other}", factors, offset))
    return found, odd


def _motors(root: Element, joints: dict[str, Joint], supplement: Supplement) -> tuple[Motor, ...]:
    """Motors where no closure file names any.

    URDF+ marks them; without loops, every joint that no coupling moves is one.
    """
    single = [
        name
        for name, joint in joints.items()
        if joint.kind in ("revolute", "continuous", "prismatic")
    ]
    if marked := independent(root):
        return tuple(Motor(name, name) for name in single if name in marked)
    if supplement.closures:
        return ()
    follow = {next(iter(one.coefficients)) for one in supplement.couplings}
    return tuple(Motor(name, name) for name in single if name not in follow)
