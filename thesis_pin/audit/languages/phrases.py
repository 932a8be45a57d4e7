"""Sentences in another language, from tables that a person wrote."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from thesis_pin.model.specification import Key, Strict, read_toml

_SPANISH = Path(__file__).with_name("spanish.toml")
"""What every thesis's errata say, in Spanish."""

_FIELD = re.compile(r"\{(\*?)(\w+)\}")


class _Phrase(Strict):
    en: str
    es: str


class _PhraseFile(Strict):
    phrase: tuple[_Phrase, ...] = ()
    template: tuple[_Phrase, ...] = ()

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        for name in ("phrase", "template"):
            known: set[str] = set()
            for k, phrase in enumerate(getattr(self, name)):
                if sorted(_FIELD.findall(phrase.en)) != sorted(_FIELD.findall(phrase.es)):
                    yield (name, k, "es"), "the translation has other fields", phrase.es
                if phrase.en in known:
                    yield (name, k, "en"), "used twice", phrase.en
                known.add(phrase.en)


@dataclass(frozen=True)
class Phrases:
    """Says English sentences in a language.

    Attributes:
        table: English → that language; empty for English. ``{name}`` in a phrase stands for
            anything, which is kept, ``{*name}`` for something that is translated in turn.
        templates: The same for sentences of a document, whose fields are filled afterwards.
        missing: Sentences asked for that the tables lack; they are left in English.
    """

    table: Mapping[str, str] = field(default_factory=dict)
    templates: Mapping[str, str] = field(default_factory=dict)
    missing: set[str] = field(default_factory=set)

    @classmethod
    def spanish(cls, *paths: Path) -> Phrases:
        """Spanish, from TOML files with tables ``phrase`` and ``template``.

        Args:
            *paths: What a thesis says, beside what every thesis's errata say.

        Raises:
            SpecificationError: A file breaks the schema, or a translation has other fields than
                what it translates.
        """
        table: dict[str, str] = {}
        templates: dict[str, str] = {}
        for path in (_SPANISH, *paths):
            file = read_toml("phrases", _PhraseFile, path)
            table |= {phrase.en: phrase.es for phrase in file.phrase}
            templates |= {phrase.en: phrase.es for phrase in file.template}
        return cls(table, templates)

    def __call__(self, text: str, **values: object) -> str:
        """A sentence; with values, a template and what belongs in its fields."""
        said = self.templates.get(text, None if self.table else text) if values else self._of(text)
        if said is None:
            self.missing.add(text)
            said = text
        return said.format(**values) if values else said

    def _of(self, text: str) -> str | None:
        """A sentence, or several with a semicolon or comma between; None if one is unknown."""
        whole = self._whole(text)
        if whole is not None:
            return whole
        for mark in ("; ", ", "):
            parts = text.split(mark)
            for k in range(len(parts) - 1, 0, -1):
                head = self._whole(mark.join(parts[:k]))
                tail = None if head is None else self._of(mark.join(parts[k:]))
                if tail is not None:
                    return f"{head}{mark}{tail}"
        return None

    def _whole(self, text: str) -> str | None:
        if not self.table or not re.search("[A-Za-z]", text):
            return text
        if text in self.table:
            return self.table[text]
        for pattern, other in self._patterns:
            match = pattern.fullmatch(text)
            said = self._filled(other, match.groupdict()) if match else None
            if said is not None:
                return said
        return None

    def _filled(self, other: str, values: Mapping[str, str]) -> str | None:
        """A translation with its fields filled; None if one of them can't be translated."""
        said = {
            name: self._of(values[name]) if star else values[name]
            for star, name in _FIELD.findall(other)
        }
        if None in said.values():
            return None
        return _FIELD.sub(lambda match: said[match[2]] or "", other)

    @cached_property
    def _patterns(self) -> list[tuple[re.Pattern[str], str]]:
        """Phrases with fields, as expressions that match a whole sentence; the longest first."""
        found = []
        for english in sorted(self.table, key=len, reverse=True):
            if _FIELD.search(english):
                parts = _FIELD.split(english)
                text = "".join(
                    re.escape(parts[k]) + (f"(?P<{parts[k + 2]}>.+?)" if k + 2 < len(parts) else "")
                    for k in range(0, len(parts), 3)
                )
                found.append((re.compile(text, re.DOTALL), self.table[english]))
        return found
