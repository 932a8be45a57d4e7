"""Pieces of a torque report that both robots need: summaries and writers."""

from __future__ import annotations

import io
import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from thesis_pin.errors import NotFinite

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class ActuatorSummary:
    """What each actuator has to do over a motion; arrays of shape ``(k,)``.

    Attributes:
        names: Actuator names.
        peak_torque: Largest |τ| [N·m].
        rms_torque: Root mean square of τ over time [N·m].
        peak_speed: Largest |θ̇| [rad/s].
        peak_power: Largest |τ θ̇| [W].
        positive_work: Work given to the mechanism [J].
        negative_work: Work taken from it [J], ≤ 0.
    """

    names: tuple[str, ...]
    peak_torque: np.ndarray
    rms_torque: np.ndarray
    peak_speed: np.ndarray
    peak_power: np.ndarray
    positive_work: np.ndarray
    negative_work: np.ndarray

    @property
    def net_work(self) -> np.ndarray:
        """Work given minus work taken back [J]."""
        return self.positive_work + self.negative_work


def summarise(
    names: Sequence[str], time: np.ndarray, torque: np.ndarray, speed: np.ndarray
) -> ActuatorSummary:
    """Summary of sampled torques and speeds.

    Integrals over time use the trapezoidal rule on the samples.

    Args:
        names: Actuator names, k of them.
        time: Sample times [s], shape ``(n,)``.
        torque: τ [N·m], shape ``(n, k)``.
        speed: θ̇ [rad/s], shape ``(n, k)``.
    """
    power = torque * speed
    duration = time[-1] - time[0]
    return ActuatorSummary(
        names=tuple(names),
        peak_torque=np.abs(torque).max(axis=0),
        rms_torque=np.sqrt(np.trapezoid(torque**2, time, axis=0) / duration),
        peak_speed=np.abs(speed).max(axis=0),
        peak_power=np.abs(power).max(axis=0),
        positive_work=np.trapezoid(np.maximum(power, 0.0), time, axis=0),
        negative_work=np.trapezoid(np.minimum(power, 0.0), time, axis=0),
    )


def json_bytes(document: Any) -> bytes:
    """A document of dicts, lists, numbers, strings, None and NumPy arrays as JSON.

    Raises:
        NotFinite: Some number is NaN or infinite, which JSON can't say.
    """
    import orjson

    _refuse_not_finite(document, ())
    options = orjson.OPT_SERIALIZE_NUMPY | orjson.OPT_INDENT_2 | orjson.OPT_APPEND_NEWLINE
    # Indenting ten thousand rows of twelve numbers costs more than computing them.
    if any(isinstance(value, np.ndarray) and value.size > 10_000 for value in _values(document)):
        options &= ~orjson.OPT_INDENT_2
    # orjson takes C-contiguous arrays only; others go through lists.
    return orjson.dumps(document, option=options, default=lambda value: value.tolist())


def _values(document: Any) -> list[Any]:
    return list(document.values()) if isinstance(document, Mapping) else []


def _refuse_not_finite(value: Any, path: tuple[Any, ...]) -> None:
    if isinstance(value, Mapping):
        for key, item in value.items():
            _refuse_not_finite(item, (*path, key))
    elif isinstance(value, np.ndarray) and value.dtype.kind == "f" and not np.isfinite(value).all():
        index = tuple(int(k) for k in np.argwhere(~np.isfinite(value))[0])
        raise NotFinite("output " + ".".join(map(str, path)), index)
    elif isinstance(value, float) and not np.isfinite(value):
        raise NotFinite("output " + ".".join(map(str, path)), ())
    elif isinstance(value, list | tuple):
        for k, item in enumerate(value):
            _refuse_not_finite(item, (*path, k))


def csv_bytes(columns: Mapping[str, np.ndarray | Sequence[str]]) -> bytes:
    """Columns of equal length as CSV with a header; numbers read back exactly.

    Args:
        columns: Name → values, shape ``(n,)``; strings are kept, NaN becomes empty.
    """
    groups: list[list[bytes]] = []
    for numeric, group in itertools.groupby(columns.values(), key=_is_float):
        values = list(group)
        groups += [_number_rows(np.column_stack(values))] if numeric else map(_text_rows, values)
    lines = [",".join(columns).encode(), *map(b",".join, zip(*groups, strict=True))]
    return b"\n".join(lines) + b"\n"


def _is_float(values: Any) -> bool:
    return isinstance(values, np.ndarray) and values.dtype.kind == "f"


def _text_rows(values: Any) -> list[bytes]:
    return [str(value).encode() for value in values]


def _number_rows(table: np.ndarray) -> list[bytes]:
    """The rows of a table ``(n, k)`` as text; NaN becomes empty."""
    import orjson

    if not table.size or np.isinf(table).any():  # which JSON can't say
        return [",".join("" if v != v else repr(v) for v in row).encode() for row in table.tolist()]
    text = orjson.dumps(table, option=orjson.OPT_SERIALIZE_NUMPY)
    return text[2:-2].replace(b"null", b"").split(b"],[")


def new_figure(width: float, height: float, rows: int = 1, columns: int = 1) -> tuple[Any, Any]:
    """A Matplotlib figure and its axes, drawn without a display or global state.

    Args:
        width: Width [inch].
        height: Height [inch].
        rows: Rows of the grid of axes.
        columns: Its columns.

    Returns:
        The figure and an array of axes, shape ``(rows, columns)``.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False)


def figure_files(name: str, figure: Figure) -> dict[str, bytes]:
    """A figure as ``name.png`` and ``name.svg``, the same bytes for the same figure."""
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    # Laid out once, and each format drawn once: savefig does both again and again.
    figure.set_dpi(150)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    png, svg = io.BytesIO(), io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": name}):
        FigureCanvasAgg(figure).print_png(png, metadata={"Software": None})
        FigureCanvasSVG(figure).print_svg(svg, metadata={"Date": None})
    return {f"{name}.png": png.getvalue(), f"{name}.svg": svg.getvalue()}


PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Colours that a colour-blind reader can tell apart (Okabe and Ito, 2008)."""
