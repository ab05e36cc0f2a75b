"""The noise of the measured motion: where its spectrum meets a floor, and what that floor is.

What is differentiated twice to give accelerations is known only up to the frequency at which the
motion drowns in the noise of its sensor. One object says where that is, joint by joint; cut-offs,
masks, sigmas, warnings and the diagnosis read it.
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from modeler.core.json import ShortRepr
from modeler.core.manifest import JointSpec
from modeler.core.table import format_percent
from modeler.numerics.spectra import (
    BandSpectrum,
    MotionSpectrum,
    compute_band_spectrum,
    compute_motion_spectrum,
)
from modeler.regression.log import RawSegment
from modeler.regression.motion import ChosenProcessing
from modeler.regression.thresholds import THRESHOLDS

MEASURED = ("accelerations", "speeds", "positions")
"""What noise is reported of, by the number of derivatives from it to the acceleration."""


@dataclass(frozen=True)
class ChannelNoise(ShortRepr):
    """Noise of what is measured of one joint's motion, as plain data.

    Attributes:
        joint: name.
        unit: of its position, "rad" or "m".
        quantity: what was measured of it: "positions", "speeds", "accelerations".
        is_moving: False at rest.
        density: one-sided power density of its noise, unit^2/Hz; of speeds (unit/s)^2/Hz.
        deviation: standard deviation of white noise of that density.
        noise_crossover_hz: above it the noise exceeds the motion; None if too little shows it.
        step: resolution of what was measured; 0: none.
        spectral_slope: noise grows as f^-slope towards low frequencies; 0 for white.
        band_hz: of its motion.
        frequency, spectrum: (m,) Hz, and density of what was measured, means over third octaves.
        noise_torque: of the noise at 1 Hz, (N m)^2/Hz; it grows as f^4 (positions) or f^2
            (speeds). None where no fit said it.
        torque_noise: of the torque itself, (N m)^2/Hz.
    """

    joint: str
    unit: str
    quantity: str
    is_moving: bool
    density: float
    deviation: float
    noise_crossover_hz: float | None
    step: float
    spectral_slope: float
    band_hz: float
    frequency: tuple[float, ...]
    spectrum: tuple[float, ...]
    noise_torque: float | None = None
    torque_noise: float | None = None

    @property
    def order(self) -> int:
        """Returns how many derivatives lead from what is measured to the acceleration."""
        return MEASURED.index(self.quantity)

    @property
    def cutoff(self) -> float:
        """Returns the Hz up to which the measured says more of the motion than of its sensor."""
        least = THRESHOLDS.min_position_bands * self.band_hz
        return float(
            np.clip(self.noise_crossover_hz or np.inf, least, THRESHOLDS.max_position_cutoff)
        )

    @property
    def is_exact(self) -> bool:
        """Returns True if the noise is smaller than that of any sensor."""
        size = self.deviation / max(2.0 * np.pi * self.band_hz, 1.0) ** (2 - self.order)
        return size < THRESHOLDS.exact_noise and self.step < THRESHOLDS.exact_noise

    def compute_speed_deviation(self, cutoff: float) -> float:
        """Returns standard deviation of the noise of the speed below a cut-off (Hz), unit/s.

        White noise of density N differentiated, sigma_v^2 = N (2 pi)^2 f^3 / 3; of a logged speed
        N f.
        """
        power = 3.0 if self.order == 2 else 1.0
        factor = (2.0 * np.pi) ** 2 / 3.0 if self.order == 2 else 1.0
        return float(np.sqrt(self.density * factor * cutoff**power))

    def compute_acceleration_density(self, frequency: float) -> float:
        """Returns the noise as the acceleration's: (2 pi f)^(2 order) N, (unit/s^2)^2/Hz."""
        return float(self.density * (2.0 * np.pi * frequency) ** (2 * self.order))

    def format_words(self) -> str:
        """Returns the noise of the joint in words."""
        size, unit = self.scale_to_milli(self.deviation)
        coloured = f", growing as f^-{self.spectral_slope:.1f}" if self.spectral_slope else ""
        above = self.noise_crossover_hz or np.inf
        return f"joint {self.joint} {size:.2g} {unit} above {above:.2g} Hz{coloured}"

    def scale_to_milli(self, size: float) -> tuple[float, str]:
        """Returns a size and its unit: mrad or mm if it is small; counts stay counts."""
        small = size < 0.1 and self.unit in ("rad", "m")
        unit = self.unit + ("/s2", "/s", "")[self.order]
        return (1e3 * size, f"m{unit}") if small else (size, unit)


