"""What no robot does, in the channels of a log: found, told, and mended or left out."""

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.contract import ModuleSpec
from modeler.observation.glitches import glitches, torque_glitches
from modeler.observation.isolated import LEAST
from modeler.observation.leaps import Leap, Walk, floors, leaps_of, walked
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
class _Found:
    """A defect of a channel, at rows of the log from `start` to before `stop`."""

    kind: str
    start: int
    stop: int
    size: float


def repaired(log: Log, spec: ModuleSpec) -> tuple[Log, tuple[Damage, ...]]:
    """The log without the values that no robot can have made, and what was found.

    Wraps are counted on, and positions that begin to count from another zero are joined to the
    longest stretch. Spikes and repeated values become missing ones. Where rows are missing and the
    clock ran on, a new piece begins.

    Args:
        log: as it was read.
        spec: the robot's manifest; it names the joints.
    """
    q, segment = log.q.copy(), _segments(log)
    positions: list[list[_Found]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    steps = np.array([resolution(values) for values in log.q.T])
    stretches = list(_stretches(log, np.isfinite(log.q).all(axis=1)))
    walks = [walked(log.time[rows], log.q[rows], revolute, steps) for rows in stretches]
    least = floors([walk for walk in walks if walk is not None], steps)
    for rows, walk in zip(stretches, walks, strict=True):
        for j in range(len(spec.joints) if walk is not None else 0):
            assert walk is not None
            leaps = leaps_of(walk, log.time[rows], j, least[j])
            q[rows, j] = _mended(walk, j, leaps)
            positions[j] += [_at(leap, rows) for leap in leaps]
            for leap in leaps:
                if leap.kind == "lost":
                    segment[rows[leap.start] :] += 1
    others = {"tau": _torques(log), **_rates(log)}
    new = segment if (segment != _segments(log)).any() else log.segment
    mended = dataclasses.replace(
        log,
        q=q,
        segment=new,
        tau=_without(log.tau, others["tau"]),
        qd=None if log.qd is None else _without(log.qd, others["qd"]),
        qdd=None if log.qdd is None else _without(log.qdd, others["qdd"]),
    )
    return mended, tuple(_damages(log, spec, {"q": positions, **others}))


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


def _at(leap: Leap, rows: np.ndarray) -> _Found:
    start = int(rows[leap.start])
    stop = int(rows[leap.stop - 1]) + 1 if leap.stop > leap.start else start
    return _Found(leap.kind, start, stop, leap.size)


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


def _torques(log: Log) -> list[list[_Found]]:
    """Spikes of the measured torques by joint."""
    there = np.isfinite(log.tau).all(axis=1) & np.isfinite(log.q).all(axis=1)
    stretches = list(_stretches(log, there))
    speeds = [np.gradient(log.q[rows], log.time[rows], axis=0) for rows in stretches
              if len(rows) >= LEAST]  # fmt: skip
    stretches = [rows for rows in stretches if len(rows) >= LEAST]
    spikes = torque_glitches([log.tau[rows] for rows in stretches], speeds)
    return [
        [_spike(one, rows) for own, rows in zip(by_joint, stretches, strict=True) for one in own]
        for by_joint in spikes
    ]


def _rates(log: Log) -> dict[str, list[list[_Found]]]:
    """Spikes of logged velocities and accelerations, by column and joint."""
    found: dict[str, list[list[_Found]]] = {}
    for name in ("qd", "qdd"):
        values = getattr(log, name)
        for channel in () if values is None else values.T:
            stretches = [
                rows for rows in _stretches(log, np.isfinite(channel)) if len(rows) >= LEAST
            ]
            spikes = glitches([channel[rows] for rows in stretches])
            found.setdefault(name, []).append(
                [_spike(one, rows) for own, rows in zip(spikes, stretches, strict=True)
                 for one in own]
            )  # fmt: skip
    return found


def _spike(spike: tuple[int, int, float], rows: np.ndarray) -> _Found:
    return _Found("spike", int(rows[spike[0]]), int(rows[spike[1] - 1]) + 1, spike[2])


def _without(values: np.ndarray, found: Sequence[Sequence[_Found]]) -> np.ndarray:
    kept = values.copy()
    for j, own in enumerate(found):
        for one in own:
            kept[one.start : one.stop, j] = np.nan
    return kept


def _damages(log: Log, spec: ModuleSpec, found: dict[str, list[list[_Found]]]) -> Iterator[Damage]:
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


def _damage(log: Log, channel: _Channel, kind: str, same: Sequence[_Found]) -> Damage:
    largest = max(same, key=lambda one: abs(one.size))
    words = _WORDS["torque" if kind == "spike" and channel.column[0] != "q" else kind]
    return Damage(
        column=channel.column,
        joint=channel.joint,
        kind=kind,
        times=tuple(float(log.time[one.start]) for one in same),
        samples=sum(one.stop - one.start for one in same),
        size=abs(largest.size),
        unit=channel.unit,
        line=f"{channel.column}: {words(log, channel, same)}",
    )


def _when(log: Log, same: Sequence[_Found]) -> str:
    first = f"at {log.time[same[0].start]:.6g} s"
    return first if len(same) == 1 else f"{len(same)} times, first {first}"


def _size(channel: _Channel, same: Sequence[_Found]) -> str:
    up_to = "" if len(same) == 1 else "up to "
    return f"{up_to}{max(abs(one.size) for one in same):.3g} {channel.unit}"


def _lost(log: Log, same: Sequence[_Found]) -> str:
    count = sum(one.stop - one.start for one in same)
    samples = f"{count} sample{'s' if count > 1 else ''}"
    return f"{samples} ({100.0 * count / log.rows:.2g} % of the rows) not used"


def _wrap(log: Log, channel: _Channel, same: Sequence[_Found]) -> str:
    return (
        f"leaps by whole turns of 2 pi rad {_when(log, same)}; counted on from the longest "
        "stretch between two leaps: only what does not repeat with every turn, as a spring or a "
        "cable, is not served by that; log positions that do not wrap"
    )


def _position_spike(log: Log, channel: _Channel, same: Sequence[_Found]) -> str:
    return (
        f"leaps by {_size(channel, same)} and back {_when(log, same)}, which no joint can; "
        f"{_lost(log, same)}; check the encoder and its cable"
    )


def _torque_spike(log: Log, channel: _Channel, same: Sequence[_Found]) -> str:
    return (
        f"a spike of {_size(channel, same)} {_when(log, same)}, far above the noise, which no "
        f"other joint feels; {_lost(log, same)}; check the wiring of that channel"
    )


def _frozen(log: Log, channel: _Channel, same: Sequence[_Found]) -> str:
    return (
        f"repeats an old value while the joint moves, {_when(log, same)}; {_lost(log, same)}; "
        "the logger or the bus was late: log fewer columns, or slower"
    )


def _zero(log: Log, channel: _Channel, same: Sequence[_Found]) -> str:
    at = log.time[same[0].start]
    return (
        f"leaps by {_size(channel, same)} {_when(log, same)} and goes on from there: the encoder "
        "found another zero; joined to the longest stretch between two leaps, whose zero is kept; "
        f"if another is right, use that part alone, as in {log.name}@{at:.6g}:"
    )


def _lost_rows(log: Log, channel: _Channel, same: Sequence[_Found]) -> str:
    return (
        f"leaps along its motion by {_size(channel, same)} {_when(log, same)}: rows are missing "
        "there while the clock ran on; no filter runs across; log the true time of each row"
    )


_WORDS: dict[str, Callable[[Log, _Channel, Sequence[_Found]], str]] = {
    "wrap": _wrap, "spike": _position_spike, "torque": _torque_spike, "frozen": _frozen,
    "zero": _zero, "lost": _lost_rows,
}  # fmt: skip
