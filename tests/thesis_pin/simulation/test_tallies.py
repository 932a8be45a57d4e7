"""What several tries have in common, counted by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from thesis_pin.simulation.tallies import Tally, lost_sentences, passed_sentence, tallied


def asked(**met):
    return [SimpleNamespace(name=name, met=answer) for name, answer in met.items()]


TRIES = [
    asked(far=True, straight=True, dry=True),
    asked(far=False, straight=True, dry=True),
    asked(far=False, straight=False, dry=True),
]


def test_tries_are_counted_by_criterion_and_as_a_whole():
    found = tallied(TRIES, {"length": [1.0, 3.0, 2.0]})
    quantiles = found.pop("quantiles")
    assert found == {
        "draws": 3,
        "draws_passed": 1,
        "kept": {"far": 1, "straight": 2, "dry": 3},
    }
    assert quantiles["of"] == [0.05, 0.5, 0.95]
    np.testing.assert_allclose(quantiles["length"], [1.1, 2.0, 2.9])


@pytest.mark.parametrize(("some", "passes"), [(slice(0, 1), True), (slice(0, 3), False)])
def test_a_simulation_passes_if_every_try_keeps_all_and_is_doubted_as_its_report(some, passes):
    class Simulated(Tally):
        report = SimpleNamespace(doubts=lambda: ["is this in degrees?"])
        tries = TRIES[some]

        def verdict(self):
            return ""

    found = Simulated()
    assert (found.passed, found.within_limits) == (passes, passes)
    assert found.doubts() == ["is this in degrees?"]


def test_only_criteria_that_some_try_breaks_are_told():
    assert passed_sentence(TRIES) == "1 of 3 draws keep all that is asked."
    words = {"far": "how far they come", "straight": "where they head", "dry": "water"}
    assert list(lost_sentences(TRIES, words)) == [
        "2 of 3 fail by how far they come.",
        "1 of 3 fail by where they head.",
    ]


def test_criteria_of_tries_stand_in_one_order():
    with pytest.raises(ValueError, match="zip"):
        tallied([asked(far=True, dry=True), asked(far=True)], {})
