"""``load()`` → the robot: Pinocchio model, loops, motors, kinematics and dynamics."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, overload

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from pollard_pin.closure import CLOSURE_PATH as CLOSURE_PATH
from pollard_pin.closure import supplement
from pollard_pin.coordinates import pose_from_placement, tool_motion
from pollard_pin.implausible import implausible
from pollard_pin.kinematics import inverse as kinematics
from pollard_pin.kinematics.geometry import (
    DEFAULT_BRANCH,
    Branch,
    Geometry,
    branch_labels,
    one_branch,
)
from pollard_pin.kinematics.regular import check_regular
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.specification import ACTUATORS, JOINT_NAMES, PASSIVE, Specification
from pollard_pin.urdf import urdf
from thesis_pin.errors import ModelWarning
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import model_folder
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.shipped import is_shipped
from thesis_pin.numeric.arrays import finite_array, spread, together, vector
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.trajectory import JointTrajectory

if TYPE_CHECKING:  # inverse kinematics, and what a specification describes, need none of them
    from pollard_pin.kinematics.forward import Assemblies
    from pollard_pin.kinematics.screws import Posture
    from pollard_pin.kinematics.singularity import Actuation
    from thesis_pin.loops.kinematics import Mobility

PACKAGE_PATH = str(model_folder("pollard"))
URDF_PATH = str(Path(PACKAGE_PATH) / "pollard.urdf")
SHIPPED: dict[Reading, str] = {
    "physical": URDF_PATH,
    "printed": str(Path(PACKAGE_PATH) / "pollard_printed.urdf"),
}
"""The thesis's robot, by the reading of its inertias."""

Branches = Branch | Literal["all", "useful"] | Sequence[Branch]


def load(
    specification: Specification | str | Path | None = None, *, inertia: Reading = "physical"
) -> Pollard:
    """Load a Pollard-like robot.

    Args:
        specification: A specification, the path of one, or None for the thesis's robot.
        inertia: ``"physical"`` or ``"printed"``; see :mod:`thesis_pin.model.mechanism.inertia`.

    Returns:
        The robot. What nobody builds so, see :func:`pollard_pin.implausible.implausible`, is said
        as a :class:`~thesis_pin.errors.ModelWarning` each.

    Raises:
        SpecificationError: The specification is invalid.
        NonPhysicalInertia: A link's inertia is impossible.
        UnknownName: ``inertia`` isn't one of the above.
    """
    if not isinstance(specification, Specification):
        specification = Specification.read(specification)
    choice("inertia", inertia, ("physical", "printed"))
    for one in implausible(specification):
        warnings.warn(one, ModelWarning, stacklevel=2)
    return Pollard(specification, inertia)


