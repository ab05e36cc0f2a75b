"""The report: one HTML file that needs no network, and the same pictures as PNG and SVG."""

import base64
import html
import math
from collections.abc import Sequence
from pathlib import Path
from string import Template

import plotly.offline

from modeler.compare.comparison import Comparison, JointComparison
from modeler.compare.draw_matplotlib import image
from modeler.compare.draw_plotly import figure_json
from modeler.compare.overview_picture import overview_picture
from modeler.compare.picture import Picture, picture_csv
from modeler.compare.pictures import all_pictures, joint_pictures
from modeler.compare.verdict import (
    best_pattern,
    headline,
    joint_verdict,
    looks_like_noise,
    percent,
)
from modeler.core.files import write_atomically

_HERE = Path(__file__).parent
_HEAD = (
    '<tr><th>joint</th><th class="text">relative error</th><th>rms residual</th>'
    "<th>rms torque</th><th>largest residual</th><th class=\"text\">at</th><th>R&sup2;</th>"
    "<th>mean residual</th><th>samples</th></tr>"
)


def write_report(path: Path, comparison: Comparison, provenance: Sequence[str] = ()) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `compare.html`.
        comparison: from `compare`.
        provenance: lines on how the data came about (filtering, model, versions), as they are.

    Raises:
        ModelerError: the place cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() not in (".html", ".htm"):
        path = path / "compare.html"
    write_atomically(path, report_html(comparison, provenance))
    return path


def write_pictures(folder: Path, comparison: Comparison) -> tuple[Path, ...]:
    """Write every picture as PNG and SVG and its numbers as CSV; returns the paths written.

    Raises:
        ModelerError: the folder cannot be written.
    """
    written = []
    for picture in all_pictures(comparison):
        files = {
            "png": image(picture, "png"),
            "svg": image(picture, "svg"),
            "csv": picture_csv(picture).encode(),
        }
        for kind, content in files.items():
            place = Path(folder) / f"{picture.name}.{kind}"
            write_atomically(place, content)
            written.append(place)
    return tuple(written)


def report_html(comparison: Comparison, provenance: Sequence[str] = ()) -> str:
    """The page as text, plotly.js inside; its security policy forbids any network access."""
    figure, _, rest = headline(comparison).partition(" of ")
    lines = [_item(line) for line in (*_facts_on_data(comparison), *provenance)]
    return Template((_HERE / "report.html").read_text(encoding="utf-8")).substitute(
        robot=html.escape(comparison.prediction.robot),
        style=(_HERE / "report.css").read_text(encoding="utf-8"),
        figure=html.escape(figure),
        headline=html.escape(f"of {rest}" if rest else ""),
        facts="\n".join(_fact(name, text) for name, text in _facts(comparison)),
        verdict="\n".join(_verdict_lines(comparison)),
        table="\n".join([_HEAD, *(_table_row(item, comparison) for item in comparison.joints)]),
        overview=_figure(overview_picture(comparison)) if comparison.joints else "",
        joints="\n".join(_joint_section(comparison, item) for item in comparison.joints),
        provenance="\n".join(lines),
        plotly=plotly.offline.get_plotlyjs(),
        script=(_HERE / "report.js").read_text(encoding="utf-8"),
    )


def _facts(comparison: Comparison) -> list[tuple[str, str]]:
    """The three answers of the first screen."""
    joints = comparison.joints
    if not joints:
        return []
    ranked = sorted(joints, key=lambda item: item.relative_error, reverse=True)
    good = ", ".join(f"joint {i.joint.name} {percent(i.relative_error)}" for i in ranked[::-1][:3])
    where = ranked[0]
    moment = f"{where.worst.start:.2f}-{where.worst.end:.2f} s of {where.worst.log}"
    left = sorted(
        ((found, item) for item in joints if (found := best_pattern(item))),
        key=lambda entry: entry[0][1],
        reverse=True,
    )
    if left:
        named = "; ".join(
            f"joint {item.joint.name}: {percent(found[1])} follows {found[0].phrase}"
            for found, item in left[:3]
        )
        structure = f"{len(left)} of {len(joints)} joints show a pattern. {named}."
    elif all(looks_like_noise(item) for item in joints):
        structure = "No: the residual of every joint looks like noise."
    else:
        structure = "No pattern in a joint's own motion, but not all of it is noise: see below."
    return [
        ("How good?", f"Best: {good}."),
        (
            "Where does it fail?",
            f"Most on joint {where.joint.name} ({percent(where.relative_error)}), worst at {moment}.",
        ),
        ("Does the residual still have structure?", structure),
    ]


