"""Files that ship and their checked forms."""

import runpy
import subprocess
import sys
from pathlib import Path
from typing import Literal

import pytest

from thesis_pin.errors import SpecificationError
from thesis_pin.model.shipped import checked_form, read_shipped
from thesis_pin.model.specification import read_toml
from thesis_pin.model.strict import Positive, Strict

SCRIPT = runpy.run_path(str(Path(__file__).parents[3] / "docs" / "shipped.py"))
SHIPPED = SCRIPT["SHIPPED"]
NAMES = [path.stem for path in SHIPPED]


class Part(Strict):
    """Something inside."""

    sizes: tuple[Positive, ...]
    named: dict[str, float] | None = None


class Whole(Strict):
    """Something read from a file."""

    kind: Literal["a", "b"]
    part: Part
    parts: tuple[Part, ...] = ()
    left_out: float | None = None


TEXT = """kind = "a"
part = { sizes = [1, 2.5], named = { x = 3 } }
parts = [{ sizes = [] }]
"""


def test_checked_forms_are_those_of_their_files():
    for path, text in SCRIPT["documents"]().items():
        assert path.read_text(encoding="utf-8") == text, f"{path} is stale: python docs/shipped.py"


@pytest.mark.parametrize("path", SHIPPED, ids=NAMES)
def test_what_ships_is_read_as_it_would_be_checked(path):
    kind, schema = SHIPPED[path]
    quick, checked = read_shipped(kind, schema, path), read_toml(kind, schema, path)
    assert quick == checked
    assert repr(quick) == repr(checked)  # with the types of all numbers


def test_a_checked_form_gives_the_same_object_without_pydantic(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text(TEXT)
    checked = read_toml("file", Whole, path)
    assert (checked.part.named, checked.parts[0].sizes) == ({"x": 3.0}, ())
    path.with_suffix(".json").write_text(checked_form(TEXT, checked))
    quick = read_shipped("file", Whole, path)
    assert repr(quick) == repr(checked)
    assert type(quick.part.named["x"]) is float


@pytest.mark.parametrize("form", [None, "", "[]", "{}", '{"crc32": 1, "content": {}}'])
def test_without_a_checked_form_of_its_very_text_a_file_is_checked(tmp_path, form):
    path = tmp_path / "one.toml"
    path.write_text(TEXT)
    if form is not None:
        path.with_suffix(".json").write_text(form)
    assert read_shipped("file", Whole, path) == read_toml("file", Whole, path)


def test_an_edited_file_is_checked_again(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text(TEXT)
    path.with_suffix(".json").write_text(checked_form(TEXT, read_toml("file", Whole, path)))
    path.write_text(TEXT.replace("2.5", "3.5"))
    assert read_shipped("file", Whole, path).part.sizes == (1.0, 3.5)
    path.write_text(TEXT.replace("2.5", "-2.5"))
    with pytest.raises(SpecificationError, match=r"one.toml:2: part.sizes\[1\]"):
        read_shipped("file", Whole, path)


@pytest.mark.parametrize(
    "code",
    [
        "import scout_pin; scout_pin.load().contacts",
        "import pollard_pin; pollard_pin.load()",
        "from scout_pin.motion.files import load_gait; load_gait('thesis-program')",
    ],
)
def test_what_ships_needs_neither_pydantic_nor_scipy(code):
    script = f"import sys\n{code}\nprint([m for m in ('pydantic', 'scipy') if m in sys.modules])"
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert ran.stdout == "[]\n"
