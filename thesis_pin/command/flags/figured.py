"""``--figure``: which figures ``--out`` draws, by name or by their numbers in a thesis."""

from __future__ import annotations

import argparse
from collections.abc import Mapping

from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput, UnknownName


def add_figure(words: Words) -> None:
    """The option that chooses figures."""
    words.add_argument(
        "--figure",
        nargs="+",
        action="extend",
        metavar="NUMBER",
        help="of --out's figures write these only, by the thesis's numbers (Scout 5.1 to 5.3, "
        "Pollard 4.1 to 4.4) or by name",
    )


def chosen(arguments: argparse.Namespace, known: Mapping[str, str]) -> set[str]:
    """Names of the figures that the arguments ask for; all if they don't say.

    Args:
        arguments: With ``figure`` and ``out``.
        known: Names of all figures, each with its number in the thesis, or an empty text.

    Raises:
        BadInput: There is no such figure, or no folder to write it into.
    """
    if arguments.figure is None:
        return set(known)
    if not arguments.out:
        raise BadInput("--figure chooses among the files of --out", remedy="Add --out DIR")
    names = {number: name for name, number in known.items() if number}
    for one in arguments.figure:
        if one not in names and one not in known:
            listed = [f"{number} {name}".strip() for name, number in known.items()]
            raise UnknownName("figure", one, listed, where="--figure")
    return {names.get(one, one) for one in arguments.figure}


def without(
    files: Mapping[str, bytes], known: Mapping[str, str], keep: set[str]
) -> dict[str, bytes]:
    """Files of a report but for the figures that aren't to be kept."""
    drop = set(known) - keep
    return {
        name: content
        for name, content in files.items()
        if name.removeprefix("beside_").rpartition(".")[0] not in drop
    }
