"""Writes docs/explanation/log-to-rows.md and its pictures: one measured log, channel to residual.

`python -m docsite.log_page --data FOLDER`, with the folder of the measured sets, which are not part
of the project. Words stand in log_page.md.jinja, numbers come from the run.
"""

import argparse
import re
import sys
import tempfile
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from benchmarks.textbook import MeasuredSet, list_sets, place_log, write_robot
from modeler import api
from modeler.api import CompiledModel, compile_model, derive, generate, load, read_logs
from modeler.core import figure as fig
from modeler.core.errors import FitWarning
from modeler.estimation import FitResult
from modeler.regression import (
    THRESHOLDS,
    ChannelNoise,
    Log,
    LogRepair,
    Observation,
    PreparedLogs,
    Processing,
    build_observation,
    compute_prior_weights,
    number_blocks,
    prepare_logs,
    sum_blocks,
)
from modeler.regression.cutoffs import limit_cutoffs
from modeler.regression.observe import choose_filters
from modeler.regression.repairs import choose_repairs
from modeler.validation import Comparison
from modeler.views.figure_matplotlib import render_images

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "explanation" / "log-to-rows.md"
WORSE = {
    "held": ("cobot6", "3", r"repeat the row|holds each value|plain filters"),
    "resting": ("damiao7", "j4", r"time steps|joints .* rest:|never moves"),
}
"""Other logs of which the page quotes lines: set, log, what the lines say."""
ZOOM = 0.45  # s to both sides
JOINT = 3  # index of the joint whose residual is drawn

RAW, HELD, USED = fig.Style(fig.GREY, 1.0), fig.Style(fig.VERMILLION, 7.0), fig.Style(fig.BLUE, 1.4)
DOTS, MODEL = fig.Style(fig.SLATE, 4.0), fig.Style(fig.ORANGE, 1.4)


@dataclass(frozen=True, eq=False)
class LogRun:
    """What a fit made of the log.

    Attributes:
        model: the compiled robot.
        log: the part that is fitted, as logged.
        prepared: behind the filters that its noise asks for.
        plain: behind those that are fitted.
        fit: of it.
        held_out: the fitted model on the other part.
        restamped: that of the same log with repeated rows left out and the others at even times.
        held_out_repeats: s, of rows that repeat the one before in the other part.
        worse: printed lines on the logs of `WORSE`.
    """

    model: CompiledModel
    log: Log
    prepared: PreparedLogs
    plain: PreparedLogs
    fit: FitResult
    held_out: Comparison
    restamped: Comparison
    held_out_repeats: np.ndarray
    worse: dict[str, str]

    @cached_property
    def masked_rows(self) -> Observation:
        """Returns the rows behind the filters that the noise asks for."""
        return build_observation(self.model, [self.log], self.prepared)

    @cached_property
    def rows(self) -> Observation:
        """Returns the rows that are fitted."""
        return build_observation(self.model, [self.log], self.plain)

    @cached_property
    def repeated(self) -> np.ndarray:
        """Returns the rows whose positions and torques are those of the row before."""
        return find_repeats(self.log)

    @cached_property
    def place(self) -> tuple[int, int]:
        """Returns the repeated row where a joint moves fastest, and that joint."""
        steps = np.abs(self.log.q[self.repeated + 1] - self.log.q[self.repeated])
        row, joint = np.unravel_index(int(np.argmax(steps)), steps.shape)
        return int(self.repeated[row]), int(joint)

    @property
    def window(self) -> tuple[float, float]:
        """Returns the seconds around that row which are drawn."""
        middle = float(self.log.time[self.place[0]])
        return middle - ZOOM, middle + ZOOM

    @property
    def raw_acceleration(self) -> np.ndarray:
        """Returns second differences of the logged position of that joint, rad/s^2."""
        step = float(np.median(np.diff(self.log.time)))
        return np.asarray(np.diff(self.log.q[:, self.place[1]], 2) / step**2)

    @cached_property
    def slowest_joint(self) -> int:
        """Returns the joint of which most samples are masked for low speed."""
        return int(np.argmax([joint.slow for joint in self.masked_rows.report.joints]))

    @property
    def noise(self) -> ChannelNoise:
        """Returns the noise of the positions of that joint."""
        return self.prepared.noise.joints[self.place[1]]


