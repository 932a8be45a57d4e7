"""How a running server of meshcat's is named."""

from __future__ import annotations

import re

ALLOWED = "tcp://HOST:PORT, as meshcat-server prints it (zmq_url)"
"""What a server is named by, for messages."""

_ADDRESS = re.compile(
    r"tcp://(\[[0-9a-f:.]{2,50}\]|[\w.-]{1,255}):[0-9]{1,5}|ipc://[^\0\s]{1,200}",
    re.ASCII | re.IGNORECASE,
)


def is_address(text: object) -> bool:
    """Whether a text names a server of meshcat's, as far as one can see."""
    return isinstance(text, str) and _ADDRESS.fullmatch(text) is not None
