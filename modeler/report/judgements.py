"""Comparisons and diagnoses as tables and figures of a notebook."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.figure import Picture
from modeler.core.result import Figures, Presentation, Tables, present
from modeler.core.table import Cell, Table
from modeler.diagnosis.result import Diagnosis, Finding
from modeler.diagnosis.search import Step
from modeler.diagnosis.sentences import blind_spots, lines
from modeler.report.evidence import evidence_picture
from modeler.report.figures import errors_picture, picture_figure
from modeler.report.shown import shown
from modeler.validation.comparison import Comparison, method_lines
from modeler.validation.models import Contest, contest_lines
from modeler.validation.pictures import overview_picture, residual_picture
from modeler.validation.prediction import residual
from modeler.validation.time_picture import time_picture
from modeler.validation.verdict import headline, verdict

if TYPE_CHECKING:
    from modeler.report.figure_matplotlib import Drawing


def present_judgements() -> None:
    """Comparison, Contest, Diagnosis."""
    present(Contest, Presentation("a contest of models", _contest_summary, _contest_tables))
    present(Comparison, Presentation("a comparison", _comparison_summary, _comparison_tables,
                                     _comparison_figures))  # fmt: skip
    present(Diagnosis, Presentation("a diagnosis", lambda d: "\n".join(lines(d)),
                                    _diagnosis_tables, _diagnosis_figures,
                                    ("effects", "joints")))  # fmt: skip


def _contest_summary(found: Contest) -> str:
    first = f"{found.predictions[0].robot}: {len(found.names)} models on {found.samples} samples"
    return "\n".join([first, *contest_lines(found)])


def _contest_tables(found: Contest) -> Tables:
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (item.joint.name, *(100.0 * error for error in item.errors),
         None if item.best is None else found.names[item.best], item.chance)
        for item in found.joints
    )  # fmt: skip
    columns = (("joint", ""), *((name, "%") for name in found.names), ("best beyond doubt", ""),
               ("chance", ""))  # fmt: skip
    return {"errors": lambda: Table("relative error of each model", columns, rows)}


def _comparison_summary(comparison: Comparison) -> str:
    first = f"{comparison.prediction.robot}: {headline(comparison)}"
    return "\n".join([first, comparison.summary(), *verdict(comparison)])


def _comparison_tables(comparison: Comparison) -> Tables:
    return {
        "errors": lambda: _errors(comparison),
        "logs": lambda: _by_log(comparison),
        "residuals": lambda: _residuals(comparison),
        "torques": lambda: _torques(comparison),
    }


def _errors(comparison: Comparison) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (item.joint.name, 100.0 * item.relative_error, item.rms, item.joint.effort_unit,
         item.largest.value, item.largest.time, item.largest.log, item.r2,
         None if item.shares is None else item.shares.systematic,
         None if item.shares is None else item.shares.floor, item.bias)
        for item in comparison.joints
    ]  # fmt: skip
    columns = (("joint", ""), ("relative error", "%"), ("rms", ""), ("unit", ""), ("largest", ""),
               ("at", "s"), ("of", ""), ("R2", ""), ("repeatable", ""), ("noise", ""),
               ("bias", ""))  # fmt: skip
    note = " ".join(f"{line}." for line in method_lines(comparison))
    return Table(f"{comparison.prediction.robot}: measured against predicted", columns,
                 tuple(rows), note)  # fmt: skip


def _by_log(comparison: Comparison) -> Table:
    names = [name for name, _ in comparison.logs[0].joints]
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (log.log, log.samples, 100.0 * log.relative_error,
         *(100.0 * error for _, error in log.joints))
        for log in comparison.logs
    )  # fmt: skip
    columns = (("log", ""), ("samples", ""), ("all joints", "%"),
               *((f"joint {name}", "%") for name in names))  # fmt: skip
    return Table("relative error of each log", columns, rows)


def _residuals(comparison: Comparison) -> Table:
    """Measured minus predicted torque, one row a sample; rows that do not count are NaN."""
    found = comparison.prediction
    e = residual(found)
    rows = _rows(comparison, e)
    columns = (("log", ""), ("time", "s"),
               *((joint.name, joint.effort_unit) for joint in found.joints))  # fmt: skip
    return Table("measured minus predicted torque of each joint", columns, rows,
                 "rows that do not count for a joint have no value")  # fmt: skip


def _torques(comparison: Comparison) -> Table:
    """Measured and predicted torque side by side."""
    found = comparison.prediction
    both = np.concatenate([found.measured, found.predicted], axis=1)
    columns = (("log", ""), ("time", "s"),
               *((f"{what} {joint.name}", joint.effort_unit)
                 for what in ("measured", "predicted") for joint in found.joints))  # fmt: skip
    return Table("torques of each joint", columns, _rows(comparison, both))


def _rows(comparison: Comparison, values: np.ndarray) -> tuple[tuple[Cell, ...], ...]:
    found = comparison.prediction
    pairs = zip(found.run.tolist(), found.time.tolist(), values.tolist(), strict=True)
    return tuple((found.logs[run], time, *row) for run, time, row in pairs)


def _comparison_figures(comparison: Comparison) -> Figures:
    found: dict[str, Callable[[], Drawing]] = {
        "overview": lambda: picture_figure(overview_picture(comparison))
    }
    for item in comparison.joints:
        for kind, picture in (("time", time_picture), ("residual", residual_picture)):
            drawn = partial(picture, comparison.prediction, item)
            found[f"{kind} {item.joint.name}"] = partial(_figure, drawn)
    return found


def _figure(draw: Callable[[], Picture]) -> "Drawing":
    return picture_figure(draw())


def _diagnosis_tables(diagnosis: Diagnosis) -> Tables:
    return {
        "effects": lambda: _effects(diagnosis),
        "joints": lambda: _joints(diagnosis),
        "rivals": lambda: _rivals(diagnosis),
        "blind spots": lambda: Table(
            "what these logs cannot show", (("effect", ""), ("why", "")),
            tuple(blind_spots(diagnosis)),
        ),
    }  # fmt: skip


def _effects(diagnosis: Diagnosis) -> Table:
    rows = [_finding(f, "missing" if f.status == "fact" else "named") for f in diagnosis.effects]
    rows += [_finding(f, "refines the model") for f in diagnosis.refinements]
    columns = (("effect", ""), ("joint", ""), ("error before", "%"), ("error after", "%"),
               ("gain", "%"), ("values", "SI"), ("what", ""), ("evidence", ""))  # fmt: skip
    title = f"{diagnosis.robot}: {diagnosis.verdict}"
    return Table(title, columns, tuple(rows), diagnosis.sentences[0])


def _finding(finding: Finding, what: str) -> tuple[Cell, ...]:
    values = ", ".join(
        f"{name} = {value:.4g} {finding.units.get(name, '')}".rstrip()
        for name, value in finding.parameters.items()
    )
    return (finding.effect, finding.joint, 100.0 * finding.error_before,
            100.0 * finding.error_after, 100.0 * finding.gain, values, what,
            finding.evidence)  # fmt: skip


def _joints(diagnosis: Diagnosis) -> Table:
    rows = tuple(
        (name, 100.0 * j.error_before, 100.0 * j.error_after, j.rms_before, j.rms_after, j.unit,
         j.explained, j.systematic, j.noise)
        for name, j in diagnosis.joints.items()
    )  # fmt: skip
    columns = (("joint", ""), ("error", "%"), ("with effects", "%"), ("rms", ""),
               ("rms with effects", ""), ("unit", ""), ("explained", ""), ("systematic", ""),
               ("noise", ""))  # fmt: skip
    return Table("errors without and with the effects", columns, rows)


def _rivals(diagnosis: Diagnosis) -> Table:
    rows = tuple((effect, joint, 100.0 * gain) for effect, joint, gain in diagnosis.rivals)
    columns = (("effect", ""), ("joint", ""), ("gain", "%"))
    return Table("rivals of the first effect", columns, rows)


def _diagnosis_figures(diagnosis: Diagnosis) -> Figures:
    found: dict[str, Callable[[], Drawing]] = {}
    for step in diagnosis.search.steps:
        name = step.pick.effect.id + (f"@{step.pick.joint}" if step.pick.joint else "")
        found[name] = partial(_evidence, diagnosis, step)
    found["errors"] = lambda: picture_figure(errors_picture(diagnosis))
    return found


def _evidence(diagnosis: Diagnosis, step: Step) -> "Drawing":
    return picture_figure(evidence_picture(shown(diagnosis.search, step)))
