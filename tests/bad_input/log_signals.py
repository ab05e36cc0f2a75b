"""Logs that can be read and whose signals are wrong."""

import numpy as np

from tests.bad_input.fits import true_values, unusable_or_true
from tests.bad_input.row import Outcome, Row, row
from tests.bad_input.workdir import Table, Workdir

FIT = "fit two-link bad.csv --out m.json --json f.json"
COMPARE = "compare m.json bad.csv --json c.json"
DIAGNOSE = "diagnose m.json bad.csv --json d.json"
SAMPLES = 1600
HALF = SAMPLES // 2


def signal(
    what: str, outcome: Outcome, edit: object, *words: str, run: str = FIT, of: str = "a.csv",
    theme: str = "signal", alone: bool = False,
) -> Row:  # fmt: skip
    """A row of a log of two-link with its columns edited in place."""

    def make(workdir: Workdir) -> None:
        workdir.log("bad.csv", edit, of)  # type: ignore

    check = None
    if run == FIT:
        check = {"works": true_values, "told": unusable_or_true, "ends": unusable_or_true}.get(
            outcome
        )
    return row(f"{theme}: {what}", outcome, run, *words, make=make, check=check, alone=alone)


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


def _gap(table: Table) -> Table:
    return {k: np.delete(v, np.s_[600:800]) for k, v in table.items()}


def _wrapped(values: np.ndarray) -> np.ndarray:
    return (values + np.pi) % (2 * np.pi) - np.pi + 2 * np.pi * (values > np.median(values))


