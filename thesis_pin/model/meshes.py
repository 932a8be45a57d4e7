"""Where the meshes of a URDF stand: as ROS users lay them out, and as others do.

``package://NAME/meshes/x.stl`` is looked for in the packages of the environment, then
where yourdfpy's handler of file names looks: beside the URDF and in every folder above
it, with and without the package's name. ``model://``, ``file://``, absolute and relative
names go the same way.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from urllib.parse import unquote

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.xml import canonical, parse_xml
from thesis_pin.model.mechanism.description import Description

_PACKAGES = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH")


def with_mesh_paths(
    description: Description, tag: str, environment: Mapping[str, str] | None = None
) -> str:
    """The URDF's text, in which every mesh has the absolute name of a file that is there.

    Args:
        description: The robot; its ``mesh_folders`` are where relative names start.
        tag: ``visual`` or ``collision``: whose meshes.
        environment: Variables that name packages; the process's own by default.

    Returns:
        The text, written anew.

    Raises:
        ModelError: A mesh isn't found; says which, of what link, and where it was looked for.
    """
    root, _ = parse_xml("URDF", description.text, where=description.where)
    environment = os.environ if environment is None else environment
    found: dict[str, str] = {}
    for link in root.iter("link"):
        for shape in link.iter(tag):
            for mesh in shape.iter("mesh"):
                name = mesh.get("filename", "")
                if name not in found:
                    where = f"{description.where}: link {link.get('name', '')!r}"
                    found[name] = _found(name, description.mesh_folders, environment, where)
                mesh.set("filename", found[name])
    return canonical(root)


def with_meshes_there(description: Description, tag: str) -> tuple[str, tuple[str, ...]]:
    """The same without the shapes whose meshes aren't found.

    Args:
        description: The robot.
        tag: ``visual`` or ``collision``: whose meshes; nothing else of these is kept.

    Returns:
        The text, and for each mesh that is missing where it was looked for.
    """
    root, _ = parse_xml("URDF", description.text, where=description.where)
    missing: dict[str, str] = {}
    for link in root.iter("link"):
        for shape in list(link.iter(tag)):
            for mesh in shape.iter("mesh"):
                name = mesh.get("filename", "")
                where = f"{description.where}: link {link.get('name', '')!r}"
                try:
                    mesh.set("filename", _found(name, description.mesh_folders, os.environ, where))
                except ModelError as error:
                    missing.setdefault(name, str(error))
                    link.remove(shape)
    return canonical(root), tuple(missing.values())


def with_absolute_meshes(description: Description) -> str:
    """The URDF's text, in which relative names of meshes that are there are absolute.

    Names that say a scheme, as ``package://``, stay: they mean the same from anywhere. If
    nothing changes, the text is the file's own.
    """
    root, text = parse_xml("URDF", description.text, where=description.where)
    changed = False
    for mesh in root.iter("mesh"):
        name = mesh.get("filename", "")
        if "://" in name or Path(name).is_absolute():
            continue
        for folder in description.mesh_folders:
            if (path := _by_handler(name, folder)) is not None:
                mesh.set("filename", path)
                changed = True
                break
    return canonical(root) if changed else text


def _found(name: str, folders: Sequence[str], environment: Mapping[str, str], where: str) -> str:
    tried: list[str] = []
    for candidate in _candidates(name, folders, environment):
        if candidate.is_file():
            return str(candidate.resolve())
        tried.append(str(candidate.parent))
    for folder in folders:
        if (magic := _by_handler(name, folder)) is not None:
            return magic
        tried.append(f"{folder} and every folder above it")
    raise ModelError(
        f"the mesh {name!r} isn't found; looked for in {', '.join(dict.fromkeys(tried))}",
        where=where,
        remedy="Put it there, or name the folder that holds its package in ROS_PACKAGE_PATH",
    )


def _candidates(
    name: str, folders: Sequence[str], environment: Mapping[str, str]
) -> Iterator[Path]:
    scheme, separator, rest = name.partition("://")
    if not separator:
        scheme, rest = "", name
    if scheme == "file":
        yield Path(unquote(rest))
    if not scheme:
        for folder in ("", *folders):
            yield Path(folder, rest)
    if scheme in ("package", "model"):
        package, _, inside = rest.strip("/").partition("/")
        for variable in _PACKAGES:
            for folder in filter(None, environment.get(variable, "").split(os.pathsep)):
                yield Path(folder, package, inside)
                yield Path(folder, "share", package, inside)
                if Path(folder).name == package:
                    yield Path(folder, inside)
        for folder in folders:
            yield Path(folder, package, inside)


def _by_handler(name: str, folder: str) -> str | None:
    """What yourdfpy's handler of file names finds from a folder upwards."""
    import yourdfpy

    logging.getLogger("yourdfpy.urdf").addHandler(logging.NullHandler())
    for one in (name, name.replace("model://", "package://", 1)):
        try:
            path = yourdfpy.filename_handler_magic(one, folder)
        except (TypeError, ValueError):  # nothing but a package's name
            continue
        if Path(path).is_file():
            return str(Path(path).resolve())
    return None
