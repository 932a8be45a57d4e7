"""Slips that several printed lines of the Pollard thesis share, explained.

Each explanation that can be computed is: ``tests/pollard_pin/thesis/test_causes.py``
follows the slip by an independent route and finds the printed lines.
"""

from __future__ import annotations

from pathlib import Path

from thesis_pin.audit.slips import read_causes

CAUSES = read_causes(Path(__file__).with_name("causes.toml"))
"""Name of each shared slip, as the data give it → what it is."""
