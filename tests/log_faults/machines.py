"""Logs of seven simulated machines, and the faults that are put into them.

A seed draws the machine, one of its recordings, the joint and the size of the fault.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from modeler.simulation import SimulationSettings, simulate
from tests import link_data
from tests.chain import Chain, chain_of

PAN_TILT = """
name = "pan-tilt"
gravity = [0, 0, -9.81]
parameters = {ZZ1 = 0.02, XX2 = 0.02, YY2 = 0.05, ZZ2 = 0.06, MX2 = 0.36, M2 = 3.0}
[mdh]
columns = ["j", "alpha", "d", "theta"]
rows = [["1", "pi/2", 0, "q1"], ["2", "pi/2", 0.15, "q2"]]
[effects]
viscous = "all"
coulomb = "all"
"""
"""A camera that swings about a level axis and turns about one across it."""

FOUR_AXES = """
name = "four-axes"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "alpha", "d", "theta", "r"]
rows = [["1", 0, 0, "q1", 0], ["2", "pi/2", 0.1, "q2", 0], ["3", 0, 0.35, "q3", 0],
        ["4", "-pi/2", 0.05, "q4", 0.3]]
[effects]
rotor_inertia = "all"
viscous = "all"
coulomb = "all"
"""

ROBOTS = {
    "two-link": "two-link",
    "pan-tilt": PAN_TILT,
    "demo-arm": "demo-arm",
    "stated": link_data.text(link_data.links()),
    "scara": "scara",
    "four-axes": FOUR_AXES,
    "ur10e": "ur10e",
}
LEVEL = ("two-link", "pan-tilt")
"""Whose first axis is level: gravity acts about it."""

ALONE = {"pan-tilt": ("2",), "scara": ("3", "4")}
"""Joints that share no parameter with others: nothing can show the scale of their torques."""

RECORDINGS = 3
SECONDS = 14.0
RATES = (250.0, 200.0, 500.0)  # Hz, of the recordings

Columns = dict[str, np.ndarray]
"""A log as a file has it: time, q and tau of each joint by its name."""


@cache
def open_machine(name: str) -> Chain:
    """The robot, derived and compiled once in a process."""
    return chain_of(ROBOTS[name])


@cache
def record(name: str, number: int) -> Columns:
    """A sound log, with an encoder's steps, noise of the torques and a little unmodelled torque."""
    settings = SimulationSettings(
        motion="exciting" if number else "point-to-point",
        duration=SECONDS,
        rate=RATES[number],
        seed=100 + number,
        parameter_seed=number,
        encoder_counts=(1_000_000, 200_000, 65_536)[number],
        torque_noise=(0.01, 0.02, 0.03)[number],
        process_noise=(0.0, 0.005, 0.01)[number],
    )
    made = simulate(open_machine(name).derivation.robot, settings)
    every = zip(made.joints, made.q.T, made.tau.T, strict=True)
    both = [(f"q{j}", q, f"tau{j}", tau) for j, q, tau in every]
    columns = {"time": made.time}
    columns |= {key: q for key, q, _, _ in both} | {key: tau for _, _, key, tau in both}
    return columns


@dataclass(frozen=True)
class FaultyLog:
    """A log with at most one fault.

    Attributes:
        machine: its name.
        columns: of the log.
        patterns: regular expressions one of which tells the fault; none without one.
        about: which channel, and how much.
    """

    machine: str
    columns: Columns
    patterns: tuple[str, ...]
    about: str


@dataclass
class Draw:
    """A machine and its log, which a fault changes; all joints, those that turn; random numbers."""

    machine: str
    columns: Columns
    joints: list[str]
    turning: list[str]
    rng: np.random.Generator

    @property
    def rate(self) -> float:
        """Rows a second."""
        return 1.0 / float(np.median(np.diff(self.columns["time"])))

    def choose(self, joints: list[str] | None = None) -> str:
        return str(self.rng.choice(self.joints if joints is None else joints))

    def moving_rows(self, joint: str, seconds: float) -> slice:
        """Rows at which a joint moves all the time, at least at a fifth of its top speed."""
        speed = np.abs(np.gradient(self.columns[f"q{joint}"]))
        speed = np.convolve(speed, np.full(9, 1 / 9), "same")
        count = round(seconds * self.rate)
        least = np.array([speed[k : k + count].min() for k in range(len(speed) - count)])
        start = self.rng.choice(np.flatnonzero(least >= min(0.2 * speed.max(), least.max())))
        return slice(int(start), int(start) + count)

    def size(self, joint: str) -> float:
        return float(np.ptp(self.columns[f"q{joint}"]))

    def delay(self, name: str, seconds: float) -> None:
        time = self.columns["time"]
        self.columns[name] = np.interp(time - seconds, time, self.columns[name])


