"""All joints at once: how large the errors are, where, and what they follow."""

import numpy as np

from modeler.compare.comparison import Comparison
from modeler.compare.coordinates import COORDINATES
from modeler.compare.picture import BLUE, Bars, Heat, Panel, Picture, Style
from modeler.compare.where import REGIONS


def overview_picture(comparison: Comparison) -> Picture:
    """Bars of relative error, and heat maps of velocity regions, coordinates, other joints."""
    names = tuple(item.joint.name for item in comparison.joints)
    errors = np.array([100.0 * item.relative_error for item in comparison.joints])
    bars = Bars("relative error", names, errors, tuple(f"{e:.1f}" for e in errors), Style(BLUE))
    coordinates = tuple(coordinate.id for coordinate in COORDINATES)
    panels = (
        (
            Panel("Relative error", "joint", "||residual|| / ||torque|| [%]", (bars,)),
            Panel("Where: share of squared residual [%]", "velocity", "joint",
                  (_regions(comparison),)),
        ),
        (
            Panel("Follows its own ... [%]", "coordinate", "joint",
                  (_shares(comparison, coordinates),)),
            Panel("Follows the velocity of joint ... [%]", "joint moving", "joint",
                  (_across(comparison),)),
        ),
    )  # fmt: skip
    return Picture(
        name="overview",
        title="All joints",
        caption=(
            "Top left: unexplained share of each joint's torque. Top right: in which velocity "
            "region the squared residual sits, and in brackets the share of the samples there; "
            "fast is beyond 40 %, around zero within 5 % of the joint's own top speed. Bottom: "
            "share of the residual variance that a curve over that coordinate predicts on motion "
            "not used to fit it; noise gives 0. Coordinates move together, so shares overlap. A "
            "cell away from the diagonal (bottom right) that beats the diagonal points to coupled "
            "drives."
        ),
        panels=panels,
        heights=(0.5, 0.5),
        widths=(0.5, 0.5),
        height=max(520, 240 + 2 * 44 * len(names)),
    )


def _regions(comparison: Comparison) -> Heat:
    energy = np.array([[r.energy_share for r in item.regions] for item in comparison.joints])
    texts = tuple(
        tuple(f"{r.energy_share:.0%} ({r.time_share:.0%})" for r in item.regions)
        for item in comparison.joints
    )
    return _heat(comparison, "share of squared residual", REGIONS, energy, texts)


def _shares(comparison: Comparison, coordinates: tuple[str, ...]) -> Heat:
    columns = (*coordinates, "all motion")
    rows = [
        [np.nan] * len(columns)
        if item.structure is None
        else [*(item.structure.share(name) for name in coordinates), item.structure.together]
        for item in comparison.joints
    ]
    return _heat(comparison, "explained share", columns, np.array(rows), None)


def _across(comparison: Comparison) -> Heat:
    columns = tuple(info.name for info in comparison.prediction.joints)
    rows = [
        [np.nan] * len(columns)
        if item.structure is None
        else [share for _, share in item.structure.across]
        for item in comparison.joints
    ]
    return _heat(comparison, "explained share", columns, np.array(rows), None)


def _heat(
    comparison: Comparison,
    label: str,
    columns: tuple[str, ...],
    values: np.ndarray,
    texts: tuple[tuple[str, ...], ...] | None,
) -> Heat:
    if texts is None:
        texts = tuple(
            tuple("" if np.isnan(value) else f"{100 * value:.0f}" for value in row)
            for row in values
        )
    names = tuple(item.joint.name for item in comparison.joints)
    return Heat(label, columns, names, 100.0 * values, texts, top=100.0)
