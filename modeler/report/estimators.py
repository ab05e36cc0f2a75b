"""The page of all estimators on the same logs."""

from collections.abc import Sequence

from modeler.estimation import ParameterEstimate, Tried
from modeler.report.blocks import Items, PageTable
from modeler.report.page import Origin, Page, Section


def estimators_page(robot: str, tried: Sequence[Tried], provenance: Sequence[str]) -> Page:
    """The page of all estimators on the logs of a robot of that name.

    Args:
        robot: its name.
        tried: from `estimation.side_by_side`.
        provenance: lines on how the data came about.
    """
    (head, *errors), (names, *values) = table_of(tried), values_of(tried)
    sections = [
        Section("Errors and effort", [PageTable(head, errors)]),
        Section("Values and standard deviations", [PageTable(names, values)]),
        Section("What each says", [Items(remarks_of(tried))]),
    ]
    done = sum(own.fit is not None for own in tried)
    return Page(
        f"Estimators on {robot}",
        (str(done), f"of {len(tried)} estimators fit these logs"),
        sections,
        Origin(robot),
        provenance=provenance,
        command="estimators",
    )


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


def remarks_of(tried: Sequence[Tried]) -> list[tuple[str, str]]:
    """Method and remark, or why it refused."""
    return [
        (own.method, remark)
        for own in tried
        for remark in ((own.refusal,) if own.refusal else own.remarks)
    ]
