"""How the three commands read a command line: words before meanings."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import NoReturn

from thesis_pin.command.messages import clean

_NEGATIVE = re.compile(r"-(\d+\.?\d*|\.\d+)(e[-+]?\d+)?|-inf(inity)?|-nan", re.IGNORECASE)
"""Words that begin with a minus and are values all the same; ours to judge where not finite."""


class Parser(argparse.ArgumentParser):
    """A parser whose help keeps its lines and whose words are never guessed at."""

    def __init__(
        self, *, prog: str | None = None, description: str = "", epilog: str = "", help: str = ""
    ) -> None:
        super().__init__(
            prog=prog,
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        # argparse knows -1 and -0.5 but takes -1e-3 for a flag.
        self._negative_number_matcher = re.compile(f"(?:{_NEGATIVE.pattern})$", re.IGNORECASE)
        self.add_argument(
            "--debug",
            action="store_true",
            default=argparse.SUPPRESS,  # so that a verb's parser keeps what stood before it
            help="show the traceback of a mistake of ours",
        )

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> argparse.Namespace:
        """As argparse does, but refuse ``--flag=--``, of which argparse makes an empty list."""
        for word in sys.argv[1:] if args is None else args:
            if word.startswith("--") and word.endswith("=--"):
                self.error(f"argument {word[:-3]}: '--' is no value")
        return super().parse_args(args, namespace)

    def error(self, message: str) -> NoReturn:
        """As argparse does, but without what a terminal would obey."""
        super().error(clean(message))
