"""Comparisons, free runs and diagnoses as tables and figures of a notebook."""

from collections.abc import Callable
from functools import partial

import numpy as np

from modeler import validation
from modeler.core.figure import Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Cell, Table
from modeler.diagnosis import Diagnosis, Finding, Step, blind_spots, lines
from modeler.report.comparison import comparison_page, contest_page
from modeler.report.diagnosis import diagnosis_page
from modeler.report.effect_evidence import evidence_of
from modeler.report.evidence import evidence_picture
from modeler.report.figures import errors_picture, picture_figures


def _contest_summary(found: validation.Contest) -> str:
    first = f"{found.predictions[0].robot}: {len(found.names)} models on {found.samples} samples"
    return "\n".join([first, *validation.contest_lines(found)])


def _contest_tables(found: validation.Contest) -> Tables:
    head = ["joint", *found.names, "best beyond doubt", "chance"]
    rows = [
        (item.joint.name, *item.errors,
         None if item.best is None else found.names[item.best], item.chance)
        for item in found.joints
    ]  # fmt: skip
    return {"errors": lambda: Table.of("relative error of each model", head, rows)}


def _comparison_summary(comparison: validation.Comparison) -> str:
    first = f"{comparison.prediction.robot}: {validation.headline(comparison)}"
    return "\n".join([first, comparison.summary(), *validation.verdict(comparison)])


def _comparison_tables(comparison: validation.Comparison) -> Tables:
    return {
        "errors": lambda: _errors(comparison),
        "logs": lambda: _by_log(comparison),
        "residuals": lambda: _residuals(comparison),
        "torques": lambda: _torques(comparison),
    }


def _errors(comparison: validation.Comparison) -> Table:
    rows = [
        (item.joint.name, item.relative_error, item.rms, item.joint.effort_unit,
         item.largest.value, item.largest.time, item.largest.log, item.r2,
         None if item.shares is None else item.shares.systematic,
         None if item.shares is None else item.shares.floor, item.bias)
        for item in comparison.joints
    ]  # fmt: skip
    return Table.of(
        f"{comparison.prediction.robot}: measured against predicted",
        "joint, relative error, rms, unit, largest, at [s], of, R2, repeatable, noise, bias",
        rows, " ".join(f"{line}." for line in validation.method_lines(comparison)),
    )  # fmt: skip


def _by_log(comparison: validation.Comparison) -> Table:
    joints = [f"joint {name}" for name, _ in comparison.logs[0].joints]
    rows = [(log.log, log.samples, log.relative_error, *(e for _, e in log.joints))
            for log in comparison.logs]  # fmt: skip
    head = ["log", "samples", "all joints", *joints]
    return Table.of("relative error of each log", head, rows)


def _residuals(comparison: validation.Comparison) -> Table:
    """Measured minus predicted torque, one row a sample; rows that do not count are NaN."""
    found = comparison.prediction
    head = [f"{joint.name} [{joint.effort_unit}]" for joint in found.joints]
    return Table.of(
        "measured minus predicted torque of each joint", ["log", "time [s]", *head],
        _rows(found, validation.residual(found)),
        "rows that do not count for a joint have no value",
    )  # fmt: skip


def _torques(comparison: validation.Comparison) -> Table:
    """Measured and predicted torque side by side."""
    found = comparison.prediction
    both = np.concatenate([found.measured, found.predicted], axis=1)
    head = [f"{what} {joint.name} [{joint.effort_unit}]"
            for what in ("measured", "predicted") for joint in found.joints]  # fmt: skip
    return Table.of("torques of each joint", ["log", "time [s]", *head], _rows(found, both))


def _rows(found: validation.Prediction, values: np.ndarray) -> list[tuple[Cell, ...]]:
    triples = zip(found.run.tolist(), found.time.tolist(), values.tolist(), strict=True)
    return [(found.logs[run], time, *row) for run, time, row in triples]


