"""XML → elements that know their line, read from bytes and within limits."""

from __future__ import annotations

from xml.etree.ElementTree import Element as PlainElement
from xml.etree.ElementTree import TreeBuilder, tostring
from xml.parsers import expat

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import shown


class Element(PlainElement):
    """An element of a document.

    Attributes:
        line: Where it starts, from 1.
    """

    line: int = 0


class _Reader:
    """What happens at every event of the parser."""

    def __init__(self, kind: str, where: str, encoding: str | None, nesting: int) -> None:
        self.nesting = nesting
        self.kind, self.where = kind, where
        self.builder = TreeBuilder(element_factory=Element)
        self.depth = self.count = 0
        self.parser = expat.ParserCreate(encoding)
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.EntityDeclHandler = self.entity

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self.depth, self.count = self.depth + 1, self.count + 1
        if self.depth > self.nesting:
            self.refuse(f"is nested deeper than {self.nesting} levels")
        if self.count > LIMITS.elements:
            self.refuse(f"has more than {LIMITS.elements:,} elements")
        element = self.builder.start(tag, attributes)
        assert isinstance(element, Element)  # the factory's
        element.line = self.parser.CurrentLineNumber

    def end(self, tag: str) -> None:
        self.depth -= 1
        self.builder.end(tag)

    def entity(self, name: str, *_: object) -> None:
        # A few entities of entities make gigabytes, and no model needs one.
        self.refuse(f"declares an entity {shown(name)}; write its text out")

    def refuse(self, what: str) -> None:
        where = f"{self.where}:{self.parser.CurrentLineNumber}"
        raise ModelError(f"the {self.kind} {what}", where=where)


def parse_xml(
    kind: str,
    content: bytes | str,
    *,
    where: str,
    texts: bool = False,
    nesting: int = LIMITS.nesting,
) -> tuple[Element, str]:
    """Root element of a document, and the document's text.

    Args:
        kind: What the document is, for messages.
        content: Its bytes, in the encoding they declare; or its text.
        where: File, for messages.
        texts: Whether what stands between elements is kept.
        nesting: Levels of elements at most.

    Returns:
        The root, and the text; in other encodings than UTF-8 it is written anew.

    Raises:
        ModelError: It isn't well-formed, or passes a limit.
        BadInput: It is neither bytes nor text.
    """
    if not isinstance(content, bytes | str):
        raise BadInput(f"the {kind} is {shown(content)}", allowed="its text", where=where)
    # Text has left its encoding behind, whatever its first line still says.
    data = content.encode("utf-8", "surrogatepass") if isinstance(content, str) else content
    reader = _Reader(kind, where, "utf-8" if isinstance(content, str) else None, nesting)
    if texts:
        reader.parser.CharacterDataHandler = reader.builder.data
    if len(data) > LIMITS.urdf_bytes:
        size = f"{LIMITS.urdf_bytes / 2**20:g} MiB"
        raise ModelError(f"the {kind} is larger than {size}", where=where, allowed=size)
    try:
        reader.parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ModelError(f"not well-formed XML ({error})", where=where) from None
    except ModelError:
        raise
    except (LookupError, ValueError) as error:  # an encoding that Python doesn't have
        raise ModelError(f"not XML that can be read ({error})", where=where) from None
    root = reader.builder.close()
    assert isinstance(root, Element)
    if isinstance(content, str):
        return root, content
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = ""
    return root, text if _is_utf8(text) else canonical(root)


def canonical(root: Element) -> str:
    """The document as it was read: no declaration, comments or white space of its own."""
    return tostring(root, encoding="unicode")


def _is_utf8(text: str) -> bool:
    """Whether a text's declaration, if it has one, names UTF-8."""
    declaration = text.lstrip()[:200].partition("?>")[0].lower()
    return bool(text) and ("encoding" not in declaration or "utf-8" in declaration)
