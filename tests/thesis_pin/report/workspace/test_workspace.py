"""A workspace's document, columns, sentences, picture and page."""

import json
from dataclasses import replace
from itertools import pairwise

import mechanisms
import numpy as np
import pytest

from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.workspace.mapped import WORDS, evaluate_workspace
from thesis_pin.pages.drawing import frame_placements
from thesis_pin.pages.reports.workspace import scene, workspace_page
from thesis_pin.pages.scene import Arrow, Trace
from thesis_pin.report.figures import figure_files
from thesis_pin.report.plotting.wanted import Wanted, written_as
from thesis_pin.report.workspace.document import columns, document, sentences, summary, told
from thesis_pin.report.workspace.figures import workspace_figure, workspace_files
from thesis_pin.report.writers import csv_bytes, json_bytes


@pytest.fixture(scope="module")
def space():
    robot, guess = mechanisms.built("five_bar")
    pose = close(robot, np.array(guess, float))
    along = {"x": np.linspace(-0.5, 0.7, 13), "z": np.linspace(0.11, 0.61, 11)}
    return evaluate_workspace(robot, along, frame="left_tip", pose=pose)


def test_the_document_has_every_cell_and_reads_back(space):
    found = json.loads(json_bytes(document(space)))
    assert (found["schema"], found["version"]) == ("thesis-pin/workspace", 1)
    assert [axis["name"] for axis in found["axes"]] == ["x", "z"]
    state, condition = np.array(found["state"]), found["condition"]
    np.testing.assert_array_equal(state, space.state)
    assert all(
        (condition[i][j] is None) == (found["states"][state[i, j]] != "reachable")
        for i, j in np.ndindex(13, 11)
    )
    cells = found["summary"]["states"]
    assert sum(cells.values()) == found["summary"]["cells"] == 143
    assert cells["reachable"] == found["summary"]["reachable"] == space.reachable.sum()
    assert found["parameters"]["frame"] == "left_tip"


def test_a_row_a_cell_says_where_and_why_not(space):
    lines = csv_bytes(columns(space)).decode().splitlines()
    header = lines[0].split(",")
    assert header[:4] == ["x_m", "z_m", "state", "limit"]
    assert header[-2:] == ["left_joint_rad", "right_joint_rad"]
    assert len(lines) == 144
    for line, state in zip(lines[1:], space.state.ravel(), strict=True):
        cells = dict(zip(header, line.split(","), strict=True))
        assert cells["state"] == WORDS[state].replace(" ", "-")
        assert (cells["condition"] == "") == (cells["state"] != "reachable")


def test_sentences_say_share_and_measure(space):
    said = " ".join(sentences(space))
    assert f"{space.reachable.sum()} of 143 cells are reachable" in said
    assert "of the motors against x z of frame left_tip" in said
    assert "m count as 1 rad" not in said  # shifts alone need no length
    assert summary(space)["limits"] == {}
    assert any(not isinstance(part, str) for part in told(space))


def test_planes_lines_and_volumes_are_drawn(space):
    assert set(workspace_files(space)) == {"workspace.png", "workspace.svg"}
    robot, pose = space.robot, space.q[space.reachable][0]
    line = evaluate_workspace(robot, {"left_joint": np.linspace(1.8, 2.4, 5)}, pose=pose)
    (ax,) = workspace_figure(line).axes
    assert ax.get_legend() is None
    assert "condition number of the motors" in ax.get_title()
    assert "by colour" not in workspace_page(line).decode()
    wide = replace(line, condition=np.geomspace(2, 300, 5).reshape(line.condition.shape))
    figure = workspace_figure(wide)
    figure.draw_without_rendering()
    labels = [one for one in figure.axes[0].get_yticklabels(which="both") if one.get_text()]
    ticks = sorted((one.get_window_extent() for one in labels), key=lambda one: one.y0)
    assert not any(a.overlaps(b) for a, b in pairwise(ticks))
    two = mechanisms.built("delta")
    cube = {name: np.linspace(low, low + 0.1, 3) for name, low in (("x", 0), ("y", -0.05))}
    cube["z"] = np.linspace(-0.4, -0.3, 3)
    volume = evaluate_workspace(two[0], cube, frame="tool", pose=close(*two))
    figure = workspace_figure(volume)
    *planes, bar = figure.axes
    assert len(planes) == 3
    # In the size of a column no title covers a neighbour or the colours' bar.
    with written_as(Wanted(("png",), 100, (80 / 25.4, 60 / 25.4))):
        figure_files("small", figure)
    for plane in planes:
        title = plane.title.get_window_extent()
        for other in {*planes, bar} - {plane}:
            assert not title.overlaps(other.get_window_extent())
            assert not title.overlaps(other.title.get_window_extent())


def test_the_animation_goes_through_reachable_cells_only_with_the_loops_closed(space):
    found = scene(space)
    assert len(found.time) == space.reachable.sum()
    trace = next(item for item in found.items if isinstance(item, Trace))
    cells = np.array(sorted(map(tuple, trace.points[:, [0, 2]].round(9))))
    want = space.grid.points[space.reachable.ravel()].round(9)
    np.testing.assert_allclose(cells, want, atol=1e-8)
    (gap,) = (item.vector for item in found.items if item.name == "loop 0 left_tip to right_tip")
    assert np.abs(gap).max() < 1e-8


def test_a_rod_that_closes_a_loop_is_drawn_from_end_to_end():
    from thesis_pin.loops.closures import ClosedRobot
    from thesis_pin.model.formats.closure_file import ClosureFile
    from thesis_pin.pages.robot import items_of

    tree, _ = mechanisms.four_bar()
    text = tree.yaml.replace("['3d']", "['rod']") + "thesis_pin: {lengths: [0.2]}\n"
    robot = ClosedRobot(tree.urdf, ClosureFile.parse(text))
    q = np.zeros((2, 3))
    rod = next(item for item in items_of(robot, q)[0] if item.name == "rod of loop 0")
    assert isinstance(rod, Arrow)
    one, two = (frame_placements(robot.model, name, q)[:, :3] for name in robot.loops[0].frames)
    np.testing.assert_allclose(rod.vector, two - one, atol=1e-12)


def test_the_page_holds_picture_numbers_and_animation(space):
    page = workspace_page(space).decode()
    assert "data:image/png;base64," in page
    assert "reachable" in page
    assert "of the motors against x z of frame left_tip, by colour" in page
    assert "<td>x, z</td>" in page
    assert "[&#39;" not in page


def test_a_grid_that_nothing_reaches_has_a_page_without_animation(space):
    robot, pose = space.robot, space.q[space.reachable][0]
    far = evaluate_workspace(robot, {"x": [2.0, 2.1], "z": [2.0, 2.1]}, frame="left_tip", pose=pose)
    assert not far.reachable.any()
    assert scene(far) is None
    assert "No cell of the grid is reachable" in workspace_page(far).decode()
    assert set(workspace_files(far)) == {"workspace.png", "workspace.svg"}
