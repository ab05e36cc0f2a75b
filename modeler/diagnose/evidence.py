"""The picture of an effect: the residual without it, its curve drawn through, and what is left."""

import numpy as np

from modeler.compare.picture import (
    BLACK,
    BLUE,
    GREY,
    VERMILLION,
    Bars,
    Curve,
    Means,
    Panel,
    Picture,
    Points,
    Style,
)
from modeler.diagnose.orders import order_spectrum
from modeler.diagnose.search import Search, Step
from modeler.diagnose.state import State, columns_of
from modeler.observation.travel import travel_since_reversal

_BINS = 40
_DOTS = 1500


def evidence_picture(found: Search, step: Step) -> Picture:
    """Residual against the coordinate in which the effect shows, before and after; the rivals.

    Args:
        found: the search.
        step: of the effect.
    """
    state, pick = step.before, step.pick
    j = _joint(state, step)
    label, x, turned = _coordinate(state, step, j)
    added = columns_of(state.rows, pick, {})[j]
    fitted = added @ step.judged.values if added is not None else np.zeros(len(x))
    residual = state.residual[j]
    hidden = _projected(state, j, fitted)
    unit = state.data.compiled.spec.joints[j].effort_unit
    times = " x direction of motion" if turned is not None else ""
    way = turned if turned is not None else np.ones(len(x))
    before = scatter("without the effect", label, f"residual{times} [{unit}]", x, residual * way)
    curve = _binned(x, hidden * way)
    drawn = Curve(pick.effect.id, curve[0], curve[1], Style(VERMILLION, 2.2))
    after = scatter("with it", label, f"residual{times} [{unit}]", x, (residual - hidden) * way)
    panels = [
        Panel(before.title, before.x_label, before.y_label, (*before.series, drawn), zero=True),
        after,
    ]
    if pick.effect.several:
        panels.append(_orders(state, step, j, unit))
    name = f"joint {pick.joint}" if pick.joint is not None else "the whole robot"
    return Picture(
        name=f"evidence_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"{pick.effect.title}: {name}",
        caption=(
            f"{pick.effect.signature}. Grey: filtered rows; black: means of bins with two standard "
            "errors; red: what the effect adds, as far as the model could not imitate it."
        ),
        panels=(tuple(panels),),
        heights=(1.0,),
        widths=tuple(1.0 / len(panels) for _ in panels),
        height=380,
    )


def rivals_picture(step: Step) -> Picture:
    """What the best effects explain within the logs, side by side."""
    items = [step.judged, *step.rivals[:7]]
    names = tuple(
        i.candidate.effect.id.replace("_", "<br>")
        + (f"<br>@{i.candidate.joint}" if i.candidate.joint else "")
        for i in items
    )
    gains = np.array([100.0 * max(0.0, i.gain) for i in items])
    bars = Bars("gain", names, gains, tuple(f"{g:.0f}" for g in gains), Style(BLUE))
    return Picture(
        name=f"rivals_{step.pick.effect.id}_{step.pick.joint or 'robot'}",
        title="Why not another effect",
        caption=(
            "Share of the error variance of its own joints that each effect explains within these "
            "logs, cross-validated. An effect on another joint is no rival, but perhaps the next "
            "one."
        ),
        panels=((Panel("", "", "explained [%]", (bars,)),),),
        heights=(1.0,),
        widths=(1.0,),
        height=340,
    )


def _joint(state: State, step: Step) -> int:
    """The joint on which it is drawn: its own, or where it explains most."""
    if step.pick.local:
        return step.pick.index
    columns = columns_of(state.rows, step.pick, {})
    strength = [
        float(np.sum((c @ step.judged.values / s) ** 2)) if c is not None else 0.0
        for c, s in zip(columns, state.base.sigma, strict=True)
    ]
    return int(np.argmax(strength))


