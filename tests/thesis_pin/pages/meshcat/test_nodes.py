"""Nodes put shapes where the scene says, at its samples and between them."""

from dataclasses import replace

import numpy as np
import pytest
from meshcat.path import Path
from scipy.spatial.transform import Rotation

from thesis_pin.errors import BadInput
from thesis_pin.pages.meshcat.drawing import Drawing, _matrix, word
from thesis_pin.pages.meshcat.lines import bundle, moving, threshold, tube
from thesis_pin.pages.meshcat.nodes import held, nodes
from thesis_pin.pages.meshcat.shapes import look, surface
from thesis_pin.pages.meshcat.tracks import MOST_BYTES, animation, samples
from thesis_pin.pages.scene import Arc, Arrow, Ball, Bars, Item, Polygon, Shape, Trace, Triad

NONE = np.full(3, np.nan)


def by_path(item):
    return {node.path: node for node in nodes(item)}


def arrow(vector, origin=None, head=True):
    vector = np.asarray(vector, dtype=float)
    origin = np.zeros_like(vector) if origin is None else origin
    return Arrow("a", "g", origin, vector, 0.5, 0.01, "#112233", head=head)


def corners(node):
    """A node's vertices at the origin of its parent."""
    shape = node.shape
    geometry = shape.geometry
    if hasattr(geometry, "vertices"):
        points = geometry.vertices
    else:  # a cylinder or cone along y
        turn = np.linspace(0, 2 * np.pi, 9)[:-1]
        rings = [
            np.column_stack([r * np.cos(turn), np.full(8, y), r * np.sin(turn)])
            for r, y in (
                (geometry.radiusBottom, -geometry.height / 2),
                (geometry.radiusTop, geometry.height / 2),
            )
        ]
        points = np.concatenate(rings)
    return points @ shape.place[:3, :3].T + shape.place[:3, 3]


def moved(points, *matrices):
    for matrix in reversed(matrices):
        points = points @ matrix[:3, :3].T + matrix[:3, 3]
    return points


@pytest.mark.parametrize("head", [True, False])
def test_an_arrows_tip_is_at_origin_plus_scaled_vector_at_every_sample(head):
    rng = np.random.default_rng(1)
    vectors = np.concatenate(
        [rng.normal(size=(20, 3)), [[0, 0, -2.0]], [[0, 0, 3.0]], [[0.02, 0, 0]]]
    )
    origins = rng.normal(size=vectors.shape)
    found = by_path(arrow(vectors, origins, head))
    part = found["head"] if head else found[""]
    for k, (origin, vector) in enumerate(zip(origins, vectors, strict=True)):
        outer = _matrix(found[""], k, 0.0)
        matrices = (outer, _matrix(part, k, 0.0)) if head else (outer,)
        drawn = moved(corners(part), *matrices)
        tip = origin + 0.5 * vector
        along = (drawn - origin) @ vector / np.linalg.norm(vector)
        np.testing.assert_allclose(along.max(), 0.5 * np.linalg.norm(vector), rtol=1e-12)
        end = drawn[along > along.max() - 1e-12].mean(axis=0)
        np.testing.assert_allclose(end, tip, atol=1e-12)
        if head:
            shaft = moved(corners(found["shaft"]), outer, _matrix(found["shaft"], k, 0.0))
            far = (shaft - origin) @ vector / np.linalg.norm(vector)
            assert far.min() == pytest.approx(0, abs=1e-12)
            assert far.max() == pytest.approx(along.min(), rel=1e-9)


def test_an_arrow_hides_where_it_isnt_known_and_where_it_is_none():
    vectors = [[0, 0, 1.0], NONE, [0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 2]]
    shown = by_path(arrow(vectors))[""].visible
    # From a sample to the next: unknown next to it, zero throughout, growing from zero.
    assert shown.tolist() == [False, False, True, False, True, True]


def test_held_samples_keep_the_last_known_and_the_first_for_those_before():
    values, shown = held(np.array([[np.nan], [1.0], [2.0], [np.nan]]))
    assert values.ravel().tolist() == [1, 1, 2, 2]
    assert shown.tolist() == [False, True, False, False]


