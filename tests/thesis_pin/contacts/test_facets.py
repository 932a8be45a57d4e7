"""The facets of wrench cones, against Qhull's and by hand."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from thesis_pin.contacts import facets
from thesis_pin.contacts.cones import Contact

FRICTIONS = st.sampled_from([0.05, 0.6, 1.0, 3.0])


def qhulls(contact):
    """Rays all have the same normal force: corners of a polytope in five dimensions."""
    equations = ConvexHull(contact.rays[:, [0, 1, 3, 4, 5]] / contact.rays[0, 2]).equations
    found = np.column_stack([equations[:, :2], equations[:, 5], equations[:, 2:5]])
    found /= np.linalg.norm(found, axis=1)[:, None]
    return np.unique(found.round(12), axis=0)


def assert_alike(one, other):
    apart = np.abs(one[:, None] - other[None]).max(axis=2)
    assert apart.min(axis=1).max() < 1e-9
    assert apart.min(axis=0).max() < 1e-9


def regular(corners, turned):
    angle = 2 * np.pi * np.arange(corners) / corners + turned
    return 0.1 * np.column_stack([np.cos(angle), np.sin(angle)])


@given(
    outline=st.lists(
        st.tuples(st.integers(-4, 4), st.integers(-4, 4)), min_size=3, max_size=10, unique=True
    ),
    friction=FRICTIONS,
)
@settings(max_examples=40, deadline=None)
def test_facets_are_qhulls_on_soles_of_round_numbers(outline, friction):
    """Where many facets meet in a ray, and many rays lie on a facet."""
    points = 0.01 * np.array(outline, dtype=float)
    assume(np.linalg.matrix_rank(points - points[0]) == 2)
    contact = Contact.from_outline(points, friction)
    assert_alike(contact.facets, qhulls(contact))


@pytest.mark.parametrize("corners", [3, 4, 6, 8])
@pytest.mark.parametrize("turned", [0.0, np.pi / 8, 0.1])
def test_facets_are_qhulls_on_regular_soles(corners, turned):
    """Corners in line with the edges of the friction pyramid, and not."""
    contact = Contact.from_outline(regular(corners, turned), 0.6)
    assert_alike(contact.facets, qhulls(contact))
    assert len(contact.hull) == corners


@pytest.mark.parametrize("friction", [1e-3, 0.6, 10.0])
@pytest.mark.parametrize(
    "outline",
    [
        np.array([[-1, -1e-6], [1, -1e-6], [1, 1e-6], [-1, 1e-6]]) * 0.05,
        np.array([[1, 1], [1.001, 1], [1.001, 1.001], [1, 1.001]]),
        np.array([[0, 0], [0.05, -1e-7], [0.1, 0], [0.1, 0.2], [0.05, 0.2 + 1e-8], [0, 0.2]]),
    ],
    ids=["a hair", "far from its origin", "corners beside an edge"],
)
def test_facets_of_odd_soles_are_qhulls(outline, friction):
    contact = Contact.from_outline(outline, friction)
    assert_alike(contact.facets, qhulls(contact))


def test_what_isnt_the_whole_cone_is_left_to_qhull(monkeypatch):
    expected = Contact.from_outline(regular(5, 0.3), 0.6).facets
    full = facets._yawing
    for spoiled in (lambda rays: full(rays)[:0], lambda rays: full(rays) + 0.1):
        monkeypatch.setattr(facets, "_yawing", spoiled)
        assert_alike(Contact.from_outline(regular(5, 0.3), 0.6).facets, expected)


def test_facets_without_yaw_are_the_pyramids_sides_and_the_soles_edges():
    half, friction = 0.05, 0.6
    contact = Contact.from_outline(half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]), friction)
    level = contact.facets[contact.facets[:, 5] == 0.0]
    assert len(level) == 8 + 4
    unit = np.repeat([contact.length, 1.0], 3)
    for k in range(8):  # at the limit of friction between two edges of the pyramid
        angle = (k + 0.5) * np.pi / 4
        limit = friction * np.cos(np.pi / 8)
        wrench = np.array([limit * np.cos(angle), limit * np.sin(angle), 1.0, 0, 0, 0]) * unit
        assert np.sort(level @ wrench)[-1] == pytest.approx(0.0, abs=1e-12)
    for place in (-half, half):  # pressed at the middle of an edge
        for wrench in ([0, 0, 1, 0, -place, 0], [0, 0, 1, place, 0, 0]):
            assert (level @ (wrench * unit)).max() == pytest.approx(0.0, abs=1e-12)
