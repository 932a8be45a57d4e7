"""MuJoCo as an engine: compiled, placed, driven step by step, recorded.

The only place of these packages that simulates with MuJoCo; what needs it imports this late.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import ModuleType

import numpy as np
import pinocchio as pin

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.numeric.workers import silent
from thesis_pin.simulation.states import States


def engine_module() -> ModuleType:
    """MuJoCo itself.

    Raises:
        BadInput: It isn't installed.
    """
    try:
        import mujoco
    except ImportError as error:
        raise BadInput(
            f"the second engine, MuJoCo, can't be imported ({error})",
            remedy="pip install 'thesis-pin[simulate]'",
        ) from None
    return mujoco  # type: ignore[no-any-return]


@dataclass(frozen=True)
class Recording:
    """What an engine did, at its recorded instants.

    Attributes:
        time: [s], shape ``(n,)``.
        q, v: As Pinocchio counts them, ``(n, nq)`` and ``(n, nv)``.
        torque: Of the drives [N·m] or [N], ``(n, drives)``.
        seen: What was watched at each instant, ``(n, ...)``; empty if nothing was.
    """

    time: np.ndarray
    q: np.ndarray
    v: np.ndarray
    torque: np.ndarray
    seen: np.ndarray


class Engine:
    """A compiled world with one robot in it.

    Args:
        text: Its MJCF, by :func:`thesis_pin.simulation.mjcf.mjcf`.
        tree: The tree that it was made from.

    Attributes:
        model, data: MuJoCo's own.
        states: Translates between both countings.

    Raises:
        BadInput: MuJoCo isn't installed.
        ModelError: It refuses the text.
    """

    def __init__(self, text: str, tree: pin.Model) -> None:
        self.mujoco = engine_module()
        try:
            self.model = self.mujoco.MjModel.from_xml_string(text)
        except ValueError as error:
            raise ModelError(f"MuJoCo refuses the robot ({error})", where=tree.name) from None
        self.data = self.mujoco.MjData(self.model)
        self.states = States(tree, self.model)

    @property
    def time_step(self) -> float:
        """Of the engine [s]."""
        return float(self.model.opt.timestep)

    def place(self, q: np.ndarray, v: np.ndarray | None = None, time: float = 0.0) -> None:
        """Put the robot somewhere: q ``(nq,)``, v ``(nv,)`` or None for rest, time [s]."""
        self.mujoco.mj_resetData(self.model, self.data)
        self.data.time = time
        self.data.qpos[:] = self.states.qpos(q)
        if v is not None:
            self.data.qvel[:] = self.states.qvel(q, v)
        self.mujoco.mj_forward(self.model, self.data)

    def inverse(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
        """Generalized forces of a motion by the engine itself, ``(nv,)``, as Pinocchio counts.

        Contacts, friction and damping are left out of it: they are its forces, not the robot's.
        """
        self.place(q, v)
        self.data.qacc[:] = self.states.qacc(q, v, a)
        self.mujoco.mj_inverse(self.model, self.data)
        taken = self.data.qfrc_inverse + self.data.qfrc_constraint + self.data.qfrc_passive
        found: np.ndarray = self.states.force(q, taken)
        return found

    @contextmanager
    def _listening(self) -> Iterator[list[str]]:
        """Take what MuJoCo warns of: it would write to standard error and a log file."""
        said: list[str] = []
        before = self.mujoco.get_mju_user_warning()
        self.mujoco.set_mju_user_warning(lambda message: said.append(str(message)))
        try:
            yield said
        finally:
            self.mujoco.set_mju_user_warning(before)

    def state(self) -> tuple[np.ndarray, np.ndarray]:
        """Where it is and how it moves, as Pinocchio counts: ``(nq,)``, ``(nv,)``."""
        q = self.states.q(self.data.qpos)
        return q, self.states.v(q, self.data.qvel)

    def run(
        self,
        asked: np.ndarray,
        *,
        every: int = 1,
        before: Callable[[], object] | None = None,
        after: Callable[[], object] | None = None,
        watch: Callable[[], np.ndarray] | None = None,
        progress: Callable[[int, int], None] = silent,
    ) -> Recording:
        """Go on for as many steps as the drives are asked for something.

        Args:
            asked: Of each drive at each step, ``(steps, drives)``; see
                :class:`thesis_pin.simulation.mjcf.Drive`.
            every: Steps from one recorded instant to the next; the first and, where it fits,
                the last instant are recorded.
            before: Called before each step, as to limit forces by speeds.
            after: Called after each step, before what it found is overwritten.
            watch: What else to record at an instant.
            progress: Called with the steps done and their total.

        Raises:
                ModelError: The engine's numbers overflow, or contacts are too many for it.
        """
        model, data, step = self.model, self.data, self.mujoco.mj_step
        count = len(asked) // every + 1
        time, torque = np.empty(count), np.empty((count, model.nu))
        qpos, qvel = np.empty((count, model.nq)), np.empty((count, model.nv))
        seen = []
        with self._listening() as said:
            for k in range(len(asked) + 1):
                if k % every == 0:
                    n = k // every
                    time[n], qpos[n], qvel[n] = data.time, data.qpos, data.qvel
                    torque[n] = data.actuator_force
                    if watch is not None:
                        seen.append(watch())
                    progress(k, len(asked))
                if k == len(asked):
                    break
                data.ctrl[:] = asked[k]
                if before is not None:
                    before()
                step(model, data)
                if after is not None:
                    after()
                if said:
                    raise ModelError(
                        f"MuJoCo gives up at t = {data.time:.4g} s ({said[0]})",
                        remedy="Take a shorter time step, or softer drives",
                    )
        q = self.states.q(qpos)
        return Recording(time, q, self.states.v(q, qvel), torque, np.array(seen))