def _coordinate(state: State, step: Step, j: int) -> tuple[str, np.ndarray, np.ndarray | None]:
    """Axis label, values by row, and the direction of motion if the effect turns with it."""
    rows, names = state.rows, step.pick.form.names
    unit = state.data.compiled.spec.joints[j].unit
    v = rows.filtered(j, [s.v[:, j] for s in rows.signals])
    way = np.sign(v)
    if "T" in names and step.pick.joint is not None:
        heat = [s.temperature(step.pick.joint) for s in rows.signals]
        found = [
            np.zeros(len(s.q)) if h is None else h for s, h in zip(rows.signals, heat, strict=True)
        ]
        return "temperature, above its mean [K]", rows.filtered(j, found), way
    if "t" in names:
        turned = way if "v" in names else None
        return "time [s]", rows.time[j], turned
    if "load" in names and "v" in names:
        load = rows.filtered(j, [np.abs(s.load[:, j]) for s in rows.signals])
        return "|load| [N m or N]", load, way
    if "torque" in names:
        return "predicted torque", rows.filtered(j, [s.torque[:, j] for s in rows.signals]), None
    if "rate" in names:
        rate = rows.filtered(j, [s.rate[:, j] for s in rows.signals])
        return "d torque / dt", rate, None
    if "z" in names and step.pick.local:
        return _travel(state, j, unit, way)
    if "q" in names:
        q = rows.filtered(j, [s.q[:, j] for s in rows.signals])
        return f"position [{unit}]", q, way if "v" in names else None
    if names <= {"a"} and names:
        return "acceleration", rows.filtered(j, [s.a[:, j] for s in rows.signals]), None
    if "v" in names or not names:
        return f"velocity [{unit}/s]", v, None
    return f"position [{unit}]", rows.filtered(j, [s.q[:, j] for s in rows.signals]), None


def _travel(state: State, j: int, unit: str, way: np.ndarray) -> tuple[str, np.ndarray, np.ndarray]:
    """Travel since the last reversal."""
    found = [travel_since_reversal(signals.q[:, j]) for signals in state.rows.signals]
    return f"travel since the last reversal [{unit}]", state.rows.filtered(j, found), way


def _projected(state: State, j: int, fitted: np.ndarray) -> np.ndarray:
    """The part of the effect that the model's own columns do not imitate, on one joint."""
    W = state.W[j]
    if not W.shape[1]:
        return fitted
    length = np.linalg.norm(W, axis=0)
    solved = np.linalg.lstsq(W / np.where(length > 0.0, length, 1.0), fitted, rcond=1e-9)[0]
    return fitted - W @ (solved / np.where(length > 0.0, length, 1.0))


def scatter(title: str, x_label: str, y_label: str, x: np.ndarray, y: np.ndarray) -> Panel:
    """Rows as dots, and the means of bins with two standard errors."""
    every = max(1, len(x) // _DOTS)
    centres, means, errors = _binned(x, y)
    return Panel(
        title, x_label, y_label,
        (
            Points("rows", x[::every], y[::every], Style(GREY, 2.0, 0.35)),
            Means("mean of bin", centres, means, errors, Style(BLACK)),
        ),
        zero=True,
    )  # fmt: skip


def _binned(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Centres, means and two standard errors of bins that hold equally many rows."""
    order = np.argsort(x)
    parts = [p for p in np.array_split(order, _BINS) if p.size >= 3]
    centres = np.array([x[p].mean() for p in parts])
    means = np.array([y[p].mean() for p in parts])
    errors = np.array([2.0 * y[p].std() / np.sqrt(p.size) for p in parts])
    return centres, means, errors


def _orders(state: State, step: Step, j: int, unit: str) -> Panel:
    spectrum = order_spectrum(state, j)
    assert spectrum is not None
    order = step.pick.order
    near = (spectrum.order > 0.5 * order) & (spectrum.order < 1.5 * order)
    return Panel(
        "order spectrum", "waves per turn", f"amplitude [{unit}]",
        (Curve("residual", spectrum.order[near], spectrum.amplitude[near], Style(BLUE)),),
        marks=((order, f"{order:.4g}"),),
    )  # fmt: skip