def _facts_on_data(comparison: Comparison) -> list[str]:
    prediction = comparison.prediction
    lines = [f"Robot: {prediction.robot}.", f"Logs: {', '.join(prediction.logs)}."]
    lines.append(
        f"Samples: {comparison.samples} of {prediction.time.size} count for at least one joint; "
        "filtered alike on both sides, never differenced across a gap."
    )
    return lines


def _verdict_lines(comparison: Comparison) -> list[str]:
    lines = []
    for item in comparison.joints:
        kind, tag = _kind(item)
        lines.append(
            f'<li class="{kind}"><span class="tag">{tag}</span>'
            f'<a href="#joint-{html.escape(item.joint.name)}">'
            f"{html.escape(joint_verdict(item))}</a></li>"
        )
    lines += [
        f'<li><span class="tag">not judged</span>Joint {html.escape(name)}: '
        f"{html.escape(reason)}.</li>"
        for name, reason in comparison.unjudged
    ]
    return lines


def _kind(item: JointComparison) -> tuple[str, str]:
    if best_pattern(item) is not None:
        return "pattern", "pattern left"
    if looks_like_noise(item):
        return "noise", "noise only"
    return "other", "not only noise"


def _table_row(item: JointComparison, comparison: Comparison) -> str:
    unit = item.joint.effort_unit
    top = max(other.relative_error for other in comparison.joints)
    width = round(110 * item.relative_error / top) if top else 0
    at = html.escape(f"{item.largest.time:.2f} s of {item.largest.log}")
    cells = [
        f"<td>{html.escape(item.joint.name)}</td>",
        f'<td class="bar"><span style="width:{width}px"></span>{percent(item.relative_error)}</td>',
        f"<td>{item.rms:.3g} {unit}</td>",
        f"<td>{item.measured_rms:.3g} {unit}</td>",
        f"<td>{item.largest.value:.3g} {unit}</td>",
        f'<td class="text">{at}</td>',
        f"<td>{'-' if math.isnan(item.r2) else f'{item.r2:.4f}'}</td>",
        f"<td>{item.bias:+.2g} {unit}</td>",
        f"<td>{item.samples}</td>",
    ]
    return f"<tr>{''.join(cells)}</tr>"


def _joint_section(comparison: Comparison, item: JointComparison) -> str:
    name = html.escape(item.joint.name)
    drawn = "\n".join(_figure(picture) for picture in joint_pictures(comparison, item))
    return (
        f'<section id="joint-{name}">\n<h2>Joint {name}</h2>\n'
        f'<p class="lead">{html.escape(joint_verdict(item))}</p>\n{drawn}\n</section>'
    )


def _figure(picture: Picture) -> str:
    numbers = base64.b64encode(picture_csv(picture).encode()).decode()
    return (
        f"<figure>\n<h3>{html.escape(picture.title)}</h3>\n"
        f'<div class="plot" style="height:{picture.height}px"></div>'
        f'<script type="application/json">{figure_json(picture)}</script>\n'
        f"<figcaption>{html.escape(picture.caption)} "
        f'<a download="{html.escape(picture.name)}.csv" href="data:text/csv;base64,{numbers}">'
        "Numbers (CSV)</a></figcaption>\n</figure>"
    )


def _fact(name: str, text: str) -> str:
    return f"<li><b>{html.escape(name)}</b>{html.escape(text)}</li>"


def _item(text: str) -> str:
    return f"<li>{html.escape(text)}</li>"
