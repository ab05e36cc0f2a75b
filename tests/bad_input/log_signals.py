"""Logs that can be read and whose signals are wrong."""

import numpy as np

from tests.bad_input.fits import true_values, unusable_or_true
from tests.bad_input.row import Outcome, Row, row
from tests.bad_input.yard import Table, Yard

FIT = "fit two-link bad.csv --out m.json --json f.json"
COMPARE = "compare m.json bad.csv --json c.json"
DIAGNOSE = "diagnose m.json bad.csv --json d.json"
SAMPLES = 1600
HALF = SAMPLES // 2


def signal(
    what: str, outcome: Outcome, edit: object, *words: str, run: str = FIT, of: str = "a.csv",
    theme: str = "signal",
) -> Row:  # fmt: skip
    """A row of a log of two-link with its columns edited in place."""

    def make(yard: Yard) -> None:
        yard.log("bad.csv", edit, of)  # type: ignore

    check = None
    if run == FIT:
        check = {"works": true_values, "told": unusable_or_true, "ends": unusable_or_true}.get(
            outcome
        )
    return row(f"{theme}: {what}", outcome, run, *words, make=make, check=check)


def put(**columns: object) -> object:
    """Edits columns by name: functions of the column, or values."""

    def edit(table: Table) -> None:
        for name, new in columns.items():
            table[name] = new(table[name]) if callable(new) else new

    return edit


def without(*names: str) -> object:
    """Leaves columns out."""
    return lambda table: {k: v for k, v in table.items() if k not in names}


def rows(chosen: object) -> object:
    """Keeps rows: a slice or an array of indices."""
    return lambda table: {k: v[chosen] for k, v in table.items()}  # type: ignore


def at(first: int, last: int, value: object) -> object:
    """Rows first to last of a column made of `value`: a number or a function of them."""

    def change(values: np.ndarray) -> np.ndarray:
        values = values.copy()
        part = values[first:last]
        values[first:last] = value(part) if callable(value) else value
        return values

    return change


def late(samples: int) -> object:
    """The column some samples late."""
    return lambda v: np.r_[np.full(samples, v[0]), v[:-samples]]


def noisy(size: float) -> object:
    """The column with white noise, from a fixed seed."""
    return lambda v: v + size * np.random.default_rng(5).standard_normal(len(v))


def _speeds(lag: int) -> object:
    """Logged velocities, that of joint 2 late."""

    def edit(table: Table) -> None:
        for joint in "12":
            table[f"qd{joint}"] = np.gradient(table[f"q{joint}"], table["time"])
        if lag:
            table["qd2"] = late(lag)(table["qd2"])  # type: ignore

    return edit


def _exchanged(*pairs: tuple[str, str]) -> object:
    def edit(table: Table) -> None:
        for one, other in pairs:
            table[one], table[other] = table[other], table[one]

    return edit


def _jumping(table: Table) -> None:
    table["time"][HALF:] -= 2.0


def _gap(table: Table) -> Table:
    return {k: np.delete(v, np.s_[600:800]) for k, v in table.items()}


def _wrapped(values: np.ndarray) -> np.ndarray:
    return (values + np.pi) % (2 * np.pi) - np.pi + 2 * np.pi * (values > np.median(values))