def _comparison_figures(comparison: validation.Comparison) -> Figures:
    drawn = {"overview": partial(validation.overview_picture, comparison)}
    for item in comparison.joints:
        for kind, picture in (
            ("time", validation.time_picture),
            ("residual", validation.residual_picture),
        ):
            drawn[f"{kind} {item.joint.name}"] = partial(picture, comparison.prediction, item)
    return picture_figures(drawn)


def _diagnosis_tables(diagnosis: Diagnosis) -> Tables:
    blind = "what these logs cannot show", "effect, why"
    return {
        "effects": lambda: _effects(diagnosis),
        "joints": lambda: _joints(diagnosis),
        "rivals": lambda: Table.of(
            "rivals of the first effect", "effect, joint, gain", diagnosis.rivals
        ),
        "blind spots": lambda: Table.of(*blind, blind_spots(diagnosis)),
    }  # fmt: skip


def _effects(diagnosis: Diagnosis) -> Table:
    rows = [_finding(f, "missing" if f.status == "fact" else f.status) for f in diagnosis.effects]
    rows += [_finding(f, "refines the model") for f in diagnosis.refinements]
    return Table.of(
        f"{diagnosis.robot}: {diagnosis.verdict}",
        "effect, joint, error before, error after, gain, values [SI], what, evidence",
        rows, diagnosis.sentences[0],
    )  # fmt: skip


def _finding(finding: Finding, what: str) -> tuple[Cell, ...]:
    values = ", ".join(
        f"{name} = {value:.4g} {finding.units.get(name, '')}".rstrip()
        for name, value in finding.parameters.items()
    )
    errors = finding.error_before, finding.error_after
    return finding.effect, finding.joint, *errors, finding.gain, values, what, finding.evidence


def _joints(diagnosis: Diagnosis) -> Table:
    rows = [
        (name, j.error_before, j.error_after, j.rms_before, j.rms_after, j.unit,
         j.explained, j.systematic, j.noise)
        for name, j in diagnosis.joints.items()
    ]  # fmt: skip
    return Table.of(
        "errors without and with the effects",
        "joint, error, with effects, rms, rms with effects, unit, explained, systematic, "
        "noise", rows,
    )  # fmt: skip


def _diagnosis_figures(diagnosis: Diagnosis) -> Figures:
    drawn: dict[str, Callable[[], Picture]] = {}
    for step in diagnosis.search.steps:
        name = step.pick.effect.id + (f"@{step.pick.joint}" if step.pick.joint else "")
        drawn[name] = partial(_evidence, diagnosis, step)
    return picture_figures(drawn | {"errors": partial(errors_picture, diagnosis)})


def _evidence(diagnosis: Diagnosis, step: Step) -> Picture:
    return evidence_picture(evidence_of(diagnosis.search, step))


def _free_run_tables(found: validation.FreeRun) -> Tables:
    return {"joints": lambda: Table.of(
        f"{found.robot}: free run in windows of {found.window:g} s",
        "joint, position [%], constant speed [%], whole run [%], horizon [s], largest error, unit",
        [(j.name, j.fit, j.constant_speed, j.whole, j.horizon, j.largest, j.unit)
         for j in found.joints],
        "position: 100 % is the logged one, 0 % its mean",
    )}  # fmt: skip


def _free_run_figures(found: validation.FreeRun) -> Figures:
    drawn = [partial(validation.free_run_picture, found, j) for j in range(len(found.joints))]
    names = [f"joint {joint.name}" for joint in found.joints]
    return picture_figures(dict(zip(names, drawn, strict=True)))


PRESENTATIONS = {
    validation.FreeRun: Presentation("a free run", validation.FreeRun.summary, _free_run_tables,
                                     _free_run_figures),
    validation.Contest: Presentation("a contest of models", _contest_summary, _contest_tables,
                                     document=contest_page),
    validation.Comparison: Presentation("a comparison", _comparison_summary, _comparison_tables,
                                        _comparison_figures, document=comparison_page),
    Diagnosis: Presentation("a diagnosis", lambda d: "\n".join(lines(d)), _diagnosis_tables,
                            _diagnosis_figures, ("effects", "joints"), diagnosis_page),
}  # fmt: skip
