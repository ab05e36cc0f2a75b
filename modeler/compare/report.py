"""The report: one HTML file that needs no network, and the same pictures as PNG and SVG."""

import base64
import html
import math
import statistics
from collections.abc import Callable, Sequence
from pathlib import Path
from string import Template

import plotly.offline

from modeler.compare.comparison import Comparison, JointComparison
from modeler.compare.draw_matplotlib import images
from modeler.compare.draw_plotly import figure_json
from modeler.compare.overview_picture import overview_picture
from modeler.compare.picture import Picture, picture_csv
from modeler.compare.pictures import all_pictures, joint_pictures
from modeler.compare.table import method_lines, or_dash, share_text
from modeler.compare.verdict import (
    best_other,
    best_pattern,
    headline,
    joint_verdict,
    kind_of_residual,
    looks_like_noise,
    percent,
    wrong_scale,
)
from modeler.core.files import page_place, write_atomically

_TAGS = {"pattern": "pattern left", "noise": "noise only", "other": "unclear"}
_REGION_PHRASES = {
    "fast -": "fast in the negative direction",
    "slow -": "slow in the negative direction",
    "around zero": "around zero speed",
    "slow +": "slow in the positive direction",
    "fast +": "fast in the positive direction",
}
_HERE = Path(__file__).parent
_HEAD = (
    '<tr><th>joint</th><th class="text">relative error</th><th>rms residual</th>'
    '<th>rms torque</th><th>largest residual</th><th class="text">at</th><th>R&sup2;</th>'
    "<th>repeatable</th><th>noise</th><th>mean residual</th><th>samples</th></tr>"
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
    path = page_place(path, "compare.html")
    write_atomically(path, report_html(comparison, provenance))
    return path


def write_pictures(
    folder: Path, comparison: Comparison, progress: Callable[[float], None] | None = None
) -> tuple[Path, ...]:
    """Write every picture as PNG and SVG and its numbers as CSV; returns the paths written.

    Args:
        folder: made if it is not there.
        comparison: from `compare`.
        progress: called with the share done, 0 to 1.

    Raises:
        ModelerError: the folder cannot be written.
    """
    written = []
    pictures = all_pictures(comparison)
    for number, picture in enumerate(pictures, start=1):
        files = {**images(picture), "csv": picture_csv(picture).encode()}
        for kind, content in files.items():
            place = Path(folder) / f"{picture.name}.{kind}"
            write_atomically(place, content)
            written.append(place)
        if progress is not None:
            progress(number / len(pictures))
    return tuple(written)


def report_html(comparison: Comparison, provenance: Sequence[str] = ()) -> str:
    """The page as text, plotly.js inside; its security policy forbids any network access."""
    figure, _, rest = headline(comparison).partition(" of ")
    lines = [_item(line) for line in (*_facts_on_data(comparison), *provenance)]
    return Template((_HERE / "report.html").read_text(encoding="utf-8")).substitute(
        robot=html.escape(comparison.prediction.robot),
        figure=html.escape(figure),
        headline=html.escape(f"of {rest}" if rest else ""),
        facts="\n".join(_fact(name, text) for name, text in _facts(comparison)),
        verdict="\n".join(_verdict_lines(comparison)),
        table="\n".join([_HEAD, *(_table_row(item, comparison) for item in comparison.joints)]),
        method=html.escape(" ".join(f"{line}." for line in method_lines(comparison))),
        logs=_log_table(comparison),
        overview=figure_html(overview_picture(comparison), titled=False)
        if comparison.joints
        else "",
        joints="\n".join(_joint_section(comparison, item) for item in comparison.joints),
        provenance="\n".join(lines),
        **page_assets(),
    )


def page_assets() -> dict[str, str]:
    """What every page carries: style, plotly.js and the script that draws the figures."""
    return {
        "style": (_HERE / "report.css").read_text(encoding="utf-8"),
        "plotly": plotly.offline.get_plotlyjs(),
        "script": (_HERE / "report.js").read_text(encoding="utf-8"),
    }


def _facts(comparison: Comparison) -> list[tuple[str, str]]:
    """The three answers of the first screen."""
    if not comparison.joints:
        return []
    return [
        ("How good?", _how_good(comparison.joints)),
        ("Where does it fail?", _where(comparison.joints)),
        ("Does the residual still have structure?", _what_is_left(comparison.joints)),
    ]


def _how_good(joints: tuple[JointComparison, ...]) -> str:
    below = sum(item.relative_error < 0.1 for item in joints)
    middle = percent(statistics.median(item.relative_error for item in joints))
    text = f"{below} of {len(joints)} joints are within 10 %; the middle one is at {middle}."
    defined = [item for item in joints if not math.isnan(item.r2)]
    if defined:
        worst = min(defined, key=lambda item: item.r2)
        text += f" Lowest R\u00b2: {worst.r2:.3f} (joint {worst.joint.name})."
    return text


def _where(joints: tuple[JointComparison, ...]) -> str:
    worst = max(joints, key=lambda item: item.relative_error)
    window = worst.worst
    region = max(worst.regions, key=lambda part: part.energy_share - part.time_share)
    return (
        f"Most on joint {worst.joint.name} ({percent(worst.relative_error)}): "
        f"{percent(region.energy_share)} of its squared residual while "
        f"{_REGION_PHRASES[region.name]} ({percent(region.time_share)} of the samples); "
        f"worst at {window.start:.2f}-{window.end:.2f} s of {window.log}."
    )


def _what_is_left(joints: tuple[JointComparison, ...]) -> str:
    named = []
    for item in joints:
        pattern, other = best_pattern(item), best_other(item)
        if wrong_scale(item) is not None and item.scale is not None:
            named.append((item.scale.mended, f"joint {item.joint.name} has a wrong sign or scale"))
        elif other is not None:
            named.append((other[1], f"joint {item.joint.name} follows the velocity of {other[0]}"))
        elif pattern is not None:
            named.append((pattern[1], f"joint {item.joint.name} follows {pattern[0].phrase}"))
    if named:
        named.sort(reverse=True)
        listed = "; ".join(f"{text} ({percent(share)})" for share, text in named[:3])
        return f"Yes, on {len(named)} of {len(joints)} joints: {listed}."
    if all(looks_like_noise(item) for item in joints):
        return "No: the residual of every joint looks like noise."
    return "No pattern in the joints' motion, but not all of it is noise: see below."


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
        kind, name = kind_of_residual(item), html.escape(item.joint.name)
        first, _, rest = html.escape(joint_verdict(item)).partition(": ")
        lines.append(
            f'<li class="{kind}"><span class="tag">{_TAGS[kind]}</span>'
            f'<span><a href="#joint-{name}">{first}</a>: {rest}</span></li>'
        )
    lines += [
        f'<li><span class="tag">not judged</span><span>Joint {html.escape(name)}: '
        f"{html.escape(reason)}.</span></li>"
        for name, reason in comparison.unjudged
    ]
    return lines


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
        f"<td>{or_dash(item.r2, '.4f')}</td>",
        *_share_cells(item),
        f"<td>{item.bias:+.2g} {unit}</td>",
        f"<td>{item.samples}</td>",
    ]
    return f"<tr>{''.join(cells)}</tr>"


