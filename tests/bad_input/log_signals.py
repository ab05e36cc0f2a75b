"""Logs that can be read and whose signals are wrong."""

import numpy as np

from tests.bad_input.fits import true_values, unusable_or_true
from tests.bad_input.row import row
from tests.bad_input.workdir import Table, Workdir

FIT = "fit two-link bad.csv --out m.json --json f.json"
COMPARE = "compare m.json bad.csv --json c.json"
DIAGNOSE = "diagnose m.json bad.csv --json d.json"
SAMPLES = 1600
HALF = SAMPLES // 2
CHECKS = {"works": true_values, "told": unusable_or_true, "ends": unusable_or_true}


def signal(what, outcome, edit, *words, run=FIT, of="a.csv", theme="signal", alone=False):
    """A row of a log of two-link with its columns edited in place."""

    def make(workdir: Workdir) -> None:
        workdir.log("bad.csv", edit, of)  # type: ignore

    check = CHECKS.get(outcome) if run == FIT else None
    return row(f"{theme}: {what}", outcome, run, *words, make=make, check=check, alone=alone)


def put(**columns: object) -> object:
    """Edits columns by name: functions of the column, or values."""

    def edit(table: Table) -> None:
        for name, new in columns.items():
            table[name] = new(table[name]) if callable(new) else new

    return edit


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


SHORT = rows(np.s_[:100])
CENTURY = put(time=at(SAMPLES - 1, SAMPLES, lambda v: v + 3e9))
TURN = put(q1=at(HALF, SAMPLES, lambda v: v + 2 * np.pi))
WRAPPED = put(q1=lambda v: np.degrees(v) % 360)
WRAPPED_SAYS = ("q1|joint 1", "rad|degrees|jump|turn")
SPIKE = put(q1=at(700, 701, lambda v: v + 0.5))
CLIPPED = put(tau1=lambda v: np.clip(v, -8, 8))
CONSTANT = put(tau2=np.full(SAMPLES, 3.0))
NEGATIVE, BOTH_NEGATIVE = put(tau2=np.negative), put(tau1=np.negative, tau2=np.negative)
EXCHANGED = _exchanged(("tau1", "tau2"))

CLOCK = [
    signal("time in ms", "told", put(time=lambda v: 1000 * v), "second", alone=True),
    signal("since 1970", "works", put(time=lambda v: 1.7e9 + v)),
    signal("one row of another century", "told", CENTURY, "gap|pieces"),
    signal("a second is lost", "told", rows(np.r_[:600, 800:SAMPLES]), "1 gaps"),
    signal("a quarter of a second", "ends", SHORT, "usable|sample|row|essential", alone=True),
    signal("20 Hz of 200", "ends", rows(np.s_[::10]), "Hz"),
    signal("segments that distinguish two runs", "works", put(segment=np.arange(SAMPLES) // HALF)),
]

POSITION = [
    signal("position that stands still", "ends", put(q2=np.zeros(SAMPLES)), "joint 2|q2"),
    signal("position in degrees", "ends", put(q1=np.degrees, q2=np.degrees), "rad|degrees"),
    signal("sign of joint 1 turned", "told", put(q1=lambda v: -v), "joint 1|q1", "sign"),
    signal("positions exchanged", "told", _exchanged(("q1", "q2")), "exchanged|swapped"),
    signal("a turn too much from half way", "ends", TURN, "q1", "jump|turn|wrap|leap"),
    signal("wrapped in degrees", "ends", WRAPPED, *WRAPPED_SAYS, alone=True),
    signal("a position inf", "told", put(q1=at(700, 701, np.inf)), "q1", "without a value"),
]

TORQUE = [
    signal("one torque constant", "told", CONSTANT, "joint 2", "never changes"),
    signal("torque in N mm", "told", put(tau1=lambda v: 1000 * v), "joint 1|tau1"),
    signal("torque of both of the other sign", "told", BOTH_NEGATIVE, "sign|negative"),
    signal("torque of one of the other sign", "told", NEGATIVE, "joint 2", "sign"),
    signal("torques exchanged", "told", EXCHANGED, "exchanged|swapped"),
    signal("torque late by 40 ms", "told", put(tau1=late(8), tau2=late(8)), "late|delay|lag"),
    signal("torque of 1e300", "ends", put(tau1=at(700, 701, 1e300)), "tau1|joint 1"),
    signal("torque clipped", "told", CLIPPED, "joint 1|tau1", "saturat|limit"),
]

SPEED = [
    signal("speeds as they are", "works", _speeds(0)),
    signal("speed of joint 2 late by 40 ms", "told", _speeds(8), "qd2|joint 2", "late|delay|ms"),
]

HELD = [
    signal(what, "ends", edit, *words, run=run, of="b.csv", theme=run.split()[0], alone=alone)
    for run, only in ((COMPARE, False), (DIAGNOSE, True))
    for what, edit, words, alone in (
        ("torque of the other sign", NEGATIVE, ("joint 2", "sign"), False),
        ("torques exchanged", EXCHANGED, ("exchanged|swapped",), False),
        ("a turn too much", TURN, ("q1", "jump|turn|wrap|leap"), False),
        ("a spike of 0.5 rad", SPIKE, ("q1", "spike|jump|leap"), only),
        ("torque never changes", CONSTANT, ("joint 2",), only),
    )
]

ROWS = [*CLOCK, *POSITION, *TORQUE, *SPEED, *HELD]
