"""An audit as one HTML page: rendered formulas, filters, no network."""

from __future__ import annotations

import html
import re

from thesis_pin.audit import VERDICTS, Report, Row
from thesis_pin.audit_report import effect_text, residual_text, summary_lines

_STYLE = """
body{font:15px/1.45 system-ui,sans-serif;margin:1.5rem auto;max-width:78rem;padding:0 1rem;
color:#1c2430;background:#fff}
h1{font-size:1.5rem}nav{position:sticky;top:0;background:#fff;padding:.6rem 0;
border-bottom:1px solid #ccd3dc;z-index:1}
label{margin-right:.9rem;white-space:nowrap}
input[type=search]{width:22rem;font:inherit;padding:.2rem}
article{border-left:5px solid #8a94a3;margin:1rem 0;padding:.2rem .9rem;overflow-x:auto}
.holds{border-color:#2c7a4b}.misprint{border-color:#b7791f}.wrong{border-color:#b42318}
.unexplained{border-color:#6b21a8}code{background:#eef1f5;padding:0 .25rem}
article h2{font-size:1rem;margin:.2rem 0}
dl{display:grid;grid-template-columns:9rem 1fr;gap:.15rem .6rem}
dt{color:#5b6675}dd{margin:0;padding:.15rem 0;overflow:auto hidden}
math{math-style:normal}table{border-collapse:collapse}
td,th{padding:.15rem .7rem;text-align:left;border-bottom:1px solid #e1e5ea}
"""
_SCRIPT = """
const rows=[...document.querySelectorAll('article')],find=document.getElementById('find'),
shown=document.getElementById('shown'),
boxes=[...document.querySelectorAll('nav input[type=checkbox]')];
function filter(){const on=new Set(boxes.filter(b=>b.checked).map(b=>b.value)),
text=find.value.toLowerCase();let n=0;for(const r of rows){const ok=on.has(r.dataset.verdict)
&&r.dataset.text.includes(text);r.hidden=!ok;n+=ok}shown.textContent=n}
find.oninput=filter;boxes.forEach(b=>b.onchange=filter);filter();
"""


def page(report: Report) -> str:
    """A self-contained page: formulas as MathML, filters, no network."""
    boxes = "".join(
        f'<label><input type="checkbox" value="{v}"{" checked" if v != "holds" else ""}> '
        f"{v} ({report.counts[v]})</label>"
        for v in VERDICTS
        if report.counts[v]
    )
    order = {row.id: k for k, row in enumerate(report.failures)}
    rows = sorted(report.rows, key=lambda row: order.get(row.id, len(order)))
    coverage = "".join(
        f"<tr><td>{s.name}</td><td>{s.rows}</td><td>{s.checked}</td></tr>" for s in report.sections
    )
    beyond = "".join(f"<li>{html.escape(w)}: {html.escape(y)}</li>" for w, y in report.beyond)
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Audit: '
        f"{html.escape(report.thesis)}</title><style>{_STYLE}</style></head><body>"
        f"<h1>Audit of the {html.escape(report.thesis)}</h1>"
        + "".join(f"<p>{html.escape(line)}</p>" for line in summary_lines(report))
        + f'<nav>{boxes}<input type="search" id="find" placeholder="id, note, place …" '
        f'aria-label="search"> <span id="shown"></span> shown</nav><main>'
        + "".join(_article(row) for row in rows)
        + "</main><h2>Coverage</h2><table>"
        "<tr><th>section</th><th>equations</th><th>computed</th></tr>"
        f"{coverage}</table><p>Outside the audit:</p><ul>{beyond}</ul>"
        f"<script>{_SCRIPT}</script></body></html>\n"
    )


def _article(row: Row) -> str:
    entries: list[tuple[str, str]] = []
    chain = " = ".join(mathml(text) for text in (row.left, *row.printed) if text)
    entries.append(("printed", chain))
    for number, text in sorted(row.corrected.items()):
        label = "left side" if number == 0 else f"member {number}"
        entries.append((f"corrected, {label}", mathml(text) if text else "(nothing)"))
    for label, value in (
        ("residual printed", row.residual_printed),
        ("residual corrected", row.residual_corrected),
    ):
        if value is not None:
            entries.append((label, html.escape(residual_text(value))))
    entries += [("where", f"<code>{html.escape(place)}</code>") for place in row.places]
    texts = (
        *(("effect", effect_text(row)), ("finding", row.reason), ("note", row.note)),
        ("guess", f"{row.attribution}: {row.why}" if row.attribution else ""),
    )
    entries += [(label, html.escape(text)) for label, text in texts if text]
    search = " ".join((row.id, row.note, row.reason, row.why, *row.places)).lower()
    body = "".join(f"<dt>{label}</dt><dd>{content}</dd>" for label, content in entries)
    return (
        f'<article class="{row.verdict.replace(" ", "-")}" data-verdict="{row.verdict}" '
        f'data-text="{html.escape(search, quote=True)}"><h2>{html.escape(row.id)} '
        f"<small>{html.escape(row.source)}: {row.verdict}</small></h2><dl>{body}</dl></article>"
    )


def mathml(formula: str) -> str:
    """A formula as MathML; one that is broken in print is shown as its source."""
    from latex2mathml.converter import convert

    loose = re.sub(r"\\(left|right)\s*\.|\\[bB]igg?[lr]?|\\(left|right)(?![a-z])", "", formula)
    for text in (formula, loose):
        try:
            return convert(text).replace(' xmlns="http://www.w3.org/1998/Math/MathML"', "")
        except Exception:  # the converter has no common base class of its errors
            continue
    return f"<code>{html.escape(formula)}</code>"
