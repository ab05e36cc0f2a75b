"""The page of a fit: values with sigma, what each is the sum of, condition, doubts."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.core.estimators import titled
from modeler.fit import IdentifiedModel
from modeler.fit.result import FitResult
from modeler.pages.following import after_fit
from modeler.pages.sheet import (
    Cell,
    Items,
    Judged,
    Origin,
    Section,
    Sheet,
    Table,
    Verdicts,
    write_page,
)
from modeler.pages.values import joints_table, values_table

_TANGLED = 0.95  # correlation of two estimates from which on they are told
_MOST = 12  # pairs that are told


def write_fit(
    path: Path,
    model: IdentifiedModel,
    provenance: Sequence[str] = (),
    place: str = "MODEL",
    following: Sequence[str] = (),
) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `fit.html`.
        model: fitted.
        provenance: lines on how the data came about.
        place: of the model file.
        following: commands to go on with; none: those for any logs.

    Raises:
        ModelerError: the place cannot be written.
    """
    fit = model.fit
    sheet = Sheet(
        title=f"{fit.robot}: fitted values",
        headline=(fit.error_told("{:.2f} %"), f"left on the fitted logs: {_verdict(fit)}"),
        sections=_sections(model),
        origin=Origin(place, [log.name for log in model.logs], False),
        facts=_facts(fit),
        next=following or after_fit(place, ["LOG"], fit.robot, fit),
        provenance=provenance,
        command="fit",
    )
    return write_page(path, sheet, "fit.html")


def _verdict(fit: FitResult) -> str:
    return "nobody has judged it" if fit.verdict is None else fit.verdict.line


def _facts(fit: FitResult) -> list[tuple[str, str]]:
    sure = [p for p in fit.parameters if (p.relative_sigma_percent or np.inf) < 10.0]
    aside = [p.name for p in fit.parameters if p.sigma is None]
    facts = [
        ("How sure?", f"{len(sure)} of {len(fit.parameters)} parameters within 10 % (one sigma); "
         f"{sum(p.essential for p in fit.parameters)} are essential"),
        ("Condition number", f"{fit.condition_number:.4g}; {fit.condition_scaled:.4g} with columns "
         f"of length one; {fit.rows} rows of {fit.samples} samples"),
        ("Estimator", titled(fit.method)),
    ]  # fmt: skip
    if aside:
        facts.append(("Set aside", ", ".join(aside)))
    return facts


def _sections(model: IdentifiedModel) -> list[Section]:
    fit = model.fit
    found = [Section("Verdict", _judged(fit)), Section("Joints", [joints_table(fit)])]
    caption = (
        "SI units. Sigma is one standard deviation from the scatter of the residuals; the bar is "
        "full at 30 %. A parameter without a sum is a standard parameter by itself."
    )
    found.append(Section("Values", [values_table(fit.parameters, model.spec.base, caption)]))
    for title, others in (("Loads", fit.loads), ("Drive gains", fit.gains)):
        if others:
            found.append(Section(title, [values_table(others)]))
    pairs = tangled(model)
    if pairs:
        found.append(Section("What the data hardly tell apart", [_pairs(pairs)]))
    return found


def _judged(fit: FitResult) -> list[Verdicts | Items]:
    blocks: list[Verdicts | Items] = []
    if fit.verdict is not None:
        kind, tag = ("noise", "usable") if fit.verdict.usable else ("pattern", "not usable")
        lines = [Judged(kind, tag, "This fit", fit.verdict.line)]
        lines += [Judged("other", "doubt", f"Doubt {k}", text)
                  for k, text in enumerate(fit.verdict.doubts, start=1)]  # fmt: skip
        blocks.append(Verdicts(lines))
    if fit.sentences:
        blocks.append(Items([("", line) for line in fit.sentences]))
    return blocks


def tangled(model: IdentifiedModel) -> list[tuple[str, str, float]]:
    """Pairs of parameters whose estimates correlate by more than 0.95, worst first."""
    deviation = np.sqrt(np.diag(model.covariance))
    size = np.where(deviation > 0.0, deviation, np.inf)
    correlation = model.covariance / np.outer(size, size)
    names = [p.name for p in model.fit.parameters]
    rows, columns = np.triu_indices(len(names), 1)
    strong = [
        (names[i], names[j], float(correlation[i, j]))
        for i, j in zip(rows, columns, strict=True)
        if abs(correlation[i, j]) > _TANGLED
    ]
    return sorted(strong, key=lambda pair: -abs(pair[2]))[:_MOST]


def _pairs(pairs: Sequence[tuple[str, str, float]]) -> Table:
    rows: list[list[str | Cell]] = [[a, Cell(b, "text"), f"{value:+.3f}"] for a, b, value in pairs]
    return Table(
        ("parameter", Cell("and", "text"), "correlation"), rows,
        "The torques of these logs tell the sum (-1) or the difference (+1) of such a pair better "
        "than either; more exciting motion parts them.",
    )  # fmt: skip
