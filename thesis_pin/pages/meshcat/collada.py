"""Collada files that meshcat's page can't put together, which it would leave out without a word."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path


def is_mixed(file: str | Path) -> bool:
    """Whether the meshes of a Collada file have different kinds of data.

    meshcat's page makes one mesh of a file; of a mesh with texture coordinates and one
    without it makes none.

    Args:
        file: Path of the file; one that can't be read isn't mixed.
    """
    kinds = set()
    try:
        for _, node in ElementTree.iterparse(file):
            if node.tag.rpartition("}")[2] == "mesh":
                kinds.add(frozenset(_semantics(node)))
                node.clear()
    except (OSError, ElementTree.ParseError):
        return False
    return len(kinds) > 1


def _semantics(mesh: ElementTree.Element) -> set[str]:
    """What the corners of a mesh's faces have: positions, normals, texture coordinates."""
    inputs = (node for node in mesh.iter() if node.tag.rpartition("}")[2] == "input")
    found = {node.get("semantic", "") for node in inputs}
    return found - {"POSITION", "VERTEX"}
