"""``load()`` → the biped: Pinocchio model, index maps, coordinates, kinematics."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from scout_pin import coordinates
from scout_pin.implausible import implausible
from scout_pin.kinematics import choosing, following, forward, one_sample
from scout_pin.kinematics import inverse as kinematics
from scout_pin.kinematics.branches import Numbers, allowed_branches
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from scout_pin.urdf import meshes, urdf
from thesis_pin.contacts.cones import Contact as Contact
from thesis_pin.contacts.feet import sole_corners
from thesis_pin.errors import BadInput, ModelWarning
from thesis_pin.model.loading import LoadedRobot, frame_id, joint_id, model_folder
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.shipped import is_shipped
from thesis_pin.numeric.arrays import finite_array, pose_array, together
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.rotations import invert, quaternions
from thesis_pin.numeric.trajectory import BodyMotion

PACKAGE_PATH = str(model_folder("scout"))
URDF_PATH = str(Path(PACKAGE_PATH) / "scout.urdf")
SHIPPED: dict[Reading, str] = {
    "physical": URDF_PATH,
    "printed": str(Path(PACKAGE_PATH) / "scout_printed.urdf"),
}
"""The thesis's robot, by the reading of its inertias."""

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
        inertia: ``"physical"`` or ``"printed"``; see :mod:`thesis_pin.model.mechanism.inertia`.

    Returns:
        The robot. What nobody builds so, see :func:`scout_pin.implausible.implausible`, is said
        as a :class:`~thesis_pin.errors.ModelWarning` each.

    Raises:
        SpecificationError: The specification is invalid.
        NonPhysicalInertia: A link's inertia is impossible.
        UnknownName: ``root`` or ``inertia`` isn't one of the above.
    """
    if not isinstance(specification, Specification):
        specification = Specification.read(specification)
    choice("root", root, ("free_flyer", "thesis"))
    choice("inertia", inertia, ("physical", "printed"))
    for one in implausible(specification):
        warnings.warn(one, ModelWarning, stacklevel=2)
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
        text = urdf(specification, inertia)
        shipped = is_shipped(text, SHIPPED[inertia])
        super().__init__(text, meshes(specification), joint, ships=shipped)
        self.specification, self.root, self.inertia = specification, root, inertia
        self.legs = {side: LegGeometry.of(specification, side) for side in SIDES}
        self.sole_frames = {side: frame_id(self.model, f"{side}_sole") for side in SIDES}
        self.lower, self.upper = specification.assumptions.joint_range.radians()
        self.stall_torque, self.no_load_speed = specification.servo_limits()
        armature = np.array(self.model.armature)
        armature[6:] += specification.armature()
        self.model.armature = armature
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
        soles = [np.array(self.specification.leg(side).sole) for side in SIDES]
        left, right = (Contact.from_outline(sole, friction) for sole in soles)
        return left, right

    @property
    def mass(self) -> float:
        """Mass of the whole robot [kg]."""
        return self.specification.mass

    # -- coordinates ---------------------------------------------------------

    def to_free_flyer(
        self, q: ArrayLike, v: ArrayLike | None = None, a: ArrayLike | None = None
    ) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
        """Thesis coordinates → free-flyer q, v, a: :func:`scout_pin.coordinates.to_free_flyer`."""
        return coordinates.to_free_flyer(q, v, a)

    def to_thesis(
        self, q: ArrayLike, v: ArrayLike | None = None, a: ArrayLike | None = None
    ) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
        """Free-flyer q, v, a → thesis coordinates: :func:`scout_pin.coordinates.to_thesis`."""
        return coordinates.to_thesis(q, v, a)

    def configuration(self, torso: ArrayLike, angles: ArrayLike) -> np.ndarray:
        """Pinocchio's q of a torso's place and joint angles, for this robot's root.

        Args:
            torso: Torso in the world: ``pin.SE3``, sequence, or ``(..., 4, 4)``.
            angles: Joint angles [rad], shape ``(..., 12)``.

        Returns:
            Shape ``(..., 19)`` with a free-flyer root, ``(..., 18)`` with the thesis's.

        Raises:
            SingularPose: The root is the thesis's and φ_B = ±90°.
        """
        place, joints = pose_array("torso", torso), finite_array("angles", angles, 12)
        root = np.concatenate([place[..., :3, 3], quaternions(place[..., :3, :3])], axis=-1)
        root, joints = together(torso=root, angles=joints)
        q = np.concatenate([root, joints], axis=-1)
        return q if self.root == "free_flyer" else coordinates.to_thesis(q)[0]

    # -- kinematics ----------------------------------------------------------

    def leg_inverse_kinematics(
        self,
        side: str,
        torso_to_foot: ArrayLike,
        reference: ArrayLike | None = None,
        *,
        out: kinematics.LegSolutions | None = None,
    ) -> kinematics.LegSolutions:
        """All branches of one leg; where an angle is free, one member of each family.

        See :func:`scout_pin.kinematics.inverse.leg_inverse_kinematics`.
        """
        leg = self._leg(side)
        return kinematics.leg_inverse_kinematics(leg, torso_to_foot, reference, out=out)

    def leg_angles(
        self,
        side: str,
        torso_to_foot: ArrayLike,
        branch: str | None = None,
        reference: ArrayLike | None = None,
    ) -> np.ndarray:
        """One valid branch a pose, for one leg alone: ``(..., 6)``.

        See :func:`scout_pin.kinematics.following.leg_angles`.
        """
        return following.leg_angles(self._leg(side), torso_to_foot, branch, reference)

    def inverse_kinematics(
        self,
        torso: ArrayLike,
        left_foot: ArrayLike,
        right_foot: ArrayLike,
        reference: ArrayLike | None = None,
        *,
        branch: str | Sequence[str] | None = None,
    ) -> np.ndarray:
        """Joint angles that bring both soles to their places, one branch a leg.

        They are no Pinocchio q; :meth:`configuration` makes one of them.

        The branch is the one nearest the reference that exists and keeps the joint
        limits. Without a reference, a stack is a trajectory along its first axis, and
        both legs take branches of one shape that are valid throughout: knees the same
        way, hips the same way, nearest to the neutral pose at the first sample, knees
        forward where two are equally near. Where no shape serves both legs each takes
        its own nearest; where no branch is valid throughout each sample takes the
        one nearest the sample before.

        Args:
            torso: Torso in the world: ``pin.SE3``, sequence, or ``(..., 4, 4)``.
            left_foot: Left sole in the world, likewise.
            right_foot: Right sole in the world, likewise.
            reference: Angles [rad], ``(12,)`` for a start or ``(..., 12)`` for each pose.
            branch: What to choose from: the way the knees bend, ``"forward"`` or
                ``"backward"``, or the signs of one branch, as ``"+-+"``; for both legs or
                for each, as ``("+++", "-+-")``; None takes what the specification says,
                or near a reference any.

        Returns:
            Joint angles [rad], shape ``(..., 12)``.

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
        targets = [world_to_torso @ place for place in placements[1:]]
        allowed, legs = self.allowed_branches(branch, near=given is not None), self._legs
        if given is None:
            sides = choosing.both_legs(legs, targets, allowed)
        else:
            sides = [
                following.one_branch(leg, side, target, given[..., part], only)
                for leg, side, target, part, only in zip(
                    legs, SIDES, targets, (slice(0, 6), slice(6, 12)), allowed, strict=True
                )
            ]
        return np.concatenate(np.broadcast_arrays(*sides), axis=-1)

    def allowed_branches(
        self, branch: str | Sequence[str] | None, *, near: bool = False
    ) -> tuple[Numbers, Numbers]:
        """Which of :data:`scout_pin.BRANCHES` each leg may take, left then right.

        Args:
            branch: As in :meth:`inverse_kinematics`; None for what the specification says.
            near: Whether a reference is to decide where nobody asks.

        Raises:
            BadInput: There is no such branch.
        """
        asked = self.specification.branch_asked if branch is None and not near else branch
        return allowed_branches(self._legs, asked)

    def follow(
        self,
        torso: BodyMotion,
        left_foot: BodyMotion,
        right_foot: BodyMotion,
        reference: np.ndarray | None = None,
        *,
        branch: str | Sequence[str] | None = None,
    ) -> np.ndarray:
        """Joint angles along a motion ``(n, 12)``: :meth:`inverse_kinematics`, only faster.

        Args:
            torso: Motion of the torso.
            left_foot: Motion of the left sole.
            right_foot: Motion of the right sole.
            reference: Angles the first sample is to be near [rad], ``(12,)``.
            branch: As in :meth:`inverse_kinematics`.

        Raises:
            Unreachable: Some sample has no valid branch; says which and why.
            BadInput: A rotation isn't one.
        """
        allowed, legs = self.allowed_branches(branch, near=reference is not None), self._legs
        feet = (left_foot, right_foot)

        def entries(number: int) -> Callable[[slice], np.ndarray]:
            if torso.count == 1:  # asked for twice, and dearer than the rest
                found = one_sample.entries_in(feet[number], torso)
                return lambda part: found
            return lambda part: feet[number].part(part).entries_in(torso.part(part))

        both = (entries(0), entries(1))
        if reference is None:
            counts = (left_foot.count, right_foot.count)
            found = choosing.follow_both(legs, counts, both, allowed, checked=False)
        else:
            starts = (reference[:6], reference[6:])
            found = [
                following.follow_branch(leg, foot.count, of, start, only, f"{side} foot")
                for leg, side, foot, of, start, only in zip(
                    legs, SIDES, feet, both, starts, allowed, strict=True
                )
            ]
        angles = [one for one in found if one is not None]
        if len(angles) < 2:
            places = (torso.placement, left_foot.placement, right_foot.placement)
            return self.inverse_kinematics(*places, reference, branch=branch)
        return np.concatenate([one.T for one in angles]).T

    def leg_forward_kinematics(self, side: str, theta: ArrayLike) -> np.ndarray:
        """Sole in the torso frame from six angles, ``(..., 6)`` → ``(..., 4, 4)``."""
        return forward.leg_forward_kinematics(self._leg(side), finite_array("theta", theta, 6))

    def forward_kinematics(
        self, theta: ArrayLike, torso: ArrayLike | None = None
    ) -> dict[str, np.ndarray]:
        """Soles in the world from twelve angles.

        Args:
            theta: Joint angles [rad], shape ``(..., 12)``.
            torso: Torso in the world, ``(..., 4, 4)`` or ``pin.SE3``; None is the origin.

        Returns:
            Placement of each sole by side, shape ``(..., 4, 4)``.
        """
        angles = finite_array("theta", theta, 12)
        base = np.eye(4) if torso is None else pose_array("torso", torso)
        return {
            side: base @ self.leg_forward_kinematics(side, angles[..., 6 * k : 6 * k + 6])
            for k, side in enumerate(SIDES)
        }

    def sole_vertices(self, side: str, foot: ArrayLike) -> np.ndarray:
        """Corners of a sole in the world [m]: ``(..., 4, 4)`` → ``(..., corners, 3)``.

        Source: Scout thesis, 3.1 (last equation) and B.4.
        """
        placement = pose_array("foot", foot)
        outline = np.array(self.specification.leg(choice("side", side, SIDES)).sole)
        return sole_corners(outline, placement)

    def neutral_feet(self) -> dict[str, np.ndarray]:
        """Soles in the torso frame with all servos neutral, by side."""
        return self.forward_kinematics(np.zeros(12))

    @property
    def _legs(self) -> tuple[LegGeometry, LegGeometry]:
        return self.legs["left"], self.legs["right"]

    def _leg(self, side: str) -> LegGeometry:
        return self.legs[choice("side", side, SIDES)]
