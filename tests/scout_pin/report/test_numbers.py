"""Numbers of a gait that one sample decides: worst contact, the way it tips, what blocks it."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin

from ..conftest import EXAMPLES


@pytest.fixture(scope="module")
def walk(scout):
    return scout_pin.gait_report(scout, scout_pin.load_gait(EXAMPLES / "walk.toml"), samples=41)


@pytest.mark.parametrize("size", [0.7, 2.5])
def test_the_worst_contact_may_be_in_double_support(walk, size):
    double = np.flatnonzero(walk.dynamics.support.all(axis=1))
    violation = walk.dynamics.double_violation.copy()
    violation[double[3]], violation[double[5]] = size, size / 2
    worse = replace(walk, dynamics=replace(walk.dynamics, double_violation=violation))
    assert worse.worst_contact == (double[3], size)
    assert not worse.can_walk
    assert worse.dynamics.admissible.sum() == walk.dynamics.admissible.sum() - 2


def test_the_worst_contact_is_the_one_that_misses_most_of_all(scout):
    report = scout_pin.gait_report(scout, scout_pin.load_gait("thesis"), samples=201)
    sizes = [report.dynamics.least_violation(k)[0] for k in range(len(report.joints.time))]
    assert report.worst_contact == (np.argmax(sizes), max(sizes))


@pytest.mark.parametrize(("depth", "walks"), [(7e-9, True), (0.9e-4, True), (1.1e-4, False)])
def test_a_swinging_sole_a_tenth_of_a_millimetre_below_the_floor_is_no_walk(walk, depth, walks):
    """All else as in a gait that can be walked; no floor is flatter than that."""
    assert walk.can_walk
    lowered = walk.motion.left_foot.position - (0.0, 0.0, walk.lowest_corner + depth)
    motion = replace(walk.motion, left_foot=replace(walk.motion.left_foot, position=lowered))
    dug = replace(walk, motion=motion)
    assert dug.lowest_corner < 0
    assert dug.can_walk == walks
    assert any("A swinging sole goes 0.1 mm" in one for one in dug.verdict()) != walks
    assert not any("0.0 mm" in sentence for sentence in dug.verdict())


@pytest.mark.parametrize("lean", [0.3, -0.3])
def test_it_tips_towards_the_foot_on_whose_side_the_zmp_lies(walk, lean):
    """At the worst sample in single support, found and leaned by hand."""
    phases = walk.motion.phase
    k = next(k for k, phase in enumerate(phases) if phase == "right")
    left, right = walk.motion.left_foot.position[k, :2], walk.motion.right_foot.position[k, :2]
    zmp, margin = walk.zmp.copy(), walk.margin.copy()
    zmp[k], margin[k] = right + lean * (left - right), -1.0
    assert replace(walk, zmp=zmp, margin=margin).tips_towards_swing == (lean > 0)
