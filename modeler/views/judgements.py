"""Comparisons, free runs and diagnoses as tables and figures of a notebook."""

from collections.abc import Callable
from functools import partial

import numpy as np

from modeler import validation
from modeler.core.figure import Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Cell, Table
from modeler.diagnosis import Diagnosis, Finding, SearchStep, describe_undetectable, format_lines
from modeler.views.comparison import build_comparison_page, build_model_comparison_page
from modeler.views.diagnosis import build_diagnosis_page
from modeler.views.effect_evidence import collect_evidence
from modeler.views.evidence import draw_evidence_picture
from modeler.views.figures import collect_figures, draw_errors_picture


def _summarise_model_comparison(comparison: validation.ModelComparison) -> str:
    first = (
        f"{comparison.predictions[0].robot}: {len(comparison.names)} models on "
        f"{comparison.samples} samples"
    )
    return "\n".join([first, *validation.format_model_comparison(comparison)])


def _collect_model_comparison_tables(comparison: validation.ModelComparison) -> Tables:
    head = ["joint", *comparison.names, "best beyond doubt", "chance"]
    rows = [
        (item.joint.name, *item.errors,
         None if item.best is None else comparison.names[item.best], item.p_value)
        for item in comparison.joints
    ]  # fmt: skip
    return {"errors": lambda: Table.build("relative error of each model", head, rows)}


def _summarise_comparison(comparison: validation.Comparison) -> str:
    first = f"{comparison.prediction.robot}: {validation.write_headline(comparison)}"
    return "\n".join([first, comparison.summary(), *validation.write_verdict(comparison)])


def _collect_comparison_tables(comparison: validation.Comparison) -> Tables:
    return {
        "errors": lambda: _tabulate_errors(comparison),
        "logs": lambda: _tabulate_logs(comparison),
        "residuals": lambda: _tabulate_residuals(comparison),
        "torques": lambda: _tabulate_torques(comparison),
    }


def _tabulate_errors(comparison: validation.Comparison) -> Table:
    rows = [
        (item.joint.name, item.relative_error, item.rms, item.joint.effort_unit,
         item.largest.value, item.largest.time, item.largest.log, item.r2,
         None if item.shares is None else item.shares.systematic,
         None if item.shares is None else item.shares.floor, item.bias)
        for item in comparison.joints
    ]  # fmt: skip
    return Table.build(
        f"{comparison.prediction.robot}: measured against predicted",
        "joint, relative error, rms, unit, largest, at [s], of, R2, repeatable, noise, bias",
        rows, " ".join(f"{line}." for line in validation.describe_methods(comparison)),
    )  # fmt: skip


def _tabulate_logs(comparison: validation.Comparison) -> Table:
    joints = [f"joint {name}" for name, _ in comparison.logs[0].joints]
    rows = [(log.log, log.samples, log.relative_error, *(e for _, e in log.joints))
            for log in comparison.logs]  # fmt: skip
    head = ["log", "samples", "all joints", *joints]
    return Table.build("relative error of each log", head, rows)


def _tabulate_residuals(comparison: validation.Comparison) -> Table:
    """Measured minus predicted torque, one row a sample; rows that do not count are NaN."""
    prediction = comparison.prediction
    head = [f"{joint.name} [{joint.effort_unit}]" for joint in prediction.joints]
    return Table.build(
        "measured minus predicted torque of each joint", ["log", "time [s]", *head],
        _build_rows(prediction, validation.compute_residual(prediction)),
        "rows that do not count for a joint have no value",
    )  # fmt: skip


def _tabulate_torques(comparison: validation.Comparison) -> Table:
    """Measured and predicted torque side by side."""
    prediction = comparison.prediction
    both = np.concatenate([prediction.measured, prediction.predicted], axis=1)
    head = [f"{what} {joint.name} [{joint.effort_unit}]"
            for what in ("measured", "predicted") for joint in prediction.joints]  # fmt: skip
    return Table.build(
        "torques of each joint", ["log", "time [s]", *head], _build_rows(prediction, both)
    )


def _build_rows(prediction: validation.Prediction, values: np.ndarray) -> list[tuple[Cell, ...]]:
    triples = zip(prediction.run.tolist(), prediction.time.tolist(), values.tolist(), strict=True)
    return [(prediction.logs[run], time, *row) for run, time, row in triples]


