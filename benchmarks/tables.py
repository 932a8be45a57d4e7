"""What was measured as rows of text, for the terminal and for docs/speed.md."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

Json = Mapping[str, object]

COLUMNS = ("work", "N", "ours", "against", "theirs", "ratio", "spread", "goal", "met")


def printed(suite: str, rows: Sequence[Json]) -> None:
    """Print a suite's table."""
    from thesis_pin.command.output import print_table

    print_table(COLUMNS, [line for row in rows for line in lines(row)], title=suite)


def lines(row: Json) -> Iterator[tuple[str, ...]]:
    """Lines of a table: one for a row, and one more for every goal beyond its first."""
    ours, peer, ratio, clock = row["ours"], row["peer"], row["ratio"], row["clock"]
    goals = [(goal_text(goal), met_text(goal)) for goal in row["goals"]] or [("", "")]
    missing = peer.get("missing")
    yield (
        str(row["work"]),
        spaced(row["size"]),
        seconds(ours[clock]["median"]),
        peer["name"],
        "not installed" if missing else seconds(peer[clock]["median"]),
        "" if ratio is None else f"{ratio['median']:.3g}",
        "" if ratio is None else f"{ratio['low']:.3g} to {ratio['high']:.3g}",
        *goals[0],
    )
    for goal in goals[1:]:
        yield ("", "", "", "", "", "", "", *goal)


def spaced(number: int) -> str:
    """A whole number with a space between thousands."""
    return f"{number:_}".replace("_", " ")


def seconds(time: float) -> str:
    """A time with the unit that fits it."""
    for unit, scale in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if time >= scale:
            return f"{time / scale:.3g} {unit}"
    return f"{time / 1e-6:.2g} µs"


def goal_text(goal: Json) -> str:
    """What was to be reached."""
    most, of = goal["most"], goal["of"]
    if of == "ratio":
        return f"≤ {most:.3g}" if most >= 0.1 else f"≤ 1/{1 / most:.3g}"
    return f"≤ {most:g} {of}"


def met_text(goal: Json) -> str:
    """Whether it was, and what was found where the ratio doesn't say it."""
    if goal["met"] is None:
        return "not measured"
    word = "yes" if goal["met"] else "no"
    return word if goal["of"] == "ratio" else f"{word}, {goal['found']:.3g} {goal['of']}"
