"""A closed loop: two frames, and which components of their relative twist are forbidden.

A mask that forbids one turn is a universal joint, whose axes stand at right angles:

========== =================== ====================
forbidden  axis of the first   axis of the second
turn       frame               frame
========== =================== ====================
about z    x                   y
about x    y                   z
about y    z                   x
========== =================== ====================
"""

from __future__ import annotations

from dataclasses import dataclass

import pinocchio as pin

from thesis_pin.errors import BadInput

Mask = tuple[bool, bool, bool, bool, bool, bool]
"""Which of tx, ty, tz, rx, ry, rz of a relative twist are zero."""

POINT: Mask = (True, True, True, False, False, False)
WELD: Mask = (True, True, True, True, True, True)


@dataclass(frozen=True)
class Loop:
    """One closed loop: two frames of which some relative motions are forbidden.

    Attributes:
        name: Its name in reports.
        kind: The word for what closes it (``"3d"``: the origins coincide, ``"6d"``: the
            frames do, ``"hinge_z"``, …).
        frames: Names of the two frames.
        ids: Their indices in the model.
        rows: Which translations, then turns, of the second frame are forbidden, in the
            first frame's axes; all False for a rod.
        length: Distance of the origins that a rod keeps [m]; None for all other kinds.
    """

    name: str
    kind: str
    frames: tuple[str, str]
    ids: tuple[int, int]
    rows: Mask = POINT
    length: float | None = None

    @property
    def size(self) -> int:
        """Number of equations, 1 to 6."""
        return 1 if self.length is not None else sum(self.rows)

    @property
    def perpendicular(self) -> tuple[int, int] | None:
        """Axes of the first and the second frame at right angles, where one turn is forbidden."""
        if sum(self.rows[3:]) != 1:
            return None
        turn = self.rows[3:].index(True)
        return (turn + 1) % 3, (turn + 2) % 3

    def constraint_model(
        self, model: pin.Model
    ) -> pin.PointAnchorConstraintModel | pin.FrameAnchorConstraintModel:
        """The loop as a ``PointAnchorConstraintModel`` or ``FrameAnchorConstraintModel``.

        Its residual is the second frame seen from the first. Of a point anchor the
        Jacobian is d residual / dq in open configurations too; of a frame anchor
        only in closed ones (elsewhere it gives the relative twist, and d residual
        is that times the derivative of log6).

        Raises:
            BadInput: Pinocchio has no constraint of this kind.
        """
        self._refuse_unless_anchor()
        one, two = (model.frames[k] for k in self.ids)
        point, frame = pin.PointAnchorConstraintModel, pin.FrameAnchorConstraintModel
        kind = point if self.rows == POINT else frame
        return kind(model, one.parentJoint, one.placement, two.parentJoint, two.placement)

    def rigid_constraint_model(self, model: pin.Model) -> pin.RigidConstraintModel:
        """The loop as a ``RigidConstraintModel``, which ``constraintDynamics`` asks for.

        Raises:
            BadInput: Pinocchio has no constraint of this kind.
        """
        self._refuse_unless_anchor()
        one, two = (model.frames[k] for k in self.ids)
        three, six = pin.ContactType.CONTACT_3D, pin.ContactType.CONTACT_6D
        result = pin.RigidConstraintModel(
            three if self.rows == POINT else six,
            model,
            one.parentJoint,
            one.placement,
            two.parentJoint,
            two.placement,
            pin.ReferenceFrame.LOCAL,
        )
        result.name = self.name
        return result

    def _refuse_unless_anchor(self) -> None:
        if self.length is not None or self.rows not in (POINT, WELD):
            raise BadInput(
                f"Pinocchio has no constraint for loop {self.name!r} of kind {self.kind!r}",
                allowed="3d and 6d",
                remedy="The functions of thesis_pin.loops take every kind",
            )
