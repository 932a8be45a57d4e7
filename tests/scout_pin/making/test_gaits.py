"""First gaits: made from neutral soles, followed, and judged like any other."""

from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.making.gaits import gait_text
from scout_pin.specification import NEW_PATH, SIDES, Specification
from thesis_pin.errors import BadInput, UnknownName

EXAMPLES = Path(__file__).parents[3] / "examples"


def straight():
    """Legs straight in the neutral pose, where there are no joint rates."""
    data = Specification.read().model_dump() | {"name": "straight", "knee": "forward"}
    data["legs"]["left"]["beta_deg"] = (180.0, 90.0, 0.0, 0.0, 75.0, 180.0)
    data["legs"]["right"]["beta_deg"] = (0.0, 90.0, 0.0, 0.0, 285.0, 0.0)
    return Specification.model_validate(data)


ROBOTS = {
    "thesis": None,
    "new": NEW_PATH,
    "lopsided": EXAMPLES / "lopsided.toml",
    "straight": straight(),
}


@pytest.mark.parametrize("kind", ["squat", "sway"])
@pytest.mark.parametrize("name", ROBOTS)
def test_a_first_gait_is_followed_stands_and_moves_as_it_says(kind, name, tmp_path):
    robot = scout_pin.load(ROBOTS[name])
    path = tmp_path / "first.toml"
    path.write_text(gait_text(robot, kind))
    gait = scout_pin.load_gait(path)
    report = scout_pin.gait_report(robot, gait, samples=81)
    assert report.can_walk
    assert report.motion.support.all()
    torso = report.motion.torso.position
    span = np.ptp(torso, axis=0)
    moved = span[2] if kind == "squat" else span[0]
    assert moved > 5e-3
    assert np.sort(span)[1] < 1e-9  # nothing else moves
    # Quasi-static: the zero-moment point is where the centre of mass is.
    assert np.abs(report.zmp - report.com[:, :2]).max() < 3e-3
    for side, foot in zip(SIDES, (report.motion.left_foot, report.motion.right_foot), strict=True):
        np.testing.assert_allclose(
            foot.position[:, :2],
            np.tile(robot.neutral_feet()[side][:2, 3], (len(torso), 1)),
            atol=1e-6,
        )


def test_robots_that_can_t_follow_one_are_told_why():
    data = Specification.read().model_dump()
    data["assumptions"]["joint_range"] |= {"lower_deg": -4.0, "upper_deg": 4.0}
    robot = scout_pin.load(Specification.model_validate(data))
    with pytest.raises(BadInput, match="no squat from the neutral pose is within"):
        gait_text(robot, "squat")
    tilted = Specification.read().model_dump()
    tilted["legs"]["left"]["beta_deg"] = (180.0, 90.0, 330.0, 60.0, 55.0, 180.0)
    with pytest.raises(BadInput, match="β_5 = 45° instead of 55°"):
        gait_text(scout_pin.load(Specification.model_validate(tilted)), "sway")
    with pytest.raises(UnknownName, match="run"):
        gait_text(robot, "run")
