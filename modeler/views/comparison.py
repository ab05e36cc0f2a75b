"""Comparisons: the page of one model, of several, of a free run, and the pictures."""

import math
import statistics
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from operator import attrgetter

import numpy as np

from modeler import validation
from modeler.core.figure import Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Cell, Column, Table, format_percent
from modeler.views import page
from modeler.views.figures import collect_figures

# The page of a free run.


def build_free_run_page(free_run: validation.FreeRun, origin: page.Origin) -> page.Page:
    """Builds the page of a free run: table, sentences, positions by joint."""
    fits = [joint.fit for joint in free_run.joints if joint.fit is not None]
    worst = f"{min(fits):.3g} %" if fits and min(fits) > 0.0 else "nothing"
    return page.Page(
        title=f"{free_run.robot}: free run in windows of {free_run.window:g} s",
        headline=(worst, "of the position is simulated right, on the joint that is worst"),
        sections=[
            page.Section("Positions", [page.Code(free_run.summary())]),
            *(
                page.Section(p.title, [page.Figure(p, False)])
                for p in validation.draw_free_run_pictures(free_run)
            ),
        ],
        origin=origin,
        command="compare",
    )


# The page of several models side by side.


def build_model_comparison_page(
    comparison: validation.ModelComparison,
    provenance: Sequence[str] = (),
    held_out: bool | None = None,
) -> page.Page:
    """Builds the page of models side by side.

    Args:
        comparison: from `contest`.
        provenance: lines on how the data came about.
        held_out: False if a model was fitted on rows of these logs.
    """
    first = comparison.predictions[0]
    return page.Page(
        title=f"{first.robot}: {len(comparison.names)} models side by side",
        headline=validation.describe_winner(comparison),
        sections=_build_model_sections(comparison),
        origin=page.Origin(", ".join(comparison.names), first.logs, held_out),
        facts=[(name, _describe_model(comparison, k)) for k, name in enumerate(comparison.names)],
        provenance=provenance,
        command="compare",
    )


def draw_model_pictures(comparison: validation.ModelComparison) -> list[Picture]:
    """Draws the residuals of every model, joint by joint."""
    return [_draw_model_picture(comparison, item) for item in comparison.joints]


def _describe_model(comparison: validation.ModelComparison, k: int) -> str:
    errors = ", ".join(
        f"{format_percent(error)} of the {unit}"
        if len(comparison.by_unit[k]) > 1
        else format_percent(error)
        for unit, error in comparison.by_unit[k].items()
    )
    won = comparison.find_best_joints(k)
    best = f"joint {', '.join(won)}" if won else "no joint"
    return f"error {errors}; significantly best on {best}"


def _build_model_sections(comparison: validation.ModelComparison) -> list[page.Section]:
    said = page.Items([("", line) for line in validation.describe_model_comparison(comparison)])
    return [
        page.Section(
            "Verdict", [said, _tabulate_errors(comparison), _tabulate_residuals(comparison)]
        )
    ] + [
        page.Section(
            f"Joint {item.joint.name}",
            [page.Figure(_draw_model_picture(comparison, item), titled=False)],
            f"joint-{item.joint.name}",
        )
        for item in comparison.joints
    ]


def _draw_model_picture(
    comparison: validation.ModelComparison, item: validation.JointModelComparison
) -> Picture:
    joints = [info.name for info in comparison.predictions[0].joints]
    return validation.draw_overlay_picture(
        comparison.names, comparison.predictions, joints.index(item.joint.name)
    )


def _build_model_columns(comparison: validation.ModelComparison) -> list[Column]:
    def read(k: int) -> Callable[[validation.JointModelComparison], float]:
        return lambda item: item.errors[k]

    names = comparison.names
    return [
        Column("joint", "joint.name"),
        *(Column(name, read(k), "%", kind="bar") for k, name in enumerate(names)),
        Column(
            "significantly best", lambda i: None if i.best is None else names[i.best], kind="text"
        ),
        Column(
            "chance", "p_value", lambda i: f"{i.p_value:.2g}" if i.p_value >= 1e-6 else "under 1e-6"
        ),
    ]


