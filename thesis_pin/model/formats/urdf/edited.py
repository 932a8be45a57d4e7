"""A URDF's text after links and joints were added, left out or turned round."""

from __future__ import annotations

from collections.abc import Mapping

from thesis_pin.model.formats.writer import write_urdf
from thesis_pin.model.formats.xml import Element, canonical, parse_xml
from thesis_pin.model.mechanism.description import Description, Joint, Link


def edited(
    root: Element, before: Description, links: Mapping[str, Link], joints: Mapping[str, Joint]
) -> str:
    """Text of a URDF with other links and joints; all else in it stays as it was.

    Args:
        root: The document.
        before: What was read from it.
        links: Its links and new ones.
        joints: Its joints, of which some may be new, missing or changed.
    """
    new_links = [link for name, link in links.items() if name not in before.links]
    new_joints = [joint for name, joint in joints.items() if before.joints.get(name) is not joint]
    stay = {name for name, joint in joints.items() if before.joints.get(name) is joint}
    added, _ = parse_xml("URDF", write_urdf("new", new_links, new_joints), where=before.where)
    whole = Element(root.tag, dict(root.attrib))
    whole.text = "\n  "
    for child in root:
        joint = child.tag == "joint"
        if child.tag in ("loop", "coupling") or (joint and child.get("name") not in stay):
            continue
        whole.append(child)
    whole.extend(added)
    return canonical(whole)
