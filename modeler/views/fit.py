"""Fits and models: the page of a fit and of all estimators, tables and figures of a notebook."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler import estimation
from modeler.core import figure as fig
from modeler.core.choices import find_estimator_title
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Table, format_percent
from modeler.estimation import (
    Addition,
    FitResult,
    IdentifiedModel,
    MethodComparison,
    MethodResult,
    ParameterEstimate,
)
from modeler.regression import Bands, ChannelNoise
from modeler.views import history, page
from modeler.views.figures import draw_parameters, draw_picture
from modeler.views.thresholds import THRESHOLDS

# The page of all estimators on the same logs.


def build_estimators_page(
    robot: str, trials: Sequence[MethodResult], provenance: Sequence[str]
) -> page.Page:
    """Builds the page of all estimators on the logs of a robot of that name.

    Args:
        robot: its name.
        trials: from `estimation.compare_methods`.
        provenance: lines on how the data came about.
    """
    (head, *errors), (names, *values) = tabulate_estimators(trials), tabulate_estimates(trials)
    sections = [
        page.Section("Errors and effort", [page.PageTable(head, errors)]),
        page.Section("Values and standard deviations", [page.PageTable(names, values)]),
        page.Section("What each says", [page.Items(collect_remarks(trials))]),
    ]
    done = sum(trial.fit is not None for trial in trials)
    return page.Page(
        f"Estimators on {robot}",
        (str(done), f"of {len(trials)} estimators fit these logs"),
        sections,
        page.Origin(robot),
        provenance=provenance,
        command="estimators",
    )


def tabulate_estimators(trials: Sequence[MethodResult]) -> list[list[str]]:
    """Returns a head and one row a method: errors, conditioning, seconds."""
    rows = [["method", "training %", "held out %", "condition", "essential", "farthest", "seconds"]]
    for trial in trials:
        fit = trial.fit
        if fit is None:
            rows.append([trial.method, "refused", "", "", "", "", f"{trial.seconds:.2f}"])
            continue
        far = (
            "-"
            if trial.largest_shift is None
            else f"{trial.largest_shift[0]} {trial.largest_shift[1]:.1f} sigma"
        )
        rows.append(
            [
                trial.method,
                f"{100 * fit.relative_error:.3f}",
                "-" if trial.held_out_error is None else f"{100 * trial.held_out_error:.3f}",
                f"{fit.condition_scaled:.3g}",
                f"{sum(p.essential for p in fit.parameters)} of {len(fit.parameters)}",
                far,
                f"{trial.seconds:.2f}",
            ]
        )
    return rows


def tabulate_estimates(trials: Sequence[MethodResult]) -> list[list[str]]:
    """Returns a head and one row a parameter: value +- sigma by each method that fitted."""
    fits = [trial.fit for trial in trials if trial.fit is not None]
    rows = [["parameter", "unit", *(fit.method for fit in fits)]]
    for column in zip(*(fit.parameters for fit in fits), strict=True):
        rows.append([column[0].name, column[0].unit, *map(_format_value, column)])
    return rows


def _format_value(parameter: ParameterEstimate) -> str:
    if parameter.sigma is None:
        return "set aside"
    return f"{parameter.value:.4g} +- {parameter.sigma:.2g}"


def collect_remarks(trials: Sequence[MethodResult]) -> list[tuple[str, str]]:
    """Returns method and remark, or the reason of its refusal."""
    return [
        (trial.method, remark)
        for trial in trials
        for remark in ((trial.refusal,) if trial.refusal else trial.notes)
    ]


# Fits and models: the page of a fit, tables and figures of a notebook.


def _summarise_fit(fit: FitResult) -> str:
    first = (
        f"{fit.robot}: {len(fit.parameters)} base parameters by {fit.method}, relative error "
        f"{format_percent(fit.relative_error)}{_describe_refusal(fit)}"
    )
    return "\n".join([first, *fit.format_lines()])


def _describe_refusal(fit: FitResult) -> str:
    """That a fit is not usable, and why: for a headline; "" of one that is."""
    verdict = fit.verdict
    whole = verdict is None or verdict.is_valid_everywhere
    return "" if verdict is None or whole else f"; {verdict.line.partition(';')[0]}"


def collect_fit_tables(fit: FitResult) -> Tables:
    """Collects the tables of a fit, with those of loads, gains and the reduced model."""
    reduced = () if fit.essential is None else fit.essential.parameters
    named = {
        "essential": ("reduced model", reduced),
        "loads": ("loads", fit.loads),
        "gains": ("drive gains", fit.gains),
    }
    return {
        "parameters": lambda: _build_estimates_table(
            f"{fit.robot}: base parameters", fit.parameters
        ),
        "errors": lambda: _tabulate_errors(fit),
        **{
            name: partial(_build_estimates_table, f"{fit.robot}: {title}", parameters)
            for name, (title, parameters) in named.items()
            if parameters or (name == "essential" and fit.essential is not None)
        },
    }


def _build_estimates_table(title: str, parameters: Sequence[ParameterEstimate]) -> Table:
    known = any(p.prior is not None for p in parameters)
    rows = [
        (p.name, p.value, p.sigma, p.relative_sigma_percent, p.unit, p.essential, *prior)
        if p.sigma is not None
        else (p.name, None, None, p.relative_sigma_percent, p.unit, p.status, *prior)
        for p in parameters
        for prior in [[p.prior] if known else []]
    ]
    head = "parameter, value, sigma, relative_sigma_percent, unit, essential"
    return Table.build(title, f"{head}, prior share" if known else head, rows)


def _tabulate_errors(fit: FitResult) -> Table:
    note = f"all rows together: {format_percent(fit.relative_error)}, on the logs of the fit"
    title = f"{fit.robot}: what the fit leaves"
    return Table.of_rows(title, history.JOINT_COLUMNS, fit.joints, note)


def _collect_fit_figures(fit: FitResult) -> Figures:
    picture = draw_noise_picture(fit.bands)
    noise = {} if picture is None else {"noise": partial(draw_picture, picture)}
    return {"parameters": lambda: draw_parameters(fit), **noise}


def _summarise_model(model: IdentifiedModel) -> str:
    logs = ", ".join(log.name for log in model.logs)
    lines = [
        f"model of {model.spec.robot}: {len(model.beta)} base parameters by "
        f"{model.fit.method}, fitted on {logs}{_describe_refusal(model.fit)}"
    ]
    lines += [_describe_step(step) for step in model.history]
    return "\n".join([*lines, *model.fit.format_lines()])


def _collect_model_tables(model: IdentifiedModel) -> Tables:
    tables = dict(collect_fit_tables(model.fit))
    if model.history:
        tables["waterfall"] = lambda: _tabulate_history(model)
    tables["logs"] = lambda: Table.build(
        "logs of the fit",
        "log, rows, samples, from [s], to [s]",
        [(log.name, log.rows, log.samples, log.start, log.end) for log in model.logs],
    )
    return tables


def _tabulate_history(model: IdentifiedModel) -> Table:
    held = ", ".join(model.history[-1].held_out_logs)
    return Table.build(
        f"{model.spec.robot}: error after every effect",
        "effect, joint, error, on the fitted logs",
        [
            (step.effect or "as fitted", step.joint, step.error, step.training_error)
            for step in model.history
        ],
        f"error: on {held}" if held else "error: on parts of the fitted logs, left out in turn",
    )


def _collect_model_figures(model: IdentifiedModel) -> Figures:
    figures = dict(_collect_fit_figures(model.fit))
    if model.history:
        picture = history.draw_waterfall_picture(model.history)
        figures["waterfall"] = lambda: draw_picture(picture)
    return figures


def _describe_step(step: Addition) -> str:
    fitted = format_percent(step.training_error)
    return (
        f"{history.format_step_name(step)}: error {format_percent(step.error)} ({fitted} on the "
        "fitted logs)"
    )


def _summarise_trials(trials: MethodComparison) -> str:
    fitted = sum(trial.fit is not None for trial in trials.results)
    first = f"{trials.robot}: {fitted} of {len(trials.results)} estimators fit these logs"
    remarks = [f"{method}: {remark}" for method, remark in collect_remarks(trials.results)]
    return "\n".join([first, *trials.data, *remarks])


def _collect_trials_tables(trials: MethodComparison) -> Tables:
    errors, values = tabulate_estimators(trials.results), tabulate_estimates(trials.results)
    return {
        "errors": lambda: Table.build("estimators on the same logs", errors[0], errors[1:]),
        "values": lambda: Table.build("values and standard deviations", values[0], values[1:]),
    }


PRESENTATIONS = {
    FitResult: Presentation(
        "a fit", _summarise_fit, collect_fit_tables, _collect_fit_figures, ("parameters", "errors")
    ),
    IdentifiedModel: Presentation(
        "a model",
        _summarise_model,
        _collect_model_tables,
        _collect_model_figures,
        ("parameters", "errors", "waterfall"),
        lambda m, notes: (history.build_history_page if m.history else build_fit_page)(m, notes),
        dict.fromkeys(("", ".json"), estimation.save_model),
    ),
    Addition: Presentation("an addition", _describe_step),
    MethodComparison: Presentation(
        "a comparison of estimators",
        _summarise_trials,
        _collect_trials_tables,
        document=lambda s, notes: build_estimators_page(s.robot, s.results, [*s.data, *notes]),
    ),
}


# The page of a fit: values with sigma, what each is the sum of, condition, warnings.


def build_fit_page(
    model: IdentifiedModel,
    provenance: Sequence[str] = (),
    place: str = "MODEL",
    following: Sequence[str] = (),
) -> page.Page:
    """Builds the page of a fit.

    Args:
        model: fitted.
        provenance: lines on how the data came about.
        place: of the model file.
        following: commands to go on with; none: those for any logs.
    """
    fit = model.fit
    judged = "nobody has judged it" if fit.verdict is None else fit.verdict.line
    following = following or page.suggest_after_fit(place, ["LOG"], fit.robot, fit)
    return page.Page(
        title=f"{fit.robot}: fitted values",
        headline=(fit.format_error(), f"left on the fitted logs: {judged}"),
        sections=_build_sections(model),
        origin=page.Origin(place, [log.name for log in model.logs], False, following),
        facts=_collect_facts(fit),
        provenance=provenance,
        command="fit",
    )


def _collect_facts(fit: FitResult) -> list[tuple[str, str]]:
    sure = [p for p in fit.parameters if (p.relative_sigma_percent or np.inf) < 10.0]
    aside = [p.name for p in fit.parameters if p.sigma is None]
    facts = [
        (
            "Uncertainty",
            f"{len(sure)} of {len(fit.parameters)} parameters within 10 % (one sigma); "
            f"{sum(p.essential for p in fit.parameters)} are essential",
        ),
        (
            "Condition number",
            f"{fit.condition_number:.4g}; {fit.condition_scaled:.4g} with columns "
            f"of length one; {fit.rows} rows of {fit.samples} samples",
        ),
        ("Estimator", find_estimator_title(fit.method)),
    ]
    if aside:
        facts.append(("Set aside", ", ".join(aside)))
    return facts


def _build_sections(model: IdentifiedModel) -> list[page.Section]:
    fit = model.fit
    sections = [
        page.Section("Verdict", _build_verdict_blocks(fit)),
        page.Section("Joints", [history.tabulate_joint_errors(fit)]),
    ]
    caption = (
        "SI units. Sigma is one standard deviation from the scatter of the residuals; the bar is "
        "full at 30 %. A parameter without a sum is a standard parameter by itself."
    )
    sections.append(
        page.Section("Values", [history.tabulate_values(fit.parameters, model.spec.base, caption)])
    )
    for title, others in (("Loads", fit.loads), ("Drive gains", fit.gains)):
        if others:
            sections.append(page.Section(title, [history.tabulate_values(others)]))
    if noise := build_noise_blocks(fit.bands):
        sections.append(page.Section("Noise of the motion", noise))
    pairs = find_correlated_pairs(model)
    if pairs:
        table = page.PageTable(
            ("parameter", "and", "correlation"),
            [(a, b, f"{value:+.3f}") for a, b, value in pairs],
            "The torques of these logs fix the sum (-1) or the difference (+1) of such a pair "
            "better than either; more exciting motion parts them.",
            {"and": "text"},
        )
        sections.append(page.Section("What the data hardly distinguish", [table]))
    return sections


_KINDS = {"good": "noise", "doubtful": "other", "undetermined": "pattern"}
"""Of a joint's line of a verdict, by its state."""