def run_log(data: Path) -> LogRun:
    """Runs the whole way on the measured log.

    Args:
        data: folder of the measured sets.
    """
    warnings.simplefilter("ignore", FitWarning)
    one = next(one for one in list_sets() if one.label == "fer_bag")
    with tempfile.TemporaryDirectory() as folder:
        robot = write_robot(one, data, Path(folder))
        training, held_out = (
            [place_log(one, log, data) for log in logs] for logs in (one.training, one.held_out)
        )
        identified = api.identify(robot, training, holdout=held_out)
        model = compile_model(generate(derive(load(robot))))
        logs = read_logs(model, training)
        asked = choose_repairs(model, logs, Processing())
        repair = LogRepair(logs, model.spec)
        widest = prepare_logs(model.spec, logs, asked, repair)
        prepared = limit_cutoffs(model, widest, asked)
        plain = choose_filters(model, logs, widest, asked, repair)
        (log,), (other,) = logs, read_logs(model, held_out)
        worse = {key: quote_lines(data, *what) for key, what in WORSE.items()}
        even = Path(folder) / "even.parquet"
        restamp_rows(data / one.folder / "excitation.parquet").to_parquet(even)
        parts = [
            [f"{even}@{part.partition('@')[2]}" for part in some] for some in (training, held_out)
        ]
        restamped = api.identify(robot, parts[0], holdout=parts[1])
        compared = identified.compare(), restamped.compare()
        return LogRun(
            model,
            log,
            prepared,
            plain,
            identified.fit,
            *compared,
            other.time[find_repeats(other)],
            worse,
        )


def find_repeats(log: Log) -> np.ndarray:
    """Returns the rows whose positions and torques are those of the row before."""
    steps = np.diff(np.hstack([log.q, log.tau]), axis=0)
    return np.flatnonzero((steps == 0.0).all(axis=1)) + 1


def restamp_rows(path: Path) -> pd.DataFrame:
    """Returns a log without rows that repeat the one before, the others at even times."""
    frame = pd.read_parquet(path)
    values = frame.drop(columns="time").to_numpy()
    is_new = np.append(True, (np.diff(values, axis=0) != 0.0).any(axis=1))
    frame, time = frame[is_new].reset_index(drop=True), frame["time"].to_numpy()
    return frame.assign(time=np.linspace(time[0], time[-1], len(frame)))


def quote_lines(data: Path, name: str, log: str, pattern: str) -> str:
    """Returns the lines with the pattern that are printed of the processing of another log."""
    with tempfile.TemporaryDirectory() as folder:
        one = MeasuredSet(name, "robot.toml", (log,), ())
        model = compile_model(generate(derive(load(write_robot(one, data, Path(folder))))))
        report = api.observe(model, read_logs(model, [place_log(one, log, data)])).report
    lines = [line.strip() for line in report.summary().splitlines()]
    return "\n".join(line for line in lines if re.search(pattern, line))


# The pictures.


def draw_pictures(run: LogRun) -> dict[str, fig.Picture]:
    """Returns {name: picture} of the page."""
    return {
        "raw": draw_raw(run),
        "noise": draw_noise(run),
        "rows": draw_rows(run),
        "residual": draw_residual(run),
    }


def _select(time: np.ndarray, window: tuple[float, float]) -> np.ndarray:
    return np.flatnonzero((time >= window[0]) & (time <= window[1]))


