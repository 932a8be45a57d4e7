"""Workspace: agrees with inverse kinematics point by point, whatever the threads."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.study.workspace import evaluate_workspace
from thesis_pin.errors import BadInput

X, Y, Z = np.linspace(0.1, 0.8, 23), np.linspace(-0.3, 0.3, 7), np.linspace(-0.5, 0.5, 19)


def test_every_position_agrees_with_inverse_kinematics_and_actuation(robot):
    space = evaluate_workspace(robot, X, Y, Z, orientation=[0.1, 0.2, -0.1])
    pose = np.concatenate([space.points, np.broadcast_to([0.1, 0.2, -0.1], space.points.shape)], -1)
    found = robot.inverse_kinematics(pose)
    np.testing.assert_array_equal(space.reachable, found.valid)
    some = space.reachable & np.isfinite(space.condition)
    holding = robot.actuation(found.angles[some])
    np.testing.assert_allclose(space.condition[some], holding.condition, rtol=1e-9)
    np.testing.assert_allclose(space.determinant[some], holding.base_determinant, rtol=1e-9)


def test_what_a_joint_limit_forbids_is_out_of_reach():
    data = pollard_pin.Specification.read().model_dump()
    data["assumptions"]["joint_limits"]["lower_deg"] = -140
    data["assumptions"]["joint_limits"]["upper_deg"] = 140
    tight = pollard_pin.load(pollard_pin.Specification.model_validate(data))
    space = evaluate_workspace(tight, X, 0.0, Z)
    pose = np.concatenate([space.points, np.zeros_like(space.points)], -1)
    found = tight.inverse_kinematics(pose)
    assert (found.reachable & ~found.valid).any()
    np.testing.assert_array_equal(space.reachable, found.valid)
    assert np.isnan(space.condition[~found.valid]).all()


def test_threads_and_progress_do_not_change_the_result(pollard):
    seen = []
    one = evaluate_workspace(pollard, X, Y, Z, jobs=1)
    many = evaluate_workspace(
        pollard, X, Y, Z, jobs=3, progress=lambda done, total: seen.append((done, total))
    )
    np.testing.assert_array_equal(one.condition, many.condition)
    assert seen[-1] == (X.size * Y.size * Z.size,) * 2


def test_most_of_the_space_in_front_has_the_default_paths_sign(printed):
    fine = np.linspace(-0.45, 0.65, 45)
    space = evaluate_workspace(printed, np.linspace(0.15, 0.9, 40), fine, fine)
    known = np.isfinite(space.determinant)
    assert (space.determinant[known] < 0).mean() == pytest.approx(0.895, abs=0.015)


def test_a_slice_is_one_value_on_an_axis(pollard):
    space = evaluate_workspace(pollard, X, 0.0, Z)
    assert space.margin.shape == (23, 1, 19)
    document = space.document()
    assert len(document["position"]) == len(document["condition"]) == len(document["margin"])
    assert np.isfinite(document["condition"]).all()
    columns = space.columns()
    assert len(columns["x_m"]) == 23 * 19


def test_a_slice_is_drawn_without_a_display(pollard):
    from pollard_pin.study.figures import workspace_figure

    figure = workspace_figure(evaluate_workspace(pollard, X, 0.0, Z))
    assert "y = 0 m" in figure.axes[0].get_title()


def test_a_line_of_positions_is_drawn_as_condition_over_its_coordinate(pollard):
    from pollard_pin.study.figures import workspace_figure

    x = np.linspace(0.0, 1.0, 41)
    space = evaluate_workspace(pollard, x, 0.0, 0.0)
    (ax,) = workspace_figure(space).axes
    drawn = {line.get_label(): line.get_xydata() for line in ax.lines}
    np.testing.assert_array_equal(drawn["condition number"][:, 0], x)
    np.testing.assert_array_equal(drawn["condition number"][:, 1], space.condition.ravel())
    np.testing.assert_array_equal(drawn["out of reach"][:, 0], x[~space.reachable.ravel()])
    sign = np.sign(space.determinant.ravel())
    (change,) = np.flatnonzero(sign[1:] * sign[:-1] < 0)
    assert x[change] < drawn["motors lose the tool"][0, 0] < x[change + 1]
    assert (ax.get_xlabel(), ax.get_title()) == ("x [m]", "y = 0 m, z = 0 m")


@pytest.mark.parametrize("axes", [(0.45, 0.0, 0.0), ([2.0, 2.5, 3.0], 0.0, 0.0)])
def test_a_single_position_and_a_line_out_of_reach_are_drawn(pollard, axes):
    from pollard_pin.study.figures import workspace_figure

    (ax,) = workspace_figure(evaluate_workspace(pollard, *axes)).axes
    (line,) = ax.lines
    assert np.isfinite(line.get_ydata()).all()


@pytest.mark.parametrize("axes", [([], 0, 0), (np.zeros(3000), np.zeros(3000), np.zeros(3000))])
def test_an_empty_or_endless_grid_is_refused(pollard, axes):
    with pytest.raises(BadInput, match="positions"):
        evaluate_workspace(pollard, *axes)


def test_any_robots_workspace_of_pollard_is_its_own(pollard):
    """By Newton steps from cell to cell, and by the closed form."""
    import thesis_pin
    from pollard_pin.closure import CLOSURE_PATH
    from thesis_pin.loops.workspace.mapped import evaluate_workspace as anyones

    x, z = np.linspace(0.3, 0.75, 10), np.linspace(-0.35, 0.2, 12)
    own = evaluate_workspace(pollard, x, 0.05, z, orientation=[0.1, 0.2, -0.1])
    loaded = thesis_pin.load(pollard_pin.URDF_PATH, CLOSURE_PATH)
    pose = pollard.inverse_kinematics([0.45, 0.05, 0.05, 0.1, 0.2, -0.1], own.branch).angles
    from pollard_pin.coordinates import pose_rotation

    turn = pose_rotation(np.array([0, 0, 0, 0.1, 0.2, -0.1]))
    import pinocchio as pin

    at = {"y": 0.05} | dict(zip(("roll", "pitch", "yaw"), pin.rpy.matrixToRpy(turn), strict=True))
    found = anyones(loaded, {"x": x, "z": z}, at=at, frame="tool_tip", pose=pose)
    regular = own.reachable[:, 0] & np.isfinite(own.condition[:, 0])
    np.testing.assert_array_equal(found.reachable, regular)
    some = found.reachable
    np.testing.assert_allclose(found.condition[some], own.condition[:, 0][some], rtol=1e-9)
    signs = np.sign(found.determinant[some]) * np.sign(own.determinant[:, 0][some])
    assert len({*signs}) == 1
    angles = pollard.inverse_kinematics(
        np.concatenate([own.points[:, 0], np.broadcast_to([0.1, 0.2, -0.1], (10, 12, 3))], -1),
        own.branch,
    ).angles
    apart = (found.q - angles)[some]
    np.testing.assert_allclose(np.sin(apart / 2), 0, atol=1e-9)


def test_a_pose_that_is_singular_spoils_no_condition_number(pollard):
    """Without a pose the map starts at the neutral one, where the wrist is singular."""
    import thesis_pin
    from pollard_pin.closure import CLOSURE_PATH
    from thesis_pin.loops.workspace.mapped import evaluate_workspace as anyones

    loaded = thesis_pin.load(pollard_pin.URDF_PATH, CLOSURE_PATH)
    along = {"x": np.linspace(0.3, 0.75, 8), "z": np.linspace(-0.35, 0.2, 7)}
    at = dict.fromkeys(("y", "roll", "pitch", "yaw"), 0.0)
    found = anyones(loaded, along, at=at, frame="tool_tip")
    some = found.reachable
    assert some.mean() > 0.8
    holding = pollard.actuation(found.q[some])
    np.testing.assert_allclose(found.condition[some], holding.condition, rtol=1e-8)
    np.testing.assert_allclose(found.determinant[some], holding.determinant, rtol=1e-8)