def _build_verdict_blocks(fit: FitResult) -> list[page.Verdict | page.Items]:
    blocks: list[page.Verdict | page.Items] = []
    if fit.verdict is not None:
        kind, tag = ("noise", "valid") if fit.verdict.valid else ("pattern", "not valid")
        if fit.verdict.valid and not fit.verdict.is_valid_everywhere:
            kind, tag = "other", "in part"
        lines = [page.JudgedLine(kind, tag, "This fit", fit.verdict.line)]
        lines += [
            page.JudgedLine(_KINDS[one.state], one.state, f"Joint {name}", one.why[0])
            for name, one in fit.verdict.by_joint.items()
        ]
        lines += [
            page.JudgedLine("other", "doubt", f"Warning {k}", text)
            for k, text in enumerate(fit.verdict.lines, start=1)
        ]
        blocks.append(page.Verdict(lines))
    if fit.sentences:
        blocks.append(page.Items([("", line) for line in fit.sentences]))
    return blocks


def find_correlated_pairs(model: IdentifiedModel) -> list[tuple[str, str, float]]:
    """Finds pairs of estimates that correlate by more than 0.95, worst first."""
    deviation = np.sqrt(np.diag(model.covariance))
    size = np.where(deviation > 0.0, deviation, np.inf)
    correlation = model.covariance / np.outer(size, size)
    names = [p.name for p in model.fit.parameters]
    rows, columns = np.triu_indices(len(names), 1)
    strong = [
        (names[i], names[j], float(correlation[i, j]))
        for i, j in zip(rows, columns, strict=True)
        if abs(correlation[i, j]) > THRESHOLDS.min_correlation
    ]
    return sorted(strong, key=lambda pair: -abs(pair[2]))[: THRESHOLDS.max_pairs]


