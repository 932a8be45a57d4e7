"""Robots of example-robot-data by name."""

import pytest
from example_robots import urdf_files

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.model import examples as module
from thesis_pin.model.examples import example, examples, located, robots_folder
from thesis_pin.model.formats.reading import read


def test_a_part_of_a_name_is_answered_by_the_names_that_hold_it_first():
    with pytest.raises(
        UnknownName, match=r"allowed: talos_full_v2, .*talos_reduced_corrected, [^t]"
    ):
        example("talos")


def test_every_urdf_and_sdf_of_the_package_has_a_name():
    files = set(examples().values())
    assert set(urdf_files()) <= files
    assert sum(file.suffix == ".sdf" for file in files) == 5


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("solo12", "solo_description/robots/solo12.urdf"),
        ("cassie_v2", "cassie_description/robots/cassie_v2.sdf"),
        ("finger_edu_description", "finger_edu_description/robots/finger_edu.urdf"),
        ("anymal_b_simple_description/anymal", "anymal_b_simple_description/robots/anymal.urdf"),
    ],
)
def test_a_robot_is_named_by_stem_or_folder_or_both(name, file):
    assert example(name) == robots_folder() / file


@pytest.mark.parametrize("name", ["anymal", "panda_description"])
def test_several_robots_of_a_name_are_listed_as_they_can_be_named(name):
    with pytest.raises(BadInput, match=f"robots are called '{name}'") as caught:
        example(name)
    choices = caught.value.allowed.split(", ")
    assert len(choices) > 1
    for choice in choices:
        assert example(choice.removeprefix("example:")).is_file()


def test_unknown_robots_are_refused_with_those_there_are():
    with pytest.raises(UnknownName, match="unknown example 'pandda'") as caught:
        example("pandda")
    assert {"panda", "talos_reduced", "cassie"} <= set(caught.value.known)


@pytest.mark.parametrize(
    ("said", "meant"),
    [("talos", "talos_reduced"), ("g1", "g1_29dof_rev_1_0"), ("PANDDA", "panda")],
)
def test_of_many_robots_those_called_like_what_was_said_are_listed_first(said, meant):
    with pytest.raises(UnknownName) as caught:
        example(said)
    listed = caught.value.allowed.split(", ")
    assert listed.index(meant) < listed.index("alexander_v1.lowerBodyOnly")


@pytest.mark.parametrize("variable", ["CONDA_PREFIX", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"])
def test_other_ways_of_installing_it_are_found(tmp_path, monkeypatch, variable):
    def none(name):
        raise module.metadata.PackageNotFoundError(name)

    monkeypatch.setattr(module.metadata, "files", none)
    monkeypatch.setattr(module.util, "find_spec", lambda name: None)
    monkeypatch.setattr(module.sys, "path", [str(tmp_path)])
    monkeypatch.setattr(module.sys, "prefix", str(tmp_path))
    for one in module._ENVIRONMENT:
        monkeypatch.delenv(one, raising=False)
    with pytest.raises(BadInput, match=r"pip install example-robot-data"):
        robots_folder()
    folder = tmp_path / "env" / "share" / "example-robot-data" / "robots"
    folder.mkdir(parents=True)
    monkeypatch.setenv(variable, f"/nowhere:{tmp_path / 'env'}")
    assert robots_folder() == folder


def test_a_file_that_is_called_as_an_example_is_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert located("example:solo12") == example("solo12")
    assert located("solo12.urdf") == "solo12.urdf"
    assert read("example:solo12").name == "solo"
    (tmp_path / "example:solo12").write_text('<robot name="mine"><link name="base"/></robot>')
    assert read("example:solo12").name == "mine"
    with pytest.raises(BadInput, match="unknown example"):
        read("example:nothing")
