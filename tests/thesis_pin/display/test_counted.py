"""Numbers of things in words."""

from thesis_pin.display.counted import counted


def test_one_thing_has_no_plural_and_none_has():
    assert [counted(k, "sample") for k in (0, 1, 2)] == ["0 samples", "1 sample", "2 samples"]
    assert [counted(k, "body", "bodies") for k in (0, 1, 2)] == ["0 bodies", "1 body", "2 bodies"]
