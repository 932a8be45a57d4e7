"""In meshcat: a walk with its forces on meshcat's own play bar, then single configurations."""

import sys

import numpy as np

import pollard_pin
import scout_pin
from scout_pin.report.drawn.view import gait_scene
from thesis_pin.pages.meshcat.display import show


def wait() -> None:
    """Leave time to look, where somebody does."""
    if sys.stdin is not None and sys.stdin.isatty():
        input("Enter goes on ")


def main() -> None:
    """Show both, each on a server of its own that ends with its viewer."""
    report = scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait())
    with show(gait_scene(report)) as walk:
        print(f"Scout walks at {walk.url}; as a page that works alone: ", end="")
        print(f"{len(walk.static_html()) / 1e6:.1f} MB")
        wait()
        walk.display(1.0)  # stops, and shows one moment
        walk.visualizer["mark"].set_transform(np.eye(4))  # meshcat's own object, for all else

    robot = pollard_pin.load()
    with robot.viewer() as viewer:  # Pinocchio's MeshcatVisualizer
        print(f"Pollard stands at {viewer.url}")
        wait()
        for y in np.linspace(0.0, 0.1, 11):
            viewer.display(robot.inverse_kinematics([0.45, y, 0, 0, 0, 0]).angles)
        print("its tool has moved by 100 mm, its loops stayed closed")
        wait()


if __name__ == "__main__":
    main()
