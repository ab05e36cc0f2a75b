"""How well the default fit predicts measured motion, beside a fit as textbooks have it.

Run from the top of the checkout: `python -m benchmarks.textbook --data FOLDER [--only SET ...]`,
with the folder of the measured sets. The textbook fit: rows at even times, zero-phase Butterworth
low-pass of order 4, central differences, the same low-pass on both sides of the regression, weights
1 / sigma_j^2 iterated, and of some cut-offs that which predicts blocks of the training logs best.

Both are judged by one evaluation that belongs to neither: every row of the held-out logs, their
positions and both sides of the equation behind one zero-phase low-pass of 5 Hz; the error of joint
j is ||tau_j - W_j beta|| / ||tau_j||. Printed is the error of modeler's fit over that of the
textbook's: geometric mean over the joints, and the worst joint. A joint is worse if it is so by
more than 10 %, and by more than two standard errors of ten blocks of time.
"""

import argparse
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.signal import butter, sosfiltfilt

import modeler
from modeler.api import CompiledModel, compile_model, derive, generate, load
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import ModelerError
from modeler.core.manifest import ModuleSpec

CUTOFFS = (2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 40.0)  # Hz
JUDGED = 5.0  # Hz
ROOT = Path(__file__).parents[1]
EFFECTS = '\n[effects]\nviscous = "all"\ncoulomb = "all"\noffset = "all"\n'


@dataclass(frozen=True)
class MeasuredSet:
    """Logs of one machine; `name@start:end` is a part of one, in seconds."""

    folder: str
    robot: str
    training: tuple[str, ...]
    held_out: tuple[str, ...]
    name: str = ""
    also: str = ""

    @property
    def label(self) -> str:
        return self.name or self.folder


@dataclass(frozen=True)
class Motion:
    """One uniform piece of a log; n samples."""

    step: float
    q: np.ndarray
    tau: np.ndarray


@dataclass(frozen=True)
class Score:
    """Errors of both fits (joints,), and logarithms of their ratio by block (blocks, joints)."""

    ours: np.ndarray
    textbook: np.ndarray
    blocks: np.ndarray
    joints: tuple[str, ...]

    @property
    def ratio(self) -> np.ndarray:
        return self.ours / self.textbook

    @property
    def worse(self) -> list[int]:
        """Joints that are surely more than 10 % worse."""
        error = self.blocks.std(axis=0, ddof=1) / len(self.blocks) ** 0.5
        sure = np.log(self.ratio) - 2.0 * error > 0.0
        return [int(j) for j in np.flatnonzero(sure & (self.ratio > 1.1))]


