"""What ``info`` says of both robots: one schema, and numbers that are the models'."""

import json

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
import scout_pin
from pollard_pin.report.info import document as pollard_info
from scout_pin.report.info import document as scout_info
from thesis_pin.report.writers import json_bytes


@pytest.fixture(scope="module")
def both():
    robots = scout_pin.load(), pollard_pin.load()
    return [
        (robot, json.loads(json_bytes(describe(robot))))
        for robot, describe in zip(robots, (scout_info, pollard_info), strict=True)
    ]


def test_both_documents_have_the_same_keys_in_the_same_order(both):
    one, other = (document for _, document in both)
    assert list(one) == list(other)
    assert one["version"] == other["version"] == 2
    for key in ("joints", "bodies"):
        keys = {tuple(entry) for document in (one, other) for entry in document[key]}
        assert len(keys) == 1
    assert list(one["freedom"]) == list(other["freedom"])
    for document in (one, other):
        assert all({"name", "why"} < set(entry) for entry in document["assumptions"])


def test_masses_limits_and_freedom_are_those_of_pinocchios_model(both):
    for robot, document in both:
        data = robot.model.createData()
        masses = sum(body["mass"] for body in document["bodies"])
        assert masses == pytest.approx(document["mass"], abs=1e-12)
        # Pollard's base isn't counted in the robot's mass.
        assert masses == pytest.approx(
            sum(inertia.mass for inertia in list(robot.model.inertias)[1:]), abs=1e-12
        )
        for joint in document["joints"]:
            index = robot.model.joints[robot.model.getJointId(joint["name"])]
            assert robot.model.lowerPositionLimit[index.idx_q] == pytest.approx(joint["lower"])
            assert robot.model.upperPositionLimit[index.idx_q] == pytest.approx(joint["upper"])
            # J of a revolute joint in its own frame: zeros, then its axis.
            own = pin.computeJointJacobian(robot.model, data, robot.q0, index.id)[:, index.idx_v]
            assert own.round(12)[3:].tolist() == np.eye(3)["xyz".index(joint["axis"])].tolist()
    scout, pollard = (document for _, document in both)
    assert scout["freedom"]["by_rank"] == 18
    assert pollard["freedom"]["by_rank"] == pollard["freedom"]["counted"] == 6
    assert sum(joint["motor"] for joint in pollard["joints"]) == 6


def test_moments_are_physical_and_belong_to_the_inertia(both):
    for _, document in both:
        for body in document["bodies"]:
            smallest, middle, largest = body["principal_moments"]
            assert 0 < smallest <= middle <= largest <= (smallest + middle) * (1 + 1e-9)
            assert np.trace(body["inertia"]) == pytest.approx(smallest + middle + largest)
            assert body["radius_of_gyration"] ** 2 * body["mass"] == pytest.approx(largest)
