"""What to record next: the motion that adds most to what logs tell already."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler import excitation
from modeler.api.fitting import processing_of
from modeler.api.log_maps import Mapped
from modeler.api.motion import (
    Encoders,
    Progress,
    Subject,
    bounds_of,
    no_progress,
    subject_of,
    wish_of,
)
from modeler.api.workflow import Logs, listed, read_logs
from modeler.core.table import aligned
from modeler.estimation import FitResult, IdentifiedModel, identify
from modeler.observation import Log, Observation, Processing, check_apart, observe
from modeler.robot import Robot

_TOLD = 12  # parameters, in the answer for people


@dataclass(frozen=True, eq=False)
class Sharpened:
    """What the next log will add.

    Attributes:
        names: (c,) of the base parameters.
        units: of their values.
        before: their sigmas by the logs that there are; None: those do not tell.
        after: those to expect of these logs and the next one, by the rules of the same fit.
        logs: names of the logs that there are.
        condition: of their rows, and with those of the next one; columns of length one.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    before: tuple[float | None, ...]
    after: tuple[float | None, ...]
    logs: tuple[str, ...]
    condition: tuple[float, float]

    @property
    def order(self) -> list[int]:
        """Columns, those that gain most first."""
        gains = [
            np.inf if a is None else a / b if b else 1.0
            for a, b in zip(self.before, self.after, strict=True)
        ]
        return sorted(range(len(gains)), key=lambda k: -gains[k])

    def lines(self) -> list[str]:
        """Lines of text."""
        first, then = self.condition
        rows = [("parameter", "sigma before", "expected after", "unit", "")]
        for k in self.order[:_TOLD]:
            a, b = self.before[k], self.after[k]
            cells = ["not told" if value is None else f"{value:.3g}" for value in (a, b)]
            rows.append((self.names[k], *cells, self.units[k], f"/ {a / b:.3g}" if a and b else ""))
        more = len(self.names) - len(rows) + 1
        return [
            f"beside {', '.join(self.logs)}: condition number with columns of length one "
            f"{first:.4g} before, {then:.4g} with it; it sharpens",
            *(line.rstrip() for line in aligned(rows, (0, 3))),
            *([f"and {more} others less"] if more > 0 else []),
        ]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        sigmas = zip(self.names, self.before, self.after, strict=True)
        first, then = (c if np.isfinite(c) else None for c in self.condition)
        return {
            "logs": list(self.logs),
            "condition_scaled": {"before": first, "after": then},
            "sigmas": {name: {"before": a, "after": b} for name, a, b in sigmas},
        }


@dataclass(frozen=True, eq=False)
class Recorded:
    """Logs that there are, and what their fit says.

    Attributes:
        subject: the robot, with the noise and values of that fit.
        logs: as read.
        observation: of them.
        fit: of that.
        processing: that a fit of more logs begins with.
    """

    subject: Subject
    logs: list[Log]
    observation: Observation
    fit: FitResult
    processing: Processing

    @property
    def known(self) -> excitation.Known:
        """Their information W'S^-1 W, as a triangle, and how many rows a second has."""
        seen = self.observation
        sigma = np.array([joint.sigma for joint in self.fit.joints])[seen.row_joint]
        used = sigma > 0.0
        steps = np.diff(seen.time)[np.diff(seen.segment) == 0]
        R = np.linalg.qr(seen.W[used] / sigma[used, None], mode="r")
        return excitation.Known(R, 1.0 / float(np.median(steps)))

    def sharpened(self, motion: excitation.Exciting, rate: float, encoders: Encoders) -> Sharpened:
        """What a log of a motion adds: the fit of these logs and of a forecast of it."""
        compiled = self.subject.compiled
        if encoders == Encoders():  # as those of the logs
            seen = {n.joint: n.deviation for n in self.fit.bands.noise if n.of == "positions"}
            noise = [seen.get(joint.name, 0.0) for joint in compiled.spec.joints]
            encoders = Encoders(0, np.array(noise))
        log = self.subject.forecast_log(motion, rate, encoders)
        together = observe(compiled, [*self.logs, log], self.processing)
        both = identify(together, "weighted", compiled)
        told = self.fit.parameters
        return Sharpened(
            tuple(p.name for p in told), tuple(p.unit for p in told),
            tuple(p.sigma for p in told), tuple(p.sigma for p in both.parameters),
            tuple(log.name for log in self.logs),
            (self.fit.condition_scaled, both.condition_scaled),
        )  # fmt: skip


def recorded(subject: Subject, logs: Logs, mapping: Mapped = ()) -> Recorded:
    """The logs of a robot, fitted as `modeler fit` does by itself: all parameters, weighted.

    Raises:
        DataError: a log cannot be read or fitted, or rows are given twice.
    """
    read = read_logs(subject.compiled, listed(logs), mapping)
    check_apart(read)
    processing = processing_of(subject.robot.fit)
    observation = observe(subject.compiled, read, processing)
    fit = identify(observation, "weighted", subject.compiled)
    sigma = np.array([joint.sigma for joint in fit.joints])
    sigma = np.where(sigma > 0.0, sigma, sigma.max())
    subject = dataclasses.replace(
        subject, sigma=sigma, kept=None, beta=fit.beta,
        cutoff=fit.processing.parallel_cutoff or 0.0,
    )  # fmt: skip
    return Recorded(subject, read, observation, fit, processing)


def next_motion(
    thing: Robot | IdentifiedModel,
    logs: Logs,
    *,
    mapping: Mapped = (),
    rate: float = 1000.0,
    counts: int = 0,
    noise: float = 0.0,
    limits: Mapping[str, Sequence[float]] | None = None,
    boxes: Mapping[str, Sequence[float]] | None = None,
    clearance: float | None = None,
    progress: Progress = no_progress,
    **wish: Any,
) -> tuple[excitation.Exciting, Sharpened]:
    """The motion to record next: it adds most to what the logs tell, and what it will add.

    >>> motion, gain = next_motion(robot, ["mon.parquet"], duration=4.0, harmonics=2, starts=1)
    >>> gain.names[0], gain.after[0] < gain.before[0]
    ('ZZ1R', True)

    Args:
        thing: a robot, or a model of it.
        logs: that there are.
        mapping: whose column is which, over [log] of the robot file.
        rate: samples of the next log per second.
        counts: of its encoders, per turn of a revolute joint.
        noise: of its positions, rad or m; with neither, that of the positions of the logs.
        limits: as of `excite`.
        boxes: as of `excite`.
        clearance: as of `excite`.
        progress: called with the share done, 0 to 1.
        wish: as of `excite`; the criterion is "information" where none is given.

    Raises:
        DataError: a log cannot be fitted; what `excite` refuses.
    """
    there = recorded(subject_of(thing), logs, mapping)
    robot, compiled = there.subject.robot, there.subject.compiled
    bounds = bounds_of(robot, compiled, limits or {}, boxes or {}, clearance)
    asked = wish_of(bounds, {"criterion": "information", **wish})
    motion = there.subject.search(bounds, asked, progress, there.known)
    return motion, there.sharpened(motion, rate, Encoders(counts, noise))