def list_sets() -> Iterator[MeasuredSet]:
    """The measured sets, one way; `exchange` gives the other."""
    ur = tuple(
        f"ur-20_{name}" for name in ("02_19_14harm50sec", "02_12-50sec_12harm", "02_05-20sec_8harm")
    )
    yield MeasuredSet("emps", "emps", ("train",), ("pulses",))
    yield MeasuredSet(
        "ur10e", "ur10e", ur, ("ur-20_02_19_15harm50sec", "ur-20_01_17-ptp_10_points")
    )
    yield MeasuredSet("tx40", "tx40", ("log_joint@0:4.6",), ("log_joint@4.6:7.45",))
    yield MeasuredSet("dvrk_psm", "dvrk-psm", ("one",), ("two",))
    kinova = tuple(f"traj_{k}" for k in (1, 3, 5)), tuple(f"traj_{k}" for k in (2, 4))
    yield MeasuredSet("kinova_gen3", "kinova_gen3", *kinova)
    yield MeasuredSet(
        "panda", "panda", ("excitation@:11.55",), ("excitation@11.55:",), also=EFFECTS
    )
    yield MeasuredSet(
        "dualarm7", "page:dualarm7", ("excitation_13", "excitation_15"), ("excitation_52",)
    )
    yield MeasuredSet("dvrk_mtm", "robot.toml", ("one",), ("two",))
    sines = ("055032", "055640", "055903", "060143", "060245", "060329")
    yield MeasuredSet(
        "dfki_pendulum",
        "robot_a.toml",
        tuple(f"a_{n}" for n in sines),
        ("a_061157", "a_061705"),
        also="coulomb",
    )
    names = [f"c_{k:02d}" for k in range(6)], ["c_06", "c_12"]
    yield MeasuredSet(
        "dfki_pendulum", "robot_c.toml", tuple(names[0]), tuple(names[1]), "dfki_c", "coulomb"
    )
    yield MeasuredSet("ur10_bag", "robot.toml", ("excitation@:18",), ("excitation@18:",))
    yield MeasuredSet(
        "ur10_bag",
        "robot.toml",
        ("excitation@:18",),
        ("excitation@18:",),
        "ur10_bag_offset",
        "offset",
    )
    arm = EFFECTS.replace("viscous", 'rotor_inertia = "all"\nviscous')
    yield MeasuredSet("fer_bag", "panda", ("excitation@:15",), ("excitation@15:",), also=arm)
    yield MeasuredSet("cobot6", "robot.toml", ("1", "2"), ("3",))
    logs = [f"j{k}" for k in (1, 3, 4, 6, 7)]
    yield MeasuredSet(
        "damiao7", "robot.toml", tuple(f"{n}@:60%" for n in logs), tuple(f"{n}@60%:" for n in logs)
    )
    for name in logs:
        yield MeasuredSet(
            "damiao7", "robot.toml", (f"{name}@:60%",), (f"{name}@60%:",), f"damiao7_{name}"
        )


def exchange(one: MeasuredSet) -> MeasuredSet:
    """Training and held-out logs in each other's place."""
    return MeasuredSet(one.folder, one.robot, one.held_out, one.training, f"{one.label}*", one.also)


def write_robot(one: MeasuredSet, data: Path, folder: Path) -> Path:
    """The robot file of a set."""
    if one.robot.startswith("page:"):
        page = (ROOT / "docs/studies/measured-sets.md").read_text("utf-8")
        found = re.search(rf"^```toml\n# {one.robot[5:]}\.toml\n(.*?)^```", page, re.M | re.S)
        assert found is not None
        text = found[1]
    elif one.robot.endswith(".toml"):
        text = (data / one.folder / one.robot).read_text("utf-8")
    else:
        text = read_builtin_robot(one.robot)
    if one.also.startswith("\n"):
        text += one.also
    elif one.also:
        text = text.replace("[effects]", f'[effects]\n{one.also} = "all"')
    place = folder / "robot.toml"
    place.write_text(text, encoding="utf-8")
    return place


def place_log(one: MeasuredSet, log: str, data: Path) -> str:
    """A log as `modeler` takes it; percents are of its time."""
    name, at, part = log.partition("@")
    place = data / one.folder / f"{name}.parquet"
    if "%" in part:
        time = pd.read_parquet(place, columns=["time"])["time"].to_numpy()
        ends = [
            f"{time[0] + float(x[:-1]) / 100.0 * (time[-1] - time[0]):.6f}" if x else ""
            for x in part.split(":")
        ]
        part = ":".join(ends)
    return f"{place}{at}{part}"


