"""No slip in a tenth of both theses' lines goes unnoticed; docs/audit/slips.md has them all."""

from collections import Counter

import pytest

from pollard_pin.thesis.audit import THESIS as POLLARD
from scout_pin.thesis.audit import THESIS as SCOUT
from thesis_pin.audit.mutation.slips import SLIPS
from thesis_pin.audit.mutation.table import missed_lines, try_slips

SHARE, SEED = 0.1, 19
"""The same tenth in every run."""


@pytest.mark.parametrize(
    ("thesis", "kinds"),
    # Sines and cosines stand in few of the Scout thesis's lines.
    [(SCOUT, set(SLIPS) - {"sine for cosine"}), (POLLARD, set(SLIPS))],
    ids=["scout", "pollard"],
)
def test_no_slip_in_a_tenth_of_the_lines_that_hold_is_missed(thesis, kinds):
    trials = try_slips(thesis, share=SHARE, seed=SEED)
    assert list(missed_lines(trials)) == []
    assert {trial.kind for trial in trials} >= kinds
    answers = Counter(trial.answer for trial in trials)
    assert len(trials) > 2000
    assert answers["caught"] > 0.9 * len(trials)
