"""Drawn robots in a table."""

from thesis_pin.report.draws import draws_table


def test_draws_stand_in_quantiles_in_the_asked_unit_and_zero_has_no_sign():
    spread = {"peak_torque": [3.0, 1.0, 2.0, 5.0, 4.0], "sideways": [-1e-8, 0.0, 0.0, 0.0, 2e-3]}
    table = draws_table(spread, {"peak_torque": ("N·m", 1.0), "sideways": ("mm", 1e3)})
    assert table.title == "5 robots with drawn errors"
    assert table.rows == [
        ("peak torque [N·m]", "1.000", "2.000", "3.000", "4.000", "5.000"),
        ("sideways [mm]", "0.000", "0.000", "0.000", "0.000", "2.000"),
    ]
