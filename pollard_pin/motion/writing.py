"""A path written down again in our own format."""

from __future__ import annotations

import json

import numpy as np

from pollard_pin.motion.path import ToolMotion


def path_toml(name: str, motion: ToolMotion) -> str:
    """Poses over time in our own format, to be splined with free ends.

    Args:
        name: The path's name.
        motion: Its samples.
    """
    lines = ["format = 1", f"name = {json.dumps(name)}", 'interpolation = "free"']
    angles = np.degrees(motion.pose[:, 3:]) + 0.0
    for time, position, turned in zip(
        motion.time.tolist(), (motion.pose[:, :3] + 0.0).tolist(), angles.tolist(), strict=True
    ):
        lines += ["", "[[poses]]", f"time = {time!r}", f"position = {position!r}"]
        lines.append(f"orientation_deg = {turned!r}")
    return "\n".join(lines) + "\n"
