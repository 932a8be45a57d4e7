"""Tables of the README, CONTRIBUTING.md and docs/any_robot.md, worked out by the package itself.

Run ``python docs/readme_tables.py`` to renew them; a test fails when they are stale.
"""

from __future__ import annotations

import ast
import json
import re
import runpy
import tomllib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def gaits() -> Iterator[str]:
    """What the report says of the gaits that come with the package."""
    import scout_pin
    from scout_pin.report.judged.limits import headline

    yield (
        "| gait | on | can it walk? | ZMP margin, worst | peak torque | servo line "
        "| walks and is carried at |"
    )
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    examples = ROOT / "examples"
    for gait, specification in (
        ("thesis", None),
        (examples / "walk.toml", None),
        (examples / "lopsided_walk.toml", examples / "lopsided.toml"),
        (examples / "quasi_static.toml", None),
        (examples / "cruise.toml", None),
        (examples / "fast.toml", None),
        (examples / "lopsided_plan.toml", examples / "lopsided.toml"),
    ):
        robot = scout_pin.load(specification)
        report = scout_pin.gait_report(robot, scout_pin.load_gait(gait))
        name = gait if isinstance(gait, str) else f"`examples/{gait.name}`"
        peak = report.actuators.peak_torque.max()
        units = headline(report.time_units, report.time_unit)
        cells = (
            name,
            robot.specification.name,
            "yes" if report.can_walk else "**no**",
            f"{report.margin.min() * 1e3:.1f} mm",
            f"{peak:.3f} N·m",
            f"{report.servo_use.max():.0%}",
            f"{units.shortest * 1e3:.1f} to {units.longest * 1e3:.0f} ms" if units else "none",
        )
        yield f"| {' | '.join(cells)} |"


def paths() -> Iterator[str]:
    """What the report says of Pollard on the thesis's curve."""
    import pollard_pin

    yield (
        "| Pollard, appendix B in 20 s | base motors, peak | wrist, peak | ball joints, peak "
        "| condition |"
    )
    yield "| --- | --- | --- | --- | --- |"
    path = pollard_pin.appendix_b()
    for inertia in ("physical", "printed"):
        report = pollard_pin.trajectory_report(pollard_pin.load(inertia=inertia), path)
        peak = report.actuators.peak_torque
        condition = report.holding.condition
        cells = (
            f"{inertia} inertias",
            f"{peak[0]:.3f}, {peak[1]:.3f}, {peak[2]:.3f} N·m",
            f"{peak[3:].max():.4f} N·m",
            f"{report.loop_force_size.max():.2f} N",
            f"{condition.min():.1f} to {condition.max():.1f}",
        )
        yield f"| {' | '.join(cells)} |"


def audits() -> Iterator[str]:
    """Verdict counts, from the generated documents (which have staleness tests of their own)."""
    verdicts = ("holds", "misprint", "wrong", "illegible", "rebuilt")
    verdicts += ("not checkable", "unexplained")
    yield f"| thesis | equations | {' | '.join(verdicts)} | numbered ones covered |"
    yield "| --- " * (len(verdicts) + 3) + "|"
    for name in ("scout", "pollard"):
        text = (ROOT / "docs" / "audit" / f"{name}.md").read_text(encoding="utf-8")
        line = re.search(r"^(\d+) equations of .*$", text, flags=re.MULTILINE)
        if line is None:
            raise SystemExit(f"docs/audit/{name}.md doesn't count its equations")
        counts = [re.search(rf"(\d+) {verdict}", line[0]) for verdict in verdicts]
        covered = re.search(r"covered: (\d+ of \d+)", text)
        cells = [line[1], *(count[1] if count else "0" for count in counts)]
        cells.append(covered[1] if covered else "")
        yield f"| [{name}](docs/audit/{name}.md) | {' | '.join(cells)} |"


