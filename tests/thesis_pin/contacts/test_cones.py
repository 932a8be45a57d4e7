"""What a sole can carry: corner forces by linear programming, Coulomb's law by hand."""

import numpy as np
import pytest
from corner_forces import linear_programme_admits

from thesis_pin.contacts.cones import FRICTION_EDGES, Contact, in_sole_axes
from thesis_pin.errors import BadInput
from thesis_pin.numeric.rotations import rotation


@pytest.fixture
def rng():
    return np.random.default_rng(20101)


OUTLINES = {
    "a foot": [[-0.016, -0.05], [0.028, -0.05], [0.028, 0.07], [0.01, 0.08], [-0.016, 0.06]],
    "a square": [[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]],
}


@pytest.fixture(params=OUTLINES)
def contact(request):
    return Contact.from_outline(np.array(OUTLINES[request.param]), 0.6)


def test_wrench_cone_is_what_corner_forces_can_do(contact, rng):
    inside = 0
    for _ in range(150):
        wrench = rng.normal(size=6) * [0.3, 0.3, 0.3, 0.04, 0.04, 0.02] + [0, 0, 1, 0, 0, 0]
        margin = contact.margin(wrench)
        if abs(margin) < 1e-6:
            continue
        admitted = linear_programme_admits(contact, wrench)
        assert (margin > 0) == admitted
        assert (contact.violation(wrench)[0] < 1e-9) == admitted
        inside += admitted
    assert 10 < inside < 140


def test_bounds_of_violations_hold_and_are_tight_near_the_wrench_they_come_from(contact, rng):
    scale = [0.3, 0.3, 0.3, 0.04, 0.04, 0.02]
    for like in rng.normal(size=(20, 6)) * scale + [0.5, 0, 1, 0, 0.02, 0]:
        others = rng.normal(size=(30, 6)) * scale + [0, 0, 1, 0, 0, 0]
        bounds = contact.violation_at_most(others, like)
        sizes = np.array([contact.violation(one)[0] for one in others])
        assert (bounds >= sizes - 1e-12).all()
        near = like * (1 + 1e-9 * np.arange(4))[:, None]
        exact = [contact.violation(one)[0] for one in near]
        np.testing.assert_allclose(contact.violation_at_most(near, like), exact, atol=1e-8)


def test_least_violation_is_a_distance_and_repairs_the_wrench(contact, rng):
    for _ in range(50):
        wrench = rng.normal(size=6) * [3, 3, 3, 0.5, 0.5, 0.5]
        size, missing = contact.violation(wrench)
        assert size == pytest.approx(np.linalg.norm(contact.scale(missing)), abs=1e-9)
        assert contact.margin(wrench - missing) > -1e-9
        assert size >= -contact.margin(wrench) - 1e-9


def test_pulling_slipping_tipping_and_spinning_are_each_refused(contact):
    middle = contact.hull.mean(axis=0)

    def pressed(force, moment=(0.0, 0.0, 0.0), at=middle):
        return np.concatenate([force, np.cross([*at, 0.0], force) + moment])

    good = pressed([0.5, 0.3, 8.0])
    assert contact.margin(good) > 0
    assert contact.margin(pressed([0, 0, -1.0])) < 0
    assert contact.margin(pressed([0.61 * 8, 0, 8.0])) < 0
    assert contact.margin(pressed([0, 0, 8.0], at=(0.06, 0.0))) < 0
    # Full friction at the farthest corner bounds the yaw moment.
    assert contact.margin(pressed([0, 0, 8.0], moment=(0, 0, 8.0 * 0.6 * 0.1))) < 0
    assert contact.friction_used(pressed([2.4, 0, 8.0])) == pytest.approx(0.5)


