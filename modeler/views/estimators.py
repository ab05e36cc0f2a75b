"""The page of all estimators on the same logs."""

from collections.abc import Sequence

from modeler.estimation import MethodResult, ParameterEstimate
from modeler.views.blocks import Items, PageTable
from modeler.views.page import Origin, Page, Section


def build_estimators_page(
    robot: str, trials: Sequence[MethodResult], provenance: Sequence[str]
) -> Page:
    """The page of all estimators on the logs of a robot of that name.

    Args:
        robot: its name.
        trials: from `estimation.side_by_side`.
        provenance: lines on how the data came about.
    """
    (head, *errors), (names, *values) = tabulate_estimators(trials), tabulate_estimates(trials)
    sections = [
        Section("Errors and effort", [PageTable(head, errors)]),
        Section("Values and standard deviations", [PageTable(names, values)]),
        Section("What each says", [Items(collect_remarks(trials))]),
    ]
    done = sum(trial.fit is not None for trial in trials)
    return Page(
        f"Estimators on {robot}",
        (str(done), f"of {len(trials)} estimators fit these logs"),
        sections,
        Origin(robot),
        provenance=provenance,
        command="estimators",
    )


def tabulate_estimators(trials: Sequence[MethodResult]) -> list[list[str]]:
    """Header and one row a method: errors, conditioning, seconds."""
    rows = [["method", "training %", "held out %", "condition", "essential", "farthest", "seconds"]]
    for trial in trials:
        fit = trial.fit
        if fit is None:
            rows.append([trial.method, "refused", "", "", "", "", f"{trial.seconds:.2f}"])
            continue
        far = (
            "-" if trial.farthest is None else f"{trial.farthest[0]} {trial.farthest[1]:.1f} sigma"
        )
        rows.append([
            trial.method,
            f"{100 * fit.relative_error:.3f}",
            "-" if trial.held_out_error is None else f"{100 * trial.held_out_error:.3f}",
            f"{fit.condition_scaled:.3g}",
            f"{sum(p.essential for p in fit.parameters)} of {len(fit.parameters)}",
            far,
            f"{trial.seconds:.2f}",
        ])  # fmt: skip
    return rows


def tabulate_estimates(trials: Sequence[MethodResult]) -> list[list[str]]:
    """Header and one row a parameter: value +- sigma by each method that fitted."""
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
    """Method and remark, or why it refused."""
    return [
        (trial.method, remark)
        for trial in trials
        for remark in ((trial.refusal,) if trial.refusal else trial.remarks)
    ]
