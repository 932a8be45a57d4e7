"""The verb ``thesis-pin formats``: what of a robot's file is read?"""

from __future__ import annotations

import argparse

from thesis_pin.command.running import ExitCode
from thesis_pin.command.verbs import Answer, give
from thesis_pin.report.formats import document, summary


def run(arguments: argparse.Namespace) -> ExitCode:
    """Say what is read of each format, and what is passed over."""
    return give(arguments, lambda: Answer(document, summary))