class Pollard(ClosedRobot):
    """A three-chain robot of Pollard's kind, in Pinocchio and in closed form.

    Joint vectors have twelve entries in the order of :data:`JOINT_NAMES`, torques
    six in the order of :data:`ACTUATOR_NAMES`, poses six: x, y, z [m], ψ, θ, φ [rad].

    Attributes:
        specification: The numbers it was made from.
        inertia: Reading of the printed inertias.
        geometry: Lengths for the closed forms.
        lower, upper: Joint limits [rad], each ``(12,)``.
    """

    def __init__(self, specification: Specification, inertia: Reading) -> None:
        text = urdf(specification, inertia)
        shipped = is_shipped(text, SHIPPED[inertia])
        super().__init__(text, supplement(specification), ships=shipped)
        self.specification, self.inertia = specification, inertia
        self.geometry = Geometry.of(specification)
        self.lower, self.upper = self.geometry.lower, self.geometry.upper
        order = tuple(list(self.model.names)[1:])
        if order != JOINT_NAMES or tuple(self.passive.tolist()) != PASSIVE:
            raise RuntimeError(f"Pinocchio reordered the joints: {order}")
        if tuple(self.actuated) != ACTUATORS:
            raise RuntimeError(f"the closure file reordered the motors: {self.actuated}")

    @functools.cached_property
    def pool(self) -> pin.ModelPool:
        """What Pinocchio's batched algorithms work on."""
        return pin.ModelPool(self.model, 1)

    @property
    def mass(self) -> float:
        """Mass of everything that moves [kg]."""
        return self.specification.mass

    # -- kinematics ----------------------------------------------------------

    def inverse_kinematics(
        self, pose: ArrayLike, branch: Branches = DEFAULT_BRANCH, reference: ArrayLike | None = None
    ) -> Solutions:
        """Joint angles for poses; see :func:`pollard_pin.kinematics.inverse.inverse_kinematics`.

        Args:
            pose: (x, y, z, ψ, θ, φ), shape ``(..., 6)``.
            branch: One :class:`Branch`, several, ``"useful"`` (16) or ``"all"`` (128).
            reference: Angles that fill in what a singular pose leaves free; see
                :func:`pollard_pin.kinematics.inverse.inverse_kinematics`.

        Returns:
            Angles ``(..., 12)`` on one branch, ``(..., branches, 12)`` on several.
        """
        if isinstance(branch, Branch):
            return kinematics.inverse_kinematics(
                self.geometry, pose, (one_branch(branch),), reference
            )
        return kinematics.inverse_kinematics(
            self.geometry, pose, branch_labels(branch), reference, squeeze=False
        )

    @overload
    def forward_kinematics(self, motors: ArrayLike) -> Assemblies: ...
    @overload
    def forward_kinematics(self, motors: ArrayLike, reference: ArrayLike) -> np.ndarray: ...
    def forward_kinematics(
        self, motors: ArrayLike, reference: ArrayLike | None = None
    ) -> Assemblies | np.ndarray:
        """Assembly modes of motor angles ``(..., 6)`` [rad].

        Args:
            motors: Angles of the six motors, in the order of :data:`ACTUATOR_NAMES`.
            reference: Joint angles ``(12,)`` or ``(..., 12)``; picks the nearest mode.

        Returns:
            Every mode, as :class:`Assemblies`; or with a reference the angles
            ``(..., 12)`` of the nearest.
        """
        from pollard_pin.kinematics import forward

        modes = forward.forward_kinematics(self.geometry, motors)
        return modes if reference is None else modes.nearest(reference)

    def posture(self, q: ArrayLike) -> Posture:
        """Points and axes of configurations ``(..., 12)``."""
        from pollard_pin.kinematics.screws import Posture

        return Posture.of(self.geometry, finite_array("q", q, 12))

    def pose(self, q: ArrayLike) -> np.ndarray:
        """Pose of the spray tip, by chain 0: ``(..., 12)`` → ``(..., 6)``."""
        posture = self.posture(q)
        return pose_from_placement(posture.tip, posture.tool_rotation)

    def branch_of(self, q: ArrayLike) -> Branch:
        """Label of a closed configuration ``(12,)``."""
        from pollard_pin.kinematics import forward

        return forward.branch_of(self.geometry, vector("q", q, 12))

    def joint_motion(
        self,
        pose: ArrayLike,
        rate: ArrayLike,
        acceleration: ArrayLike | None = None,
        branch: Branch = DEFAULT_BRANCH,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Joint angles, rates and accelerations of a motion of the tool.

        Args:
            pose: Shape ``(..., 6)``.
            rate: Its time derivative, same shape.
            acceleration: Its second time derivative; None for zero.
            branch: Which solution.

        Returns:
            θ, θ̇, θ̈, each ``(..., 12)``.

        Raises:
            Unreachable: A pose has no solution on the branch within the limits.
            SingularPose: Rates don't exist at a pose.
        """
        solution = self.inverse_kinematics(pose, one_branch(branch)).require()
        return solution.angles, *self._derivatives(solution.angles, pose, rate, acceleration)

    def rates(
        self, pose: ArrayLike, rate: ArrayLike, branch: Branch = DEFAULT_BRANCH
    ) -> np.ndarray:
        """Joint rates ``(..., 12)``; see :meth:`joint_motion`."""
        return self.joint_motion(pose, rate, None, branch)[1]

    def accelerations(
        self,
        pose: ArrayLike,
        rate: ArrayLike,
        acceleration: ArrayLike,
        branch: Branch = DEFAULT_BRANCH,
    ) -> np.ndarray:
        """Joint accelerations ``(..., 12)``; see :meth:`joint_motion`."""
        return self.joint_motion(pose, rate, acceleration, branch)[2]

    def _derivatives(
        self, angles: np.ndarray, pose: ArrayLike, rate: ArrayLike, acceleration: ArrayLike | None
    ) -> tuple[np.ndarray, np.ndarray]:
        from pollard_pin.kinematics import rates

        shape = angles.shape[:-1]
        still = np.zeros(6)
        pose, rate, acceleration = (
            spread(name, finite_array(name, value, 6), shape).reshape(-1, 6)
            for name, value in (
                ("pose", pose),
                ("rate", rate),
                ("acceleration", still if acceleration is None else acceleration),
            )
        )
        tool = tool_motion(pose, rate, acceleration)
        v, a = rates.stack_rates(self.geometry, angles.reshape(-1, 12), tool)
        return v.reshape(*shape, 12), a.reshape(*shape, 12)

    def rate_jacobian(self, q: ArrayLike) -> np.ndarray:
        """Joint rates over the pose's rates at closed configurations, ``(..., 12, 6)``."""
        from pollard_pin.kinematics import singularity

        posture = self.posture(q)
        check_regular(self.geometry, posture.linkage)
        return singularity.rate_jacobian(posture, self.pose(q))

    def actuation(self, q: ArrayLike) -> Actuation:
        """Condition and determinants of the six motors' Jacobian at ``(..., 12)``."""
        from pollard_pin.kinematics import singularity

        posture = self.posture(q)
        check_regular(self.geometry, posture.linkage)
        return singularity.actuation(posture)

    def mobility(self, q: ArrayLike) -> Mobility:
        """Degrees of freedom by rank at one configuration ``(12,)``."""
        from thesis_pin.loops import kinematics as loops

        return loops.mobility(self, q)

    # -- dynamics ------------------------------------------------------------

    def forward_dynamics(self, q: ArrayLike, v: ArrayLike, torque: ArrayLike) -> np.ndarray:
        """Joint accelerations ``(..., 12)`` under six torques, the loops closed."""
        from thesis_pin.loops import dynamics as loop_dynamics

        return loop_dynamics.forward_dynamics(self, q, v, torque)

    def simulate(
        self,
        q: ArrayLike,
        v: ArrayLike,
        torque: Callable[[float, np.ndarray, np.ndarray], np.ndarray],
        duration: float,
        step: float = 1e-3,
    ) -> JointTrajectory:
        """Motion under six torques; see :func:`thesis_pin.loops.dynamics.simulate`."""
        from thesis_pin.loops import dynamics as loop_dynamics

        return loop_dynamics.simulate(self, q, v, torque, duration, step)

    def energy(self, q: ArrayLike, v: ArrayLike) -> np.ndarray:
        """Kinetic plus potential energy [J], shape ``(...)``."""
        q, v = together(q=finite_array("q", q, 12), v=finite_array("v", v, 12))
        data = self.model.createData()
        values = [
            pin.computeKineticEnergy(self.model, data, one, rate)
            + pin.computePotentialEnergy(self.model, data, one)
            for one, rate in zip(q.reshape(-1, 12), v.reshape(-1, 12), strict=True)
        ]
        return np.array(values).reshape(q.shape[:-1])
