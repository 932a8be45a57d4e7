"""A file's content says which reader it needs, not its name."""

import pytest

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.model.reading import is_example, read_description, root_element

URDF = '<robot name="r"><link name="base"/></robot>'


@pytest.mark.parametrize(
    ("content", "root"),
    [
        (b'<?xml version="1.0"?><!-- <robot/> --><mujoco model="m"/>', "mujoco"),
        (URDF.encode("utf-16"), "robot"),
        (b"\xef\xbb\xbf<sdf version='1.6'/>", "sdf"),
        (b"t,x\n0,1\n", ""),
        (b"", ""),
        (b"<robot", ""),
    ],
)
def test_the_root_element_is_found(content, root):
    assert root_element(content) == root


def test_entities_are_not_expanded_to_find_the_root():
    levels = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 40}">' for k in range(1, 9))
    bomb = f'<!DOCTYPE r [<!ENTITY e0 "x">{levels}]><robot name="r">&e8;</robot>'
    assert root_element(bomb.encode()) == "robot"
    with pytest.raises(ModelError, match="declares an entity"):
        read_description_of(bomb)


def read_description_of(text, name="file"):
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        (path := Path(folder, name)).write_text(text)
        return read_description(path)


def test_a_urdf_may_be_called_whatever():
    found = read_description_of(URDF, "robot.xml")
    assert list(found.links) == ["base"]
    assert found.where.endswith("robot.xml")


def test_other_files_are_refused_with_the_formats_there_are():
    with pytest.raises(ModelError, match=r"the root element is <svg>; allowed: .*URDF.*MJCF"):
        read_description_of("<svg/>")
    with pytest.raises(ModelError, match="not well-formed"):
        read_description_of("t,x\n0,1\n")


def test_a_file_that_is_called_as_an_example_is_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert is_example("example:panda")
    assert not is_example("panda.urdf")
    (tmp_path / "example:panda").write_text(URDF)
    assert list(read_description("example:panda").links) == ["base"]
    with pytest.raises(BadInput, match="unknown example"):
        read_description("example:nothing")