def _tabulate_errors(comparison: validation.ModelComparison) -> page.PageTable:
    return page.tabulate(
        _build_model_columns(comparison),
        comparison.joints,
        "Relative error: norm of measured minus predicted torque (force) over the norm of what was "
        "measured, each joint by itself, on the rows that count for every model. Chance: that the "
        "best and the next best are equally good, from the spread of the difference between "
        "blocks of time; significant is less than "
        f"{format_percent(validation.THRESHOLDS.max_p_value)}, shared among the alternatives.",
        lambda item: f"joint-{item.joint.name}",
    )


def _tabulate_residuals(comparison: validation.ModelComparison) -> page.PageTable:
    rows = [
        [item.joint.name, *(f"{rms:.3g} {item.joint.effort_unit}" for rms in item.rms)]
        for item in comparison.joints
    ]
    return page.PageTable(
        ["joint", *comparison.names], rows, "Root mean square of what each model leaves."
    )


# All pictures of a comparison, and as files.


def draw_joint_pictures(
    comparison: validation.Comparison, item: validation.JointComparison
) -> tuple[Picture, ...]:
    """Draws the pictures of one joint: against time, then against each coordinate."""
    prediction = comparison.prediction
    return validation.draw_time_picture(prediction, item), validation.draw_residual_picture(
        prediction, item
    )


def draw_all_pictures(comparison: validation.Comparison) -> tuple[Picture, ...]:
    """Draws the overview, then the pictures of each judged joint."""
    drawn = [p for item in comparison.joints for p in draw_joint_pictures(comparison, item)]
    return (validation.draw_overview_picture(comparison), *drawn)


_FINER = {"R2": ".4f", "bias": "+.2g"}  # than in a text
_PAGE_COLUMNS = [replace(c, show=_FINER.get(c.head, c.show)) for c in validation.JOINT_COLUMNS]
_TAGS = {"pattern": "pattern left", "noise": "noise only", "other": "unclear"}
_REGION_PHRASES = {
    "fast -": "fast in the negative direction",
    "slow -": "slow in the negative direction",
    "around zero": "around zero speed",
    "slow +": "slow in the positive direction",
    "fast +": "fast in the positive direction",
}


def build_comparison_page(
    comparison: validation.Comparison,
    provenance: Sequence[str] = (),
    origin: page.Origin | None = None,
) -> page.Page:
    """Builds the page of a comparison.

    Args:
        comparison: from `compare`.
        provenance: lines on how the data came about (filtering, model, versions), as they are.
        origin: model, logs, and whether they were held out; robot and logs if it is left out.
    """
    prediction = comparison.prediction
    figure, _, rest = validation.write_headline(comparison).partition(" of ")
    return page.Page(
        title=f"{prediction.robot}: measured against predicted torque",
        headline=(figure, f"of {rest}" if rest else ""),
        sections=_build_sections(comparison),
        origin=origin or page.Origin(prediction.robot, prediction.logs),
        facts=_collect_facts(comparison),
        provenance=(
            f"Robot: {prediction.robot}.",
            f"Logs: {', '.join(prediction.logs)}.",
            f"Samples: {comparison.samples} of {prediction.time.size} count for at least one "
            "joint; filtered alike on both sides, never differenced across a gap.",
            *provenance,
        ),
        command="compare",
    )


