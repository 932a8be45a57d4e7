"""What forbids a speed."""

from __future__ import annotations

from typing import Literal

Cause = Literal["zmp", "contact", "stall torque", "servo", "rate jump", "gap"]
CAUSES: tuple[Cause, ...] = ("zmp", "contact", "stall torque", "servo", "rate jump", "gap")
