"""Whose a motion is: what changes the fingerprint, what doesn't, and what is said."""

import re

import pytest

import pollard_pin
import scout_pin
from pollard_pin.specification import POLLARD_PATH
from scout_pin.specification import SCOUT_PATH
from thesis_pin.model.made_for import MadeFor, fingerprint

KINDS = {
    "scout": (scout_pin.Specification, SCOUT_PATH),
    "pollard": (pollard_pin.Specification, POLLARD_PATH),
}


@pytest.fixture(params=KINDS)
def given(request):
    """A specification's class and the text of the thesis's."""
    kind, file = KINDS[request.param]
    return kind, file.read_text(encoding="utf-8")


def read(kind, text, folder):
    file = folder / "robot.toml"
    file.write_text(text, encoding="utf-8")
    return kind.read(file)


@pytest.mark.parametrize(
    ("pattern", "by"),
    [
        (r'^name = ".*"$', 'name = "my_robot"'),
        (r'^source = ".*"$', 'source = "measured"'),
        (r"\n\n", "\n# said besides\n\n"),
    ],
)
def test_what_is_no_number_of_the_robot_keeps_the_fingerprint(given, pattern, by, tmp_path):
    kind, text = given
    changed, count = re.subn(pattern, by, text, count=1, flags=re.MULTILINE)
    assert count == 1
    assert fingerprint(read(kind, changed, tmp_path)) == fingerprint(kind.read())


def test_a_checked_form_and_its_text_have_one_fingerprint(given, tmp_path):
    kind, text = given
    assert fingerprint(kind.read()) == fingerprint(read(kind, text + "\n# a copy\n", tmp_path))


def test_every_length_and_mass_changes_the_fingerprint(given, tmp_path):
    kind, text = given
    found, lines = set(), text.splitlines(keepends=True)
    numbers = re.compile(r"^(?:x_\w+|z_\w+|y_\w+|mass) = -?(\d[\d.e+-]*)")
    changes = [k for k, line in enumerate(lines) if numbers.match(line)]
    assert len(changes) > 5
    for k in changes:
        row = re.match(numbers, lines[k])
        other = [*lines]
        number = float(row[1]) * 1.01 + 1e-4
        other[k] = lines[k][: row.start(1)] + f"{number:.6g}" + lines[k][row.end(1) :]
        found.add(fingerprint(read(kind, "".join(other), tmp_path)))
    assert len(found) == len(changes)
    assert fingerprint(kind.read()) not in found


def test_a_default_that_is_written_down_is_as_one_that_isnt(tmp_path):
    text = SCOUT_PATH.read_text(encoding="utf-8")
    said = text.replace("format = 1\n", 'format = 1\nneutral_soles = "flat"\n', 1)
    assert said != text
    found = read(scout_pin.Specification, said, tmp_path)
    assert fingerprint(found) == fingerprint(scout_pin.Specification.read())


def test_where_appendix_b_stands_makes_no_other_robot(tmp_path):
    text = POLLARD_PATH.read_text(encoding="utf-8")
    moved = text
    for old, new in (
        (r"^duration = [\d.]+", "duration = 7.5"),
        (r"^(\[assumptions\.placement\]\n(?:.*\n)*?position = \[)0\.45", r"\g<1>0.4"),
    ):
        moved, count = re.subn(old, new, moved, flags=re.MULTILINE)
        assert count == 1
    found = read(pollard_pin.Specification, moved, tmp_path)
    assert fingerprint(found) == fingerprint(pollard_pin.Specification.read())


def test_a_zero_with_a_minus_is_zero(tmp_path):
    text = POLLARD_PATH.read_text(encoding="utf-8")
    minus, count = re.subn(r"(?m)^(tool = \[0\.03, )0\.0", r"\g<1>-0.0", text)
    assert count == 1
    found = read(pollard_pin.Specification, minus, tmp_path)
    assert fingerprint(found) == fingerprint(pollard_pin.Specification.read())


def test_another_robot_and_other_numbers_of_one_name_are_told_apart():
    own = scout_pin.Specification.read()
    assert MadeFor.of(own).against(own, "gait 'walk'") == ()
    (same,) = MadeFor.made(robot="scout", fingerprint="00000000").against(own, "gait 'walk'")
    assert "other numbers of that name" in same
    (other,) = MadeFor.made(robot="rover", fingerprint="00000000").against(own, "gait 'walk'")
    assert "'rover' (fingerprint 00000000)" in other
    assert f"'scout' ({fingerprint(own)})" in other
    renamed = own.model_copy(update={"name": "rover"})
    assert MadeFor.of(renamed).against(own, "gait 'walk'") == ()
