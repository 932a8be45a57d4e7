"""A page of sliders: made once, then told where everything is."""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Callable, Iterable, Sequence
from typing import cast
from urllib.parse import urlsplit

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.checking.poses import pose_text
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import instance
from thesis_pin.pages import player
from thesis_pin.pages.live.alone import hooks
from thesis_pin.pages.live.hung import Places, items, samples
from thesis_pin.pages.live.layers import Layers
from thesis_pin.pages.live.rig import Rig, Stand
from thesis_pin.pages.scene import Item, Scene

Array = NDArray[np.float64]

PATH = "/pose"
"""Where a served page posts to."""


class LivePage:
    """A robot on a page, with sliders.

    Args:
        rig: What the sliders move.
        layers: What is drawn.
        title: Headline.
        command: What shows the page with sliders that move, for pages whose don't.
        forward: The way ahead on the floor, for the views.
        notes: What there is to say of the robot besides what its layers say.
    """

    def __init__(
        self,
        rig: Rig,
        layers: Layers,
        title: str,
        command: str,
        *,
        forward: tuple[float, float] = (1.0, 0.0),
        notes: Sequence[str] = (),
    ) -> None:
        self.rig, self.layers = rig, instance("layers", layers, Layers, "layers()")
        self.title, self._command, self._forward = title, command, forward
        self.notes = (*notes, *layers.notes)
        self._data = rig.robot.model.createData()
        self._lock = threading.Lock()  # requests come in threads of their own

    def scene(self) -> Scene:
        """The robot where it stands at first, at rest for a second."""
        stand = self.rig.start()
        model = self.rig.robot.model
        count = len(self.rig.sliders)
        return Scene(
            title=self.title,
            description=f"The robot {model.name} in one pose. {count} sliders beside it move it.",
            time=np.array([0.0, 1.0]),
            groups=self.layers.groups,
            items=self.items(stand),
            floor=self.layers.low - 0.02 * self.layers.size,
            forward=self._forward,
        )

    def items(self, stand: Stand) -> tuple[Item, ...]:
        """The scene's items where the robot stands."""
        model = self.rig.robot.model
        places = Places.of(model, model.createData(), stand.q)
        return items(self.layers.hung, places, stand.levels)

    def html(self, *, served: bool = False, meshcat: str = "") -> bytes:
        """The page; not served, it moves a robot without loops by itself, and shows another.

        Args:
            served: Whether a server answers it.
            meshcat: Address of meshcat's page, which then shows the robot in place of our own.
        """
        stand = self.rig.start()
        document = {
            "sliders": [
                {
                    "name": one.name,
                    "unit": one.unit,
                    "factor": one.factor,
                    "low": one.low,
                    "high": one.high,
                    "group": one.group,
                    "note": one.note,
                }
                for one in self.rig.sliders
            ],
            "choices": list(self.rig.choices),
            "notes": list(self.notes),
            "command": self._command,
            "stand": self.document(stand),
        }
        if not served:
            alone = self.rig.alone()
            known = isinstance(alone, str)
            document |= (
                {"why": alone} if known else {"tree": alone, "hooks": hooks(self.layers.hung)}
            )
        text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
        return player.render(
            "live.html",
            title=self.title,
            player_parts=None if meshcat else player.player_parts(self.scene()),
            meshcat=meshcat,
            frames=_origin(meshcat),
            unpack=player.web_file("unpack.js"),
            live=player.packed(text),
            script=player.web_file("tree.js") + player.web_file("live.js"),
            style=player.web_file("live.css"),
            served=served,
        )

    def document(self, stand: Stand) -> dict[str, object]:
        """Where the robot stands, for the page's script."""
        robot = self.rig.robot
        places = Places.of(robot.model, self._data, stand.q)
        digits = int(np.clip(9 - np.floor(np.log10(self.layers.size)), 3, 15))
        numbers = ", ".join(map(repr, stand.q.tolist()))
        return {
            "state": list(stand.state),
            "values": list(stand.values),
            "marks": list(stand.marks),
            "notes": list(stand.notes),
            "readouts": [list(pair) for pair in stand.readouts],
            "choice": stand.choice,
            "possible": list(stand.possible),
            "items": samples(self.layers.hung, places, stand.levels, digits),
            "toml": pose_text(robot, stand.q),
            "q": f"q = np.array([{numbers}])",
        }

    def answer(
        self, body: bytes, show: Callable[[Iterable[Item]], object] | None = None
    ) -> bytes | None:
        """What a posted request is answered: JSON; None if it makes no sense.

        Args:
            body: JSON with ``state`` and either ``slider`` and ``value`` or ``choice``; or with
                nothing, for where the robot stands at first.
            show: Is given the items where the robot stands then, one call after another.
        """
        try:
            asked = json.loads(body)
            with self._lock:
                stand = self._asked(asked)
                document = self.document(stand)
                if show is not None:
                    show(self.items(stand))
        except ThesisPinError as error:  # some are ValueErrors too
            document = {"error": str(error)}
        except (ValueError, TypeError, KeyError, IndexError, RecursionError, OverflowError):
            return None
        return json.dumps(document, separators=(",", ":"), allow_nan=False).encode()

    def _asked(self, asked: object) -> Stand:
        if asked == {}:
            return self.rig.start()
        request = cast("dict[str, object]", asked)
        told = cast("list[object]", request["state"])
        if not all(map(_is_number, told)):
            raise ValueError
        state = np.array(told, dtype=float)
        # Pinocchio's squares of larger numbers overflow, and NaN is no JSON.
        within = np.abs(state) <= LIMITS.magnitude
        if state.shape != (len(self.rig.start().state),) or not within.all():
            raise ValueError
        if "choice" in request:
            return self.rig.chosen(state, _index(request["choice"], len(self.rig.choices)))
        number = _index(request["slider"], len(self.rig.sliders))
        slider, value = self.rig.sliders[number], request["value"]
        if not _is_number(value):
            raise ValueError
        value = float(cast("float", value))
        return self.rig.moved(state, number, float(np.clip(value, slider.low, slider.high)))


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and value == value


def _origin(address: str) -> str:
    """Scheme, host and port of a page, for a policy; empty if they hold anything else."""
    place = urlsplit(address)
    origin = f"{place.scheme}://{place.netloc}"
    return origin if re.fullmatch(r"https?://[\w.:\[\]-]+", origin, re.ASCII) else ""


def _index(value: object, count: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < count:
        raise ValueError
    return value