Told = tuple[tuple[str, ...], str]
"""Regular expressions one of which tells the fault, and what was done, for people."""


def clip(draw: Draw) -> Told:
    j, share = draw.choose(), draw.rng.uniform(0.1, 0.25)
    q, upper = draw.columns[f"q{j}"], draw.rng.uniform() < 0.5
    end = q.max() - share * draw.size(j) if upper else q.min() + share * draw.size(j)
    draw.columns[f"q{j}"] = np.minimum(q, end) if upper else np.maximum(q, end)
    return (rf"\bq{j}: stays at .* end of its range",), f"q{j}, {100 * share:.0f} %"


def jump(draw: Draw) -> Told:
    j, share = draw.choose(), 10 ** draw.rng.uniform(-1.5, -0.5)
    start = draw.moving_rows(j, 0.1).start
    draw.columns[f"q{j}"][start:] += draw.rng.choice([-1, 1]) * share * draw.size(j)
    return (rf"\bq{j}: jumps by .* goes on from there",), f"q{j}, {100 * share:.0f} %"


def wrap(draw: Draw) -> Told:
    j = draw.choose(draw.turning)
    q = draw.columns[f"q{j}"]
    q[q > np.quantile(q, draw.rng.uniform(0.6, 0.8))] -= 2 * np.pi
    return (rf"\bq{j}: wraps",), f"q{j}"


def position_spikes(draw: Draw) -> Told:
    j, share = draw.choose(), draw.rng.uniform(0.05, 0.5)
    for row in draw.rng.integers(100, len(draw.columns["time"]) - 100, 3):
        size = draw.rng.choice([-1, 1]) * share * draw.size(j)
        draw.columns[f"q{j}"][row : row + draw.rng.integers(1, 3)] += size
    return (rf"\bq{j}: jumps by .* and back",), f"q{j}, {100 * share:.0f} %"


def torque_spikes(draw: Draw) -> Told:
    j, share = draw.choose(), draw.rng.uniform(1.0, 3.0)
    for row in draw.rng.integers(100, len(draw.columns["time"]) - 100, 3):
        size = draw.rng.choice([-1, 1]) * share * np.abs(draw.columns[f"tau{j}"]).max()
        draw.columns[f"tau{j}"][row : row + draw.rng.integers(1, 3)] += size
    return (rf"\btau{j}: spike",), f"tau{j}, {100 * share:.0f} %"


def frozen(draw: Draw) -> Told:
    j, seconds = draw.choose(), draw.rng.uniform(0.4, 1.2)
    rows = draw.moving_rows(j, seconds)
    draw.columns[f"tau{j}"][rows] = draw.columns[f"tau{j}"][rows.start]
    return (rf"\btau{j}: (?:repeats|keeps) one value",), f"tau{j}, {seconds:.1f} s"


def lost_rows(draw: Draw) -> Told:
    """The clock runs on: what is left is stamped as if nothing were missing."""
    seconds = draw.rng.uniform(0.1, 0.4)
    rows = draw.moving_rows(draw.choose(), seconds)
    left = np.delete(np.arange(len(draw.columns["time"])), rows)
    time = draw.columns["time"][: len(left)]
    draw.columns |= {name: values[left] for name, values in draw.columns.items()}
    draw.columns["time"] = time
    return (r"\bq\w+: jumps along its motion", r"rows (?:are|were) (?:lost|missing)"), (
        f"{seconds:.2f} s"
    )