def read_motions(place: str, spec: ModuleSpec) -> Iterator[Motion]:
    """Pieces between gaps of more than five steps, at even times; repeated rows are left out."""
    path, _, part = place.partition("@")
    frame = pd.read_parquet(path)
    low, high = (
        float(x) if x else sign * np.inf
        for x, sign in zip((part or ":").split(":"), (-1, 1), strict=True)
    )
    frame = frame[(frame["time"] >= low) & (frame["time"] < high)]
    joints = [joint.name for joint in spec.joints if f"q{joint.name}" in frame]
    torque = [f"tau{j}" if f"tau{j}" in frame else f"current{j}" for j in joints]
    gains = [
        1.0 if name[0] == "t" else joint.drive_gain or 1.0
        for name, joint in zip(torque, spec.joints, strict=True)
    ]
    values = frame[["time", *(f"q{j}" for j in joints), *torque]].dropna().to_numpy()
    values = values[np.diff(np.maximum.accumulate(values[:, 0]), prepend=-np.inf) > 0.0]
    fresh = np.any(np.diff(values[:, 1:], axis=0, prepend=np.nan) != 0.0, axis=1)
    values = values[fresh]
    step = float(np.median(np.diff(values[:, 0])))
    for rows in np.split(values, np.flatnonzero(np.diff(values[:, 0]) > 5.0 * step) + 1):
        time = np.arange(rows[0, 0], rows[-1, 0] + 0.5 * step, step)
        if len(time) > 40:
            at = [np.interp(time, rows[:, 0], column) for column in rows[:, 1:].T]
            n = len(joints)
            yield Motion(
                step, np.unwrap(np.stack(at[:n], axis=1), axis=0), np.stack(at[n:], axis=1) * gains
            )


