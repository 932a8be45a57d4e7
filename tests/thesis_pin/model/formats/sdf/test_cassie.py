"""The five SDFs of Cassie that example-robot-data brings: read, cut, placed."""

import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin
import pytest
from example_robots import SHARE
from scipy.spatial.transform import Rotation

from thesis_pin.loops.loading import load

FILES = sorted(SHARE.glob("example-robot-data/robots/cassie_description/robots/*.sdf"))
CUTS = {"left-pitch-rod-joint", "left-plantar-foot-joint"}
CUTS |= {name.replace("left", "right") for name in CUTS}


def test_there_are_five():
    assert len(FILES) == 5


@pytest.fixture(scope="module", params=FILES, ids=lambda path: path.stem)
def robot(request):
    return request.param, load(request.param)


def test_every_cut_is_named_with_its_joint_and_line(robot):
    path, found = robot
    names = {loop.name for loop in found.loops}
    assert names >= CUTS
    assert names <= CUTS | {"left-shin-spring-joint", "right-shin-spring-joint"}
    lines = path.read_text().splitlines()
    for name in names:
        (said,) = (one for one in found.description.warnings if f"{name!r}: the loop is cut" in one)
        line = int(said.split(":")[1])
        assert f'<joint name="{name}"' in lines[line - 1]


def test_links_stand_where_the_file_says_and_the_loops_are_closed(robot):
    path, found = robot
    q = pin.neutral(found.model)
    if found.supplement.free_root:
        q[:7] = found.supplement.poses["initial"]["root_joint"]
    pin.framesForwardKinematics(found.model, found.data, q)
    for link in ET.parse(path).iter("link"):
        x, y, z, *angles = map(float, link.findtext("pose", "0 0 0 0 0 0").split())
        place = found.data.oMf[found.model.getFrameId(link.get("name"), pin.BODY)]
        np.testing.assert_allclose(place.translation, [x, y, z], atol=1e-14)
        turn = Rotation.from_euler("xyz", angles).as_matrix()
        np.testing.assert_allclose(place.rotation, turn, atol=1e-14)
    for loop in found.loops:
        one, two = (found.data.oMf[k].translation for k in loop.ids)
        np.testing.assert_allclose(one, two, atol=1e-14)


def test_its_springs_and_gears_are_read(robot):
    path, found = robot
    rates = [float(one.text) for one in ET.parse(path).iter("spring_stiffness")]
    assert sorted(spring.stiffness for spring in found.supplement.springs) == sorted(rates)
    gears = [joint for joint in ET.parse(path).iter("joint") if joint.get("type") == "gearbox"]
    assert len(found.supplement.couplings) == len(gears)