def test_a_turning_body_is_halfway_between_samples():
    turn = Rotation.from_rotvec([[0, 0, 0], [0, 0, 3.0]]).as_quat()
    turn[1] *= -1  # the same rotation, the other sign
    place = np.column_stack([[[0, 0, 0], [1.0, 2, 3]], turn])
    box = {"type": "box", "size": [1, 1, 1]}
    node = by_path(Shape("s", "g", box, place, np.eye(4)))[""]
    middle = _matrix(node, 0, 0.5)
    np.testing.assert_allclose(middle[:3, 3], [0.5, 1, 1.5])
    np.testing.assert_allclose(middle[:3, :3], Rotation.from_rotvec([0, 0, 1.5]).as_matrix())


def test_an_arc_is_as_long_as_its_angle_and_turns_the_way_of_its_sign():
    angle = np.array([1.0, -2.0, 2 * np.pi, 0.0])
    about = Rotation.from_euler("xyz", [0.4, -0.7, 1.1])
    still = np.tile([0, 0, 0, *about.as_quat()], (4, 1))
    item = Arc("a", "g", still, angle, 0.3, ("#000000", "#ffffff"), np.array([0, 1, 1, 0]))
    found = by_path(item)
    assert found[""].visible.tolist() == [True, True, True, False]
    assert found["ring"].colour.tolist() == [[0, 0, 0], [1, 1, 1], [1, 1, 1], [0, 0, 0]]
    for k in range(3):
        opacity = found["ring"].shape.geometry.color[:, 3]
        points = found["ring"].shape.geometry.vertices[opacity >= threshold(found["ring"].share[k])]
        drawn = about.inv().apply(moved(points, _matrix(found[""], k, 0.0)))
        swept = np.unwrap(np.arctan2(drawn[:, 1], drawn[:, 0]))
        assert np.sign(angle[k]) == np.sign(swept[-1] - swept[0])
        assert np.ptp(swept) == pytest.approx(abs(angle[k]), abs=2 * np.pi / 48 + 1e-9)
        tip = moved(
            corners(found["head"]), _matrix(found[""], k, 0.0), _matrix(found["head"], k, 0.0)
        )
        end = 0.3 * np.array([np.cos(angle[k]), np.sin(angle[k]), 0])
        np.testing.assert_allclose(tip.mean(axis=0), about.apply(end), atol=1e-9)


def test_a_triads_bars_lie_along_the_frames_axes():
    local = np.eye(4)
    local[:3, :3] = Rotation.from_euler("xyz", [0.3, -0.5, 0.7]).as_matrix()
    local[:3, 3] = 0.1, 0.2, 0.3
    body = np.eye(4)
    body[:3, :3] = (about := Rotation.from_euler("xyz", [1.0, 0.2, -0.6])).as_matrix()
    body[:3, 3] = 1.0, -2.0, 0.5
    place = np.tile([*body[:3, 3], *about.as_quat()], (2, 1))
    found = by_path(Triad("t", "g", place, local, 0.4, "name"))
    for k, axis in enumerate("xyz"):
        drawn = moved(corners(found[axis]), _matrix(found[""], 0, 0.0))
        own = moved(drawn, np.linalg.inv(body @ local))
        assert own[:, k].min() == pytest.approx(0.0, abs=1e-12)
        assert own[:, k].max() == pytest.approx(0.4)
        assert np.abs(np.delete(own, k, axis=1)).max() < 0.02


def test_a_trace_is_bold_as_far_as_it_has_come():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 0], [1, 2, 0], NONE, [1, 2, 1.0]])
    done = by_path(Trace("t", "g", points, 0.01, "#000000"))["done"]
    assert done.share.tolist() == pytest.approx([0, 1 / 3, 1 / 3, 2 / 3, 2 / 3, 1])
    assert list(nodes(Trace("t", "g", points[1:3], 0.01, "#000000"))) == []


