"""Pinocchio's own viewer of a robot in meshcat, with what Pinocchio doesn't draw beside it."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable

import numpy as np
import pinocchio as pin
from meshcat import Visualizer
from meshcat.geometry import TriangularMeshGeometry
from numpy.typing import ArrayLike, NDArray
from pinocchio.visualize import MeshcatVisualizer

from thesis_pin.errors import ModelWarning, ThesisPinError
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.drawing import joint_placements
from thesis_pin.pages.meshcat.collada import is_mixed
from thesis_pin.pages.meshcat.drawing import Drawing, word
from thesis_pin.pages.meshcat.shapes import shares
from thesis_pin.pages.meshcat.shown import Shown
from thesis_pin.pages.meshcat.stage import box_of, dress, floor_grid
from thesis_pin.pages.meshcat.window import visualizer
from thesis_pin.pages.meshes import seen
from thesis_pin.pages.robot import around, size_of
from thesis_pin.pages.scene import Item

Array = NDArray[np.float64]
Overlays = Callable[[Array], Iterable[Item]]
"""What stands beside a robot at configurations ``(n, nq)``: the same items at all of them."""


def viewer(robot: ClosedRobot, url: str | None = None) -> RobotViewer:
    """Any robot in meshcat, ready for ``display(q)``: its bodies or bars, and its loops.

    It stands in its neutral configuration at first, or in one nearby that closes its loops.

    Args:
        robot: The robot.
        url: Address of a running server, as ``tcp://127.0.0.1:6000``; None starts our own.

    Raises:
        BadInput: No server answers there.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    q0 = np.asarray(robot.q0)[None]
    size = size_of(joint_placements(robot.model, q0))
    bare = not seen(robot, "visual", []).ngeoms

    def overlays(q: Array) -> Iterable[Item]:
        return around(robot, q, size, bars=bare)

    return RobotViewer(robot, overlays, url, q=closed(robot))


def closed(robot: ClosedRobot) -> Array:
    """A configuration to begin with: its loops are closed, or the neutral one if none was found.

    Args:
        robot: The robot.
    """
    try:
        found = assembly(robot, None)
    except ThesisPinError:
        return np.asarray(robot.q0)
    return np.asarray(found.q if found.closed else robot.q0)


class RobotViewer(Shown, MeshcatVisualizer):  # type: ignore[misc] # Pinocchio has no types
    """Pinocchio's ``MeshcatVisualizer`` on a server of ours or a named one, its model loaded.

    All that Pinocchio's can do it does: ``display(q)``, ``play``, ``displayFrames``,
    ``displayCollisions``, ``captureImage``. No browser is opened and nothing printed.

    Args:
        robot: The robot; shapes whose meshes are missing are said and left out.
        overlays: What is drawn beside it and follows it.
        url: Address of a running server; None starts our own, which ends with this object.
        q: The configuration shown at first, shape ``(nq,)``; None for ``robot.q0``.
        floor: Height of the floor [m]; None for none.
        forward: The way ahead on the floor, for the camera.
        colour: Colour and opacity of a body by its name; None takes the model's own.

    Attributes:
        viewer: meshcat's own object, of the robot's node's parent.
    """

    def __init__(
        self,
        robot: LoadedRobot,
        overlays: Overlays,
        url: str | None = None,
        *,
        q: ArrayLike | None = None,
        floor: float | None = None,
        forward: tuple[float, float] = (1.0, 0.0),
        colour: Callable[[str], tuple[str, float]] | None = None,
    ) -> None:
        notes: list[str] = []
        collision, visual = (seen(robot, kind, notes) for kind in ("collision", "visual"))
        for note in notes:
            warnings.warn(note, ModelWarning, stacklevel=3)
        if colour is not None:
            visual = visual.copy()
            for one in visual.geometryObjects:
                paint, opacity = colour(one.name)
                one.meshColor = np.array([*shares(paint), opacity])
        super().__init__(robot.model, collision, visual)
        self._overlays, self._forward = overlays, forward
        self.initViewer(visualizer(url))
        try:
            self._load(np.asarray(robot.q0 if q is None else q, dtype=float), floor)
        except BaseException:
            self.close()
            raise

    def _load(self, q: Array, floor: float | None) -> None:
        # The stage first: the page is told in this order, and large meshes take it seconds.
        pin.forwardKinematics(self.model, self.data, q)
        pin.updateGeometryPlacements(self.model, self.data, self.visual_model, self.visual_data)
        box = self._box(q)
        if self.viewer.window.own:
            dress(self.viewer, box, self._forward)
        name = word(self.model.name)
        root = self.viewer[name]
        root.delete()
        if floor is not None:
            root["floor"].set_object(floor_grid(floor, box))
        self._drawing = Drawing(root)
        self.loadViewerModel(name)
        self.display(q)

    def _box(self, q: Array) -> Array:
        """Least and largest corner of what is to be seen, shape ``(2, 3)``."""
        beside = box_of(self._overlays(q[None]))
        low = [beside[0], *(place.translation for place in self.data.oMi)]
        high = [beside[1], *(place.translation for place in self.data.oMi)]
        for one, place in zip(self.visual_model.geometryObjects, self.visual_data.oMg, strict=True):
            one.geometry.computeLocalAABB()
            scale = np.abs(one.meshScale).max()
            middle = place.act(np.asarray(one.geometry.aabb_center) * one.meshScale)
            low.append(middle - scale * one.geometry.aabb_radius)
            high.append(middle + scale * one.geometry.aabb_radius)
        return np.array([np.min(low, axis=0), np.max(high, axis=0)])

    def display(self, q: ArrayLike | None = None) -> None:
        """Show a configuration, with all that stands beside the robot.

        Args:
            q: Shape ``(nq,)``; None draws the bodies again where Pinocchio's data have them.

        Raises:
            WrongShape, NotFinite: ``q`` doesn't fit the model.
        """
        if q is None:
            super().display()
            return
        where = vector("q", q, self.model.nq)
        super().display(where)
        for place, node in self._drawing.laid(self._overlays(where[None])):
            self._drawing.put(place, node, 0)

    def loadMeshFromFile(self, geometry_object: pin.GeometryObject) -> object:
        """Pinocchio's, but for files of which meshcat's page makes nothing: these without texture.

        Args:
            geometry_object: The shape.
        """
        file = geometry_object.meshPath
        if file.lower().endswith(".dae") and is_mixed(file):
            mesh = geometry_object.geometry
            corners = np.array(mesh.vertices()) / geometry_object.meshScale  # which comes again
            faces = [mesh.tri_indices(k) for k in range(mesh.num_tris)]
            return TriangularMeshGeometry(corners, [[one[j] for j in range(3)] for one in faces])
        return super().loadMeshFromFile(geometry_object)

    def _meshcat(self) -> Visualizer:
        return self.viewer

    def __repr__(self) -> str:
        return f"RobotViewer({self.model.name}, {self.url})"
