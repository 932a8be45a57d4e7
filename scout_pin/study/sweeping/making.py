"""Studies of bipeds made: what designs change, and what judges them."""

from __future__ import annotations

import hashlib
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from scout_pin.kinematics.branches import branch_words
from scout_pin.motion.files import GAITS, PRESETS, GaitFile, gait_of, load_gait
from scout_pin.motion.gait import Gait
from scout_pin.specification import Specification
from scout_pin.study.plan.planning import LEAST_SAMPLES
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.sweeping.design import GAIT, PLAN
from scout_pin.study.sweeping.gaits import MEASURES, GaitStudy
from scout_pin.study.sweeping.plans import PlanStudy, request_of
from thesis_pin.errors import BadInput, ModelWarning, UnknownName
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.shipped import read_shipped
from thesis_pin.model.source import read_bytes
from thesis_pin.model.specification import read_toml
from thesis_pin.numeric.checks import whole
from thesis_pin.smoothing.stated import stated
from thesis_pin.sweep.measures import chosen


def gait_study(
    specification: Specification | str | Path | None = None,
    gait: str | Path = "thesis",
    *,
    samples: int = 401,
    inertia: Reading = "physical",
    branch: str | None = None,
    interpolation: str | None = None,
    smooth: str = "auto",
    time_unit: float | None = None,
    cycle: bool = False,
    repeat: int = 1,
    extra: Sequence[str] = (),
) -> GaitStudy:
    """Bipeds that are judged by the report on a gait.

    Args:
        specification: Of the biped that designs change; None for the thesis's.
        gait: A preset or a file; of one in TOML designs may change keys too, as
            ``gait.time_unit``.
        samples: See :func:`scout_pin.gait_report`.
        inertia: See :func:`scout_pin.load`.
        branch: See :func:`scout_pin.gait_report`.
        interpolation: See :func:`scout_pin.load_gait`.
        smooth: The same.
        time_unit: Seconds in the gait's unit of t; None for its own.
        cycle: Whether its end is its start.
        repeat: How often it is walked.
        extra: Measures besides the usual ones:
            :data:`scout_pin.study.sweeping.gaits.MEASURES`.

    Raises:
        BadInput: A file can't be read, ``smooth`` is no resolution, or the gait is of joint
            angles, which belong to one robot.
        UnknownName: There is no such measure.
    """
    chosen(MEASURES, extra)
    branch_words(branch)
    whole("samples", samples, 2)
    whole("repeat", repeat, 1)
    how = stated(smooth)  # also of a gait in TOML, which has no samples
    base = _data(specification)
    file = _gait_file(gait)
    if file is not None:
        if file.made_for is not None:
            robot = specification
            if not isinstance(robot, Specification):
                robot = Specification.read(robot)
            for one in file.made_for.against(robot, f"gait {file.name!r}"):
                warnings.warn(one, ModelWarning, stacklevel=2)
            file = file.model_copy(update={"made_for": None})  # designs are other robots
        values = file.model_dump(mode="json") | {"cycle": file.cycle or cycle}
        del values["made_for"]
        if time_unit is not None:
            values["time_unit"] = float(time_unit)
        base = {**base, GAIT: values}
        made = gait_of(file, interpolation)
        made = replace(made, cycle=made.cycle or cycle, time_unit=time_unit or made.time_unit)
        motion = ""
    else:
        made = _sampled(gait, interpolation, smooth, time_unit)
        made = replace(made, cycle=made.cycle or cycle)
        content = read_bytes("gait", gait, LIMITS.csv_bytes)
        motion = f"{how} {hashlib.sha256(content).hexdigest()}"
    return GaitStudy(
        base, made, samples, inertia, branch, repeat, interpolation, tuple(extra), motion
    )


def plan_study(
    specification: Specification | str | Path | None = None,
    request: PlanRequest | Mapping[str, object] | None = None,
    *,
    steps: int = 10,
    samples: int = 801,
    inertia: Reading = "physical",
) -> PlanStudy:
    """Bipeds that are judged by the walk that is planned for each.

    Args:
        specification: Of the biped that designs change; None for the thesis's.
        request: What is asked for, or some of its fields in SI; None for the default. Designs may
            change its fields, as ``plan.step_length``.
        steps: Steps of the walk.
        samples: See :func:`scout_pin.plan_gait`.
        inertia: See :func:`scout_pin.load`.

    Raises:
        BadInput: A file can't be read, or no such walk can be asked for.
        UnknownName: A request has no such field.
    """
    whole("steps", steps, 1)
    whole("samples", samples, LEAST_SAMPLES)
    if not isinstance(request, PlanRequest):
        asked = dict(request or {})
        known = tuple(PlanRequest().document())
        for name in asked:
            if name not in known:
                raise UnknownName("field of a plan's request", name, known)
        request = request_of(asked)
    values = request.document()
    if request.line_reserve == PlanRequest(objective=request.objective).line_reserve:
        values["line_reserve"] = None  # what suits the objective, which may vary
    return PlanStudy({**_data(specification), PLAN: values}, steps, samples, inertia)


def _data(specification: Specification | str | Path | None) -> dict[str, object]:
    if not isinstance(specification, Specification):
        specification = Specification.read(specification)
    return specification.model_dump(mode="json")


def _gait_file(gait: str | Path) -> GaitFile | None:
    """A gait in TOML; None for a table of samples."""
    if str(gait) in PRESETS:
        return read_shipped("gait", GaitFile, GAITS / f"{gait}.toml")
    if isinstance(gait, str | Path) and Path(gait).suffix.lower() == ".toml":
        return read_toml("gait", GaitFile, gait)
    return None


def _sampled(
    gait: str | Path, interpolation: str | None, smooth: str, time_unit: float | None
) -> Gait:
    """A gait of samples, the same for every design.

    Raises:
        BadInput: Its joints' angles are given, which another robot's feet don't follow.
    """
    try:
        return load_gait(gait, interpolation, smooth=smooth, time_unit=time_unit)
    except BadInput as error:
        if "needs the robot" not in error.what:
            raise
        raise BadInput(
            "a table of joint angles belongs to one robot, and a sweep has many",
            where=str(gait),
            remedy="Write the poses of its bodies first: scout-pin convert --as poses",
        ) from None
