"""The page of all estimators on the same logs."""

import html
from collections.abc import Sequence
from pathlib import Path

from modeler.core.files import page_place, write_atomically
from modeler.fit.result import ParameterEstimate
from modeler.fit.side_by_side import Tried
from modeler.pages.sheet import page, section


def write_estimators(
    path: Path, robot: str, tried: Sequence[Tried], provenance: Sequence[str]
) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `estimators.html`.
        robot: its name.
        tried: from `fit.side_by_side`.
        provenance: lines on how the data came about.

    Raises:
        ModelerError: the place cannot be written.
    """
    path = page_place(path, "estimators.html")
    sections = [
        section("Errors and effort", _html(table_of(tried))),
        section("Values and standard deviations", _html(values_of(tried))),
        section("What each says", _said(tried)),
    ]
    done = sum(own.fit is not None for own in tried)
    text = page(
        f"Estimators on {robot}", (str(done), f"of {len(tried)} estimators fit these logs"), (),
        "\n".join(sections), provenance,
    )  # fmt: skip
    write_atomically(path, text)
    return path


def table_of(tried: Sequence[Tried]) -> list[list[str]]:
    """Header and one row a method: errors, conditioning, seconds."""
    rows = [["method", "training %", "held out %", "condition", "essential", "farthest", "seconds"]]
    for own in tried:
        fit = own.fit
        if fit is None:
            rows.append([own.method, "refused", "", "", "", "", f"{own.seconds:.2f}"])
            continue
        far = "-" if own.farthest is None else f"{own.farthest[0]} {own.farthest[1]:.1f} sigma"
        rows.append([
            own.method,
            f"{100 * fit.relative_error:.3f}",
            "-" if own.held_out is None else f"{100 * own.held_out:.3f}",
            f"{fit.condition_scaled:.3g}",
            f"{sum(p.essential for p in fit.parameters)} of {len(fit.parameters)}",
            far,
            f"{own.seconds:.2f}",
        ])  # fmt: skip
    return rows


def values_of(tried: Sequence[Tried]) -> list[list[str]]:
    """Header and one row a parameter: value +- sigma by each method that fitted."""
    fits = [own.fit for own in tried if own.fit is not None]
    rows = [["parameter", "unit", *(fit.method for fit in fits)]]
    for column in zip(*(fit.parameters for fit in fits), strict=True):
        rows.append([column[0].name, column[0].unit, *map(_value, column)])
    return rows


def _value(parameter: ParameterEstimate) -> str:
    if parameter.sigma is None:
        return "set aside"
    return f"{parameter.value:.4g} +- {parameter.sigma:.2g}"


def _html(rows: Sequence[Sequence[str]]) -> str:
    head, *body = rows
    lines = ["<tr>" + "".join(f"<th>{html.escape(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>"
              for row in body]  # fmt: skip
    return '<div class="wide"><table>\n' + "\n".join(lines) + "\n</table></div>"


def _said(tried: Sequence[Tried]) -> str:
    lines = [
        f"<li><b>{html.escape(own.method)}</b> {html.escape(remark)}</li>"
        for own in tried
        for remark in ((own.refusal,) if own.refusal else own.remarks)
    ]
    return "<ul>\n" + "\n".join(lines) + "\n</ul>"