def _build_sections(comparison: validation.Comparison) -> list[page.Section]:
    method = " ".join(f"{line}." for line in validation.describe_methods(comparison))
    table = page.tabulate(
        _PAGE_COLUMNS,
        comparison.joints,
        "Relative error is the norm of measured minus predicted torque (force) over the norm of "
        "what was measured, each joint by itself, over the samples that count. R\u00b2 compares "
        "with the best constant. Sigma is the rms standard deviation of the prediction by the "
        "covariance of the fit. " + method,
        link=lambda item: f"joint-{item.joint.name}",
    )
    sections = [
        page.Section(
            "Verdict", [page.Verdict(_judge_joints(comparison)), table, *_tabulate_logs(comparison)]
        )
    ]
    if comparison.joints:
        sections.append(
            page.Section(
                "All joints",
                [page.Figure(validation.draw_overview_picture(comparison), titled=False)],
            )
        )
    for item in comparison.joints:
        pictures = [page.Figure(picture) for picture in draw_joint_pictures(comparison, item)]
        name, said = item.joint.name, page.Paragraph(validation.write_joint_verdict(item))
        sections.append(page.Section(f"Joint {name}", [said, *pictures], f"joint-{name}"))
    return sections


def _collect_facts(comparison: validation.Comparison) -> list[tuple[str, str]]:
    """The three answers of the first screen."""
    if not comparison.joints:
        return []
    return [
        ("How good?", _describe_fit_quality(comparison.joints)),
        ("Where does it fail?", _describe_worst_region(comparison.joints)),
        (
            "Does the residual still have structure?",
            _describe_remaining_structure(comparison.joints),
        ),
    ]


def _describe_fit_quality(joints: tuple[validation.JointComparison, ...]) -> str:
    below = sum(item.relative_error < 0.1 for item in joints)
    middle = format_percent(statistics.median(item.relative_error for item in joints))
    text = f"{below} of {len(joints)} joints are within 10 %; the middle one is at {middle}."
    defined = [item for item in joints if not math.isnan(item.r2)]
    if defined:
        worst = min(defined, key=lambda item: item.r2)
        text += f" Lowest R\u00b2: {worst.r2:.3f} (joint {worst.joint.name})."
    return text


def _describe_worst_region(joints: tuple[validation.JointComparison, ...]) -> str:
    worst = max(joints, key=lambda item: item.relative_error)
    window = worst.worst
    region = max(worst.regions, key=lambda part: part.energy_share - part.time_share)
    return (
        f"Most on joint {worst.joint.name} ({format_percent(worst.relative_error)}): "
        f"{format_percent(region.energy_share)} of its squared residual while "
        f"{_REGION_PHRASES[region.name]} ({format_percent(region.time_share)} of the samples); "
        f"worst at {window.start:.2f}-{window.end:.2f} s of {window.log}."
    )


def _describe_remaining_structure(joints: tuple[validation.JointComparison, ...]) -> str:
    named = []
    for item in joints:
        pattern, other = validation.find_best_pattern(item), validation.find_best_other(item)
        if validation.describe_wrong_scale(item) is not None and item.scale is not None:
            named.append(
                (
                    item.scale.variance_reduction,
                    f"joint {item.joint.name} has a wrong sign or scale",
                )
            )
        elif other is not None:
            named.append((other[1], f"joint {item.joint.name} follows the velocity of {other[0]}"))
        elif pattern is not None:
            named.append((pattern[1], f"joint {item.joint.name} follows {pattern[0].phrase}"))
    if named:
        named.sort(reverse=True)
        listed = "; ".join(f"{text} ({format_percent(share)})" for share, text in named[:3])
        return f"Yes, on {len(named)} of {len(joints)} joints: {listed}."
    if all(validation.is_noise_like(item) for item in joints):
        return "No: the residual of every joint looks like noise."
    return "No pattern in the joints' motion, but not all of it is noise: see below."


def _judge_joints(comparison: validation.Comparison) -> list[page.JudgedLine]:
    lines = []
    for item in comparison.joints:
        kind, text = validation.classify_residual(item), validation.write_joint_verdict(item)
        first, _, rest = text.partition(": ")
        lines.append(page.JudgedLine(kind, _TAGS[kind], first, rest, f"joint-{item.joint.name}"))
    lines += [
        page.JudgedLine("", "not judged", f"Joint {name}", f"{reason}.")
        for name, reason in comparison.excluded_joints
    ]
    return lines


