"""A path written down again in our own format."""

from __future__ import annotations

import json

import numpy as np

from pollard_pin.motion.path import ToolMotion
from thesis_pin.model.made_for import MadeFor


def path_toml(name: str, motion: ToolMotion, made_for: MadeFor | None = None) -> str:
    """Poses over time in our own format, to be splined with free ends.

    Args:
        name: The path's name.
        motion: Its samples.
        made_for: The robot it was made for; None says nothing.
    """
    lines = ["format = 1", f"name = {json.dumps(name)}", 'interpolation = "free"']
    lines += [made_for.toml] if made_for else []
    angles = np.degrees(motion.pose[:, 3:]) + 0.0
    for time, position, turned in zip(
        motion.time.tolist(), (motion.pose[:, :3] + 0.0).tolist(), angles.tolist(), strict=True
    ):
        lines += ["", "[[poses]]", f"time = {time!r}", f"position = {position!r}"]
        lines.append(f"orientation_deg = {turned!r}")
    return "\n".join(lines) + "\n"