def test_a_tube_lies_around_its_line_also_where_that_turns_back():
    line = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 0, 0], [1, 0, -1.0]])
    ring = tube(line, 0.1, 6).vertices.reshape(5, 6, 3)
    np.testing.assert_allclose(ring.mean(axis=1), line, atol=1e-7)
    away = np.linalg.norm(ring - line[:, None], axis=-1)
    np.testing.assert_allclose(away, 0.1, atol=1e-7)


def test_outlines_of_a_polygon_take_turns():
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    which = np.array([0.0, 1, -1])
    found = by_path(Polygon("p", "g", (square, square[:2]), which, "#000000", 0.01))
    assert found["outline 0"].visible.tolist() == [True, False, False]
    assert found["outline 1"].visible.tolist() == [False, True, False]
    assert found["outline 1"].shape is None  # two corners have no area
    assert found["outline 1/border"].shape is not None


def test_a_ball_takes_its_levels_colour():
    places = np.zeros((3, 3))
    ball = Ball("b", "g", places, 0.1, ("#ff0000", "#0000ff"), np.array([0.0, 1, np.nan]))
    (node,) = nodes(ball)
    assert node.colour.tolist() == [[1, 0, 0], [0, 0, 1], [1, 0, 0]]


@pytest.mark.parametrize(
    ("geometry", "low", "high"),
    [
        ({"type": "cylinder", "radius": 0.2, "length": 2.0}, -1, 1),
        ({"type": "cone", "radius": 0.2, "length": 2.0}, -1, 1),
        ({"type": "capsule", "radius": 0.2, "length": 2.0}, -1.2, 1.2),
    ],
)
def test_round_shapes_lie_along_z_and_a_cones_tip_is_above(geometry, low, high):
    from meshcat.geometry import MeshLambertMaterial

    shape = surface(geometry, MeshLambertMaterial(), np.eye(4))
    points = corners(type("Node", (), {"shape": shape}))
    assert points[:, 2].min() == pytest.approx(low, abs=1e-6)
    assert points[:, 2].max() == pytest.approx(high, abs=1e-6)
    top = np.linalg.norm(points[points[:, 2] > high - 1e-6][:, :2], axis=1).max()
    assert top == pytest.approx({"cone": 0, "cylinder": 0.2}.get(geometry["type"], 0), abs=1e-6)


def test_an_ellipsoid_is_swollen_along_its_own_axes_and_then_turned():
    from meshcat.geometry import MeshLambertMaterial

    place = np.eye(4)
    place[:3, :3] = turn = Rotation.from_euler("xyz", [0.3, -0.5, 0.7]).as_matrix()
    geometry = {"type": "ellipsoid", "radii": [0.1, 0.2, 0.3]}
    shape = surface(geometry, MeshLambertMaterial(), place)
    assert shape.geometry.radius == 1.0
    for k, radius in enumerate(geometry["radii"]):
        np.testing.assert_allclose(shape.place[:3, :3] @ np.eye(3)[k], radius * turn[:, k])


def test_a_motion_plays_at_its_speed_and_changes_colour_halfway_to_the_next_sample():
    time = np.array([3.0, 4.0, 6.0, 7.0])
    places = np.column_stack([time, 0 * time, 0 * time])
    ball = Ball("b", "g", places, 0.1, ("#ff0000", "#0000ff"), np.array([0.0, 0, 1, 1]))
    made = animation([(Path(("b",)), next(nodes(ball)))], time, 2.0)
    tracks = {name: track for clip in made.clips.values() for name, track in clip.tracks.items()}
    np.testing.assert_allclose(tracks["position"].frames, [0.0, 0.5, 1.5, 2.0])
    colour = tracks["material.color"]
    assert (colour.frames[1], colour.values[1].tolist()) == (1.0, [0, 0, 1])  # at 5 s


def test_another_kind_of_item_is_refused_by_name():
    with pytest.raises(BadInput, match="can't draw a Item in meshcat"):
        next(nodes(Item("x", "g")))


def test_names_that_javascript_or_meshcat_uses_are_no_steps_of_a_path():
    assert word("left/foot") == "left-foot"
    assert word("constructor") == "constructor_"
    assert word("__proto__") == "__proto___"
    assert word("<object>") == "<object>_"
    assert word(" ") == "_"


