"""Robots of example-robot-data, by name: ``example:panda``.

The package has no Python module; its files stand in the folder ``share`` of whatever
installed it.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from importlib import metadata, util
from pathlib import Path

from thesis_pin.errors import BadInput, UnknownName

PREFIX = "example:"
"""What the name of an example starts with where a file may be named."""

_PACKAGE = "example-robot-data"
_ENVIRONMENT = ("CONDA_PREFIX", "CMAKE_PREFIX_PATH", "AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH")


def located(file: str | Path) -> str | Path:
    """A file, or the file of the example that is named; no file is called so by accident.

    Raises:
        BadInput: As :func:`example`.
    """
    if isinstance(file, str) and file.startswith(PREFIX) and not Path(file).exists():
        return example(file.removeprefix(PREFIX))
    return file


def example(name: str) -> Path:
    """File of a robot of example-robot-data.

    Args:
        name: Stem of a URDF or SDF, name of its folder, or both with a slash between, as
            ``panda``, ``panda_description``, ``panda_description/panda``.

    Raises:
        UnknownName: There is no such robot; lists all.
        BadInput: Several files are so called; lists them. Or the package isn't installed.
    """
    known = examples()
    named = [path for key, path in known.items() if name in (key, *key.split("/"))]
    if not named:
        stems = sorted({key.rpartition("/")[2] for key in known})
        stems.sort(key=lambda stem: name.casefold() not in stem.casefold())  # those first
        raise UnknownName("example", name, stems, where=_PACKAGE)
    if len(named) > 1:
        choices = [key for key, path in known.items() if path in named]
        raise BadInput(
            f"{len(named)} robots are called {name!r}",
            where=_PACKAGE,
            allowed=", ".join(f"{PREFIX}{choice}" for choice in choices),
        )
    return named[0]


def examples() -> dict[str, Path]:
    """Every URDF and SDF of example-robot-data by its folder's name, a slash and its stem.

    Raises:
        BadInput: The package isn't installed; says where it was looked for.
    """
    robots = robots_folder()
    files = sorted(path for kind in ("urdf", "sdf") for path in robots.rglob(f"*.{kind}"))
    return {f"{path.relative_to(robots).parts[0]}/{path.stem}": path for path in files}


def robots_folder() -> Path:
    """Folder of the robots of example-robot-data, from wheels, conda, ROS or a system.

    Raises:
        BadInput: It isn't there; says where it was looked for.
    """
    tried = []
    for folder in _folders():
        if folder.is_dir():
            return folder
        tried.append(str(folder))
    raise BadInput(
        f"{_PACKAGE} isn't found; looked for {', '.join(dict.fromkeys(tried))}",
        remedy=f"Install it: pip install {_PACKAGE}",
    )


def _folders() -> Iterator[Path]:
    inside = Path("share", _PACKAGE, "robots")
    try:
        files = metadata.files(_PACKAGE) or []
    except metadata.PackageNotFoundError:
        files = []
    for file in files:
        if "robots" in file.parts:
            yield Path(str(file.locate())).parents[len(file.parts) - 2 - file.parts.index("robots")]
            break
    module = util.find_spec("pinocchio")
    if module is not None and module.origin:
        for above in list(Path(module.origin).parents)[:6]:
            yield above / inside
    for folder in sys.path:
        yield Path(folder, "cmeel.prefix") / inside
    for variable in _ENVIRONMENT:
        for folder in filter(None, os.environ.get(variable, "").split(os.pathsep)):
            yield Path(folder) / inside
            yield Path(folder, _PACKAGE, "robots")
    for folder in (sys.prefix, "/opt/openrobots", "/usr/local", "/usr"):
        yield Path(folder) / inside