# The noise of the motion as a picture: where it exceeds the motion, and the torques.


_ROW = 210  # pixels

_POWER = {"positions": 4, "speeds": 2, "accelerations": 0}
_SPECTRUM, _FLOOR, _MEETS = (
    fig.Style(fig.BLUE, 1.6),
    fig.Style(fig.ORANGE, 1.6),
    fig.Style(fig.SLATE, 1.2, dash=True),
)
_TORQUE, _OF_NOISE = fig.Style(fig.GREEN, 1.6), fig.Style(fig.VERMILLION, 1.6)
_POSITION, _PARALLEL = fig.Style(fig.PINK, 1.4), fig.Style(fig.BLACK, 1.4)


def build_noise_blocks(bands: Bands | None) -> list[page.Block]:
    """Returns how the cut-offs were chosen, and the picture; nothing where nothing moves."""
    picture = draw_noise_picture(bands)
    if bands is None or picture is None:
        return []
    said = [page.Items([("", line) for line in bands.reasons])] if bands.reasons else []
    return [*said, page.Figure(picture, titled=False)]


def draw_noise_picture(bands: Bands | None) -> fig.Picture | None:
    """Draws spectrum and noise floor of each moving joint, and its torque noise if fitted."""
    moving = [one for one in bands.noise if one.is_moving and any(one.spectrum)] if bands else []
    if bands is None or not moving:
        return None
    fitted = any(one.torque_noise for one in moving)
    rows = tuple(
        (_build_motion_panel(one, bands), *[_build_torque_panel(one, bands)] * fitted)
        for one in moving
    )
    caption = _write_caption(bands, moving[0].quantity, fitted)
    height = 60 + _ROW * len(rows)
    return fig.Picture("noise_of_the_motion", "Noise of the motion", caption, rows, height)


