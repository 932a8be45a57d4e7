"""Names of branches: the way the knee bends, mirror images, and which branch angles lie on."""

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.kinematics.branches import (
    BRANCHES,
    allowed_branches,
    branch_label,
    knee,
    mirrored,
    taken_branches,
)
from scout_pin.specification import SIDES, Specification
from thesis_pin.errors import BadInput, SpecificationError
from thesis_pin.report.branches import label

MIRROR = np.diag([-1.0, 1.0, 1.0])


def knee_ahead(robot, side, angles):
    """How far the knee is before the line from hip to ankle, towards the toes, by Pinocchio [m]."""
    q = robot.configuration(np.eye(4), angles)
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)

    def place(name):
        return data.oMi[robot.model.getJointId(f"{side}_{name}")].translation

    hip, bend, ankle = (place(name) for name in ("hip_pitch", "knee_pitch", "ankle_pitch"))
    toes = data.oMf[robot.sole_frames[side]].rotation[:, 1]
    line = (ankle - hip) / np.linalg.norm(ankle - hip)
    off = bend - hip - (bend - hip) @ line * line
    return off @ toes


def test_forward_is_where_pinocchio_puts_the_knee_before_the_line_from_hip_to_ankle(biped, rng):
    checked = 0
    for _ in range(60):
        angles = rng.uniform(-0.35, 0.35, 12)
        for leg, side in enumerate(SIDES):
            mine = angles[6 * leg : 6 * leg + 6]
            solutions = biped.leg_inverse_kinematics(
                side, biped.leg_forward_kinematics(side, mine), mine
            )
            for number in np.flatnonzero(solutions.reachable):
                if BRANCHES[number][1] < 0:
                    continue  # the thigh begins above the hip there: no leg that stands
                here = angles.copy()
                here[6 * leg : 6 * leg + 6] = solutions.angles[number]
                ahead = knee_ahead(biped, side, here)
                assert (ahead > 0) == (knee(biped.legs[side], number) == "forward")
                checked += 1
    assert checked > 300


def test_the_branch_of_angles_is_the_one_that_gave_them(biped, rng):
    for side in SIDES:
        leg = biped.legs[side]
        poses = biped.leg_forward_kinematics(side, rng.uniform(leg.lower, leg.upper, (200, 6)))
        solutions = biped.leg_inverse_kinematics(side, poses)
        for number in range(8):
            exists = solutions.reachable[:, number]
            assert exists.any()
            assert (taken_branches(leg, solutions.angles[exists, number]) == number).all()


@pytest.fixture(params=["as the thesis counts", "as the left leg counts"])
def symmetric(request):
    """Mirror-symmetric legs whose right angles are counted either way."""
    data = Specification.read().model_dump()
    if request.param.startswith("as the left"):
        data["legs"]["right"]["beta_deg"] = data["legs"]["left"]["beta_deg"]
    return scout_pin.load(Specification.model_validate(data))


def test_mirrored_branches_put_every_joint_in_mirrored_places(symmetric, rng):
    from scout_pin.kinematics.forward import leg_frames

    legs = symmetric.legs["left"], symmetric.legs["right"]
    for _ in range(20):
        pose = symmetric.leg_forward_kinematics("left", rng.uniform(-1.2, 1.2, 6))
        other = np.eye(4)
        other[:3, :3], other[:3, 3] = MIRROR @ pose[:3, :3] @ MIRROR, MIRROR @ pose[:3, 3]
        left = symmetric.leg_inverse_kinematics("left", pose)
        right = symmetric.leg_inverse_kinematics("right", other)
        for number in np.flatnonzero(left.reachable):
            image = mirrored(legs, number)
            assert right.reachable[image]
            points = [
                leg_frames(leg, angles[None]).points[..., 0]
                for leg, angles in zip(
                    legs, (left.angles[number], right.angles[image]), strict=True
                )
            ]
            np.testing.assert_allclose(points[1], points[0] @ MIRROR, atol=1e-9)
            assert knee(legs[1], image) == knee(legs[0], number)


def test_the_thesis_s_two_branches_are_mirror_images(scout):
    legs = scout.legs["left"], scout.legs["right"]
    assert label(BRANCHES[mirrored(legs, BRANCHES.index((1, 1, 1)))]) == "-+-"


def test_words_for_branches_name_the_knee_the_signs_or_one_for_each_leg(scout):
    legs = scout.legs["left"], scout.legs["right"]
    every = tuple(range(8))
    assert allowed_branches(legs, None) == (every, every)
    forward = allowed_branches(legs, "forward")
    for leg, some in zip(legs, forward, strict=True):
        assert len(some) == 4
        assert {knee(leg, k) for k in some} == {"forward"}
    assert allowed_branches(legs, "forward,backward")[0] == forward[0]
    assert allowed_branches(legs, ("+++", "backward"))[0] == (0,)
    assert branch_label("forward,forward") == "forward"
    assert branch_label("forward,backward") == "forward,backward"
    assert branch_label("+++") == "+++,+++"
    assert branch_label(None) is None
    for bad in ("straight", "forward,", "+++,-+-,+++", "", ["forward", 1]):
        with pytest.raises(BadInput, match="forward, backward"):
            allowed_branches(legs, bad)


def test_a_knee_without_forward_is_refused_by_that_word_only():
    data = Specification.read().model_dump()
    data["legs"]["left"]["beta_7_deg"] = 0.0  # joint 6 turns about the sole's x
    robot = scout_pin.load(Specification.model_validate(data))
    robot.allowed_branches("+++")
    with pytest.raises(BadInput, match="left knee has no way 'forward'"):
        robot.allowed_branches("forward")


@pytest.mark.parametrize(
    ("keys", "key", "says"),
    [
        ({"knee": "sideways"}, "knee", "forward"),
        ({"branch": "++"}, "branch", "three signs"),
        ({"knee": "forward", "branch": "+++,-+-"}, "branch", "says what knee says"),
    ],
)
def test_wrong_branch_keys_of_a_specification_are_named(keys, key, says):
    from thesis_pin.model.specification import validate

    with pytest.raises(SpecificationError) as caught:
        validate("specification", Specification, Specification.read().model_dump() | keys)
    assert [problem.key for problem in caught.value.problems] == [key]
    assert says in caught.value.problems[0].what
