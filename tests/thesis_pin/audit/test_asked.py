"""Lines of a thesis by whatever a reader calls them."""

import pytest

from pollard_pin.thesis import catalogue as pollard
from scout_pin.thesis.catalogue import catalogue as scout
from thesis_pin.audit.asked import asked

THESES = {"pollard": pollard, "scout": scout}


@pytest.mark.parametrize(
    ("robot", "name", "ids"),
    [
        ("scout", "scout:6.2:ZMP_x", ["6.2:ZMP_x"]),
        ("scout", "6.2:zmp_x", ["6.2:ZMP_x"]),
        ("scout", "ZMP_x", ["6.2:ZMP_x", "6.2:ZMP_x_at_rest"]),
        ("scout", "zmp_x", ["6.2:ZMP_x", "6.2:ZMP_x_at_rest"]),
        ("scout", "C.1", ["C:C.1"]),
        ("scout", "(c.1)", ["C:C.1"]),
        ("pollard", "(3.154)", ["3.7:3.154"]),
        ("pollard", "3.154", ["3.7:3.154"]),
        ("pollard", "v_22", ["D:V_22"]),
        ("pollard", r"\dot{b}_{12}", ["2.5.4:dot_b_12"]),
        ("pollard", " dot b_12", ["2.5.4:dot_b_12"]),
    ],
)
def test_an_id_a_number_and_a_symbol_are_found_in_any_spelling(robot, name, ids):
    found, said = asked(name, THESES[robot](), robot)
    assert found == [f"{robot}:{one}" for one in ids]
    assert said == ""


def test_capitals_count_where_they_tell_two_symbols_apart():
    for name in ("e_31", "E_31"):
        found, _ = asked(name, pollard(), "pollard")
        assert found
        assert all(one.endswith(f":{name}") for one in found)


def test_a_section_is_all_its_lines():
    found, _ = asked("6.2", scout(), "scout")
    assert found == [line.id for line in scout().equations if line.section == "6.2"]
    assert len(found) > 1


def test_a_number_of_an_appendix_without_numbers_counts_its_lines_and_says_so():
    for name in ("D.1", "(d.1)"):
        found, said = asked(name, pollard(), "pollard")
        assert found == ["pollard:D:V_1"]
        assert said == "appendix D prints no numbers: pollard:D:V_1 is its line 1"
    (first,), _ = asked("D.1", scout(), "scout")
    assert scout()[first].line == min(e.line for e in scout().equations if e.section == "D")
    assert asked("D.999", pollard(), "pollard") == ([], "")
    assert asked("D.0", pollard(), "pollard") == ([], "")


@pytest.mark.parametrize("name", ["", "()", "nothing", "2.999", "ZMP"])
def test_what_isnt_there_isnt_found(name):
    assert asked(name, pollard(), "pollard") == ([], "")