def _build_motion_panel(one: ChannelNoise, bands: Bands) -> fig.Panel:
    """Its spectrum, and the floor that it meets."""
    f, S = np.array(one.frequency), np.array(one.spectrum)
    f, S = f[S > 0.0], S[S > 0.0]
    ends = min(S.min(initial=np.inf), one.density or np.inf), S.max(initial=one.density)
    series: list[fig.Series] = [fig.Curve(f"spectrum of the {one.quantity}", f, S, _SPECTRUM)]
    if one.density and one.noise_crossover_hz:
        along = np.array([one.noise_crossover_hz, f[-1]])
        series.append(fig.Curve("floor: its noise", along, np.full(2, one.density), _FLOOR))
        series.append(
            _build_vertical_curve(
                "the noise exceeds the motion", one.noise_crossover_hz, ends, _MEETS
            )
        )
    band = np.array([[min(f[0], one.band_hz) / 2.0, one.band_hz]])
    colour = f", noise of f^-{one.spectral_slope:.1f}" if one.spectral_slope else ""
    colour = ", planned, filtered or simulated" if one.is_exact else colour
    unit = {4: one.unit, 2: f"({one.unit}/s)", 0: f"({one.unit}/s2)"}[_POWER[one.quantity]]
    title, label = f"Joint {one.joint}: {one.quantity}{colour}", f"density [{unit}^2/Hz]"
    spans = (fig.Span("motion band", band, fig.PALE["blue"]),) if one.band_hz else ()
    every = (*series, *_build_cutoff_curves(bands, ends))
    return fig.Panel(title, "frequency [Hz]", label, every, "log", spans=spans)


