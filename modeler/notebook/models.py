"""Fits and models."""

from collections.abc import Sequence

from modeler.core.presented import Figures, Presentation, Tables, present
from modeler.core.table import Cell, Table
from modeler.fit import Addition, FitResult, IdentifiedModel, ParameterEstimate
from modeler.fit.side_by_side import SideBySide
from modeler.notebook.figures import parameters_figure, picture_figure
from modeler.pages.additions import waterfall_picture
from modeler.pages.estimators import table_of, values_of


def present_models() -> None:
    """FitResult, IdentifiedModel, Addition, SideBySide."""
    present(FitResult, Presentation("a fit", _fit_summary, fit_tables, _fit_figures,
                                    ("parameters", "errors")))  # fmt: skip
    present(IdentifiedModel, Presentation("a model", _model_summary, _model_tables, _model_figures,
                                          ("parameters", "errors", "waterfall")))  # fmt: skip
    present(Addition, Presentation("an addition", _addition_summary))
    present(SideBySide, Presentation("a comparison of estimators", _trials_summary, _trials_tables))


def _fit_summary(fit: FitResult) -> str:
    first = (f"{fit.robot}: {len(fit.parameters)} base parameters by {fit.method}, relative error "
             f"{100.0 * fit.relative_error:.3f} %")  # fmt: skip
    return "\n".join([first, *fit.lines()])


def fit_tables(fit: FitResult) -> Tables:
    """The tables of a fit; those of loads, gains and the reduced model where there are any."""
    found = {
        "parameters": lambda: _estimates(f"{fit.robot}: base parameters", fit.parameters),
        "errors": lambda: _errors(fit),
    }
    if fit.essential is not None:
        reduced = fit.essential.parameters
        found["essential"] = lambda: _estimates(f"{fit.robot}: reduced model", reduced)
    if fit.loads:
        found["loads"] = lambda: _estimates(f"{fit.robot}: loads", fit.loads)
    if fit.gains:
        found["gains"] = lambda: _estimates(f"{fit.robot}: drive gains", fit.gains)
    return found


def _estimates(title: str, parameters: Sequence[ParameterEstimate]) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (p.name, p.value if p.sigma is not None else None, p.sigma, p.relative_sigma_percent,
         p.unit, p.essential if p.sigma is not None else p.status)
        for p in parameters
    ]  # fmt: skip
    columns = (("parameter", ""), ("value", ""), ("sigma", ""), ("relative sigma", "%"),
               ("unit", ""), ("essential", ""))  # fmt: skip
    return Table(title, columns, tuple(rows))


def _errors(fit: FitResult) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (j.name, None if j.relative_error is None else 100.0 * j.relative_error, j.rms, j.unit,
         j.rows)
        for j in fit.joints
    ]  # fmt: skip
    columns = (("joint", ""), ("relative error", "%"), ("rms", ""), ("unit", ""), ("rows", ""))
    note = f"all rows together: {100.0 * fit.relative_error:.3f} %, on the logs of the fit"
    return Table(f"{fit.robot}: what the fit leaves", columns, tuple(rows), note)


def _fit_figures(fit: FitResult) -> Figures:
    return {"parameters": lambda: parameters_figure(fit)}


def _model_summary(model: IdentifiedModel) -> str:
    logs = ", ".join(log.name for log in model.logs)
    lines = [f"model of {model.spec.robot}: {len(model.beta)} base parameters by "
             f"{model.fit.method}, fitted on {logs}"]  # fmt: skip
    lines += [_step_line(step) for step in model.history]
    return "\n".join([*lines, *model.fit.lines()])


def _model_tables(model: IdentifiedModel) -> Tables:
    found = dict(fit_tables(model.fit))
    if model.history:
        found["waterfall"] = lambda: _waterfall(model)
    found["logs"] = lambda: Table(
        "logs of the fit",
        (("log", ""), ("rows", ""), ("samples", ""), ("from", "s"), ("to", "s")),
        tuple((log.name, log.rows, log.samples, log.start, log.end) for log in model.logs),
    )
    return found


def _waterfall(model: IdentifiedModel) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (step.effect or "as fitted", step.joint, 100.0 * step.error, 100.0 * step.training_error)
        for step in model.history
    ]
    columns = (("effect", ""), ("joint", ""), ("error", "%"), ("on the fitted logs", "%"))
    held = ", ".join(model.history[-1].held_out)
    note = f"error: on {held}" if held else "error: on parts of the fitted logs, left out in turn"
    return Table(f"{model.spec.robot}: error after every effect", columns, tuple(rows), note)


def _model_figures(model: IdentifiedModel) -> Figures:
    found = dict(_fit_figures(model.fit))
    if model.history:
        picture = waterfall_picture(model.history)
        found["waterfall"] = lambda: picture_figure(picture)
    return found


def _addition_summary(step: Addition) -> str:
    return _step_line(step)


def _step_line(step: Addition) -> str:
    name = f"+ {step.effect}" if step.effect else "as fitted"
    name += f" @{step.joint}" if step.joint else ""
    return f"{name}: error {step.error:.2%} ({step.training_error:.2%} on the fitted logs)"


def _trials_summary(trials: SideBySide) -> str:
    fitted = sum(own.fit is not None for own in trials.tried)
    first = f"{trials.robot}: {fitted} of {len(trials.tried)} estimators fit these logs"
    said = [
        f"{own.method}: {remark}"
        for own in trials.tried
        for remark in ((own.refusal,) if own.refusal else own.remarks)
    ]
    return "\n".join([first, *trials.data, *said])


def _trials_tables(trials: SideBySide) -> Tables:
    return {
        "errors": lambda: _texts("estimators on the same logs", table_of(trials.tried)),
        "values": lambda: _texts("values and standard deviations", values_of(trials.tried)),
    }


def _texts(title: str, lines: list[list[str]]) -> Table:
    head, *rows = lines
    return Table(title, tuple((name, "") for name in head), tuple(map(tuple, rows)))
