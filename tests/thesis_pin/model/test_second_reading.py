"""yourdfpy reads every example as we do, and would be heard if it didn't."""

from dataclasses import replace

import pytest
from example_robots import urdf_files

from thesis_pin.errors import ModelError, ThesisPinError
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.mechanism.description import Description
from thesis_pin.model.second_reading import second_reading

from .formats.urdf.test_reading import GOOD


@pytest.mark.parametrize("file", urdf_files(), ids=lambda file: file.name)
def test_yourdfpy_reads_every_example_as_we_do(file):
    try:
        description = read_urdf(file.read_bytes())
    except ThesisPinError as error:
        pytest.skip(str(error))
    assert second_reading(description) == []


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"0.75"', '"0.76"', "the mass of link 'b' is 0.76 there and 0.75 here"),
        ('ixx="0.01"', 'ixx="0.011"', "the inertia of link 'b'"),
        ('xyz="0.1 0 0"', 'xyz="0.1 0 0.1"', "the centre of mass of link 'b'"),
        ('xyz="0 0 1"', 'xyz="0 0 1.1"', "the placement of joint 'j'"),
        ('xyz="0 0 2"', 'xyz="0 1 2"', "the axis of joint 'j'"),
        ('upper="1.5"', 'upper="1.6"', "the upper limit of joint 'j'"),
        ('"revolute"', '"prismatic"', "the type of joint 'j' is 'prismatic' there"),
        ('name="j"', 'name="k"', "the joints j, k are read by one only"),
    ],
)
def test_every_kind_of_difference_is_seen(old, new, says):
    ours = read_urdf(GOOD)
    assert second_reading(ours) == []
    assert old in GOOD
    found = second_reading(replace(ours, text=GOOD.replace(old, new, 1)))
    assert any(one.startswith(says) for one in found), found


def test_a_link_without_mass_there_is_seen():
    ours = read_urdf(GOOD)
    start, end = GOOD.index("<inertial>"), GOOD.index("</inertial>") + len("</inertial>")
    found = second_reading(replace(ours, text=GOOD[:start] + GOOD[end:]))
    assert found == ["the mass of link 'b' is read by one only"]


def test_what_yourdfpy_cannot_read_is_told():
    with pytest.raises(ModelError, match=r"r\.urdf: yourdfpy can't read it"):
        second_reading(Description("r", {}, {}, "<robot"), where="r.urdf")