def draw_raw(run: LogRun) -> fig.Picture:
    """Draws position and torque of the joint that moves fastest at a repeated row."""
    log, (_, j), name = run.log, run.place, run.log.joints[run.place[1]]
    near = _select(log.time, run.window)
    held = np.intersect1d(near, run.repeated)
    panels = []
    for quantity, values in ((f"q{name} [rad]", log.q[:, j]), (f"tau{name} [N m]", log.tau[:, j])):
        whole = fig.Panel(
            f"{quantity.split()[0]}, as logged",
            "time [s]",
            quantity,
            (fig.Curve("as logged", log.time, values, RAW),),
            shade=run.window,
        )
        zoom = fig.Panel(
            "the grey interval",
            "time [s]",
            quantity,
            (
                fig.Curve("as logged", log.time[near], values[near], RAW),
                fig.Points("row", log.time[near], values[near], DOTS),
                fig.Points("repeats the row before", log.time[held], values[held], HELD),
            ),
        )
        panels.append((whole, zoom))
    return fig.Picture("log-to-rows-raw", "Raw channels", "", tuple(panels), 420)


def draw_noise(run: LogRun) -> fig.Picture:
    """Draws the spectrum of the position with its floor, and the acceleration made of it."""
    noise, log, (_, j) = run.noise, run.log, run.place
    hz = np.array(noise.frequency)
    filters = run.prepared.processing
    spectrum = fig.Panel(
        f"spectrum of q{noise.joint}",
        "frequency [Hz]",
        "rad²/Hz",
        (
            fig.Curve("spectrum", hz, np.array(noise.spectrum), fig.Style(fig.BLACK, 1.4)),
            fig.Curve("noise floor", hz, np.full(len(hz), noise.density), MODEL),
        ),
        scale="log",
        marks=(
            (noise.band_hz, "motion band"),
            (filters.parallel_cutoff, "parallel"),
            (filters.position_cutoff, "position filter"),
        ),
    )
    inner, segment = _select(log.time[1:-1], run.window), run.rows.stretches[0].segment
    near = _select(segment.time, run.window)
    acceleration = fig.Panel(
        f"acceleration of joint {noise.joint}",
        "time [s]",
        "rad/s²",
        (
            fig.Curve(
                "differences as logged", log.time[1:-1][inner], run.raw_acceleration[inner], RAW
            ),
            fig.Curve("as fitted", segment.time[near], segment.qdd[near, j], USED),
        ),
        zero=True,
    )
    return fig.Picture("log-to-rows-noise", "Noise", "", ((spectrum, acceleration),), 330)


def draw_rows(run: LogRun) -> fig.Picture:
    """Draws which samples count, and the torque behind both pairs of filters."""
    part, j = run.masked_rows.stretches[0], run.slowest_joint
    name, time = run.log.joints[j], part.segment.time
    intervals = find_intervals(time, ~part.usable[:, j])
    inner = intervals[(intervals[:, 0] > time[0] + 0.5) & (intervals[:, 1] < time[-1] - 0.5)]
    longest = max(inner if len(inner) else intervals, key=np.ptp)
    span = float(longest[0]) - 0.5, float(longest[1]) + 0.5
    speed = fig.Panel(
        f"speed of joint {name}, and samples that do not count",
        "time [s]",
        "rad/s",
        (fig.Curve("speed", time, part.segment.qd[:, j], USED),),
        zero=True,
        spans=(fig.Span("does not count", intervals, fig.SHADE),),
    )
    series: list[fig.Series] = []
    near = _select(run.log.time, span)
    series.append(fig.Curve("as logged", run.log.time[near], run.log.tau[near, j], RAW))
    for label, rows, style in (
        ("rows behind the filters above", run.masked_rows, fig.Style(fig.ORANGE, 9.0)),
        ("rows that are fitted", run.rows, fig.Style(fig.BLUE, 5.0)),
    ):
        at = _select(rows.time, span)
        at = at[rows.used[at, j]]
        series.append(fig.Points(label, rows.time[at], rows.torque[at, j], style))
    torque = fig.Panel(f"torque of joint {name}", "time [s]", "N m", tuple(series))
    return fig.Picture("log-to-rows-rows", "Rows", "", ((speed, torque),), 330)


