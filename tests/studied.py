"""A robot that is a bowl: its study costs nothing; it sleeps, warns, fails or dies as told."""

import os
import signal
import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from thesis_pin.errors import BadInput, ModelWarning
from thesis_pin.sweep.designs.making import combined, vary
from thesis_pin.sweep.designs.text import toml
from thesis_pin.sweep.result import Effort, Sweep
from thesis_pin.sweep.running.runner import chunks
from thesis_pin.sweep.running.work import work
from thesis_pin.sweep.study import Column

BASE = {
    "name": "bowl",
    "x": 1.0,
    "legs": {"left": {"length": 0.3}, "right": {"length": 0.4}},
    "kind": "round",
    "count": 3,
    "servos": {"HS-5475HB": {"torque": 0.4}, "a.b": {"torque": 1.0}},
    "beta": [1.0, 2.0, 3.0],
    "bodies": [{"mass": 1.0}, {"mass": 2.0}],
    "nothing": None,
}


@dataclass(frozen=True)
class Bowl:
    """``depth`` is (x − 1)² + length², ``width`` is x; some x do what ``does`` says."""

    does: Mapping[float, str] = field(default_factory=dict)
    folder: str = ""
    base: Mapping[str, object] = field(default_factory=lambda: BASE)
    columns: tuple[Column, ...] = (
        Column("good", kind="flag"),
        Column("depth", "m", "how deep", "less"),
        Column("width", "m", "how wide", "more"),
        Column("colour", kind="text"),
    )
    feasible: str = "good"
    aims: tuple[str, str] = ("depth", "width")
    version: str = "1"

    @property
    def inputs(self):
        return {"robot": "bowl", "judge": "its shape", "version": self.version}

    def judge(self, data):
        x = data["x"]
        if self.folder:
            (Path(self.folder) / f"pid-{os.getpid()}").touch()
        self._do(self.does.get(x, ""), x)
        length = data["legs"]["left"]["length"]
        depth = (x - 1.0) ** 2 / 3.0 + length**2
        return {"good": depth < 2.0, "depth": depth, "width": x, "colour": f"blue, {x:g}"}

    def _do(self, what, x):
        if what == "sleep":
            time.sleep(0.1)
        elif what == "warn":
            warnings.warn("it leaks", ModelWarning, stacklevel=1)
        elif what == "refuse":
            raise BadInput(f"x = {x:g} is\nno bowl", remedy="Take another")
        elif what == "break":
            raise ZeroDivisionError("a slip")
        elif what == "die":
            os.kill(os.getpid(), signal.SIGKILL)
        elif what == "die once":
            dead = Path(self.folder) / f"dead-{x}"
            if not dead.exists():
                dead.touch()
                os.kill(os.getpid(), signal.SIGKILL)

    def written(self, data, notes):
        return {"best.toml": toml(data, notes).encode()}


def swept(*texts, study=None):
    """A sweep of the bowl in this process."""
    study = study or Bowl()
    designs = combined([vary(study.base, text) for text in texts])
    rows = [row for task in chunks(designs) for row in work(study, designs, task).rows]
    return Sweep(study, designs, tuple(rows), Effort(1, None, len(rows), 1.0, 1.0))
