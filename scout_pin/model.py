"""``load()`` → the biped: Pinocchio model, index maps, coordinates, kinematics."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pinocchio as pin

from scout_pin.kinematics import forward
from scout_pin.kinematics import inverse as kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from scout_pin.urdf import meshes, urdf
from thesis_pin.contacts.cones import Contact
from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.model.inertia import Reading
from thesis_pin.model.loading import LoadedRobot, frame_id, joint_id, model_folder
from thesis_pin.numeric.arrays import check_rigid, finite_array, pose_array, together
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.rotations import euler_placement, euler_rate_matrix, invert, quaternions
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

PACKAGE_PATH = str(model_folder("scout"))
URDF_PATH = str(Path(PACKAGE_PATH) / "scout.urdf")

Root = Literal["free_flyer", "thesis"]


def load(
    specification: Specification | str | Path | None = None,
    *,
    root: Root = "free_flyer",
    inertia: Reading = "physical",
) -> Scout:
    """Load a Scout-like biped.

    Args:
        specification: A specification, the path of one, or None for the thesis's robot.
        root: ``"free_flyer"`` (nq 19, nv 18, Pinocchio's usual floating base) or
            ``"thesis"`` (nq = nv = 18: x_B, y_B, z_B, θ_B, φ_B, ψ_B, then the joints,
            so q is the thesis's vector (4.2)).
        inertia: ``"physical"`` or ``"printed"``; see :mod:`thesis_pin.model.inertia`.

    Returns:
        The robot.

    Raises:
        SpecificationError: The specification is invalid.
        NonPhysicalInertia: A link's inertia is impossible.
        UnknownName: ``root`` or ``inertia`` isn't one of the above.
    """
    if not isinstance(specification, Specification):
        specification = Specification.read(specification)
    choice("root", root, ("free_flyer", "thesis"))
    choice("inertia", inertia, ("physical", "printed"))
    return Scout(specification, root, inertia)


def _thesis_root() -> list[tuple[str, Any]]:
    """Translations along x, y, z, then rotations about x, y, z (thesis 3.1).

    Six joints, not one composite joint: on a composite, Pinocchio 4.1's
    computeCoriolisMatrix doesn't give the Coriolis terms of nonLinearEffects.
    """
    return [
        ("torso_x", pin.JointModelPX()),
        ("torso_y", pin.JointModelPY()),
        ("torso_z", pin.JointModelPZ()),
        ("torso_pitch", pin.JointModelRX()),
        ("torso_roll", pin.JointModelRY()),
        ("torso_yaw", pin.JointModelRZ()),
    ]


class Scout(LoadedRobot):
    """A biped of Scout's kind, in Pinocchio and in closed form.

    Joint vectors have twelve entries in the order of :data:`JOINT_NAMES`: left
    leg from hip to foot, then right. They are the last twelve entries of q and v.

    Attributes:
        specification: The numbers it was made from.
        root: ``"free_flyer"`` or ``"thesis"``.
        inertia: Reading of the printed inertias.
        legs: Leg geometries by side.
        sole_frames: Pinocchio frame index of each sole, by side.
        lower, upper: Joint limits [rad], each ``(12,)``.
        stall_torque, no_load_speed: Servo limits [N·m], [rad/s], each ``(12,)``.
    """

    def __init__(self, specification: Specification, root: Root, inertia: Reading) -> None:
        joint = pin.JointModelFreeFlyer() if root == "free_flyer" else _thesis_root()
        super().__init__(urdf(specification, inertia), meshes(specification), joint)
        self.specification, self.root, self.inertia = specification, root, inertia
        self.legs = {side: LegGeometry.of(specification, side) for side in SIDES}
        self.sole_frames = {side: frame_id(self.model, f"{side}_sole") for side in SIDES}
        self.lower, self.upper = specification.assumptions.joint_range.radians()
        self.stall_torque, self.no_load_speed = specification.servo_limits()
        order = [self.model.joints[joint_id(self.model, name)].idx_v for name in JOINT_NAMES]
        if order != list(range(6, 18)):
            raise RuntimeError(f"Pinocchio reordered the joints: {order}")

    @functools.cached_property
    def pool(self) -> pin.ModelPool:
        """What Pinocchio's batched algorithms work on."""
        return pin.ModelPool(self.model, 1)

    @functools.cached_property
    def contacts(self) -> tuple[Contact, Contact]:
        """What the floor can do to each sole, left then right."""
        friction = self.specification.assumptions.floor_friction.coefficient
        left, right = (np.array(self.specification.leg(side).sole) for side in SIDES)
        return Contact.from_outline(left, friction), Contact.from_outline(right, friction)

    @property
    def mass(self) -> float:
        """Mass of the whole robot [kg]."""
        return self.specification.mass

    # -- coordinates ---------------------------------------------------------

    def to_free_flyer(
        self, q: Any, v: Any = None, a: Any = None
    ) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
        """Thesis coordinates (4.2) and their derivatives → free-flyer q, v, a.

        Args:
            q: Thesis vector, shape ``(..., 18)``.
            v: q̇, shape ``(..., 18)``.
            a: q̈, shape ``(..., 18)``; needs v.

        Returns:
            q ``(..., 19)``, v ``(..., 18)``, a ``(..., 18)``; the root's velocity is
            linear then angular, in the torso's axes, as Pinocchio has it.
        """
        q, rates, second = _motion(finite_array("q", q, 18), v, a)
        matrix, omega, alpha = euler_placement(
            "xyz", q[..., 3:6], rates[..., 3:6], second[..., 3:6]
        )
        position = np.concatenate([q[..., :3], quaternions(matrix), q[..., 6:]], axis=-1)
        if v is None:
            return position, None, None
        v, a = rates, None if a is None else second
        local = _in_axes(matrix, np.stack([v[..., :3], omega], axis=-2))
        velocity = np.concatenate([local[..., 0, :], local[..., 1, :], v[..., 6:]], axis=-1)
        if a is None:
            return position, velocity, None
        local_a = _in_axes(matrix, np.stack([a[..., :3], alpha], axis=-2))
        # Pinocchio differentiates the components in the moving axes.
        linear = local_a[..., 0, :] - np.cross(local[..., 1, :], local[..., 0, :])
        acceleration = np.concatenate([linear, local_a[..., 1, :], a[..., 6:]], axis=-1)
        return position, velocity, acceleration

    def to_thesis(
        self, q: Any, v: Any = None, a: Any = None
    ) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
        """Free-flyer q, v, a → thesis coordinates (4.2) and their derivatives.

        Args:
            q: Shape ``(..., 19)``.
            v: Shape ``(..., 18)``.
            a: Shape ``(..., 18)``; needs v.

        Returns:
            q, q̇, q̈, each ``(..., 18)``.

        Raises:
            SingularPose: φ_B = ±90°, where θ_B and ψ_B can't be told apart.
        """
        q, given, second = _motion(finite_array("q", q, 19), v, a)
        if not np.linalg.norm(q[..., 3:7], axis=-1).all():
            raise BadInput("a quaternion in q[3:7] is zero", allowed="unit quaternions")
        matrix = _rotation_matrix(q[..., 3:7])
        cosine = np.hypot(matrix[..., 0, 0], matrix[..., 0, 1])
        if (cosine < TOLERANCES.near_singular).any():
            k = int(np.argmax(np.atleast_1d(cosine) < TOLERANCES.near_singular))
            raise SingularPose(
                "φ_B is ±90°, where θ_B and ψ_B turn about the same axis",
                where=f"sample {k}",
                remedy='Use root="free_flyer"',
            )
        angles = np.stack(
            [
                np.arctan2(-matrix[..., 1, 2], matrix[..., 2, 2]),
                np.arctan2(matrix[..., 0, 2], cosine),
                np.arctan2(-matrix[..., 0, 1], matrix[..., 0, 0]),
            ],
            axis=-1,
        )
        position = np.concatenate([q[..., :3], angles, q[..., 7:]], axis=-1)
        if v is None:
            return position, None, None
        v, a = given, None if a is None else second
        linear = np.einsum("...ij,...j->...i", matrix, v[..., :3])
        omega = np.einsum("...ij,...j->...i", matrix, v[..., 3:6])
        inverse = np.linalg.inv(euler_rate_matrix("xyz", angles))
        rates = np.einsum("...ij,...j->...i", inverse, omega)
        velocity = np.concatenate([linear, rates, v[..., 6:]], axis=-1)
        if a is None:
            return position, velocity, None
        moving = a[..., :3] + np.cross(v[..., 3:6], v[..., :3])
        bias = euler_placement("xyz", angles, rates, np.zeros(rates.shape))[2]
        alpha = np.einsum("...ij,...j->...i", matrix, a[..., 3:6])
        second = np.einsum("...ij,...j->...i", inverse, alpha - bias)
        linear = np.einsum("...ij,...j->...i", matrix, moving)
        return position, velocity, np.concatenate([linear, second, a[..., 6:]], axis=-1)

    # -- kinematics ----------------------------------------------------------

    def leg_inverse_kinematics(
        self, side: str, torso_to_foot: Any, reference: Any = None
    ) -> kinematics.LegSolutions:
        """All branches of one leg.

        See :func:`scout_pin.kinematics.inverse.leg_inverse_kinematics`.
        """
        return kinematics.leg_inverse_kinematics(self._leg(side), torso_to_foot, reference)

    def inverse_kinematics(
        self, torso: Any, left_foot: Any, right_foot: Any, reference: Any = None
    ) -> np.ndarray:
        """Joint angles that bring both soles to their places, one branch a leg.

        The branch is the one nearest the reference that exists and keeps the joint
        limits. Without a reference, a stack is a trajectory along its first axis:
        if one branch is valid throughout it is kept, the one with the smallest
        first angles if there are several; otherwise each sample takes the branch
        nearest the sample before.

        Args:
            torso: Torso in the world: ``pin.SE3``, sequence, or ``(..., 4, 4)``.
            left_foot: Left sole in the world, likewise.
            right_foot: Right sole in the world, likewise.
            reference: Angles [rad], ``(12,)`` for a start or ``(..., 12)`` for each pose.

        Returns:
            Angles [rad], shape ``(..., 12)``.

        Raises:
            Unreachable: Some pose has no valid branch; says which and why.
            BadInput: Wrong shape, NaN or not a rigid placement.
        """
        placements = [
            pose_array(name, pose)
            for name, pose in (
                ("torso", torso),
                ("left_foot", left_foot),
                ("right_foot", right_foot),
            )
        ]
        try:
            np.broadcast_shapes(*(place.shape for place in placements))
        except ValueError:
            shapes = ", ".join(str(place.shape) for place in placements)
            raise BadInput(
                f"torso and feet have shapes {shapes}", allowed="equal stacks, or single poses"
            ) from None
        given = None if reference is None else finite_array("reference", reference, 12)
        world_to_torso = invert(placements[0])
        sides = []
        for number, side in enumerate(SIDES):
            start = None if given is None else given[..., 6 * number : 6 * number + 6]
            target = world_to_torso @ placements[number + 1]
            sides.append(kinematics.one_branch(self.legs[side], side, target, start))
        return np.concatenate(np.broadcast_arrays(*sides), axis=-1)

    def follow(
        self,
        torso: BodyMotion,
        left_foot: BodyMotion,
        right_foot: BodyMotion,
        reference: np.ndarray | None = None,
    ) -> np.ndarray:
        """Joint angles along a motion ``(n, 12)``: :meth:`inverse_kinematics`, only faster.

        Args:
            torso: Motion of the torso.
            left_foot: Motion of the left sole.
            right_foot: Motion of the right sole.
            reference: Angles the first sample is to be near [rad], ``(12,)``.

        Raises:
            Unreachable: Some sample has no valid branch; says which and why.
            BadInput: A rotation isn't one.
        """
        angles: list[np.ndarray] = []
        for side, foot in zip(SIDES, (left_foot, right_foot), strict=True):

            def entries(part: slice, foot: BodyMotion = foot, side: str = side) -> np.ndarray:
                found = foot.part(part).entries_in(torso.part(part))
                check_rigid(f"{side} foot", found, found.shape[1:], part.start)
                return found

            start = None if reference is None else reference[6 * len(angles) :][:6]
            found = kinematics.follow_branch(self.legs[side], len(foot.position), entries, start)
            if found is None:
                return self.inverse_kinematics(
                    torso.placement, left_foot.placement, right_foot.placement, reference
                )
            angles.append(found)
        return np.concatenate(angles, axis=1)

    def leg_forward_kinematics(self, side: str, theta: Any) -> np.ndarray:
        """Sole in the torso frame from six angles, ``(..., 6)`` → ``(..., 4, 4)``."""
        return forward.leg_forward_kinematics(self._leg(side), finite_array("theta", theta, 6))

    def forward_kinematics(self, theta: Any, torso: Any = None) -> dict[str, np.ndarray]:
        """Soles in the world from twelve angles.

        Args:
            theta: Joint angles [rad], shape ``(..., 12)``.
            torso: Torso in the world, ``(..., 4, 4)`` or ``pin.SE3``; None is the origin.

        Returns:
            Placement of each sole by side, shape ``(..., 4, 4)``.
        """
        theta = finite_array("theta", theta, 12)
        base = np.eye(4) if torso is None else pose_array("torso", torso)
        return {
            side: base @ self.leg_forward_kinematics(side, theta[..., 6 * k : 6 * k + 6])
            for k, side in enumerate(SIDES)
        }

    def sole_vertices(self, side: str, foot: Any) -> np.ndarray:
        """Corners of a sole in the world [m]: ``(..., 4, 4)`` → ``(..., corners, 3)``.

        Source: Scout thesis, 3.1 (last equation) and B.4.
        """
        placement = pose_array("foot", foot)
        outline = np.array(self.specification.leg(choice("side", side, SIDES)).sole)
        turned = np.einsum("...ij,kj->...ki", placement[..., :3, :2], outline)
        return turned + placement[..., None, :3, 3]

    def neutral_feet(self) -> dict[str, np.ndarray]:
        """Soles in the torso frame with all servos neutral, by side."""
        return self.forward_kinematics(np.zeros(12))

    def _leg(self, side: str) -> LegGeometry:
        return self.legs[choice("side", side, SIDES)]


def _motion(q: np.ndarray, v: Any, a: Any) -> tuple[np.ndarray, ...]:
    """q, v and a checked and in one stack; what isn't given is zero."""
    if v is None and a is not None:
        raise BadInput("a is given without v", allowed="v alone, or both")
    v, a = (
        np.zeros(18) if x is None else finite_array(name, x, 18) for name, x in (("v", v), ("a", a))
    )
    return together(q=q, v=v, a=a)


def _rotation_matrix(quaternion: np.ndarray) -> np.ndarray:
    """Rotations of quaternions (x, y, z, w), not zero: ``(..., 4)`` → ``(..., 3, 3)``."""
    from scipy.spatial.transform import Rotation

    flat = Rotation.from_quat(quaternion.reshape(-1, 4)).as_matrix()
    return flat.reshape(*quaternion.shape[:-1], 3, 3)


def _in_axes(matrix: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Components of vectors ``(..., k, 3)`` in the axes of ``(..., 3, 3)``."""
    return np.einsum("...ji,...kj->...ki", matrix, vectors)