def _tabulate_logs(comparison: validation.Comparison) -> list[page.PageTable]:
    """Relative error of each log and joint; nothing for a single log."""
    if len(comparison.logs) < 2:
        return []
    caption = "Relative error by log: of all joints together (rows stacked), and of each by itself."
    return [page.tabulate(validation.build_log_columns(comparison), comparison.logs, caption)]


# Comparisons and free runs as tables and figures of a notebook.


def _summarise_model_comparison(comparison: validation.ModelComparison) -> str:
    first = (
        f"{comparison.predictions[0].robot}: {len(comparison.names)} models on "
        f"{comparison.samples} samples"
    )
    return "\n".join([first, *validation.format_model_comparison(comparison)])


def _collect_model_comparison_tables(comparison: validation.ModelComparison) -> Tables:
    columns, title = _build_model_columns(comparison), "relative error of each model"
    return {"errors": lambda: Table.of_rows(title, columns, comparison.joints)}


def _summarise_comparison(comparison: validation.Comparison) -> str:
    first = f"{comparison.prediction.robot}: {validation.write_headline(comparison)}"
    return "\n".join([first, comparison.summary(), *validation.write_verdict(comparison)])


def _collect_comparison_tables(comparison: validation.Comparison) -> Tables:
    title = f"{comparison.prediction.robot}: measured against predicted"
    methods = " ".join(f"{line}." for line in validation.describe_methods(comparison))
    logs, log_columns = comparison.logs, validation.build_log_columns(comparison)
    return {
        "errors": lambda: Table.of_rows(
            title, validation.JOINT_COLUMNS, comparison.joints, methods
        ),
        "logs": lambda: Table.of_rows("relative error of each log", log_columns, logs),
        "residuals": lambda: _build_residual_table(comparison),
        "torques": lambda: _tabulate_torques(comparison),
    }


def _build_residual_table(comparison: validation.Comparison) -> Table:
    """Measured minus predicted torque, one row a sample; rows that do not count are NaN."""
    prediction = comparison.prediction
    head = [f"{joint.name} [{joint.effort_unit}]" for joint in prediction.joints]
    return Table.build(
        "measured minus predicted torque of each joint",
        ["log", "time [s]", *head],
        _build_rows(prediction, validation.compute_residual(prediction)),
        "rows that do not count for a joint have no value",
    )


def _tabulate_torques(comparison: validation.Comparison) -> Table:
    """Measured and predicted torque side by side."""
    prediction = comparison.prediction
    both = np.concatenate([prediction.measured, prediction.predicted], axis=1)
    head = [
        f"{what} {joint.name} [{joint.effort_unit}]"
        for what in ("measured", "predicted")
        for joint in prediction.joints
    ]
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


def _collect_free_run_tables(run: validation.FreeRun) -> Tables:
    return {
        "joints": lambda: Table.build(
            f"{run.robot}: free run in windows of {run.window:g} s",
            "joint, position [%], constant speed [%], whole run [%], horizon [s], largest error, "
            "unit",
            map(attrgetter(*_FREE_RUN.split()), run.joints),
            "position: 100 % is the logged one, 0 % its mean",
        )
    }


_FREE_RUN = "name fit constant_speed_fit whole_run_fit horizon largest_error unit"


def _collect_free_run_figures(run: validation.FreeRun) -> Figures:
    drawn = [partial(validation.draw_free_run_picture, run, j) for j in range(len(run.joints))]
    names = [f"joint {joint.name}" for joint in run.joints]
    return collect_figures(dict(zip(names, drawn, strict=True)))


PRESENTATIONS = {
    validation.FreeRun: Presentation(
        "a free run",
        validation.FreeRun.summary,
        _collect_free_run_tables,
        _collect_free_run_figures,
    ),
    validation.ModelComparison: Presentation(
        "a comparison of models",
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
}
