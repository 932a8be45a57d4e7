"""XML from bytes, with lines, within limits."""

import pytest

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.model.formats.xml import parse_xml
from thesis_pin.model.limits import LIMITS

NAME = "jambe_é"


def parse(content):
    return parse_xml("URDF", content, where="r.urdf")


@pytest.mark.parametrize("encoding", ["utf-8", "iso-8859-1", "utf-16", "cp1252"])
def test_bytes_are_read_in_the_encoding_they_declare(encoding):
    text = f'<?xml version="1.0" encoding="{encoding}"?>\n<robot name="{NAME}"/>'
    root, plain = parse(text.encode(encoding))
    assert root.get("name") == NAME
    assert parse(plain)[0].get("name") == NAME
    assert plain == text or encoding != "utf-8"


def test_text_has_left_its_encoding_behind():
    text = f'<?xml version="1.0" encoding="ISO-8859-1"?><robot name="{NAME}"/>'
    assert parse(text)[0].get("name") == NAME


def test_a_byte_order_mark_is_no_content():
    assert parse(b"\xef\xbb\xbf<robot/>")[1] == "<robot/>"


def test_elements_know_their_lines():
    root, _ = parse('<robot>\n<link\n name="a"/>\n\n<joint/></robot>')
    assert [element.line for element in root.iter()] == [1, 2, 5]


LAUGHS = '<!DOCTYPE r [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;">]><robot>&b;</robot>'


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("<robot", "not well-formed"),
        (b"<robot>\xff</robot>", "not well-formed"),
        ("<robot>\0</robot>", "not well-formed"),
        (
            b'<?xml version="1.0" encoding="x-none"?><robot/>',
            "not XML that can be read|unknown enc",
        ),
        ("", "not well-formed"),
        (LAUGHS, "declares an entity 'a'"),
        ("<a>" * (LIMITS.nesting + 1), r"r\.urdf:1: the URDF is nested deeper than 32"),
        ("<r>" + "\n<a/>" * LIMITS.elements + "</r>", r"r\.urdf:200001: .*more than 200,000"),
        ("<r>" + " " * LIMITS.urdf_bytes + "</r>", "larger than 16 MiB"),
    ],
    ids=["cut", "not UTF-8", "NUL", "encoding", "empty", "entities", "deep", "many", "large"],
)
def test_what_is_no_document_or_too_much_of_one_is_refused(content, says):
    with pytest.raises(ModelError, match=says) as caught:
        parse(content)
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize("content", [None, 1, ["<robot/>"]])
def test_what_is_neither_bytes_nor_text_is_refused(content):
    with pytest.raises(BadInput, match="its text"):
        parse(content)