CLOCK = [
    signal("a repeated row", "refused", rows(np.r_[0:500, 499:SAMPLES]), "time", "row 501"),
    signal("clock that stands", "refused", put(time=0.0 * np.arange(SAMPLES)), "time", "row 2"),
    signal("time in ms", "told", put(time=lambda v: 1000 * v), "second", alone=True),
    signal("time in 1e200 s", "refused", put(time=lambda v: 1e200 * v), "time", "second"),
    signal("since 1970", "works", put(time=lambda v: 1.7e9 + v)),
    signal("one row of another century", "told",
           put(time=at(SAMPLES - 1, SAMPLES, lambda v: v + 3e9)), "gap|pieces"),
    signal("a second is lost", "told", _gap, "1 gaps"),
    signal("10 rows", "refused", rows(np.s_[:10]), "row|sample|s"),
    signal("a quarter of a second", "ends", rows(np.s_[:100]), "usable|sample|row|essential",
           alone=True),
    signal("20 Hz of 200", "ends", rows(np.s_[::10]), "Hz"),
    signal("every piece too short", "refused", put(segment=np.arange(SAMPLES) // 3),
        "segment|piece"),
    signal("a segment without a number", "refused",
           put(segment=np.r_[np.nan, np.zeros(SAMPLES - 1)]), "segment", "row 1"),
    signal("segments that tell two runs apart", "works", put(segment=np.arange(SAMPLES) // HALF)),
]  # fmt: skip

POSITION = [
    signal("position empty", "refused", put(q2=np.full(SAMPLES, np.nan)), "q2", "no values"),
    signal("position that stands still", "ends", put(q2=np.zeros(SAMPLES)), "joint 2|q2"),
    signal("both stand still", "refused", put(q1=np.zeros(SAMPLES), q2=np.zeros(SAMPLES)),
           "move|moving|stand|speed|motion"),
    signal("position in degrees", "ends", put(q1=np.degrees, q2=np.degrees), "rad|degrees"),
    signal("one joint in degrees", "told", put(q2=np.degrees),
           "joint 2|q2", "degrees|rad"),
    signal("sign of joint 1 turned", "told", put(q1=lambda v: -v), "joint 1|q1", "sign"),
    signal("positions exchanged", "told", _exchanged(("q1", "q2")), "exchanged|swapped"),
    signal("joints exchanged", "told", _exchanged(("q1", "q2"), ("tau1", "tau2"), ("qc1", "qc2")),
           "exchanged|swapped|order of columns"),
    signal("a turn too much from half way", "ends",
           put(q1=at(HALF, SAMPLES, lambda v: v + 2 * np.pi)), "q1", "jump|turn|wrap|leap"),
    signal("wrapped at pi", "ends", put(q2=_wrapped), "q2", "jump|turn|wrap|leap"),
    signal("wrapped in degrees", "ends",
           put(q1=lambda v: np.degrees(v) % 360), "q1|joint 1", "rad|degrees|jump|turn",
           alone=True),
    signal("a spike of 0.5 rad", "ends", put(q1=at(700, 701, lambda v: v + 0.5)), "q1",
        "spike|jump|leap"),
    signal("a position of 1e300", "ends", put(q1=at(700, 701, 1e300)), "q1|joint 1"),
    signal("a position inf", "told", put(q1=at(700, 701, np.inf)), "q1", "without a value"),
    signal("position frozen for a second", "told", put(q1=at(700, 900, lambda v: v[0])),
           "q1|joint 1", "frozen|stands|repeat|stuck|constant|jump"),
    signal("position late by 40 ms", "told", put(q2=late(8)), "joint 2|q2", "late|delay|ms"),
]  # fmt: skip

TORQUE = [
    signal("no torque", "refused", without("tau1", "tau2"), "tau1", "joint 1"),
    signal("every torque zero", "refused", put(tau1=np.zeros(SAMPLES), tau2=np.zeros(SAMPLES)),
           "every measured torque is 0"),
    signal("one torque constant", "told", put(tau2=np.full(SAMPLES, 3.0)), "joint 2",
           "never changes"),
    signal("torque in N mm", "told", put(tau1=lambda v: 1000 * v), "joint 1|tau1"),
    signal("torque of both of the other sign", "told", put(tau1=lambda v: -v, tau2=lambda v: -v),
           "sign|negative"),
    signal("torque of one of the other sign", "told", put(tau2=lambda v: -v), "joint 2", "sign"),
    signal("torques exchanged", "told", _exchanged(("tau1", "tau2")), "exchanged|swapped"),
    signal("torque late by 40 ms", "told", put(tau1=late(8), tau2=late(8)), "late|delay|lag"),
    signal("torque spike of 500 N m", "ends", put(tau1=at(700, 701, 500.0)), "tau1|joint 1",
           "spike|jump|leap"),
    signal("torque of 1e300", "ends", put(tau1=at(700, 701, 1e300)), "tau1|joint 1"),
    signal("torque inf", "told", put(tau1=at(700, 710, np.inf)), "tau1", "without a value"),
    signal("torque clipped", "told", put(tau1=lambda v: np.clip(v, -8, 8)), "joint 1|tau1",
           "saturat|limit"),
    signal("torque of the other log", "told", put(tau1=lambda v: v[::-1]), "joint 1|usable"),
]  # fmt: skip

SPEED = [
    signal("speeds as they are", "works", _speeds(0)),
    signal("speed of joint 2 late by 40 ms", "told", _speeds(8), "qd2|joint 2", "late|delay|ms"),
    signal("speed in degrees per second", "refused",
           lambda t: (_speeds(0)(t), put(qd1=np.degrees)(t))[0], "qd1"),
    signal("speed of zeros", "ends", put(qd1=np.zeros(SAMPLES), qd2=np.zeros(SAMPLES)), "qd1"),
    signal("speed insisted on and missing", "refused", put(), "qd1", "--derivatives|derivatives",
           run=FIT + " --derivatives log"),
]  # fmt: skip

HELD = [
    signal(what, "ends", edit, *words, run=command, of="b.csv", theme=command.split()[0],
           alone=command == DIAGNOSE and what in ("a spike of 0.5 rad", "torque never changes"))
    for command in (COMPARE, DIAGNOSE)
    for what, edit, words in (
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
        ("torque clipped", put(tau1=lambda v: np.clip(v, -8, 8)), ("joint 1|tau1",)),
    )
]  # fmt: skip

ROWS = [*CLOCK, *POSITION, *TORQUE, *SPEED, *HELD]