@dataclass(frozen=True)
class MotionNoise(ShortRepr):
    """Noise of the measured motion of all joints.

    Attributes:
        joints: in the order of the manifest.
        rate: Hz, of the samples.
        spectra: what was seen.
    """

    joints: tuple[ChannelNoise, ...]
    rate: float
    spectra: BandSpectrum = field(compare=False)

    @property
    def moving(self) -> tuple[ChannelNoise, ...]:
        """Returns the noise of the joints that move."""
        return tuple(joint for joint in self.joints if joint.is_moving)

    @property
    def band(self) -> float:
        """Returns the band, Hz, of the motion of the fastest joint."""
        return max((joint.band_hz for joint in self.moving), default=0.0)

    @property
    def cutoff(self) -> float:
        """Returns the cut-off, Hz, of the position filter: the geometric mean of the joints'."""
        least = THRESHOLDS.min_position_bands * self.band
        every = [max(joint.cutoff, least) for joint in self.moving]
        return float(np.exp(np.mean(np.log(every)))) if every else THRESHOLDS.max_position_cutoff

    @property
    def order(self) -> int:
        """Returns how many derivatives lead from what is measured to the acceleration."""
        return self.joints[0].order

    @property
    def quantity(self) -> str:
        """Returns the name of what is measured, in words."""
        return f"{'logged ' if self.order < 2 else ''}{MEASURED[self.order]}"

    def take_last_floors(
        self, which: Callable[[ChannelNoise], bool] = lambda joint: True
    ) -> "MotionNoise":
        """Returns the noise if what looks like a floor, and falls again, is motion.

        Args:
            which: the joints of which that is taken.
        """
        every = list(self.joints)
        for j, channel in enumerate(every):
            if which(channel):
                floor = find_floor(self.spectra, j, channel.band_hz, self.rate, last=True)
                every[j] = dataclasses.replace(channel, **floor)
        return dataclasses.replace(self, joints=tuple(every))

    def compute_speed_noise(self, coefficients: Sequence[float], cutoff: float) -> float:
        """Returns the standard deviation of the noise of a shaft's speed below a cut-off, Hz.

        Args:
            coefficients: (J,) of the joints' speeds in that of the shaft.
            cutoff: of the position filter.
        """
        deviations = [joint.compute_speed_deviation(cutoff) for joint in self.joints]
        per = (0.0, 1.0, cutoff)[self.order]
        step = [joint.step * per for joint in self.joints]
        return float(np.linalg.norm(np.asarray(coefficients) * np.maximum(deviations, step)))

    def compute_speed_step(self, coefficients: Sequence[float]) -> float:
        """Returns resolution of a shaft's speed where speeds were logged; else 0."""
        steps = [joint.step if self.order == 1 else 0.0 for joint in self.joints]
        return float(np.linalg.norm(np.asarray(coefficients) * steps))

    def format_channels(self) -> list[str]:
        """Returns a line of each channel: noise, where it exceeds the motion, resolution."""
        lines = []
        for joint in self.joints:
            if joint.is_moving and not joint.is_exact:
                size, unit = joint.scale_to_milli(joint.step)
                step = f", in steps of {size:.3g} {unit}" if joint.step else ""
                lines.append(f"noise of the {self.quantity}: {joint.format_words()}{step}")
        rest = [joint.joint for joint in self.joints if not joint.is_moving]
        if rest:
            verb = "rest" if len(rest) > 1 else "rests"
            lines.append(f"joint{'s' * (len(rest) > 1)} {', '.join(rest)} {verb}")
        return lines + self._describe_exact()

    def _describe_exact(self) -> list[str]:
        """Returns a line on the joints whose motion was not measured."""
        names = [joint.joint for joint in self.moving if joint.is_exact]
        if not names:
            return []
        return [
            f"the {self.quantity} of joint{'s' * (len(names) > 1)} {', '.join(names)} have no "
            "measurement noise: they are planned, filtered or simulated"
        ]

    def format_lines(self) -> list[str]:
        """Returns one line: the noise of each joint that moves, and where it exceeds the motion."""
        if not self.moving:
            return []
        every = "; ".join(joint.format_words() for joint in self.moving if not joint.is_exact)
        title = f"noise of the {self.quantity} (rms), and the frequency above which it exceeds"
        return [f"{title} the motion: {every}"] * bool(every) + self._describe_exact()

    def explain_cutoff(self, chosen: float) -> str:
        """Returns why a position filter of this cut-off (Hz) was chosen."""
        noise_cutoff = self.cutoff
        if chosen > 1.05 * noise_cutoff:
            return (
                f"the {self.quantity} are noise above {noise_cutoff:.2g} Hz; twice the parallel "
                "filter, which removes it"
            )
        if noise_cutoff > 0.99 * THRESHOLDS.max_position_cutoff:  # a mean of logarithms
            return f"the {self.quantity} are no noise up to there"
        return f"above, the spectrum of the {self.quantity} is that of their noise"


