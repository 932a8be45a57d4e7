"""The drawing of a leg: of this leg, whole, and the same as what is checked in."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import scout_pin
from scout_pin.report.drawn.drawing import leg_drawing
from scout_pin.specification import NEW_PATH, SIDES, Specification
from thesis_pin.errors import UnknownName

from ...conftest import random_specification

ROOT = Path(__file__).parents[4]
NAMES = ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6", *(f"β_{k}" for k in range(1, 9)))
SVG = "{http://www.w3.org/2000/svg}"


def texts(drawing):
    return [one.text for one in ElementTree.fromstring(drawing).iter(f"{SVG}text")]


@pytest.mark.parametrize("path", [None, NEW_PATH, ROOT / "examples/lopsided.toml"])
@pytest.mark.parametrize("side", SIDES)
def test_every_length_and_angle_stands_in_it_once_with_its_value(path, side):
    robot = scout_pin.load(path)
    leg = robot.specification.leg(side)
    found = texts(leg_drawing(robot, side))
    angles = (*leg.beta_deg, leg.beta_7_deg, leg.beta_8_deg)
    for k, name in enumerate(NAMES):
        value = getattr(leg, name) * 1e3 if k < 7 else angles[k - 7]
        said = [one for one in found if one.startswith(f"{name} = ")]
        assert len(said) == 1
        number = float(re.findall(r"= (-?[\d.]+)", said[0])[0])
        assert number == pytest.approx(value, rel=1e-3)


def test_its_points_are_pinocchios_joint_centres(scout):
    """The skeleton seen from the right: y and z of the joints, one scale for both."""
    import pinocchio as pin

    lines = ElementTree.fromstring(leg_drawing(scout, "left")).iter(f"{SVG}polyline")
    bones = [line for line in lines if line.get("stroke-width") == "3.0"]
    drawn = np.array(
        [[float(x) for x in pair.split(",")] for pair in bones[1].get("points").split()]
    )
    data = scout.model.createData()
    q = scout.configuration(np.eye(4), np.zeros(12))
    pin.framesForwardKinematics(scout.model, data, q)
    numbers = [scout.model.getJointId(name) for name in scout.legs["left"].names]
    places = [np.zeros(3), *(data.oMi[k].translation for k in numbers)]
    places.append(data.oMf[scout.sole_frames["left"]].translation)
    real = np.array(places)[:, 1:] * (1.0, -1.0)
    scale = np.ptp(drawn[:, 1]) / np.ptp(real[:, 1])
    gap = (drawn - drawn[0]) - scale * (real - real[0])
    assert np.abs(gap).max() < 0.15  # pixels


def test_labels_don_t_lie_on_each_other(rng):
    for _ in range(5):
        robot = scout_pin.load(random_specification(rng))
        for side in SIDES:
            boxes = []
            for one in ElementTree.fromstring(leg_drawing(robot, side)).iter(f"{SVG}text"):
                if "=" not in one.text:
                    continue
                x, y, half = float(one.get("x")), float(one.get("y")), 3.4 * len(one.text)
                boxes.append((x - half, y - 8, x + half, y + 8))
            for k, a in enumerate(boxes):
                for b in boxes[:k]:
                    assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


def test_names_that_would_end_a_text_are_escaped():
    spec = Specification.read().model_copy(update={"name": "<script>&"})
    drawing = leg_drawing(scout_pin.load(Specification.read()), "left")
    assert "<script" not in drawing
    robot = scout_pin.load()
    robot.specification = spec
    assert any("<script>&" in text for text in texts(leg_drawing(robot, "left")))
    with pytest.raises(UnknownName, match="middle"):
        leg_drawing(robot, "middle")


@pytest.mark.bytes
@pytest.mark.parametrize("side", ["left"])
def test_the_picture_in_the_documentation_is_this_drawing(scout, side):
    """Renew it by python docs/leg_drawing.py."""
    path = ROOT / "docs" / "images" / f"scout_{side}_leg.svg"
    assert path.read_text(encoding="utf-8") == leg_drawing(scout, side)
