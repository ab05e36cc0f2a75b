"""Sensors and recorders of real machines: coarse, noisy or late positions, torques that are none.

A kind changes how a case moves and what of it is logged, never what is hidden: the arm of a seed is
the same with every kind but the slow one, whose motion is another.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import butter, lfilter, sosfiltfilt

from tests.hidden_effects.motion import Bounds, motion
from tests.hidden_effects.plant import TICK, Plant, rate

FINE = "fine"
COLOUR = 10.0  # Hz, of a first order lag
STIFF = 2**16  # counts in a turn, from which on a drive is as stiff as with a fine encoder
MOVES = 0.4  # share of the usual path of a slow machine
MODEL_BAND = 60.0  # Hz, of the motion that a drive computes torques from
OF_LINKS = ("payload", "link_inertia", "base_tilt", "rotor_inertia")
"""What a torque shows that is computed from links and rotors."""


@dataclass(frozen=True)
class Sensor:
    """What differs from a fine encoder in one kind of machine.

    Attributes:
        told: what it is, in a table.
        counts: of the encoder in a turn of the joint, inside the loop of the drive; 0: as drawn.
        white: deviation of white noise in the logged positions, rad.
        coloured: deviation of noise below 10 Hz there, rad.
        late: s, by which the logged position of one joint comes too late.
        slower: the motion takes so many times as long.
        faster: the recorder has so many times the rate of the robot, and repeats rows.
        gain: factor of the logged torque of one joint.
        computed: True if torques come from links, rotors and the motion, and no drive.
        names: effects that may be named on account of it, on its joint or on the whole robot.
        words: any of which shows it in a line on the data; empty if there is nothing to show.
    """

    told: str
    counts: int = 0
    white: float = 0.0
    coloured: float = 0.0
    late: float = 0.0
    slower: int = 1
    faster: float = 1.0
    gain: float = 1.0
    computed: bool = False
    names: tuple[str, ...] = ()
    words: tuple[str, ...] = ()

    @property
    def of_joint(self) -> bool:
        """True if it is one joint's."""
        return bool(self.late) or self.gain != 1.0

    @property
    def blurs(self) -> bool:
        """True if positions are noisy or coarse."""
        return bool(self.counts or self.white or self.coloured)

    def path(self, rng: np.random.Generator, seconds: float, bounds: Bounds) -> np.ndarray:
        """(ticks, n): a motion; a slow one is a shorter path that takes longer."""
        if self.slower == 1:
            return motion(rng, seconds, bounds)
        way = motion(rng, MOVES * seconds, bounds)
        ticks = np.arange(len(way))
        return CubicSpline(ticks, way)(np.arange(self.slower * (len(way) - 1) + 1) / self.slower)

    def bounds(self, bounds: Bounds) -> Bounds:
        """Of the motion."""
        speed, acceleration = bounds.speed / self.slower, bounds.acceleration / self.slower**2
        return Bounds(bounds.angle, speed, acceleration)

    def equip(self, plant: Plant) -> None:
        """Put the encoder into the loop, tuned softer by as much as its steps need."""
        if self.counts:
            plant.encoder_step = 2 * np.pi / self.counts
            softer = min(1.0, self.counts / STIFF)
            plant.speed_filter *= softer**0.75
            plant.speed_gain *= softer**0.25
            plant.integral_gain *= softer**0.5
            plant.position_gain *= softer**0.25

    def blurred(self, q: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """(ticks, n): positions with the noise of the log."""
        q = q + self.white * rng.normal(size=q.shape)
        if self.coloured:
            share = 1 - np.exp(-2 * np.pi * COLOUR * TICK)
            white = rng.normal(size=(1000 + len(q), q.shape[1]))
            noise = lfilter([share], [1, share - 1], white, 0)[1000:]
            q = q + self.coloured * noise / noise.std(0)
        return q

    def read(self, q: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """(ticks, n): what the log of a motion would hold, outside of any loop."""
        step = 2 * np.pi / self.counts if self.counts else 0.0
        return np.round(q / step) * step if step else self.blurred(q, rng)

    def logged(self, columns, joint, rng):
        """The columns of a log as this kind of machine writes them."""
        names = [name for name in columns if name[0] == "q" and name[1:].isdigit()]
        q = self.blurred(np.stack([columns[name] for name in names], 1), rng)
        columns = columns | {name: q[:, j] for j, name in enumerate(names)}
        if self.late:
            items, rows = columns[f"q{joint + 1}"], round(self.late / TICK)
            columns[f"q{joint + 1}"] = np.concatenate([np.full(rows, items[0]), items[:-rows]])
        if self.gain != 1.0:
            columns[f"tau{joint + 1}"] = columns[f"tau{joint + 1}"] * self.gain
        if self.faster == 1.0:
            return columns
        time = columns["time"]
        ticks = np.arange(int(self.faster * (len(time) - 1)) + 1) / self.faster
        rows = np.floor(ticks + 1e-9).astype(int)
        again = {name: values[rows] for name, values in columns.items()}
        return again | {"time": time[0] + ticks * TICK}


SENSORS = {
    FINE: Sensor("2^19 counts a turn and more"),
    "coarse": Sensor("4096 counts a turn, in the loop", counts=4096),
    "medium": Sensor("16384 counts a turn, in the loop", counts=16384),
    "white": Sensor("white noise of 0.44 mrad", white=0.44e-3),
    "white2": Sensor("white noise of 2 mrad", white=2e-3),
    "coloured": Sensor("noise of 1 mrad below 10 Hz", coloured=1e-3),
    "slow": Sensor("a fifth as fast", slower=5),
    "late": Sensor(
        "one position 5 ms late", late=5e-3, names=("time_delay",), words=(" late", "delay")
    ),
    "repeat": Sensor("recorder 1.25 times as fast", faster=1.25, words=("repeat", "recorder")),
    "repeat3": Sensor("recorder 3 times as fast", faster=3.0, words=("repeat", "recorder")),
    "gain": Sensor(
        "one torque times 0.027",
        gain=0.027,
        names=("drive_gain",),
        words=("unit", "scale", "times", "gain"),
    ),
    "millinewton": Sensor(
        "one torque in mN m",
        gain=1000.0,
        names=("drive_gain",),
        words=("mN", "unit", "scale", "times", "gain"),
    ),
    "computed": Sensor("torques computed from the motion", computed=True, words=("computed",)),
}


def computed_torque(plant: Plant, q: np.ndarray) -> np.ndarray:
    """(ticks, n): what links and rotors ask for along a motion, without friction and noise."""
    q = sosfiltfilt(butter(2, MODEL_BAND, fs=1 / TICK, output="sos"), q, axis=0)
    v = rate(q)
    a = rate(v)
    return plant.inverse_dynamics(q, v, a)[0] + plant.rotor_inertia * a