def _collect_comparison_figures(comparison: validation.Comparison) -> Figures:
    drawn = {"overview": partial(validation.draw_overview_picture, comparison)}
    for item in comparison.joints:
        for kind, picture in (
            ("time", validation.draw_time_picture),
            ("residual", validation.draw_residual_picture),
        ):
            drawn[f"{kind} {item.joint.name}"] = partial(picture, comparison.prediction, item)
    return collect_figures(drawn)


def _collect_diagnosis_tables(diagnosis: Diagnosis) -> Tables:
    blind = "what these logs cannot show", "effect, why"
    return {
        "effects": lambda: _tabulate_effects(diagnosis),
        "joints": lambda: _tabulate_joints(diagnosis),
        "rivals": lambda: Table.build(
            "rivals of the first effect", "effect, joint, gain", diagnosis.rivals
        ),
        "blind spots": lambda: Table.build(*blind, describe_undetectable(diagnosis)),
    }  # fmt: skip


def _tabulate_effects(diagnosis: Diagnosis) -> Table:
    rows = [
        _build_finding_row(f, "missing" if f.status == "fact" else f.status)
        for f in diagnosis.effects
    ]
    rows += [_build_finding_row(f, "refines the model") for f in diagnosis.refinements]
    return Table.build(
        f"{diagnosis.robot}: {diagnosis.verdict}",
        "effect, joint, error before, error after, gain, values [SI], what, evidence",
        rows, diagnosis.sentences[0],
    )  # fmt: skip


def _build_finding_row(finding: Finding, what: str) -> tuple[Cell, ...]:
    values = ", ".join(
        f"{name} = {value:.4g} {finding.units.get(name, '')}".rstrip()
        for name, value in finding.parameters.items()
    )
    errors = finding.error_before, finding.error_after
    return finding.effect, finding.joint, *errors, finding.gain, values, what, finding.evidence


def _tabulate_joints(diagnosis: Diagnosis) -> Table:
    rows = [
        (name, j.error_before, j.error_after, j.rms_before, j.rms_after, j.unit,
         j.explained, j.systematic, j.noise)
        for name, j in diagnosis.joints.items()
    ]  # fmt: skip
    return Table.build(
        "errors without and with the effects",
        "joint, error, with effects, rms, rms with effects, unit, explained, systematic, "
        "noise", rows,
    )  # fmt: skip


def _collect_diagnosis_figures(diagnosis: Diagnosis) -> Figures:
    drawn: dict[str, Callable[[], Picture]] = {}
    for step in diagnosis.search.steps:
        name = step.candidate.effect.id + (
            f"@{step.candidate.joint}" if step.candidate.joint else ""
        )
        drawn[name] = partial(_draw_evidence, diagnosis, step)
    return collect_figures(drawn | {"errors": partial(draw_errors_picture, diagnosis)})


def _draw_evidence(diagnosis: Diagnosis, step: SearchStep) -> Picture:
    return draw_evidence_picture(collect_evidence(diagnosis.search, step))


def _collect_free_run_tables(free_run: validation.FreeRun) -> Tables:
    return {"joints": lambda: Table.build(
        f"{free_run.robot}: free run in windows of {free_run.window:g} s",
        "joint, position [%], constant speed [%], whole run [%], horizon [s], largest error, unit",
        [(j.name, j.fit, j.constant_speed, j.whole, j.horizon, j.largest, j.unit)
         for j in free_run.joints],
        "position: 100 % is the logged one, 0 % its mean",
    )}  # fmt: skip


def _collect_free_run_figures(free_run: validation.FreeRun) -> Figures:
    drawn = [
        partial(validation.draw_free_run_picture, free_run, j) for j in range(len(free_run.joints))
    ]
    names = [f"joint {joint.name}" for joint in free_run.joints]
    return collect_figures(dict(zip(names, drawn, strict=True)))


PRESENTATIONS = {
    validation.FreeRun: Presentation(
        "a free run",
        validation.FreeRun.summary,
        _collect_free_run_tables,
        _collect_free_run_figures,
    ),
    validation.ModelComparison: Presentation(
        "a contest of models",
        _summarise_model_comparison,
        _collect_model_comparison_tables,
        document=build_model_comparison_page,
    ),
    validation.Comparison: Presentation(
        "a comparison",
        _summarise_comparison,
        _collect_comparison_tables,
        _collect_comparison_figures,
        document=build_comparison_page,
    ),
    Diagnosis: Presentation(
        "a diagnosis",
        lambda d: "\n".join(format_lines(d)),
        _collect_diagnosis_tables,
        _collect_diagnosis_figures,
        ("effects", "joints"),
        build_diagnosis_page,
    ),
}
