"""Plain YAML with its lines; everything that could surprise is refused, and soon."""

import pytest
import yaml

from thesis_pin.errors import BadInput, SpecificationError
from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.model.formats.yaml_text import parse_yaml
from thesis_pin.model.limits import LIMITS

PLAIN = """\
# a note
closed_loop: [[a, b],
              [c, d]]
'type': ['3d',
  6d]
name_mot:
  - m1
  - m2
joint_name: []
thesis_pin: {format: 1, robot: r}
"""


def test_plain_files_read_as_yamls_own_loader_reads_them():
    assert parse_yaml("closure file", PLAIN, where="f")[0] == yaml.safe_load(PLAIN)


def test_every_key_and_entry_has_its_line():
    lines = parse_yaml("closure file", PLAIN, where="f")[1]
    assert lines[("closed_loop", 1)] == 3
    assert lines[("type",)] == 4
    assert lines[("type", 1)] == 5
    assert lines[("name_mot", 1)] == 8
    assert lines[("thesis_pin", "format")] == 10


def test_a_problem_is_told_with_the_line_of_its_entry():
    with pytest.raises(SpecificationError, match=r"f\.yaml:5: type\[1\]"):
        ClosureFile.parse(PLAIN.replace("6d", "7d"), where="f.yaml")


BOMB = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 12)
)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a: &a [*a]", "f.yaml:1: .*aliases"),
        (BOMB, "f.yaml:2: .*aliases"),
        ("b: 1\n[a]: 1", "f.yaml:2: .*a key isn't a word"),
        ("{a: 1}: 2", "a key isn't a word"),
        ("2020-01-01: 1", "a key isn't a word"),
        ("1: 2", "a key isn't a word"),
        ("<<: {a: 1}", "a key isn't a word"),
        ("type: 2020-01-01", "timestamp isn't taken"),
        ("a: !!binary aGk=", "binary isn't taken"),
        ("a: !!python/object/apply:os.getcwd []", "isn't taken"),
        ("a: " + "1" * 5000, "isn't a number"),
        ("a: 0b_", "isn't a number"),
        ("a: 1\na: 2", "f.yaml:2: .*'a' is given twice"),
        ("a: " + "[" * 100_000, "nested deeper than 32 levels"),
        ("- " * 50_000, "nested deeper than 32 levels"),
        ("a\0b: 1", "isn't valid YAML"),
        ("a: [", "isn't valid YAML"),
    ],
)
def test_what_is_not_plain_is_refused_in_a_short_message(text, says):
    with pytest.raises(BadInput, match=says) as caught:
        ClosureFile.parse(text, where="f.yaml")
    assert len(str(caught.value)) < 500


def test_a_list_longer_than_the_limit_is_refused():
    names = ", ".join(f"j{k}" for k in range(LIMITS.entries + 1))
    with pytest.raises(SpecificationError, match=r"joint_name.* at most 1000 items"):
        ClosureFile.parse(f"closed_loop: []\ntype: []\nname_mot: [a]\njoint_name: [{names}]\n")


def test_powers_of_ten_are_numbers_with_and_without_a_point():
    data, _ = parse_yaml("file", "a: [1e-5, 1.0e-5, -2E3, .5e1, 1.e+2, e5, 1e]\n", where="f")
    assert data == {"a": [1e-5, 1e-5, -2000.0, 5.0, 100.0, "e5", "1e"]}
