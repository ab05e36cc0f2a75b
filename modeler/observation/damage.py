"""What no robot does, in the channels of a log: found, told, and mended or left out."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.contract import ModuleSpec
from modeler.observation.glitches import TorqueNoise, glitch_floor, glitches, torque_glitches
from modeler.observation.isolated import LEAST, departures
from modeler.observation.leaps import Leap, Walk, floors, floors_here, leaps_of, surely_none, walked
from modeler.observation.log import Log
from modeler.observation.resolution import resolution
from modeler.observation.segments import GAP


@dataclass(frozen=True)
class Damage:
    """One kind of defect of one channel of a log.

    Attributes:
        column: of the log, "q2".
        joint: its name.
        kind: "wrap", "spike", "frozen", "zero" or "lost".
        times: when each begins, s.
        samples: that are not used for it.
        size: the largest, in `unit`.
        unit: of the channel.
        line: what it is, where and when, what was done and what to do.
    """

    column: str
    joint: str
    kind: str
    times: tuple[float, ...]
    samples: int
    size: float
    unit: str
    line: str


@dataclass(frozen=True, eq=False)
class _Channel:
    column: str
    joint: str
    unit: str


@dataclass(frozen=True)
class Found:
    """A defect of a channel, at rows of the log from `start` to before `stop`.

    Attributes:
        kind: as of a `Damage`.
        start, stop: rows.
        size: in the channel's unit.
        time: of the first row, s.
    """

    kind: str
    start: int
    stop: int
    size: float
    time: float


Defects = dict[str, list[list[Found]]]
"""By channel, "q", "tau", "qd" or "qdd", and joint."""


@dataclass(frozen=True, eq=False)
class Usual:
    """What is usual in the channels of a log, beside which a defect stands out; J joints.

    Attributes:
        steps: (J,) smallest step of each position.
        leaps: (J,) what a step must have too much to be a leap.
        torque: of the torques; None where none is measured.
        rates: (J,) departure below which no value is a spike, of logged "qd" and "qdd".
    """

    steps: np.ndarray
    leaps: np.ndarray
    torque: TorqueNoise | None
    rates: Mapping[str, np.ndarray]


def repaired(log: Log, spec: ModuleSpec) -> tuple[Log, tuple[Damage, ...]]:
    """The log without the values that no robot can have made, and what was found.

    Wraps are counted on, and positions that begin to count from another zero are joined to the
    longest stretch. Spikes and repeated values become missing ones. Where rows are missing and the
    clock ran on, a new piece begins.

    Args:
        log: as it was read.
        spec: the robot's manifest; it names the joints.
    """
    mended, found, _ = defects(log, spec)
    return mended, damages(log, spec, found)


def defects(log: Log, spec: ModuleSpec, usual: Usual | None = None) -> tuple[Log, Defects, Usual]:
    """The mended log, what was found, and what is usual in it.

    Args:
        log: as it was read, or some consecutive rows of one.
        spec: the robot's manifest; it names the joints.
        usual: in the whole log of which this is a part; None: it is all of it.
    """
    q, segment, leaps, steps, least = _positions(log, spec, usual)
    torques, noise = _torques(log, None if usual is None else usual.torque)
    rates, levels = _rates(log, {} if usual is None else usual.rates)
    others = {"tau": torques, **rates}
    new = segment if (segment != _segments(log)).any() else log.segment
    mended = dataclasses.replace(
        log,
        q=q,
        segment=new,
        tau=_without(log.tau, others["tau"]),
        qd=None if log.qd is None else _without(log.qd, others["qd"]),
        qdd=None if log.qdd is None else _without(log.qdd, others["qdd"]),
    )
    return mended, {"q": leaps, **others}, usual or Usual(steps, least, noise, levels)


def _positions(
    log: Log, spec: ModuleSpec, usual: Usual | None
) -> tuple[np.ndarray, np.ndarray, list[list[Found]], np.ndarray, np.ndarray]:
    """Mended positions, segments, what was found by joint; steps and floors of leaps."""
    q, segment = log.q.copy(), _segments(log)
    positions: list[list[Found]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    steps = np.array([resolution(own) for own in log.q.T]) if usual is None else usual.steps
    stretches = list(_stretches(log, np.isfinite(log.q).all(axis=1)))
    if usual is not None and all(
        surely_none(log.time[rows], log.q[rows], usual.leaps) for rows in stretches
    ):
        return q, segment, positions, steps, usual.leaps
    walks = [walked(log.time[rows], log.q[rows], revolute, steps) for rows in stretches]
    long = [walk for walk in walks if walk is not None]
    least = floors(long, steps) if usual is None else floors_here(long, usual.leaps)
    for rows, walk in zip(stretches, walks, strict=True):
        for j in range(len(spec.joints) if walk is not None else 0):
            assert walk is not None
            leaps = leaps_of(walk, log.time[rows], j, least[j])
            q[rows, j] = _mended(walk, j, leaps)
            positions[j] += [_at(leap, rows, log) for leap in leaps]
            for leap in leaps:
                if leap.kind == "lost":
                    segment[rows[leap.start] :] += 1
    return q, segment, positions, steps, least


def _segments(log: Log) -> np.ndarray:
    """(n,) a number that grows where a piece begins."""
    if log.segment is None:
        return np.zeros(log.rows, dtype=int)
    return np.concatenate([[0], np.cumsum(np.diff(log.segment) != 0)])


def _stretches(log: Log, there: np.ndarray) -> Iterator[np.ndarray]:
    """Rows (k,) of each stretch without a gap among those that are there (n,)."""
    rows = np.flatnonzero(there)
    cut = (np.diff(log.time[rows]) > GAP * log.step) | (np.diff(_segments(log)[rows]) != 0)
    yield from np.split(rows, np.flatnonzero(cut) + 1)


def _at(leap: Leap, rows: np.ndarray, log: Log) -> Found:
    start = int(rows[leap.start])
    stop = int(rows[leap.stop - 1]) + 1 if leap.stop > leap.start else start
    return Found(leap.kind, start, stop, leap.size, float(log.time[start]))


def _mended(walk: Walk, j: int, leaps: Sequence[Leap]) -> np.ndarray:
    """(n,) the positions of joint j: counted on, joined, and NaN where they are wrong."""
    q = walk.q[:, j].copy()
    offset, edges = np.zeros(len(q)), [0]
    for leap in leaps:
        if leap.kind in ("wrap", "zero"):
            offset[leap.start :] += leap.size
            edges.append(leap.start)
        q[leap.start : leap.stop] = np.nan
    longest = edges[int(np.argmax(np.diff([*edges, len(q)])))]
    return np.asarray(q - (offset - offset[longest]))


def _torques(log: Log, usual: TorqueNoise | None) -> tuple[list[list[Found]], TorqueNoise | None]:
    """Spikes of the measured torques by joint; and what is usual in them."""
    there = np.isfinite(log.tau).all(axis=1) & np.isfinite(log.q).all(axis=1)
    stretches = [rows for rows in _stretches(log, there) if len(rows) >= LEAST]
    spikes, noise = torque_glitches(
        [log.tau[rows] for rows in stretches],
        lambda: [np.gradient(log.q[rows], log.time[rows], axis=0) for rows in stretches],
        usual,
    )
    return [
        [_spike(one, rows, log) for own, rows in zip(by_joint, stretches, strict=True)
         for one in own]
        for by_joint in spikes
    ], noise  # fmt: skip


def _rates(log: Log, usual: Mapping[str, np.ndarray]) -> tuple[Defects, dict[str, np.ndarray]]:
    """Spikes of logged velocities and accelerations, by column and joint; and their floors."""
    found: Defects = {}
    levels: dict[str, np.ndarray] = {}
    for name in ("qd", "qdd"):
        values = getattr(log, name)
        if values is None:
            continue
        floors_of_name = []
        for j, channel in enumerate(values.T):
            rows = [r for r in _stretches(log, np.isfinite(channel)) if len(r) >= LEAST]
            stretches = [channel[r] for r in rows]
            departed = [departures(own) for own in stretches]
            floor = usual[name][j] if name in usual else glitch_floor(stretches, departed)
            floors_of_name.append(floor)
            spikes = glitches(stretches, departed, floor)
            found.setdefault(name, []).append(
                [_spike(one, r, log) for own, r in zip(spikes, rows, strict=True) for one in own]
            )
        levels[name] = np.array(floors_of_name)
    return found, levels


def _spike(spike: tuple[int, int, float], rows: np.ndarray, log: Log) -> Found:
    start = int(rows[spike[0]])
    return Found("spike", start, int(rows[spike[1] - 1]) + 1, spike[2], float(log.time[start]))


def _without(values: np.ndarray, found: Sequence[Sequence[Found]]) -> np.ndarray:
    kept = values.copy()
    for j, own in enumerate(found):
        for one in own:
            kept[one.start : one.stop, j] = np.nan
    return kept


@dataclass(frozen=True)
class Whose:
    """The log that damages are told of; a `Log` is one.

    Attributes:
        name: of its file.
        rows: of it.
        torque_source: where each joint's torque comes from, in words.
    """

    name: str
    rows: int
    torque_source: tuple[str, ...]


def damages(log: Log | Whose, spec: ModuleSpec, found: Defects) -> tuple[Damage, ...]:
    """What was found in a log, in words."""
    return tuple(_damages(log, spec, found))


def _damages(log: Log | Whose, spec: ModuleSpec, found: Defects) -> Iterator[Damage]:
    units = {"q": "{}", "qd": "{}/s", "qdd": "{}/s^2"}
    for name, by_joint in found.items():
        for j, own in enumerate(by_joint):
            joint = spec.joints[j]
            column, unit = f"{name}{joint.name}", joint.effort_unit
            if name in units:
                unit = units[name].format(joint.unit)
            elif log.torque_source:
                column = log.torque_source[j].split()[0]
            for kind in dict.fromkeys(one.kind for one in own):
                same = [one for one in own if one.kind == kind]
                yield _damage(log, _Channel(column, joint.name, unit), kind, same)


def _damage(log: Log | Whose, channel: _Channel, kind: str, same: Sequence[Found]) -> Damage:
    largest = max(same, key=lambda one: abs(one.size))
    words = _WORDS["torque" if kind == "spike" and channel.column[0] != "q" else kind]
    return Damage(
        column=channel.column,
        joint=channel.joint,
        kind=kind,
        times=tuple(one.time for one in same),
        samples=sum(one.stop - one.start for one in same),
        size=abs(largest.size),
        unit=channel.unit,
        line=f"{channel.column}: {words(log, channel, same)}",
    )


def _when(log: Log | Whose, same: Sequence[Found]) -> str:
    first = f"at {same[0].time:.6g} s"
    return first if len(same) == 1 else f"{len(same)} times, first {first}"


def _size(channel: _Channel, same: Sequence[Found]) -> str:
    up_to = "" if len(same) == 1 else "up to "
    return f"{up_to}{max(abs(one.size) for one in same):.3g} {channel.unit}"


def _lost(log: Log | Whose, same: Sequence[Found]) -> str:
    count = sum(one.stop - one.start for one in same)
    samples = f"{count} sample{'s' if count > 1 else ''}"
    return f"{samples} ({100.0 * count / log.rows:.2g} % of the rows) not used"


def _wrap(log: Log | Whose, channel: _Channel, same: Sequence[Found]) -> str:
    return (
        f"leaps by whole turns of 2 pi rad {_when(log, same)}; counted on from the longest "
        "stretch between two leaps: only what does not repeat with every turn, as a spring or a "
        "cable, is not served by that; log positions that do not wrap"
    )


def _position_spike(log: Log | Whose, channel: _Channel, same: Sequence[Found]) -> str:
    return (
        f"leaps by {_size(channel, same)} and back {_when(log, same)}, which no joint can; "
        f"{_lost(log, same)}; check the encoder and its cable"
    )


def _torque_spike(log: Log | Whose, channel: _Channel, same: Sequence[Found]) -> str:
    return (
        f"a spike of {_size(channel, same)} {_when(log, same)}, far above the noise, which no "
        f"other joint feels; {_lost(log, same)}; check the wiring of that channel"
    )


def _frozen(log: Log | Whose, channel: _Channel, same: Sequence[Found]) -> str:
    return (
        f"repeats an old value while the joint moves, {_when(log, same)}; {_lost(log, same)}; "
        "the logger or the bus was late: log fewer columns, or slower"
    )


def _zero(log: Log | Whose, channel: _Channel, same: Sequence[Found]) -> str:
    at = same[0].time
    return (
        f"leaps by {_size(channel, same)} {_when(log, same)} and goes on from there: the encoder "
        "found another zero; joined to the longest stretch between two leaps, whose zero is kept; "
        f"if another is right, use that part alone, as in {log.name}@{at:.6g}:"
    )


def _lost_rows(log: Log | Whose, channel: _Channel, same: Sequence[Found]) -> str:
    return (
        f"leaps along its motion by {_size(channel, same)} {_when(log, same)}: rows are missing "
        "there while the clock ran on; no filter runs across; log the true time of each row"
    )


_WORDS: dict[str, Callable[[Log | Whose, _Channel, Sequence[Found]], str]] = {
    "wrap": _wrap, "spike": _position_spike, "torque": _torque_spike, "frozen": _frozen,
    "zero": _zero, "lost": _lost_rows,
}  # fmt: skip