def _build_torque_panel(one: ChannelNoise, bands: Bands) -> fig.Panel:
    """A f^p, p = 4 of positions, against the level of the torque."""
    A, T, power = one.noise_torque, one.torque_noise, _POWER[one.quantity]
    if not A or not T or not power:  # without a motor or rows, or with exact accelerations
        return fig.Panel("", "", "", ())
    f, cross, factor = (
        one.frequency,
        (T / A) ** (1.0 / power),
        10.0 ** (THRESHOLDS.noise_line_decades / power),
    )
    high = min(f[-1], cross * factor)
    along = np.geomspace(max(f[0], min(cross, high) / factor), high, 20)
    noise = A * along**power
    ends = (
        min(noise[0], T / THRESHOLDS.noise_level_factor),
        max(noise[-1], T * THRESHOLDS.noise_level_factor),
    )
    label = f"density [({'N' if one.unit == 'm' else 'N m'})^2/Hz]"
    title = f"Joint {one.joint}: torques{', which limits' * (one.joint == bands.limiting_joint)}"
    level = fig.Curve("noise of the torque", np.array([f[0], f[-1]]), np.full(2, T), _TORQUE)
    curves = (
        fig.Curve("torque of that noise", along, noise, _OF_NOISE),
        level,
        *_build_cutoff_curves(bands, ends),
    )
    return fig.Panel(title, "frequency [Hz]", label, curves, "log")


def _build_cutoff_curves(bands: Bands, ends: tuple[float, float]) -> list[fig.Curve]:
    both = (
        ("position filter", bands.position_cutoff, _POSITION),
        ("parallel filter", bands.parallel_cutoff, _PARALLEL),
    )
    return [_build_vertical_curve(label, at, ends, style) for label, at, style in both if at]


def _build_vertical_curve(
    label: str, at: float, ends: tuple[float, float], style: fig.Style
) -> fig.Curve:
    return fig.Curve(label, np.full(2, at), np.array(ends), style)


def _write_caption(bands: Bands, of: str, fitted: bool) -> str:
    text = (
        f"Power density of the {of} (blue, means over third octaves) and the floor that it meets, "
        "the noise of the sensor (orange); above the dashed line it exceeds the motion. The band "
        "of the motion, with 99 % of the velocity's energy, is pale blue."
    )
    if bands.position_cutoff:
        text += " Cut-off of the position filter: pink; of the parallel filter: black."
    if fitted:
        text += (
            f" On the right the same noise as torque, A f^{_POWER[of]} through the inertia matrix "
            "(dark orange), and the noise of the torque itself (green): above their crossing the "
            "sensor is what is seen. The parallel filter lies no higher than the first crossing of "
            "all joints, unless that is below twice the motion band; the lines above say why."
        )
    if bands.chatter_ratio:
        text += (
            " Here it was lowered further: behind wider filters the model's torque has "
            f"{bands.chatter_ratio:.2g} times the high-frequency content of the measured one."
        )
    return text


# What is in a log, as pictures and as a page.
