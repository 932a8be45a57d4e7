"""Work done by a user who isn't root, inside a folder that is all they can see."""

import os
import traceback
from collections.abc import Callable
from pathlib import Path

import pytest

NOBODY = 65534


def as_user(root: Path, work: Callable[[Path], str]) -> str:
    """What work says, done by an unprivileged user to whom a folder is ``/``."""
    if os.geteuid():
        return work(root)
    root.chmod(0o755)
    reading, writing = os.pipe()
    process = os.fork()
    if not process:
        try:
            os.chroot(root)
            os.chdir("/")
            os.setgroups([])
            os.setgid(NOBODY)
            os.setuid(NOBODY)
            said = work(Path("/"))
        except BaseException:
            said = "failed: " + traceback.format_exc()
        os.write(writing, said.encode())
        os._exit(0)
    os.close(writing)
    with open(reading, encoding="utf-8") as stream:
        said = stream.read()
    os.waitpid(process, 0)
    if said.startswith("failed: "):
        pytest.fail(said)
    return said