def test_two_names_never_share_a_node():
    class Tree:
        def __init__(self, path=()):
            self.path = Path(path)

        def __getitem__(self, step):
            return Tree(self.path.append(step).entries)

    drawing = Drawing(Tree())
    ball = Ball("a/b", "g", np.zeros((2, 3)), 0.1, ("#000000",))
    paths = [drawing.place(replace(ball, name=name)).path.entries for name in ("a/b", "a-b", "a/b")]
    assert paths == [("g", "a-b"), ("g", "a-b (2)"), ("g", "a-b")]


def test_a_line_keeps_the_points_that_show_and_how_far_it_has_come():
    turn = np.linspace(0, np.pi, 2001)
    line = np.column_stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)])
    line = np.concatenate([line[:1000], np.repeat(line[1000:1001], 500, axis=0), line[1000:]])
    radius = 0.004
    kept, done = moving(line, radius)
    assert 150 < len(kept) < 420
    assert (done >= 0).all()
    assert (np.diff(done) >= 0).all()
    assert done[-1] == len(kept) - 1
    assert done[1400] == done[1000]  # it rests there
    # Each sample is where its share of the pieces ends, to a quarter of the radius.
    piece = np.minimum(done.astype(int), len(kept) - 2)
    share = (done - piece)[:, None]
    there = (1 - share) * kept[piece] + share * kept[piece + 1]
    assert np.linalg.norm(there - line, axis=1).max() < 0.26 * radius
    corner = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.2, 1, 0], [1, 1, 0.0]])
    np.testing.assert_array_equal(moving(corner, 0.01)[0], corner)  # also where it turns back
    still, none = moving(np.repeat(corner[:1], 5, axis=0), 0.01)
    assert (len(still), none.max()) == (1, 0.0)


def test_bars_go_from_end_to_end_as_one_body():
    ends = np.random.default_rng(4).normal(size=(3, 2, 3))
    (node,) = nodes(Bars("b", "g", ends, 0.01, "#000000"))
    points = node.shape.geometry.vertices.reshape(3, 2, 6, 3)
    np.testing.assert_allclose(points.mean(axis=2), ends, atol=1e-6)  # of 32 bits
    radii = np.linalg.norm(points - ends[:, :, None], axis=-1)
    np.testing.assert_allclose(radii, 0.01, atol=1e-6)
    faces = bundle(ends, 0.01, 6).faces
    assert set(faces.ravel() // 12) == {0, 1, 2}
    assert (np.ptp(faces // 12, axis=-1) == 0).all()  # none of them joins two bars
    assert list(nodes(Bars("b", "g", np.empty((0, 2, 3)), 0.01, "#000000"))) == []


def outward(vertices, faces):
    """Share of faces whose corners go round as seen from outside, from the middle line z."""
    a, b, c = (vertices[np.asarray(faces)[:, k]] for k in range(3))
    middle = (a + b + c) / 3 * (1, 1, 0)
    return float((np.einsum("ij,ij->i", np.cross(b - a, c - a), middle) > 0).mean())


def test_tubes_are_seen_from_outside():
    line = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 2.0]])
    made = tube(line, 0.1, 7)
    assert outward(made.vertices, made.faces) == 1.0


def test_equal_shapes_look_alike_and_others_dont():
    one, same, other = (
        next(nodes(Ball("b", "g", np.zeros((2, 3)), r, ("#000000",)))) for r in (1, 1, 2)
    )
    assert look(one.shape) == look(same.shape) != look(other.shape)


def test_a_motion_keeps_60_samples_a_second_and_no_more_bytes_than_a_page_can_hold():
    time = np.linspace(0, 10, 10_001)
    few = list(nodes(arrow(np.ones((10_001, 3)))))
    keep = samples(time, few)
    assert len(keep) == 601
    assert keep[[0, -1]].tolist() == [0, 10_000]
    width = 4 * (4 + 5 + 4 + 4 + 4)  # position, quaternion, two scales and the head's position
    many = samples(time, few * 2000)
    assert len(many) == MOST_BYTES // (2000 * width)
