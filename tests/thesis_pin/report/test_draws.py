"""Drawn robots in a table."""

from thesis_pin.report.draws import draws_tables


def test_draws_stand_in_quantiles_in_their_unit_and_zero_has_no_sign():
    spread = {"peak_torque": [3.0, 1.0, 2.0, 5.0, 4.0], "sideways": [-1e-8, 0.0, 0.0, 0.0, 2e-3]}
    (table,) = draws_tables(spread)
    assert table.title == "5 robots with drawn errors"
    assert table.rows == [
        ("peak torque [N·m]", "1.000", "2.000", "3.000", "4.000", "5.000"),
        ("sideways [mm]", "0.000", "0.000", "0.000", "0.000", "2.000"),
    ]


def test_one_draw_has_no_quantiles():
    assert draws_tables({"sideways": [1e-3]}) == []