def estimate_motion_noise(
    joints: Sequence[JointSpec], pieces: Sequence[RawSegment], bands: np.ndarray
) -> MotionNoise:
    """Returns the noise of the motion in all logs.

    Args:
        joints: of the robot.
        pieces: of all logs, uniform.
        bands: (J,) Hz of the motion of each joint; NaN at rest.
    """
    order = 2 if any(piece.qd is None for piece in pieces) else 1
    order = 0 if all(piece.qdd is not None for piece in pieces) else order
    measured = [(p.qdd, p.qd, p.q)[order] for p in pieces]
    steps_of = [piece.step for piece in pieces]
    spectra = compute_band_spectrum([np.asarray(x) for x in measured], steps_of, order)
    rate = 1.0 / float(np.median([piece.step for piece in pieces]))
    none, every = (0.0,) * len(joints), []
    logged = [[piece.q_step or none, piece.qd_step or none] for piece in pieces]
    steps = np.max(np.array(logged), axis=0)
    for j, (joint, band) in enumerate(zip(joints, bands, strict=True)):
        q, density = np.concatenate([piece.q[:, j] for piece in pieces]), spectra.density[:, j]
        moves = bool(np.isfinite(band)) and float(np.ptp(q)) > THRESHOLDS.rest_steps * steps[0, j]
        hz, seen = spectra.frequency[np.isfinite(density)], density[np.isfinite(density)]
        band_hz = float(band) if moves else 0.0
        every.append(
            ChannelNoise(
                joint=joint.name,
                unit=joint.unit,
                quantity=MEASURED[order],
                is_moving=moves,
                step=float(steps[min(1, 2 - order), j]) if order else 0.0,
                band_hz=band_hz,
                frequency=tuple(map(_shorten_number, hz)),
                spectrum=tuple(map(_shorten_number, seen)),
                **find_floor(spectra, j, band_hz, rate),
            )
        )
    return MotionNoise(tuple(every), rate, spectra)


def _shorten_number(value: float) -> float:
    """Returns to four digits, as pictures need it."""
    return float(f"{value:.4g}")