@pytest.mark.parametrize("direction", range(FRICTION_EDGES))
def test_friction_ends_at_coulombs_limit_in_every_direction_of_the_pyramid(contact, direction):
    """Along an edge of the pyramid it is Coulomb's law; x and y alike."""
    angle = 2 * np.pi * direction / FRICTION_EDGES
    along = np.array([np.cos(angle), np.sin(angle)])
    at = np.append(contact.hull.mean(axis=0), 0.0)
    for share, holds in ((0.99, True), (1.01, False)):
        force = np.append(share * contact.friction * 8.0 * along, 8.0)
        wrench = np.concatenate([force, np.cross(at, force)])
        assert (contact.margin(wrench) > 0) == holds
        assert (contact.violation(wrench)[0] < 1e-9) == holds
        assert contact.friction_used(wrench) == pytest.approx(share)


def test_friction_used_is_the_share_of_coulombs_limit_and_nothing_without_load(contact):
    wrenches = np.array([[3.0, -4.0, 10.0, 1, 2, 3], [0, 2.0, 5.0, 0, 0, 0], [1.0, 0, 0, 0, 0, 0]])
    np.testing.assert_allclose(
        contact.friction_used(wrenches), [5 / (0.6 * 10), 2 / (0.6 * 5), np.nan]
    )


def test_the_centre_of_pressure_is_where_a_single_force_acts(contact, rng):
    for x, y in rng.uniform(-0.1, 0.1, (20, 2)):
        force = np.append(rng.normal(size=2), rng.uniform(1.0, 9.0))
        wrench = np.concatenate([force, np.cross([x, y, 0.0], force)])
        np.testing.assert_allclose(contact.centre_of_pressure(wrench), [x, y], atol=1e-12)
    assert np.isnan(contact.centre_of_pressure(np.array([0, 0, -1.0, 0, 0, 0]))).all()


def test_the_margin_is_the_largest_disturbance_that_never_breaks_the_contact(contact, rng):
    """By its definition: no scaled disturbance of that size breaks it, and one just larger does."""
    wrench = np.array([0.2, 0.1, 8.0, *np.cross([*contact.hull.mean(axis=0), 0], [0.2, 0.1, 8.0])])
    margin = float(contact.margin(wrench))
    scaled, unit = contact.scale(wrench), np.repeat([contact.length, 1.0], 3)
    for push in rng.normal(size=(200, 6)):
        push *= margin * (1 - 1e-9) / np.linalg.norm(push)
        assert contact.violation((scaled + push) / unit)[0] < 1e-9
    worst = contact.facets[np.argmax(contact.facets @ scaled)]
    assert contact.violation((scaled + 1.001 * margin * worst) / unit)[0] > 1e-5 * margin


def test_the_length_is_half_the_diagonal_of_the_soles_box(contact):
    spans = contact.outline.max(axis=0) - contact.outline.min(axis=0)
    assert contact.length == pytest.approx(np.sqrt((spans**2).sum()) / 2)


def test_corners_inside_the_hull_change_nothing():
    square = np.array(OUTLINES["a square"])
    more = np.concatenate([square, [[0.0, 0.0], [0.01, 0.0]]])
    wrench = np.array([1.0, 0.5, 8.0, 0.1, -0.1, 0.05])
    one, other = (Contact.from_outline(outline, 0.5) for outline in (square, more))
    assert len(other.hull) == 4
    assert one.margin(wrench) == pytest.approx(float(other.margin(wrench)))


@pytest.mark.parametrize(
    ("outline", "friction", "says"),
    [
        (np.array([[0, 0], [1, 1], [2, 2.0]]), 0.5, "span no area"),
        (np.array(OUTLINES["a square"]), 0.0, "friction"),
        (np.array(OUTLINES["a square"]), -0.5, "friction"),
    ],
)
def test_a_sole_that_can_carry_nothing_is_refused(outline, friction, says):
    with pytest.raises(BadInput, match=says):
        Contact.from_outline(outline, friction)


def test_wrenches_are_turned_into_the_soles_axes(rng):
    turn = rotation("x", 0.3) @ rotation("z", 1.1)
    force, moment = rng.normal(size=(2, 3))
    found = in_sole_axes(turn[None], np.concatenate([force, moment])[None])[0]
    by_hand = [turn[:, k] @ part for part in (force, moment) for k in range(3)]
    np.testing.assert_allclose(found, by_hand, atol=1e-14)