def find_intervals(time: np.ndarray, is_out: np.ndarray) -> np.ndarray:
    """Returns (k, 2) first and last times of runs of samples that do not count."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_out.astype(int), [0]])))
    half = 0.5 * float(np.median(np.diff(time)))
    pairs = [(time[a] - half, time[b - 1] + half) for a, b in edges.reshape(-1, 2)]
    return np.array(pairs).reshape(-1, 2)


def draw_residual(run: LogRun) -> fig.Picture:
    """Draws measured and predicted torque of a joint on the held-out part, and what is left."""
    predicted, name = run.held_out.prediction, run.log.joints[JOINT]
    time, measured = predicted.time, predicted.measured[:, JOINT]
    model = predicted.predicted[:, JOINT]
    torque = fig.Panel(
        f"torque of joint {name}, held out",
        "time [s]",
        "N m",
        (fig.Curve("measured", time, measured, USED), fig.Curve("predicted", time, model, MODEL)),
    )
    left = fig.Panel(
        "residual", "time [s]", "N m", (fig.Curve("residual", time, measured - model, RAW),)
    )
    return fig.Picture(
        "log-to-rows-residual", "Residual", "", ((torque,), (left,)), 380, heights=(0.65, 0.35)
    )


# The numbers.


def collect_numbers(run: LogRun) -> dict[str, Any]:
    """Returns what the template asks for."""
    return {
        **collect_raw(run),
        **collect_filters(run),
        **collect_rows(run),
        **collect_residual(run),
        "verdict": run.fit.verdict.line if run.fit.verdict else "",
        "joints": list_joints(run),
        "worse": run.worse,
    }


def format_number(value: float, digits: int = 3) -> str:
    """Returns a number with so many significant digits, never in powers of ten."""
    rounded = float(f"{value:.{digits}g}")
    return f"{rounded:.0f}" if abs(rounded) >= 10.0 ** (digits - 1) else f"{rounded:.{digits}g}"


def collect_raw(run: LogRun) -> dict[str, Any]:
    """Returns numbers of the raw channels and of what is altered."""
    log, (row, j) = run.log, run.place
    steps = 1e3 * np.diff(log.time)
    scores = run.plain.processing.repairs or {}
    limit = THRESHOLDS.max_repair_ratio
    report = run.rows.report.logs[0]
    speed = (log.q[row + 1, j] - log.q[row, j]) / (log.time[row + 1] - log.time[row])
    segment = run.rows.stretches[0].segment
    acceleration = np.abs(segment.qdd[:, j])
    errors = [100.0 * one.relative_error for one in (run.held_out, run.restamped)]
    return {
        "rows": log.rows,
        "span": format_number(float(np.ptp(log.time))),
        "held_out_span": format_number(float(np.ptp(run.held_out.prediction.time))),
        "median_step": format_number(float(np.median(steps))),
        "least_step": format_number(float(steps.min())),
        "greatest_step": format_number(float(steps.max())),
        "repeated": len(run.repeated),
        "repeated_share": format_number(100.0 * len(run.repeated) / log.rows, 2),
        "moving": log.joints[j],
        "moving_speed": format_number(abs(float(speed)), 2),
        "raw_peak": format_number(float(np.abs(run.raw_acceleration[row - 2 : row + 1]).max()), 2),
        "acceleration": format_number(float(np.median(acceleration)), 2),
        "fitted_peak": format_number(
            float(acceleration[_select(segment.time, run.window)].max()), 2
        ),
        "held_out_error": format_number(errors[0]),
        "restamped_error": format_number(errors[1]),
        "is_restamped_better": errors[1] < limit * errors[0],
        "hypotheses": [
            (key.partition(": ")[2], f"{score:.2f}", score < limit) for key, score in scores.items()
        ],
        "limit": f"{limit:.2f}",
        "stamps": [line.strip() for line in report.format_lines() if "resampled" in line],
    }


def collect_filters(run: LogRun) -> dict[str, Any]:
    """Returns numbers of the noise, of the cut-offs and of the comparison with plain filters."""
    noise, by_noise, fitted = run.noise, run.prepared.processing, run.plain.processing
    said = [line for line in run.plain.choices if line not in run.prepared.choices]
    return {
        "band": format_number(noise.band_hz, 2),
        "deviation": format_number(1e3 * noise.deviation, 2),
        "crossover": format_number(noise.noise_crossover_hz or float("nan"), 2),
        "position": format_number(by_noise.position_cutoff),
        "parallel": format_number(by_noise.parallel_cutoff),
        "reasons": [line for line in run.prepared.choices if "Hz" in line],
        "plain": said[-1] if said else "",
        "fitted_cutoff": format_number(fitted.position_cutoff),
        "plain_limit": format_number(100.0 * (1.0 - THRESHOLDS.max_plain_ratio), 2),
        "judged": format_number(THRESHOLDS.judged_cutoff),
    }


def collect_rows(run: LogRun) -> dict[str, Any]:
    """Returns numbers of masks, of W and of the prior."""
    reports, rows = run.masked_rows.report.joints, run.rows
    slow = reports[run.slowest_joint]
    blocks, prior = number_blocks(rows, [run.log]), compute_prior_weights(rows)
    ours, without = (sum_blocks(rows, blocks, weights) for weights in (prior, 0.0 * prior))
    change = ours.compute_log_errors(ours.solutions) - without.compute_log_errors(without.solutions)
    weights = np.array([1.0 / joint.sigma**2 for joint in run.fit.joints])
    precision = np.tensordot(weights, ours.gram.sum(axis=1), 1) + np.diag(prior**2)
    shares = np.diag(np.linalg.inv(precision)) * prior**2
    return {
        "masked_samples": len(run.masked_rows.time),
        "masked_least": min(joint.used for joint in reports),
        "masked_most": max(joint.used for joint in reports),
        "slow_joint": slow.name,
        "slow_share": format_number(100.0 * slow.slow),
        "slow_floor": format_number(slow.speed_floor or 0.0, 2),
        "samples": run.fit.samples,
        "equations": run.fit.rows,
        "columns": len(rows.names),
        "condition": format_number(run.fit.condition_scaled),
        "prior_change": format_number(100.0 * float(np.nanmean(change)), 1),
        "prior_parameter": rows.names[int(np.argmax(shares))],
        "prior_share": format_number(100.0 * float(shares.max()), 2),
    }


def collect_residual(run: LogRun) -> dict[str, Any]:
    """Returns numbers of the residual that is drawn."""
    largest = run.held_out.joints[JOINT].largest
    away = np.abs(run.held_out_repeats - largest.time).min(initial=np.inf)
    return {
        "drawn": run.log.joints[JOINT],
        "residual_peak": format_number(abs(largest.value), 2),
        "peak_distance": f"{away:.2f}",
        "is_peak_repeated": bool(away < 0.1),
    }


def list_joints(run: LogRun) -> list[dict[str, str]]:
    """Returns a row of the last table for each joint."""
    verdicts = run.fit.verdict.by_joint if run.fit.verdict else {}
    held_out = {joint.joint.name: joint for joint in run.held_out.joints}
    table = []
    for joint in run.fit.joints:
        size = np.sqrt(np.mean(run.rows.torque[:, run.log.joints.index(joint.name)] ** 2))
        table.append(
            {
                "name": joint.name,
                "rows": str(joint.rows),
                "torque": format_number(float(size)),
                "sigma": format_number(joint.sigma, 2),
                "error": format_number(100.0 * (joint.relative_error or float("nan"))),
                "held_out": format_number(100.0 * held_out[joint.name].relative_error),
                "state": verdicts[joint.name].state,
            }
        )
    return table


def render_page(run: LogRun) -> str:
    """Returns the page."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    return environment.get_template("log_page.md.jinja").render(collect_numbers(run))


def main(words: Sequence[str] | None = None) -> int:
    """Writes the page and its pictures."""
    parser = argparse.ArgumentParser(
        prog="python -m docsite.log_page", description=str(__doc__).partition("\n")[0]
    )
    parser.add_argument("--data", type=Path, required=True, help="folder of the measured sets")
    run = run_log(parser.parse_args(words).data)
    PAGE.write_text(render_page(run), encoding="utf-8")
    for name, picture in draw_pictures(run).items():
        PAGE.with_name(f"log-to-rows-{name}.svg").write_bytes(render_images(picture)["svg"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
