"""Pollard-like robots whose numbers are off, closed by Pinocchio alone: no closed form of ours."""

import numpy as np
import pinocchio as pin

from pollard_pin.specification import ACTUATORS, PASSIVE, Specification
from pollard_pin.study.accuracy.parameters import COLUMNS
from pollard_pin.urdf import ANCHOR_FRAMES, ROD_TIP_FRAMES, TOOL_FRAME, urdf

UNIT = {axis: np.eye(3)[k] for k, axis in enumerate("xyz")}


def changed(specification, errors):
    """A specification whose own keys are off: ``chain_1.x_87`` → error in SI."""
    data = specification.model_dump()
    for name, error in errors.items():
        chain, key = name.split(".")
        key, error = (f"{key}_deg", np.degrees(error)) if "beta" in key else (key, error)
        data[chain][key] += float(error)
    return Specification.model_validate(data)


class ClosedTree:
    """A robot with errors by name, as Pinocchio reads it."""

    def __init__(self, specification, errors):
        own = {name: error for name, error in errors.items() if name.startswith("chain_")}
        specification = changed(specification, own)
        self.model = pin.buildModelFromXML(urdf(specification))
        self.motors = np.zeros(12)
        moved = {}
        for name, error in errors.items():
            kind, _, rest = name.partition(".")
            if kind == "motor":
                self.motors[self.model.getJointId(rest) - 1] += error
            elif kind in ("axis", "offset"):
                joint, axis = rest.split(".")
                shift, turns = moved.setdefault(joint, (np.zeros(3), {}))
                if kind == "offset":
                    shift += error * UNIT[axis]
                else:
                    turns[axis] = error
        for joint, (shift, turns) in moved.items():
            rotation = np.eye(3)
            for axis in sorted(turns):
                rotation = rotation @ pin.exp3(turns[axis] * UNIT[axis])
            self._move(joint, shift, rotation, specification.chain_0.x_1918)
        self.data = self.model.createData()
        frames = zip(ANCHOR_FRAMES, ROD_TIP_FRAMES, strict=True)
        self.loops = [tuple(map(self.model.getFrameId, pair)) for pair in frames]
        self.tool = self.model.getFrameId(TOOL_FRAME)

    def _move(self, joint, shift, rotation, length):
        if joint == "nozzle":
            frame = self.model.frames[self.model.getFrameId(TOOL_FRAME)]
            frame.placement = pin.SE3(rotation, rotation @ [length, 0.0, 0.0] + shift)
        elif joint.startswith("ball_joint"):
            frame = self.model.frames[self.model.getFrameId(f"forearm_anchor_{joint[-1]}")]
            old = frame.placement
            frame.placement = pin.SE3(old.rotation, old.translation + shift)
        else:
            number = self.model.getJointId(joint)
            old = self.model.jointPlacements[number]
            assert np.allclose(old.rotation, np.eye(3))
            self.model.jointPlacements[number] = pin.SE3(rotation, old.translation + shift)

    def tool_at(self, planned):
        """Tip and spray direction with the motors at planned angles (12,), passive joints near."""
        q, passive = planned + self.motors, list(PASSIVE)
        assert not set(passive) & set(ACTUATORS)
        for _ in range(30):
            pin.computeJointJacobians(self.model, self.data, q)
            pin.updateFramePlacements(self.model, self.data)
            gap, rows = [], []
            for a, b in self.loops:
                gap.append(self.data.oMf[a].translation - self.data.oMf[b].translation)
                one, two = (
                    pin.getFrameJacobian(self.model, self.data, k, pin.LOCAL_WORLD_ALIGNED)[:3]
                    for k in (a, b)
                )
                rows.append(one - two)
            gap = np.concatenate(gap)
            if np.abs(gap).max() < 1e-14:
                break
            q[passive] -= np.linalg.solve(np.concatenate(rows)[:, passive], gap)
        assert np.abs(gap).max() < 1e-12
        place = self.data.oMf[self.tool]
        return np.concatenate([place.translation, place.rotation[:, 0]])


def of(name, error):
    """One error, as arrays of all columns ``(m, 1)``."""
    found = np.zeros((len(COLUMNS), 1))
    found[COLUMNS.index(name)] = error
    return found
