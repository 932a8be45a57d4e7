"""Mended lines of both theses hold."""

import pytest

from pollard_pin.thesis.audit import THESIS as POLLARD
from scout_pin.thesis.audit import THESIS as SCOUT
from thesis_pin.audit.judging.verdicts import judge

THESES = pytest.mark.parametrize("thesis", [SCOUT, POLLARD], ids=["scout", "pollard"])


@THESES
def test_every_failing_line_holds_with_its_correction_as_print(thesis):
    equations = thesis.catalogue()
    ground = thesis.ground(equations)
    for equation in equations.equations:
        if not (equation.mending or equation.left_printed):
            continue
        mended = {"printed": equation.members("corrected"), "corrected": {}, "right": {}}
        changed = equation.model_copy(update={**mended, "left_printed": "", "misread": {}})
        free = ground.substituted(changed)
        row = judge(equations, changed, ground.references(changed), ground.claims, "", free)
        assert row.verdict == "holds", (row.id, row.reason)
