"""Documents, tables and pages say what the replay did."""

import json
from dataclasses import replace

import numpy as np
import pytest

from pollard_pin.study.simulate.curves import plots
from pollard_pin.study.simulate.draws import simulate_path
from pollard_pin.study.simulate.page import simulation_page, simulation_scene
from pollard_pin.study.simulate.tables import summary
from pollard_pin.study.simulate.verdict import criteria
from thesis_pin.report.tables import Table
from thesis_pin.report.writers import json_bytes
from thesis_pin.simulation.tallies import kept

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install 'thesis-pin[simulate]'")


@pytest.fixture(scope="module")
def done(short_report, held):
    return simulate_path(short_report, held(time_step=1e-3))


@pytest.fixture(scope="module")
def lost(open_loop):
    return open_loop("mujoco")


def test_json_has_the_samples_and_the_answer(done):
    document = json.loads(json_bytes(done.document()))
    assert document["schema"] == "pollard-pin/simulation"
    assert document["summary"]["passed"] is True
    assert document["summary"]["reason"] is None
    count = len(document["time"])
    for name in ("theta", "planned_theta", "torque", "deviation", "turn", "opening", "work"):
        assert len(document[name]) == count
    np.testing.assert_allclose(document["deviation"], done.replay.deviation)
    assert [one["name"] for one in document["summary"]["criteria"]] == [
        *("deviation", "turn", "opening", "energy", "saturation"),
    ]
    assert document["parameters"]["engine"].startswith("MuJoCo ")
    assert document["draws"][0]["why"] is None


def test_deviation_is_between_pinocchios_frames(done):
    """Of the simulated and the planned angles, by Pinocchio's own forward kinematics."""
    from thesis_pin.pages.drawing import frame_placements

    model = done.report.robot.model
    tip, ought = (
        frame_placements(model, "tool_tip", q)[:, :3] for q in (done.replay.q, done.replay.planned)
    )
    np.testing.assert_allclose(
        done.replay.deviation, np.linalg.norm(tip - ought, axis=1), atol=1e-15
    )
    assert done.replay.peak_deviation[0] >= done.replay.deviation.max() > 0


def test_turn_is_the_angle_between_the_tools(done, lost):
    from scipy.spatial.transform import Rotation

    for one in (done, lost):
        robot = one.report.robot
        here, there = (
            Rotation.from_matrix(robot.posture(q).tool_rotation)
            for q in (one.replay.q, one.replay.planned)
        )
        np.testing.assert_allclose(one.replay.turn, (here.inv() * there).magnitude(), atol=1e-8)


def test_columns_are_of_one_length_and_finite(done):
    columns = done.columns()
    assert {len(column) for column in columns.values()} == {len(done.replay.time)}
    assert all(np.isfinite(column).all() for column in columns.values())


def test_a_lost_replay_ends_its_samples_where_it_is_lost(lost):
    assert lost.replay.time[-1] == pytest.approx(lost.replay.ended[0])
    assert lost.replay.deviation[-1] > 0.05
    assert (lost.replay.deviation[:-1] < 0.05).all()
    assert lost.summary()["reason"].startswith("The reason: ")
    assert lost.document()["draws"][0]["left_path"] == lost.replay.left


def test_the_page_shows_the_robot_its_plan_as_a_ghost_and_the_verdict(lost):
    scene = simulation_scene(lost)
    ghosts = [item for item in scene.items if item.group == "ghost"]
    robots = [item for item in scene.items if item.group == "robot"]
    assert len(ghosts) == len(robots) > 5
    apart = [
        np.abs(ghost.placement - robot.placement).max()
        for ghost, robot in zip(ghosts, robots, strict=True)
    ]
    assert max(apart) > 0.03
    page = simulation_page(lost).decode()
    assert len(page) < 3e6
    assert "FAIL: the simulated robot" in page
    assert {plot.title for plot in plots(lost)} >= {"Deviation of the spray tip"}


def test_the_terminal_is_told_what_was_chosen(done, lost):
    said = [part for part in summary(done) if isinstance(part, str)]
    assert any(one.startswith("Damping wasn't given: it is critical") for one in said)
    assert any("springs" in one for one in said)
    table = next(part for part in summary(lost) if isinstance(part, Table))
    assert "open loop" in table.title
    assert len(table.rows) == 6


def test_a_replay_that_ends_early_fails_however_near_its_path_it_was(done):
    early = replace(done.draws[0], ended=(0.3, "the engine gives up"))
    assert kept(criteria(done.draws[0]))
    (lost,) = [one for one in criteria(early) if not one.met]
    assert lost.name == "deviation"
    assert lost.words == "The spray tip doesn't get to the end of its path."