def build_rows(
    model: CompiledModel, motions: Sequence[Motion], cutoff: float
) -> tuple[np.ndarray, np.ndarray]:
    """W (rows, joints, columns) and tau (rows, joints), all behind one low-pass."""
    columns, torques = [], []
    for motion in motions:
        share = min(2.0 * cutoff * motion.step, 0.8)
        sos = butter(4, share, output="sos")
        pad = min(len(motion.q) - 1, int(3.0 / share))

        def smooth(values: np.ndarray, sos: np.ndarray = sos, pad: int = pad) -> np.ndarray:
            return np.asarray(sosfiltfilt(sos, values, axis=0, padlen=pad))

        q = smooth(motion.q)
        qd = np.gradient(q, motion.step, axis=0)
        qdd = np.gradient(qd, motion.step, axis=0)
        edge = min(len(q) // 4, int(0.5 / (cutoff * motion.step)))
        every = max(1, int(0.1 / (cutoff * motion.step)))
        W = model.base_regressor(q, qd, qdd)
        n, J, c = W.shape
        rows = slice(edge, n - edge, every)
        columns.append(smooth(W.reshape(n, -1)).reshape(n, J, c)[rows])
        torques.append(smooth(motion.tau)[rows])
    return np.concatenate(columns), np.concatenate(torques)


def solve_weighted(W: np.ndarray, tau: np.ndarray, driven: np.ndarray) -> np.ndarray:
    """beta (c,) with weights 1 / sigma_j^2 to a fixed point; the shortest if it is not unique."""
    sigma = np.sqrt(np.mean(tau**2, axis=0))
    beta = np.zeros(W.shape[2])
    for _ in range(50):
        A = np.concatenate([W[:, j] / sigma[j] for j in driven])
        y = np.concatenate([tau[:, j] / sigma[j] for j in driven])
        scale = np.linalg.norm(A, axis=0)
        scale[scale == 0.0] = 1.0
        new = np.linalg.lstsq(A / scale, y, rcond=1e-8)[0] / scale
        left = np.sqrt(np.mean((tau - W @ new) ** 2, axis=0))
        sigma, before = np.maximum(left, 1e-6 * sigma), beta
        beta = new
        if np.linalg.norm(beta - before) < 1e-9 * np.linalg.norm(beta):
            break
    return beta


def find_driven(tau: np.ndarray) -> np.ndarray:
    return np.flatnonzero(np.any(tau != 0.0, axis=0))


def relative_errors(W: np.ndarray, tau: np.ndarray, beta: np.ndarray) -> np.ndarray:
    size = np.linalg.norm(tau, axis=0)
    return np.linalg.norm(tau - W @ beta, axis=0) / np.where(size > 0.0, size, np.nan)


def fit_textbook(model: CompiledModel, motions: Sequence[Motion]) -> tuple[np.ndarray, float]:
    """beta (c,) and the cut-off that predicts fifths of the training logs from the others best."""
    seen_W, seen_tau = build_rows(model, motions, JUDGED)
    block = np.arange(len(seen_tau)) * 5 // len(seen_tau)
    best = (np.inf, CUTOFFS[0], np.zeros(0))
    for cutoff in CUTOFFS:
        if cutoff > 0.4 / max(motion.step for motion in motions):
            continue
        W, tau = build_rows(model, motions, cutoff)
        driven, own = find_driven(tau), np.arange(len(tau)) * 5 // len(tau)
        left = np.full(seen_tau.shape, np.nan)
        for k in range(5):
            beta = solve_weighted(W[own != k], tau[own != k], driven)
            left[block == k] = seen_tau[block == k] - seen_W[block == k] @ beta
        score = float(np.mean(np.log(np.sqrt(np.mean(left[:, driven] ** 2, axis=0)))))
        if score < best[0]:
            best = score, cutoff, solve_weighted(W, tau, driven)
    return best[2], best[1]


@dataclass(frozen=True)
class Judge:
    """Held-out rows W (rows, joints, columns), tau (rows, joints), and the textbook's beta (c,)."""

    W: np.ndarray
    tau: np.ndarray
    beta: np.ndarray
    cutoff: float
    joints: tuple[str, ...]

    def score(self, beta: np.ndarray) -> Score:
        """Another beta (c,) beside it."""
        driven = find_driven(self.tau)
        blocks = [
            np.log(
                relative_errors(self.W[b], self.tau[b], beta)
                / relative_errors(self.W[b], self.tau[b], self.beta)
            )[driven]
            for b in np.array_split(np.arange(len(self.tau)), 10)
        ]
        ours, theirs = (relative_errors(self.W, self.tau, x)[driven] for x in (beta, self.beta))
        return Score(ours, theirs, np.stack(blocks), tuple(self.joints[j] for j in driven))


def make_judge(one: MeasuredSet, data: Path, robot: Path) -> Judge:
    """The textbook fit on the training logs, and the rows of the held-out ones."""
    model = compile_model(generate(derive(load(robot))))
    training, held_out = (
        [m for log in logs for m in read_motions(place_log(one, log, data), model.spec)]
        for logs in (one.training, one.held_out)
    )
    beta, cutoff = fit_textbook(model, training)
    W, tau = build_rows(model, held_out, JUDGED)
    return Judge(W, tau, beta, cutoff, tuple(joint.name for joint in model.spec.joints))


def main(words: Sequence[str] | None = None) -> int:
    """Print a line a set, and the means."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.textbook", description=__doc__.partition("\n")[0]
    )
    parser.add_argument("--data", type=Path, required=True, help="folder of the measured sets")
    parser.add_argument("--only", nargs="+", default=[], metavar="SET", help="start of a name")
    asked = parser.parse_args(words)
    means, sets = [], 0
    every = [way for one in list_sets() for way in (one, exchange(one))]
    for one in every:
        if asked.only and not one.label.startswith(tuple(asked.only)):
            continue
        sets += 1
        with tempfile.TemporaryDirectory() as folder:
            robot = write_robot(one, asked.data, Path(folder))
            judge = make_judge(one, asked.data, robot)
            try:
                logs = [place_log(one, log, asked.data) for log in one.training]
                score = judge.score(np.asarray(modeler.identify(robot, logs).params))
            except ModelerError as error:
                print(f"{one.label:<18} refused: {str(error)[:150]}", flush=True)
                continue
        log_ratio = np.log(score.ratio)
        means.append(float(np.mean(log_ratio)))
        pairs = zip(score.joints, 100.0 * score.ours, 100.0 * score.textbook, strict=True)
        worse = ", ".join(score.joints[j] for j in score.worse)
        errors = " ".join(f"{j}:{a:.3g}/{b:.3g}" for j, a, b in pairs)
        print(
            f"{one.label:<18} {np.exp(means[-1]):6.3f} / {score.ratio.max():6.3f}  "
            f"{f'worse: {worse}' if worse else '':<18} (textbook at {judge.cutoff:g} Hz) {errors}",
            flush=True,
        )
    if means:
        print(f"mean of {len(means)} of {sets} sets: {np.exp(np.mean(means)):.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