def _share_cells(item: JointComparison) -> tuple[str, str]:
    if item.shares is None:
        return "<td>-</td>", "<td>-</td>"
    return (
        f"<td>{share_text(item.shares.systematic)}</td>",
        f"<td>{share_text(item.shares.floor)}</td>",
    )


def _log_table(comparison: Comparison) -> str:
    """Relative error of each log and joint; nothing for a single log."""
    if len(comparison.logs) < 2:
        return ""
    names = [html.escape(name) for name, _ in comparison.logs[0].joints]
    head = "".join(f"<th>joint {name}</th>" for name in names)
    rows = "\n".join(
        f'<tr><td class="text">{html.escape(item.log)}</td><td>{item.samples}</td>'
        f"<td>{or_dash(item.relative_error, '.1%')}</td>"
        + "".join(f"<td>{or_dash(error, '.1%')}</td>" for _, error in item.joints)
        + "</tr>"
        for item in comparison.logs
    )
    return (
        '<table><caption>Relative error by log.</caption><tr><th class="text">log</th>'
        f"<th>samples</th><th>all</th>{head}</tr>\n{rows}</table>"
    )


def _joint_section(comparison: Comparison, item: JointComparison) -> str:
    name = html.escape(item.joint.name)
    drawn = "\n".join(figure_html(picture) for picture in joint_pictures(comparison, item))
    return (
        f'<section id="joint-{name}">\n<h2>Joint {name}</h2>\n'
        f'<p class="lead">{html.escape(joint_verdict(item))}</p>\n{drawn}\n</section>'
    )


def figure_html(picture: Picture, titled: bool = True) -> str:
    """The picture as it stands in a page, its numbers for download below it."""
    heading = f"<h3>{html.escape(picture.title)}</h3>\n" if titled else ""
    numbers = base64.b64encode(picture_csv(picture).encode()).decode()
    return (
        f"<figure>\n{heading}"
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
