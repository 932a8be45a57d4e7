"""Frames, axes and the feet's Euler angles (3.1, 3.2)."""

from __future__ import annotations

import re

import numpy as np

from scout_pin.thesis.symbols import frames
from scout_pin.thesis.symbols.coordinates import Coordinates
from thesis_pin.equations.dual import Dual, vee
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.frames import Frames
from thesis_pin.equations.values import ZERO, Value, arctan2, matrix, scalar, vector

# The axes ω is made of (3.10): letter and number of each joint's axis vector.
JOINT_AXES = {"k0": 1, "j2": 2, "k4": 3, "k6": 4, "k8": 5, "i10": 6}
_EULER_AXES = {"itheta": 0, "jphi": 1, "kpsi": 2}


class Geometry(Coordinates):
    """Rotations, transforms, unit vectors, angles."""

    def turning(self, axis: str, argument: Node, indices: dict[str, str]) -> Frames:
        """Frames of a rotation by a joint's or an Euler angle."""
        return frames.of_rotation(axis, argument, indices)

    def _frames(self, symbol: Symbol, value: Value, i: str) -> Frames:
        return frames.of_symbol(symbol, value.tail)

    def _rate(self, frame: Dual) -> np.ndarray:
        """Ṙ Rᵀ of a frame."""
        slopes = frame.slopes
        total = sum(
            slopes[k][..., :3, :3] * self.state.v[..., k, None, None]
            for k in range(18)
            if k in slopes
        )
        return np.asarray(np.asarray(total) @ np.swapaxes(frame.rotation, -1, -2))

    def _body(self, sub: str) -> str | None:
        """Link whose frame the thesis numbers so: "B", "31" (link 2, left), "1" (sole)."""
        if sub == "B":
            return "B"
        if sub in ("1", "2"):
            return f"7{sub}"
        match = re.fullmatch(r"(1|3|5|7|9|11|14)([12])", sub)
        if not match:
            return None
        return f"{'7' if match[1] == '14' else (int(match[1]) + 1) // 2}{match[2]}"

    def _of_R(self, symbol: Symbol, i: str) -> Value | None:
        body = self._body(symbol.sub)
        if symbol.sup != "0" or symbol.dots or body is None:
            return None
        return matrix(self.state.frame(body).rotation)

    def _of_i(self, symbol: Symbol, i: str) -> Value | None:
        letter, sub = symbol.base, symbol.sub
        if not symbol.sup and frames.own_frame(letter + sub) is None:
            return None
        if symbol.dots:
            still = self.state.steady and (sub == "0" or not symbol.sup)
            return ZERO if still else None
        if sub == "0" or not symbol.sup:
            own = self.state.own(letter + sub)
            return vector(np.broadcast_to(own, np.broadcast_shapes(own.shape, (1, 1, 3))))
        if symbol.sup != "0":
            return None
        axis = self._axis(letter + sub)
        if axis is not None:
            return vector(axis)
        body = self._body(sub)
        return None if body is None else vector(self.state.turned(body, letter + sub))

    _of_j = _of_k = _of_i

    def _axis(self, name: str) -> np.ndarray | None:
        """Axis of a coordinate by its vector's name: "k01", "i102", "jphiB", "kpsi1"."""
        state = self.state
        for start, k in _EULER_AXES.items():
            if name == start + "B":
                return state.torso[-1].axis(3 + k)
            if name in (start + "1", start + "2"):
                return self._foot_axes(int(name[-1]))[..., k]
        joint = JOINT_AXES.get(name[:-1])
        if joint is None or name[-1] not in "12":
            return None
        i = int(name[-1])
        return state.legs[i][joint - 1].axis(5 + 6 * (i - 1) + joint)

    def _foot_angles(self, i: int) -> np.ndarray:
        """θ_i, φ_i, ψ_i with R_i = Rx(θ) Ry(φ) Rz(ψ), shape ``(N, J, 3)``."""
        R = self.state.legs[i][-1].rotation
        upright = np.sqrt(R[..., 0, 0] ** 2 + R[..., 0, 1] ** 2)
        return np.stack(
            [
                arctan2(-R[..., 1, 2], R[..., 2, 2]),
                arctan2(R[..., 0, 2], upright),
                arctan2(-R[..., 0, 1], R[..., 0, 0]),
            ],
            axis=-1,
        )

    def _foot_axes(self, i: int) -> np.ndarray:
        """The axes the foot's Euler angles turn about, as columns."""
        theta, phi = (self._foot_angles(i)[..., k] for k in (0, 1))
        zero, one = np.zeros_like(theta), np.ones_like(theta)
        first = [one, zero, zero]
        second = [zero, np.cos(theta), np.sin(theta)]
        third = [np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta) * np.cos(phi)]
        return np.stack([np.stack(axis, axis=-1) for axis in (first, second, third)], axis=-1)

    def _foot_angle(self, base: str, i: int, dots: int) -> Value | None:
        k = ("theta", "phi", "psi").index(base)
        if dots == 0:
            return scalar(self._foot_angles(i)[..., k])
        if dots > 1:
            return None
        omega = vee(self._rate(self.state.legs[i][-1]))
        return scalar(np.linalg.solve(self._foot_axes(i), omega[..., None])[..., k, 0])

    def _of_theta(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub in ("1", "2") and not symbol.sup:
            return self._foot_angle(symbol.base, int(symbol.sub), symbol.dots)
        return None if symbol.sup else self._coordinate(symbol.name, symbol.dots)

    _of_phi = _of_psi = _of_theta