def find_floor(
    spectra: BandSpectrum, j: int, band: float, rate: float, last: bool = False
) -> dict[str, Any]:
    """Returns the floor that the spectrum of joint j meets, as fields of its noise.

    Args:
        spectra: of what is measured.
        j: index of the joint.
        band: Hz of its motion, below which nothing is a floor.
        rate: Hz, of the samples.
        last: True for a floor from which the spectrum does not fall again: what a controller leaves
            of the motion may be flat before it does.
    """
    f, S = spectra.frequency, spectra.density[:, j]
    is_above_band = (f > band) & np.isfinite(S)
    f, S = f[is_above_band], S[is_above_band]
    density, meets, colour = (S[-1], f[-1], 0.0) if f.size else (0.0, None, 0.0)
    for k in range(len(f)):
        above = S[(f > f[k]) & (f <= f[k] * 2.0**THRESHOLDS.floor_octaves)]
        highest = max(S[k], above.max(initial=0.0) / THRESHOLDS.floor_ratio)
        if above.size < 3 or highest > THRESHOLDS.floor_ratio * np.median(above):
            continue
        beyond = S[f > f[k] * 2.0**THRESHOLDS.floor_octaves]
        if not (last and beyond.size and S[k] > THRESHOLDS.floor_ratio**2 * np.median(beyond)):
            density, meets, colour = np.median(above), f[k], _estimate_spectral_slope(f[k:], S[k:])
            break
    floor = {"density": float(density), "deviation": float(np.sqrt(0.5 * density * rate))}
    return floor | {
        "noise_crossover_hz": None if meets is None else float(meets),
        "spectral_slope": colour,
    }


def _estimate_spectral_slope(f: np.ndarray, S: np.ndarray) -> float:
    if len(f) < 6 or not (S > 0.0).all():
        return 0.0
    slope = -float(np.polyfit(np.log(f), np.log(S), 1)[0])
    return slope if slope > THRESHOLDS.coloured_slope else 0.0


# Which part of the measured positions is motion, joint by joint.


def estimate_motion_bands(piece: RawSegment, measured: MotionSpectrum) -> np.ndarray:
    """Returns (J,) Hz below which 99 % of the velocity's energy lies; NaN of joints at rest.

    What counts is the power above white noise, up to where the joint rings or shows excess
    high-frequency torque; where positions were commanded, up to the band of the command. The
    window's own width 2/T is taken off in quadrature, or a piece of half a second would look fast.

    Args:
        piece: of a log.
        measured: spectrum of its positions.
    """
    frequency, above = measured.frequency, measured.power_above_noise
    joints = range(above.shape[1])
    speed = above * frequency[:, None] ** 2
    rings = [find_ringing(frequency, speed[:, j], j)[1] for j in joints]
    pairs = zip(joints, rings, strict=True)
    ends = [_find_motion_end(frequency[:n], above[:n, j]) for j, n in pairs]
    size = np.array([np.sqrt(above[: ends[j], j].sum()) for j in joints])
    moves = (size > THRESHOLDS.min_motion_share * size.max()) & (np.ptp(piece.q, axis=0) > 0.0)
    ends = _align_ends(frequency, above, ends, moves)
    window = 2.0 / (len(piece.time) * piece.step)
    band = np.fmin(_compute_bands(frequency, above, ends), _compute_commanded_band(piece))
    return np.where(moves, np.sqrt(np.maximum(0.0, band**2 - window**2)), np.nan)


def _align_ends(
    frequency: np.ndarray, above: np.ndarray, ends: list[int], moves: np.ndarray
) -> list[int]:
    """Returns the ends of the motion, where a joint far faster than the others only chatters.

    The joints of a robot are moved together: what one of them does beyond `APART` bands of their
    median, and does a little of, is noise of any colour.
    """
    if not moves.any():
        return ends
    band = _compute_bands(frequency, above, ends)
    most = int(np.searchsorted(frequency, THRESHOLDS.fast_joint_bands * np.median(band[moves])))
    return [
        most
        if most < end and joint_band > frequency[most] and _is_small(above[:end, j], most)
        else end
        for j, (end, joint_band) in enumerate(zip(ends, band, strict=True))
    ]