def held(draw: Draw) -> Told:
    name = f"{draw.rng.choice(['q', 'tau'])}{draw.choose()}"
    rows = max(3, round(draw.rng.choice([0.01, 0.02, 0.03]) * draw.rate))
    values = draw.columns[name]
    draw.columns[name] = values[np.arange(len(values)) // rows * rows]
    return (rf"\b{name}: holds? each value",), f"{name}, {rows} rows"


def late(milliseconds: int) -> Callable[[Draw], Told]:
    """The torque of a joint comes later."""

    def delay(draw: Draw) -> Told:
        j = draw.choose()
        draw.delay(f"tau{j}", 1e-3 * milliseconds)
        span = range(round(0.75 * milliseconds), round(1.25 * milliseconds) + 1)
        near = "|".join(map(str, span))
        what = rf"(?:its torque comes (?:{near}) ms late|its position comes (?:{near}) ms early)"
        return (rf"\bjoint {j}: {what}",), f"tau{j}"

    return delay


def clock(draw: Draw) -> Told:
    factor = float(draw.rng.choice([2.0, 0.5]))
    draw.columns["time"] = draw.columns["time"] * factor
    return (
        rf"with all motion {factor:g} times as fast",
        r"the time of the log is",
    ), f"x {factor:g}"


def zero(draw: Draw) -> Told:
    """Of a joint whose zero matters: the last body may be turned, and one that turns upright."""
    inner = [j for j in draw.turning if j != draw.joints[-1]]
    inner = inner if draw.machine in LEVEL else inner[1:]
    j, degrees = draw.choose(inner), int(draw.rng.choice([90, -90]))
    draw.columns[f"q{j}"] = draw.columns[f"q{j}"] + np.deg2rad(degrees)
    return (rf"\bjoint {j}: its zero seems to be off by {degrees} degrees",), f"q{j}, {degrees}"


def doubled(draw: Draw) -> Told:
    joints = [j for j in draw.joints if j not in ALONE.get(draw.machine, ())]
    j, factor = draw.choose(joints), float(draw.rng.choice([2.0, 0.5]))
    draw.columns[f"tau{j}"] = draw.columns[f"tau{j}"] * factor
    many = r"(?:1\.[6-9]\d?|2\.[0-4]?\d?|2)" if factor > 1.0 else r"0\.(?:4|5|6)\d*"
    return (rf"\bjoint {j}: the measured torque is {many} times",), f"tau{j} x {factor:g}"


def turned_sign(draw: Draw) -> Told:
    j = draw.choose()
    draw.columns[f"tau{j}"] = -draw.columns[f"tau{j}"]
    return (rf"\bjoint {j}: the measured torque has the wrong sign",), f"tau{j}"


def exchanged(draw: Draw) -> Told:
    j, k = sorted(draw.rng.choice(draw.joints, 2, replace=False), key=draw.joints.index)
    a, b = f"tau{j}", f"tau{k}"
    draw.columns[a], draw.columns[b] = draw.columns[b], draw.columns[a]
    return (rf"\bjoints (?:{j} and {k}|{k} and {j}): their torques look exchanged",), f"{j}, {k}"


def units(draw: Draw) -> Told:
    j = draw.choose()
    draw.columns[f"tau{j}"] = draw.columns[f"tau{j}"] * 1e3
    return (rf"\bjoint {j}: the measured torque is .* \(is it in mN m\?\)",), f"tau{j}"


FAULTS: dict[str, Callable[[Draw], Told]] = {
    "clip": clip,
    "jump": jump,
    "wrap": wrap,
    "spike q": position_spikes,
    "spike tau": torque_spikes,
    "frozen": frozen,
    "lost rows": lost_rows,
    "held": held,
    "late 12 ms": late(12),
    "late 40 ms": late(40),
    "clock x 2": clock,
    "zero 90": zero,
    "torque x 2": doubled,
    "sign": turned_sign,
    "exchanged": exchanged,
    "mN m": units,
}
NONE = "none"


def make_log(fault: str, seed: int) -> FaultyLog:
    """Makes the log of a seed with a fault of `FAULTS`, or without one."""
    rng = np.random.default_rng([seed, *fault.encode()])
    names = [name for name in ROBOTS if not (fault == "zero 90" and name == "scara")]
    machine = names[seed % len(names)]  # the zeros of a SCARA turn bodies alone
    sound = record(machine, int(rng.integers(RECORDINGS)))
    columns = {name: values.copy() for name, values in sound.items()}
    spec = open_machine(machine).compiled.spec
    turning = [joint.name for joint in spec.joints if joint.unit == "rad"]
    draw = Draw(machine, columns, [joint.name for joint in spec.joints], turning, rng)
    told, about = FAULTS[fault](draw) if fault != NONE else ((), "")
    return FaultyLog(machine, draw.columns, told, about)
