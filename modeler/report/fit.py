"""Fits and models: the page of a fit, tables and figures of a notebook."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler import estimation
from modeler.core.estimators import titled
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Table, percent
from modeler.estimation import Addition, FitResult, IdentifiedModel, ParameterEstimate, SideBySide
from modeler.report.blocks import Items, JudgedLine, PageTable, Verdict
from modeler.report.estimators import estimators_page, remarks_of, table_of, values_of
from modeler.report.figures import parameters_figure, picture_figure
from modeler.report.history import additions_page, step_name, waterfall_picture
from modeler.report.noise import noise_blocks, noise_picture
from modeler.report.page import Origin, Page, Section, after_fit
from modeler.report.values import joints_table, values_table


def _fit_summary(fit: FitResult) -> str:
    first = (f"{fit.robot}: {len(fit.parameters)} base parameters by {fit.method}, relative error "
             f"{percent(fit.relative_error)}{_refused(fit)}")  # fmt: skip
    return "\n".join([first, *fit.lines()])


def _refused(fit: FitResult) -> str:
    """That a fit is not usable, and why: for a headline; "" of one that is."""
    verdict = fit.verdict
    return "" if verdict is None or verdict.usable else f"; {verdict.line.partition(';')[0]}"


def fit_tables(fit: FitResult) -> Tables:
    """The tables of a fit; those of loads, gains and the reduced model where there are any."""
    reduced = () if fit.essential is None else fit.essential.parameters
    named = {"essential": ("reduced model", reduced), "loads": ("loads", fit.loads),
             "gains": ("drive gains", fit.gains)}  # fmt: skip
    return {
        "parameters": lambda: _estimates(f"{fit.robot}: base parameters", fit.parameters),
        "errors": lambda: _errors(fit),
        **{
            name: partial(_estimates, f"{fit.robot}: {title}", parameters)
            for name, (title, parameters) in named.items()
            if parameters or (name == "essential" and fit.essential is not None)
        },
    }


def _estimates(title: str, parameters: Sequence[ParameterEstimate]) -> Table:
    known = any(p.prior is not None for p in parameters)
    rows = [
        (p.name, p.value if p.sigma is not None else None, p.sigma, p.relative_sigma_percent,
         p.unit, p.essential if p.sigma is not None else p.status, *([p.prior] if known else []))
        for p in parameters
    ]  # fmt: skip
    head = "parameter, value, sigma, relative_sigma_percent, unit, essential"
    return Table.of(title, f"{head}, prior share" if known else head, rows)


def _errors(fit: FitResult) -> Table:
    return Table.of(
        f"{fit.robot}: what the fit leaves",
        "joint, relative error, rms, unit, rows",
        [(j.name, j.relative_error, j.rms, j.unit, j.rows) for j in fit.joints],
        f"all rows together: {percent(fit.relative_error)}, on the logs of the fit",
    )  # fmt: skip


def _fit_figures(fit: FitResult) -> Figures:
    picture = noise_picture(fit.bands)
    noise = {} if picture is None else {"noise": partial(picture_figure, picture)}
    return {"parameters": lambda: parameters_figure(fit), **noise}


def _model_summary(model: IdentifiedModel) -> str:
    logs = ", ".join(log.name for log in model.logs)
    lines = [f"model of {model.spec.robot}: {len(model.beta)} base parameters by "
             f"{model.fit.method}, fitted on {logs}{_refused(model.fit)}"]  # fmt: skip
    lines += [_step_line(step) for step in model.history]
    return "\n".join([*lines, *model.fit.lines()])


def _model_tables(model: IdentifiedModel) -> Tables:
    found = dict(fit_tables(model.fit))
    if model.history:
        found["waterfall"] = lambda: _waterfall(model)
    found["logs"] = lambda: Table.of(
        "logs of the fit", "log, rows, samples, from [s], to [s]",
        [(log.name, log.rows, log.samples, log.start, log.end) for log in model.logs],
    )  # fmt: skip
    return found


def _waterfall(model: IdentifiedModel) -> Table:
    held = ", ".join(model.history[-1].held_out)
    return Table.of(
        f"{model.spec.robot}: error after every effect",
        "effect, joint, error, on the fitted logs",
        [(step.effect or "as fitted", step.joint, step.error, step.training_error)
         for step in model.history],
        f"error: on {held}" if held else "error: on parts of the fitted logs, left out in turn",
    )  # fmt: skip


def _model_figures(model: IdentifiedModel) -> Figures:
    found = dict(_fit_figures(model.fit))
    if model.history:
        picture = waterfall_picture(model.history)
        found["waterfall"] = lambda: picture_figure(picture)
    return found


def _step_line(step: Addition) -> str:
    fitted = percent(step.training_error)
    return f"{step_name(step)}: error {percent(step.error)} ({fitted} on the fitted logs)"


def _trials_summary(trials: SideBySide) -> str:
    fitted = sum(own.fit is not None for own in trials.tried)
    first = f"{trials.robot}: {fitted} of {len(trials.tried)} estimators fit these logs"
    said = [f"{method}: {remark}" for method, remark in remarks_of(trials.tried)]
    return "\n".join([first, *trials.data, *said])


def _trials_tables(trials: SideBySide) -> Tables:
    errors, values = table_of(trials.tried), values_of(trials.tried)
    return {
        "errors": lambda: Table.of("estimators on the same logs", errors[0], errors[1:]),
        "values": lambda: Table.of("values and standard deviations", values[0], values[1:]),
    }


PRESENTATIONS = {
    FitResult: Presentation("a fit", _fit_summary, fit_tables, _fit_figures,
                            ("parameters", "errors")),
    IdentifiedModel: Presentation("a model", _model_summary, _model_tables, _model_figures,
                                  ("parameters", "errors", "waterfall"),
                                  lambda m, notes: (additions_page if m.history else fit_page)(
                                      m, notes),
                                  dict.fromkeys(("", ".json"), estimation.save_model)),
    Addition: Presentation("an addition", _step_line),
    SideBySide: Presentation("a comparison of estimators", _trials_summary, _trials_tables,
                             document=lambda s, notes: estimators_page(
                                 s.robot, s.tried, [*s.data, *notes])),
}  # fmt: skip


# The page of a fit: values with sigma, what each is the sum of, condition, doubts.


_TANGLED = 0.95  # correlation of two estimates from which on they are told
_MOST = 12  # pairs that are told


def fit_page(
    model: IdentifiedModel, provenance: Sequence[str] = (), place: str = "MODEL",
    following: Sequence[str] = (),
) -> Page:  # fmt: skip
    """The page of a fit.

    Args:
        model: fitted.
        provenance: lines on how the data came about.
        place: of the model file.
        following: commands to go on with; none: those for any logs.
    """
    fit = model.fit
    judged = "nobody has judged it" if fit.verdict is None else fit.verdict.line
    following = following or after_fit(place, ["LOG"], fit.robot, fit)
    return Page(
        title=f"{fit.robot}: fitted values",
        headline=(fit.error_told(), f"left on the fitted logs: {judged}"),
        sections=_sections(model),
        origin=Origin(place, [log.name for log in model.logs], False, following),
        facts=_facts(fit),
        provenance=provenance,
        command="fit",
    )


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
    if noise := noise_blocks(fit.bands):
        found.append(Section("Noise of the motion", noise))
    pairs = correlated_pairs(model)
    if pairs:
        table = PageTable(
            ("parameter", "and", "correlation"),
            [(a, b, f"{value:+.3f}") for a, b, value in pairs],
            "The torques of these logs tell the sum (-1) or the difference (+1) of such a pair "
            "better than either; more exciting motion parts them.",
            {"and": "text"},
        )
        found.append(Section("What the data hardly tell apart", [table]))
    return found


def _judged(fit: FitResult) -> list[Verdict | Items]:
    blocks: list[Verdict | Items] = []
    if fit.verdict is not None:
        kind, tag = ("noise", "valid") if fit.verdict.usable else ("pattern", "not valid")
        lines = [JudgedLine(kind, tag, "This fit", fit.verdict.line)]
        lines += [JudgedLine("other", "doubt", f"Doubt {k}", text)
                  for k, text in enumerate(fit.verdict.doubts, start=1)]  # fmt: skip
        blocks.append(Verdict(lines))
    if fit.sentences:
        blocks.append(Items([("", line) for line in fit.sentences]))
    return blocks


def correlated_pairs(model: IdentifiedModel) -> list[tuple[str, str, float]]:
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