def _compute_bands(frequency: np.ndarray, power: np.ndarray, ends: Sequence[int]) -> np.ndarray:
    """Returns (J,) energy bands of the power (n, J) before each joint's end."""
    return np.array([compute_energy_band(frequency[:n], power[:n, j]) for j, n in enumerate(ends)])


def compute_energy_band(frequency: np.ndarray, power: np.ndarray) -> float:
    """Returns frequency below which 99 % of the velocity's energy lies, Hz; 0 without any.

    Args:
        frequency: (n,) Hz.
        power: (n,) of the position.
    """
    total = np.cumsum(power * frequency**2)
    place = np.searchsorted(total, THRESHOLDS.band_energy_share * total[-1])
    return float(frequency[place]) if total[-1] > 0.0 else 0.0


def _compute_commanded_band(piece: RawSegment) -> np.ndarray:
    """Returns (J,) band of the commanded positions, Hz; NaN where none is known, or none moves."""
    if piece.commanded is None:
        return np.full(piece.q.shape[1], np.nan)
    command = compute_motion_spectrum(piece.commanded, piece.step)
    size = np.sqrt(command.power_above_noise.sum(axis=0))
    band = [compute_energy_band(command.frequency, power) for power in command.power_above_noise.T]
    return np.where(size > THRESHOLDS.min_motion_share * size.max(), band, np.nan)


def _find_motion_end(frequency: np.ndarray, above: np.ndarray) -> int:
    """Returns index of the first frequency that is not motion.

    Motion fades with frequency, noise and shaking grow before they fade: the position's energy per
    octave has a wide valley between them. What stands behind it is motion unless it is small.

    Args:
        frequency: (n,) Hz.
        above: (n,) power of the position above white noise.
    """
    if len(frequency) < 3 or not above.any():
        return len(frequency)
    octaves = np.log2(frequency[-1] / frequency[1])
    grid = frequency[1] * 2.0 ** np.arange(0.0, octaves, 1.0 / THRESHOLDS.steps_per_octave)
    energy = _integrate_octaves(frequency, above, grid)
    start = int(np.argmax(energy))
    while (valley := _find_valley(energy[start:])) is not None:
        first, last = (start + place for place in valley)
        bottom = grid[first + int(np.argmin(energy[first : last + 1]))]
        parted = int(np.searchsorted(frequency, bottom))
        if _is_small(above, parted):
            return parted
        start = last
    return len(frequency)


def _is_small(power: np.ndarray, place: int) -> bool:
    """Returns True if what stands from there on in power (n,) is none of the motion before."""
    return bool(power[place:].sum() < THRESHOLDS.max_chatter_share**2 * power[:place].sum())


def _integrate_octaves(frequency: np.ndarray, energy: np.ndarray, grid: np.ndarray) -> np.ndarray:
    """Returns (m,) energy within half an octave of each frequency of the grid (m,), Hz."""
    total = np.concatenate([[0.0], np.cumsum(energy)])
    low = np.searchsorted(frequency, grid / np.sqrt(2.0))
    high = np.searchsorted(frequency, grid * np.sqrt(2.0), side="right")
    return np.asarray(total[high] - total[low])


def _find_valley(energy: np.ndarray) -> tuple[int, int] | None:
    """Returns first and last place of the first valley of energies (m,); None without one.

    It is an octave wide or more, and lower than what stands on either side by `VALLEY`.
    """
    before = np.maximum.accumulate(energy)
    behind = np.maximum.accumulate(energy[::-1])[::-1]
    low = THRESHOLDS.valley_ratio * energy < np.minimum(before, behind)
    edges = np.flatnonzero(np.diff(low.astype(np.int8), prepend=0, append=0))
    for first, stop in zip(edges[::2], edges[1::2], strict=True):
        if stop - first > THRESHOLDS.steps_per_octave:
            return int(first), int(stop) - 1
    return None