CLOCK = [
    signal("a repeated row", "refused", rows(np.r_[0:500, 499:SAMPLES]), "time", "row 501"),
    signal("rows in disorder", "refused", rows(np.r_[0:500, 700:900, 500:700, 900:SAMPLES]),
        "time"),
    signal("clock set back", "refused", _jumping, "time", f"row {HALF + 1}"),
    signal("clock that stands", "refused", put(time=0.0 * np.arange(SAMPLES)), "time", "row 2"),
    signal("time missing in a row", "refused", put(time=at(50, 51, np.nan)), "time", "row 51"),
    signal("time missing", "refused", without("time"), "time"),
    signal("time in ms", "told", put(time=lambda v: 1000 * v), "second"),
    signal("time in minutes", "told", put(time=lambda v: v / 60), "second|time step|Hz"),
    signal("time in ns", "told", put(time=lambda v: 1e9 * v), "second"),
    signal("time in 1e200 s", "refused", put(time=lambda v: 1e200 * v), "time", "second"),
    signal("time in 1e-200 s", "refused", put(time=lambda v: 1e-200 * v), "time", "second"),
    signal("counts for time", "told", put(time=np.arange(float(SAMPLES))), "second"),
    signal("since 1970", "works", put(time=lambda v: 1.7e9 + v)),
    signal("before zero", "works", put(time=lambda v: v - 100.0)),
    signal("one row of another century", "told",
           put(time=at(SAMPLES - 1, SAMPLES, lambda v: v + 3e9)), "gap|pieces"),
    signal("a second is lost", "told", _gap, "1 gaps"),
    signal("jitter of half a step", "told",
           put(time=lambda v: v + 0.002 * np.sin(1e5 * np.arange(len(v)))), "vary"),
    signal("10 rows", "refused", rows(np.s_[:10]), "row|sample|s"),
    signal("1 row", "refused", rows(np.s_[:1]), "row"),
    signal("50 rows", "ends", rows(np.s_[:50]), "rows|samples|usable"),
    signal("a quarter of a second", "ends", rows(np.s_[:100]), "usable|sample|row|essential"),
    signal("20 Hz of 200", "ends", rows(np.s_[::10]), "Hz"),
    signal("every piece too short", "refused", put(segment=np.arange(SAMPLES) // 3),
        "segment|piece"),
    signal("a segment without a number", "refused",
           put(segment=np.r_[np.nan, np.zeros(SAMPLES - 1)]), "segment", "row 1"),
    signal("segments that tell two runs apart", "works", put(segment=np.arange(SAMPLES) // HALF)),
]  # fmt: skip

POSITION = [
    signal("no position of joint 2", "refused", without("q2"), "q2"),
    signal("position empty", "refused", put(q2=np.full(SAMPLES, np.nan)), "q2", "no values"),
    signal("position that stands still", "ends", put(q2=np.zeros(SAMPLES)), "joint 2|q2"),
    signal("both stand still", "refused", put(q1=np.zeros(SAMPLES), q2=np.zeros(SAMPLES)),
           "move|moving|stand|speed|motion"),
    signal("position in degrees", "ends", put(q1=np.degrees, q2=np.degrees), "rad|degrees"),
    signal("one joint in degrees", "told", put(q2=np.degrees),
           "joint 2|q2", "degrees|rad"),
    signal("position in mm", "ends", put(q1=lambda v: 1000 * v), "mm|rad|q1"),
    signal("position in turns", "ends", put(q2=lambda v: v / (2 * np.pi)), "q2|joint 2"),
    signal("position in encoder counts", "ends", put(q1=lambda v: np.round(v * 4096 / 6.283)),
           "q1|joint 1"),
    signal("sign of joint 1 turned", "told", put(q1=lambda v: -v), "joint 1|q1", "sign"),
    signal("positions exchanged", "told", _exchanged(("q1", "q2")), "exchanged|swapped"),
    signal("joints exchanged", "told", _exchanged(("q1", "q2"), ("tau1", "tau2"), ("qc1", "qc2")),
           "exchanged|swapped|order of columns"),
    signal("a turn too much from half way", "ends",
           put(q1=at(HALF, SAMPLES, lambda v: v + 2 * np.pi)), "q1", "jump|turn|wrap|leap"),
    signal("a turn too much, back again", "ends", put(q2=at(600, 700, lambda v: v - 2 * np.pi)),
           "q2", "jump|turn|wrap|leap"),
    signal("wrapped at pi", "ends", put(q2=_wrapped), "q2", "jump|turn|wrap|leap"),
    signal("wrapped in degrees", "ends",
           put(q1=lambda v: np.degrees(v) % 360), "q1|joint 1", "rad|degrees|jump|turn"),
    signal("a spike of 0.5 rad", "ends", put(q1=at(700, 701, lambda v: v + 0.5)), "q1",
        "spike|jump|leap"),
    signal("ten spikes of 0.5 rad", "ends",
           put(q1=lambda v: v + 0.5 * (np.arange(len(v)) % 160 == 80)), "q1", "spike|jump|leap"),
    signal("a dropout to 0", "ends", put(q1=at(700, 705, 0.0)), "q1", "spike|jump|leap|step|leap"),
    signal("a position of 1e300", "ends", put(q1=at(700, 701, 1e300)), "q1|joint 1"),
    signal("a position inf", "told", put(q1=at(700, 701, np.inf)), "q1", "without a value"),
    signal("position frozen for a second", "told", put(q1=at(700, 900, lambda v: v[0])),
           "q1|joint 1", "frozen|stands|repeat|stuck|constant|jump"),
    signal("position late by 40 ms", "told", put(q2=late(8)), "joint 2|q2", "late|delay|ms"),
    signal("position coarse", "ends", put(q1=lambda v: np.round(v, 1)), "joint 1"),
    signal("position noisy", "ends", put(q1=noisy(0.05)), "joint 1"),
    signal("half the positions missing", "ends",
           put(q1=lambda v: np.where(np.arange(len(v)) % 2, v, np.nan)), "q1|joint 1"),
]  # fmt: skip

TORQUE = [
    signal("no torque", "refused", without("tau1", "tau2"), "tau1", "joint 1"),
    signal("torque empty", "refused", put(tau1=np.full(SAMPLES, np.nan)), "joint 1"),
    signal("every torque zero", "refused", put(tau1=np.zeros(SAMPLES), tau2=np.zeros(SAMPLES)),
           "every measured torque is 0"),
    signal("one torque zero", "told", put(tau2=np.zeros(SAMPLES)), "joint 2", "never changes"),
    signal("one torque constant", "told", put(tau2=np.full(SAMPLES, 3.0)), "joint 2",
           "never changes"),
    signal("torque in N mm", "told", put(tau1=lambda v: 1000 * v), "joint 1|tau1"),
    signal("torque of both of the other sign", "told", put(tau1=lambda v: -v, tau2=lambda v: -v),
           "sign|negative"),
    signal("torque of one of the other sign", "told", put(tau2=lambda v: -v), "joint 2", "sign"),
    signal("torques exchanged", "told", _exchanged(("tau1", "tau2")), "exchanged|swapped"),
    signal("torque late by 40 ms", "told", put(tau1=late(8), tau2=late(8)), "late|delay|lag"),
    signal("torque spike of 1e6", "ends", put(tau1=at(700, 701, 1e6)), "tau1|joint 1",
           "spike|jump|leap"),
    signal("torque spike of 500 N m", "ends", put(tau1=at(700, 701, 500.0)), "tau1|joint 1",
           "spike|jump|leap"),
    signal("torque of 1e300", "ends", put(tau1=at(700, 701, 1e300)), "tau1|joint 1"),
    signal("torque inf", "told", put(tau1=at(700, 710, np.inf)), "tau1", "without a value"),
    signal("torque clipped", "told", put(tau1=lambda v: np.clip(v, -8, 8)), "joint 1|tau1",
           "saturat|limit"),
    signal("torque of noise", "told", put(tau1=lambda v: noisy(10.0)(0 * v)), "joint 1|usable"),
    signal("torque of the other log", "told", put(tau1=lambda v: v[::-1]), "joint 1|usable"),
    signal("torque dead for a second", "told", put(tau1=at(700, 900, 0.0)), "joint 1|tau1"),
    signal("a third of the torques missing", "told",
           put(tau1=lambda v: np.where(np.arange(len(v)) % 3, v, np.nan)), "tau1",
           "without a value"),
    signal("gravity of the moon in the torque", "ends", put(tau1=lambda v: v / 6), "joint 1"),
]  # fmt: skip

SPEED = [
    signal("speeds as they are", "works", _speeds(0)),
    signal("speed of joint 2 late by 15 ms", "told", _speeds(3), "qd2|joint 2", "late|delay|ms"),
    signal("speed of joint 2 late by 40 ms", "told", _speeds(8), "qd2|joint 2", "late|delay|ms"),
    signal("speed of joint 2 late by 80 ms", "ends", _speeds(16), "qd2|joint 2"),
    signal("speed in degrees per second", "refused",
           lambda t: (_speeds(0)(t), put(qd1=np.degrees)(t))[0], "qd1"),
    signal("speeds exchanged", "refused",
           lambda t: (_speeds(0)(t), _exchanged(("qd1", "qd2"))(t))[0], "qd1"),
    signal("speed of the other sign", "refused",
           lambda t: (_speeds(0)(t), put(qd2=lambda v: -v)(t))[0], "qd2"),
    signal("speed of one joint only", "told", lambda t: put(
        qd1=np.gradient(t["q1"], t["time"]))({**t}) or t | {"qd1": np.gradient(t["q1"], t["time"])},
        "qd2"),
    signal("speed of zeros", "ends", put(qd1=np.zeros(SAMPLES), qd2=np.zeros(SAMPLES)), "qd1"),
    signal("speed insisted on and missing", "refused", put(), "qd1", "--derivatives|derivatives",
           run=FIT + " --derivatives log"),
]  # fmt: skip

HELD = [
    signal(what, "ends", edit, *words, run=command, of="b.csv", theme=command.split()[0])
    for command in (COMPARE, DIAGNOSE)
    for what, edit, words in (
        ("positions in degrees", put(q1=np.degrees, q2=np.degrees), ("degrees|rad",)),
        ("sign of joint 2", put(q2=lambda v: -v), ("sign",)),
        ("torque of the other sign", put(tau2=lambda v: -v), ("joint 2", "sign")),
        ("torques exchanged", _exchanged(("tau1", "tau2")), ("exchanged|swapped",)),
        ("joints exchanged", _exchanged(("q1", "q2"), ("tau1", "tau2")),
         ("exchanged|swapped|unexplained|cannot show",)),
        ("time in ms", put(time=lambda v: 1000 * v), ("second|Hz",)),
        ("a turn too much", put(q1=at(HALF, SAMPLES, lambda v: v + 2 * np.pi)), ("q1",
            "jump|turn|wrap|leap")),
        ("a spike of 0.5 rad", put(q1=at(700, 701, lambda v: v + 0.5)), ("q1", "spike|jump|leap")),
        ("a torque spike", put(tau1=at(700, 701, 500.0)), ("tau1|joint 1", "spike|jump|leap")),
        ("torque never changes", put(tau2=np.full(SAMPLES, 3.0)), ("joint 2",)),
        ("torque 1000 times", put(tau1=lambda v: 1000 * v), ("joint 1",)),
        ("torque clipped", put(tau1=lambda v: np.clip(v, -8, 8)), ("joint 1|tau1",)),
    )
]  # fmt: skip

ROWS = [*CLOCK, *POSITION, *TORQUE, *SPEED, *HELD]
