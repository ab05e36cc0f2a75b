"""Tables of fitted values: parameters with sigma, what each is the sum of, errors by joint."""

from collections.abc import Mapping, Sequence

from modeler.core.manifest import BaseSpec, TermSpec
from modeler.core.table import format_percent
from modeler.estimation import (
    Addition,
    FitResult,
    IdentifiedModel,
    ParameterEstimate,
    format_prior,
    format_spread,
)
from modeler.views.blocks import PageCell, PageTable

_KINDS = {"% sigma": "bar", "unit": "unit", "is the sum of": "why"}
_UNSURE = 30.0  # % of the value from which on the bar of a sigma is full


def tabulate_values(
    parameters: Sequence[ParameterEstimate], base: Sequence[BaseSpec] = (), caption: str = ""
) -> PageTable:
    """Value, sigma, %sigma, unit, and what each parameter is the sum of.

    Args:
        parameters: estimated ones.
        base: the base parameters of the robot, for the sums; parameters without one have none.
        caption: below the table.
    """
    sums = {b.name: format_relation(b) for b in base}
    known = any(p.prior is not None for p in parameters)
    rows: list[list[str | PageCell]] = [
        [
            p.name,
            "set aside" if p.sigma is None else f"{p.value:.5g}",
            "" if p.sigma is None else _format_spread(p.value, p.sigma, p.interval) or "0",
            _build_sigma_cell(p),
            *([format_prior(p)] if known else []),
            p.unit,
            sums.get(p.name, ""),
        ]
        for p in parameters
    ]
    prior = ("from the prior",) if known else ()
    head = ("parameter", "value", "sigma", "% sigma", *prior, "unit", "is the sum of")
    return PageTable(head, rows, caption, _KINDS)


def format_relation(base: BaseSpec) -> str:
    """The sum behind a base parameter: "ZZ1 + Ia1 + D2**2*M2"; "" where it is one term alone."""
    if len(base.terms) == 1 and base.terms[0].coefficient == "1":
        return ""
    text = " ".join(_format_term(term) for term in base.terms)
    return text.removeprefix("+ ")


def _format_term(term: TermSpec) -> str:
    coefficient = term.coefficient
    if coefficient in ("1", "-1"):
        return f"{'-' if coefficient == '-1' else '+'} {term.parameter}"
    outside = coefficient
    depth = 0
    for k, letter in enumerate(coefficient):
        depth += (letter == "(") - (letter == ")")
        if letter in "+-" and k and depth == 0 and coefficient[k - 1] not in "*/(e":
            outside = f"({coefficient})"
            break
    if outside.startswith("-"):
        return f"- {outside[1:]}*{term.parameter}"
    return f"+ {outside}*{term.parameter}"


def _build_sigma_cell(parameter: ParameterEstimate) -> PageCell:
    share = parameter.relative_sigma_percent
    if share is None:
        return PageCell("-")
    text = f"{share:.3g}" if share < 1e4 else ">10000"
    mark = "" if parameter.essential else " not essential"
    return PageCell(f"{text}{mark}", min(1.0, share / _UNSURE))


def tabulate_joint_errors(fit: FitResult) -> PageTable:
    """Errors by joint on the logs that were fitted, each in parts of the joint's own torque."""
    top = max((joint.relative_error or 0.0 for joint in fit.joints), default=0.0) or 1.0
    rows = [
        (
            joint.name,
            PageCell(format_percent(joint.relative_error), (joint.relative_error or 0.0) / top),
            f"{joint.rms:.3g} {joint.unit}",
            f"{joint.rows}",
        )
        for joint in fit.joints
    ]
    return PageTable(
        ("joint", "relative error", "rms residual", "rows"),
        rows,
        "On the logs that were fitted. Relative error: norm of the residual over the norm of the "
        "joint's own torque or force.",
        {"relative error": "bar"},
    )


def find_added_names(model: IdentifiedModel) -> set[str]:
    """Base parameters that the effects of a model's history brought."""
    steps = {(step.effect, step.joint) for step in model.history if step.effect}
    effect_parameters = {p.name for p in model.spec.standard if (p.effect, p.joint) in steps}
    return {b.name for b in model.spec.base if b.column_of in effect_parameters}


def tabulate_nonlinear_parameters(
    steps: Sequence[tuple[Addition, Mapping[str, str]]],
) -> PageTable | None:
    """Shapes of the effects that were added; None if they have none.

    Args:
        steps: of a model's history, each with the units of its shapes by name.
    """
    rows = [
        (
            step.effect,
            step.joint or "all",
            name,
            f"{value:.5g}",
            _format_step_spread(step, name),
            units[name],
        )
        for step, units in steps
        for name, value in step.shapes.items()
    ]
    if not rows:
        return None
    return PageTable(
        ("effect", "joint", "shape", "value", "sigma", "unit"),
        rows,
        "Shapes enter the torque not as factors; they were searched for.",
        dict.fromkeys(("joint", "shape", "unit"), "text"),
    )


def _format_step_spread(step: Addition, name: str) -> str:
    sigma, interval = step.shape_sigmas.get(name, 0.0), step.shape_intervals.get(name)
    return _format_spread(step.shapes[name], sigma, interval) or "-"


def _format_spread(value: float, sigma: float, interval: tuple[float, float] | None) -> str:
    """As behind a value, without the signs that part it from that."""
    spread = format_spread(value, sigma, interval).strip()
    return spread.removeprefix("+- ").removeprefix("(").removesuffix(")")
