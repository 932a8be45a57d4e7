"""The balance report of any robot: forces on its feet, torques, margin and verdict."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.cell import Cell
from thesis_pin.report.balance import verdict
from thesis_pin.report.balance.numbers import BalanceNumbers
from thesis_pin.report.cells import report_cell
from thesis_pin.report.tables import Table
from thesis_pin.report.torque.uncertainty import uncertainty
from thesis_pin.smoothing.intervals import Interval

Array = NDArray[np.float64]

SCHEMA, VERSION = "thesis-pin/balance", 1


class BalanceReport(BalanceNumbers):
    """Everything known of a robot on its feet: numbers, verdict, documents."""

    @property
    def within_limits(self) -> bool | None:
        """Whether the floor gives all, and motors and joints keep their limits; None if open."""
        both = (self.balanced, self.motors.within_limits)
        if False in both:
            return False
        return None if None in both else True

    @property
    def reason(self) -> str | None:
        """Why the motion's samples carry no verdict; None if they do, or it is exact."""
        if self.within_limits is not None:
            return None
        motors = (
            "The samples can't carry a verdict on the motors: shares of their limits straddle "
            "100%. Finer samples are needed."
        )
        return verdict.why_not(self) or verdict.may_slide(self) or motors

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        return verdict.sentences(self)

    def doubts(self) -> list[str]:
        """What is to be asked before the numbers are believed."""
        return [] if self.held else self.motors.doubts()

    def warnings(self) -> list[str]:
        """What may make the numbers wrong."""
        found = self.motors.warnings()
        if self.sunk > 0:
            found.append(
                f"The centre of mass is up to {self.sunk:.3g} m below the floor that feet stand "
                "on: is the root where, and turned as, its columns say, a quaternion's w last?"
            )
        slides = {one.foot for one in self.slides}  # which the verdict says
        for name, moved in zip(self.names, self.sliding, strict=True):
            if moved > self.resting and name not in slides:
                found.append(
                    f"{name} moves at up to {moved:.3g} m/s while it bears load: it is taken for "
                    "resting there."
                )
        for name, gap in zip(self.names, self.off_floor, strict=True):
            if gap > self.near:
                found.append(
                    f"{name} is up to {gap * 1e3:.3g} mm off the floor while it bears load: forces "
                    "act where it is."
                )
        return found

    def _cell(self) -> Cell:
        force, used = self.found.normal_force.max(axis=0), self.peak_friction
        columns = {
            "foot": self.names,
            "normal force, most": [f"{x:.4g} N" for x in force],
            "friction used": [f"{x:.0%}" for x in used],
        }
        title = f"{self.robot.model.name}, {self.motors.motion.name}"
        return report_cell(self, title, Table.of("Feet", columns))

    @property
    def parameters(self) -> dict[str, object]:
        """What was asked for."""
        asked = dict(self.motors.parameters)
        asked.pop("external", None)
        floor = self.found.floor
        return asked | {
            "feet": list(self.names),
            "friction": [foot.friction for foot in self.found.feet],
            "floor_height": floor.height,
            "floor_slope_deg": float(np.degrees(floor.slope)),
            "floor_uphill_deg": float(np.degrees(floor.uphill)),
            "sharing": self.found.sharing,
        }

    def document(self) -> dict[str, object]:
        """The report as JSON-ready data; docs/any_robot.md describes the schema."""
        found, motors = self.found, self.motors.document()
        same = ("robot", "motors", "motor_joints", "units", "joints", "loops", "couplings")
        shared = {key: motors[key] for key in (*same, "time", "q", "v", "a", "torque", "power")}
        shared |= {key: motors[key] for key in ("loop_force", "loop_moment", "coupling_force")}
        drawn = self.drawn
        return {
            "schema": SCHEMA,
            "version": VERSION,
            **shared,
            "held": self.held,
            "feet": [
                {
                    "name": foot.name,
                    "frame": foot.frame,
                    "kind": foot.kind,
                    "friction": foot.friction,
                    "radius": foot.radius,
                    "placement": foot.placement,
                    "corners": foot.corners,
                    "source": foot.source,
                }
                for foot in found.feet
            ],
            "floor": {"height": found.floor.height, "normal": found.floor.normal},
            "support": found.support,
            "contact_origin": found.stance.origin,
            "contact_force": found.wrench[..., :3],
            "contact_moment": found.wrench[..., 3:],
            "normal_force": found.normal_force,
            "friction_used": _nulls(found.friction_used),
            "contact_margin": _nulls(found.contact_margin),
            "required": found.required,
            "zero_moment_point": _nulls(found.zero_moment_point),
            "centre_of_pressure": _nulls(found.centre_of_pressure),
            "margin": _nulls(found.margin),
            "given": self.given,
            "violation": found.violation,
            "freedoms": found.freedoms,
            "parameters": self.parameters,
            "summary": self.summary(),
            "notes": list(self.motors.motion.notes),
            "samples_uncertainty": None
            if drawn is None
            else uncertainty(self.motors.headlines, drawn.motors, self.motors.motion.variants),
        }

    def summary(self) -> dict[str, object]:
        """The verdict, margins and peaks; without the samples."""
        why, found = self.cause, self.found
        motors = self.motors.summary()
        for key in ("within_limits", "verdict", "reason", "doubts", "warnings"):
            motors.pop(key, None)
        return {
            "within_limits": self.within_limits,
            "balanced": self.balanced,
            "verdict": None if self.within_limits is None else self.verdict(),
            "reason": self.reason,
            "doubts": self.doubts(),
            "warnings": self.warnings(),
            "least_margin": _ends(self.least_margin),
            "worst_time": float(self.time[self.worst]),
            "given_share": float(self.given.mean()),
            "border": self.border,
            "largest_violation": _ends(self.missing),
            "cause": None
            if why is None
            else {
                "needed_friction": why.friction,
                "tip": why.tip,
                "turn": why.turn,
                "push": why.push,
                "pull": why.pull,
                "outside": why.outside,
            },
            "slides": [one.document() for one in self.slides],
            "peak_normal_force": found.normal_force.max(axis=0),
            "peak_friction_used": list(self.peak_friction),
            "level": float(found.level.max()),
            "length": found.length,
            "chosen": list(self.chosen),
            "motors": motors,
        }

    def columns(self) -> dict[str, Array]:
        """The samples as columns of a table: name with unit → values."""
        columns, found = dict(self.motors.columns()), self.found
        for k, name in enumerate(self.names):
            columns[f"contact_{name}"] = found.support[:, k].astype(float)
            for j, axis in enumerate("xyz"):
                columns[f"force_{name}_{axis}_N"] = found.wrench[:, k, j]
            for j, axis in enumerate("xyz"):
                columns[f"moment_{name}_{axis}_Nm"] = found.wrench[:, k, 3 + j]
            columns[f"friction_used_{name}"] = found.friction_used[:, k]
        for j, axis in enumerate("xyz"):
            columns[f"zmp_{axis}_m"] = found.zero_moment_point[:, j]
        columns["margin_m"] = np.where(np.isfinite(found.margin), found.margin, np.nan)
        columns["violation_Nm"] = found.violation
        return columns


def _nulls(values: Array) -> list[object]:
    """Numbers with None for what there isn't."""
    found: list[object] = np.where(np.isfinite(values), values, np.array(None)).tolist()
    return found


def _ends(held: Interval) -> dict[str, float | None]:
    return {
        name: getattr(held, name) if np.isfinite(getattr(held, name)) else None
        for name in ("value", "low", "high")
    }
