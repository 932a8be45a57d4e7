"""Studies of Pollard-like robots made: what designs change, and what judges them."""

from __future__ import annotations

import hashlib
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import cast

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.motion.files import load_path
from pollard_pin.motion.path import Timing, ToolPath
from pollard_pin.motion.toml import PathFile
from pollard_pin.specification import Specification
from pollard_pin.study.sweeping.design import LIMITS, PATH, PLACE
from pollard_pin.study.sweeping.paths import MEASURES, PathStudy
from pollard_pin.study.sweeping.times import BOUNDS, TimeStudy
from pollard_pin.study.timing.timed import AIMS, Aim
from thesis_pin.errors import BadInput, ModelWarning
from thesis_pin.model.limits import LIMITS as READ
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.source import read_bytes
from thesis_pin.model.specification import read_toml
from thesis_pin.numeric.checks import choice, whole
from thesis_pin.sweep.measures import chosen


def path_study(
    specification: Specification | str | Path | None = None,
    path: str | Path | None = None,
    *,
    samples: int = 2001,
    inertia: Reading = "physical",
    branch: Branch = DEFAULT_BRANCH,
    placement: Sequence[float] | None = None,
    duration: float | None = None,
    timing: Timing | None = None,
    turn_deg: float = 0.0,
    mirrored: bool = False,
    euler: str | None = None,
    feed: float | None = None,
    smooth: str = "auto",
    extra: Sequence[str] = (),
) -> PathStudy:
    """Robots that are judged by the report on a path.

    Args:
        specification: Of the robot that designs change; None for the thesis's.
        path: A file; of one in TOML designs may change keys too, as ``path.speed``. None for the
            curve of appendix B, which ``assumptions.motion`` and ``assumptions.placement`` time
            and place. Where any path is put from there, ``place`` says, which designs may change
            as well: ``place.position.0``, ``place.turn_deg``, ``place.mirrored``.
        samples: See :func:`pollard_pin.trajectory_report`.
        inertia: See :func:`pollard_pin.load`.
        branch: See :func:`pollard_pin.trajectory_report`.
        placement: What is added to the path [m]; None for the specification's, of a file none.
        duration: Of appendix B's curve [s]; None for the specification's.
        timing: Of appendix B's curve, or of a table whose times a speed gives.
        turn_deg: Turn about the vertical through the path's middle [°].
        mirrored: Whether it is the path's mirror image.
        euler: See :func:`pollard_pin.load_path`.
        feed: The same.
        smooth: The same.
        extra: Measures besides the usual ones:
            :data:`pollard_pin.study.sweeping.paths.MEASURES`.

    Raises:
        BadInput: A file can't be read, or something belongs to another kind of path.
        UnknownName: There is no such measure.
    """
    chosen(MEASURES, extra)
    whole("samples", samples, 2)
    base, made, motion = _base_and_path(
        specification,
        path,
        placement=placement,
        duration=duration,
        timing=timing,
        turn_deg=turn_deg,
        mirrored=mirrored,
        euler=euler,
        feed=feed,
        smooth=smooth,
    )
    return PathStudy(base, made, samples, inertia, one_branch(branch), tuple(extra), motion)


def time_study(
    specification: Specification | str | Path | None = None,
    path: str | Path | None = None,
    *,
    law: Aim = "fastest",
    inertia: Reading = "physical",
    branch: Branch = DEFAULT_BRANCH,
    placement: Sequence[float] | None = None,
    duration: float | None = None,
    timing: Timing | None = None,
    turn_deg: float = 0.0,
    mirrored: bool = False,
    euler: str | None = None,
    feed: float | None = None,
    smooth: str = "auto",
) -> TimeStudy:
    """Robots that are judged by the law of motion that their motors allow along a path.

    Designs may change what bounds the law besides the motors' limits, as ``limits.tool_speed``:
    :data:`pollard_pin.study.sweeping.times.BOUNDS`.

    Args:
        specification: See :func:`path_study`, as all others.
        path: The same.
        law: See :func:`pollard_pin.time_path`.
        inertia: The same.
        branch: The same.
        placement: The same.
        duration: The same.
        timing: The same.
        turn_deg: The same.
        mirrored: The same.
        euler: The same.
        feed: The same.
        smooth: The same.

    Raises:
        BadInput: A file can't be read, or something belongs to another kind of path.
        UnknownName: There is no such law.
    """
    choice("law", law, AIMS)
    base, made, motion = _base_and_path(
        specification,
        path,
        placement=placement,
        duration=duration,
        timing=timing,
        turn_deg=turn_deg,
        mirrored=mirrored,
        euler=euler,
        feed=feed,
        smooth=smooth,
    )
    base[LIMITS] = dict(BOUNDS)
    return TimeStudy(base, made, law, inertia, one_branch(branch), motion)


def _base_and_path(
    specification: Specification | str | Path | None,
    path: str | Path | None,
    *,
    placement: Sequence[float] | None,
    duration: float | None,
    timing: Timing | None,
    turn_deg: float,
    mirrored: bool,
    euler: str | None,
    feed: float | None,
    smooth: str,
) -> tuple[dict[str, object], ToolPath | None, str]:
    """What designs change, a path that they don't, and what tells that one from others.

    Raises:
        BadInput: See :func:`path_study`.
    """
    if not isinstance(specification, Specification):
        specification = Specification.read(specification)
    base = specification.model_dump(mode="json")
    place: dict[str, object] = {"position": [0.0] * 3, "turn_deg": turn_deg, "mirrored": mirrored}
    if path is None:
        for name, value in (("euler", euler), ("feed", feed)):
            if value is not None:
                raise BadInput(f"{name} belongs to a path from a table", remedy="Name its file")
        return {**_timed(base, placement, duration, timing), PLACE: place}, None, ""
    if duration is not None:
        raise BadInput(
            "a duration belongs to appendix B's curve", remedy="Write it into the path's file"
        )
    if placement is not None:
        place["position"] = [float(x) for x in placement]
    base[PLACE] = place
    made = load_path(path, euler=euler, feed=feed, timing=timing, smooth=smooth)
    if Path(path).suffix.lower() == ".toml":
        if made.made_for is not None:
            for one in made.made_for.against(specification, f"path {made.name!r}"):
                warnings.warn(one, ModelWarning, stacklevel=2)
        values = read_toml("path", PathFile, path).model_dump(mode="json")
        del values["made_for"]  # designs are other robots
        base[PATH] = values
        return base, None, ""
    content = hashlib.sha256(read_bytes("path", path, READ.csv_bytes)).hexdigest()
    return base, made, f"{content} {euler} {feed} {timing} {smooth}"


def _timed(
    base: dict[str, object],
    placement: Sequence[float] | None,
    duration: float | None,
    timing: Timing | None,
) -> dict[str, object]:
    """A specification's data with another place and time of appendix B's curve."""
    assumed = dict(cast(Mapping[str, Mapping[str, object]], base["assumptions"]))
    if placement is not None:
        assumed["placement"] = {**assumed["placement"], "position": [float(x) for x in placement]}
    for key, value in (("duration", duration), ("timing", timing)):
        if value is not None:
            assumed["motion"] = {**assumed["motion"], key: value}
    return {**base, "assumptions": assumed}