# Joints that ring far above their motion: a controller that oscillates, or a resonance.


_MOTION_ENDS = (
    THRESHOLDS.min_ringing_frequency / THRESHOLDS.ringing_gap * 1.25 ** np.arange(26)
)  # Hz where the motion may end


@dataclass(frozen=True)
class Ringing:
    """A joint that rings.

    Attributes:
        joint: its index.
        frequency: of the strongest line, Hz.
        share: of the velocity's energy.
    """

    joint: int
    frequency: float
    share: float

    def describe(self, name: str) -> str:
        """Returns what rings and its share, for the report."""
        return (
            f"joint {name} rings at {self.frequency:.3g} Hz, with {format_percent(self.share)} of "
            "its velocity's energy, far above its motion; the cut-offs are chosen without it, and "
            "friction looks smoother than it is: look at the controller's gains"
        )


def find_ringing(
    frequency: np.ndarray, energy: np.ndarray, joint: int
) -> tuple[Ringing | None, int]:
    """Returns what rings, and the index of its first frequency; all if nothing does.

    Ringing is energy above `min_ringing_frequency` that an empty gap of two octaves parts from
    motion; it rings at one frequency if most of that energy lies there.

    Args:
        frequency: (n,) Hz, from 0 on.
        energy: (n,) of the velocity, above the noise.
        joint: index.
    """
    whole = len(frequency)
    total = np.concatenate([[0.0], np.cumsum(energy)])
    for edge in _MOTION_ENDS:
        low, high = np.searchsorted(frequency, [edge, THRESHOLDS.ringing_gap * edge])
        if high >= whole:
            continue
        motion, between, above = total[low], total[high] - total[low], total[-1] - total[high]
        if (
            motion > THRESHOLDS.min_motion_energy * above
            and between < THRESHOLDS.max_gap_energy * motion
            and above > THRESHOLDS.min_ringing_energy * motion
        ):
            top = float(frequency[high + int(np.argmax(energy[high:]))])
            line = energy[np.abs(frequency - top) < THRESHOLDS.ringing_width * top].sum()
            is_line = line > 0.5 * above
            share = float(above / total[-1])
            return Ringing(joint, top, share) if is_line else None, int(high)
    return None, whole


@dataclass(frozen=True)
class Bands(ShortRepr):
    """The cut-offs, what chose them, and the noise of the motion, as plain data.

    Attributes:
        position_cutoff, parallel_cutoff: Hz; None if there was no fit.
        noise: of every channel of the motion.
        widest_cutoffs: Hz of both filters, as the motion alone asks for; empty where one was given.
        reasons: sentences.
        limiting_joint: joint that they were lowered for; None if the parallel filter is the widest.
        chatter_ratio: how many times as much as the measured torque the model's torque varies
            from row to row behind the first filters of which it is too much; 0 if behind none.
        chatter_ratio_filtered: the same behind the filters that were chosen.
        widest_values: (c,) base parameters behind the widest filters; empty where they were chosen.
    """

    position_cutoff: float | None
    parallel_cutoff: float | None
    noise: tuple[ChannelNoise, ...]
    widest_cutoffs: Mapping[str, float] = field(default_factory=dict)
    reasons: tuple[str, ...] = ()
    limiting_joint: str | None = None
    chatter_ratio: float = 0.0
    chatter_ratio_filtered: float = 0.0
    widest_values: tuple[float, ...] = ()


def build_bands(noise: MotionNoise | None, processing: ChosenProcessing | None = None) -> Bands:
    """Returns the noise of the motion, and cut-offs that nothing was lowered for."""
    joints = noise.joints if noise else ()
    if processing is None:
        return Bands(None, None, joints)
    return Bands(processing.position_cutoff, processing.parallel_cutoff, joints)