def robots() -> Iterator[str]:
    """Robots no one here made, as docs/robots.py found them."""
    stored = json.loads((ROOT / "docs" / "robots.json").read_text(encoding="utf-8"))
    sources = runpy.run_path(str(ROOT / "docs" / "robots.py"))["SOURCES"]
    yield (
        "| robot | loops | equations | freedoms (idle) | motors | torques differ by | from | µs |"
    )
    yield "| --- " * 8 + "|"
    for one in stored:
        address, version, date = sources[one["source"]]
        when = f", {date}" if date else ""
        name = f"{one['robot']} ([{one['source']}]({address}) {version}{when})"
        if said := one.get("open") or one.get("refused"):
            word = "open by " if "open" in one else "refused: "
            yield f"| {name} | {word}{said} |  |  |  |  |  |  |"
            continue
        idle = f" ({one['idle']})" if one["idle"] else ""
        cells = [name, one["loops"], one["equations"], f"{one['freedom']}{idle}", one["motors"]]
        cells += [f"{one['difference']:.0e}", one["against"], f"{one['microseconds']:.0f}"]
        yield f"| {' | '.join(map(str, cells))} |"


def formats() -> Iterator[str]:
    """What is read of each format of robots."""
    from thesis_pin.report.formats import FORMATS

    yield "| format | told by | used | not used, and named |"
    yield "| --- | --- | --- | --- |"
    for one in FORMATS:
        needs = f" (needs {one.needs})" if one.needs else ""
        cells = [one.name + needs, one.known_by, "; ".join(one.used), "; ".join(one.passed_over)]
        cells = [re.sub(r"(<[a-z_]+>)", r"`\1`", cell) for cell in cells]
        yield f"| {' | '.join(cells)} |"


LARGE = ("pages", "command", "audit")
"""Rooms whose own rooms are listed too."""


def rooms() -> Iterator[str]:
    """Packages and modules from the ground up, in the order that the layers' contracts give."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = settings["tool"]["importlinter"]["contracts"]
    yield "| where | what |"
    yield "| --- | --- |"
    for contract in contracts:
        for layer in reversed(contract["layers"] if "containers" in contract else ()):
            for room in re.findall(r"\w+", layer):
                for package in contract["containers"]:
                    if said := _first_line(ROOT / package / room):
                        yield f"| `{package}/{room}` | {said} |"
                    for inner in sorted((ROOT / package / room).iterdir() if room in LARGE else ()):
                        if said := _first_line(inner) if inner.is_dir() else "":
                            yield f"| `{package}/{room}/{inner.name}` | {said} |"


def _first_line(place: Path) -> str:
    """First line of the docstring of a package or module; empty if there is none such."""
    for path in (place / "__init__.py", place.with_suffix(".py")):
        if path.is_file():
            text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
            line = text.partition("\n")[0].replace("``", "`")
            return re.sub(r":\w+:`", "`", line).removesuffix(".")
    return ""


Tables = Mapping[str, Callable[[], Iterator[str]]]
TABLES: dict[str, Tables] = {
    "README.md": {"gaits": gaits, "paths": paths, "audits": audits, "robots": robots},
    "CONTRIBUTING.md": {"rooms": rooms},
    "docs/any_robot.md": {"formats": formats},
}


def renewed(document: str, text: str) -> str:
    """A document with every table between its markers worked out again."""
    for name, rows in TABLES[document].items():
        block = f"<!-- table:{name} -->\n" + "\n".join(rows()) + "\n<!-- end -->"
        pattern = rf"<!-- table:{name} -->\n.*?<!-- end -->"
        text, count = re.subn(pattern, lambda _, block=block: block, text, flags=re.DOTALL)
        if count != 1:
            raise SystemExit(f"{document} needs the markers of table {name!r} once, has {count}")
    return text


if __name__ == "__main__":
    for document in TABLES:
        path = ROOT / document
        path.write_text(renewed(document, path.read_text(encoding="utf-8")), encoding="utf-8")
