"""Motions: moves between points at many speeds, then a Fourier series. 1 kHz, rad, from 0 to 0."""

from dataclasses import dataclass

import numpy as np

from tests.hidden_effects.plant import TICK, rate

LEVELS = (0.04, 0.1, 0.25, 0.45, 0.7, 1, 1, 1)  # of the top speed
HOME = 2600  # ticks that are kept for the way back


@dataclass(frozen=True)
class Bounds:
    """Largest angle to either side, speed and acceleration, (n,) each; rad, s."""

    angle: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray


def draw_bounds(rng: np.random.Generator, n: int) -> Bounds:
    """Bounds of n joints; the last ones are the quickest."""
    angle = rng.uniform(1.15, 2.3, n)
    speed = rng.uniform(1.6, 3.0, n) * np.linspace(1, 1.2, n)
    return Bounds(angle, speed, speed * rng.uniform(3.5, 6, n))


def motion(rng: np.random.Generator, seconds: float, bounds: Bounds) -> np.ndarray:
    """(ticks, n): moves for so many seconds, and as many of a Fourier series."""
    return np.vstack([moves(rng, seconds, bounds), fourier(rng, seconds, bounds)])


def fourier(rng: np.random.Generator, seconds: float, bounds: Bounds) -> np.ndarray:
    """Seven harmonics of a base near 0.1 Hz that touch a bound, faded in and out."""
    time = np.arange(int(seconds * 1000)) / 1000
    base = rng.uniform(0.08, 0.13)
    path = np.zeros((len(time), len(bounds.angle)))
    for j in range(path.shape[1]):
        q = path[:, j]
        for k in range(1, 8):
            a, b = rng.normal(size=2) * k ** -rng.uniform(0.5, 1.0)
            phase = 2 * np.pi * k * base * time
            q += a * np.sin(phase) + b * np.cos(phase)
        q -= 0.5 * (q.max() + q.min())
        peaks = [np.abs(x).max() for x in (q, rate(q), rate(rate(q)))]
        most = (bounds.angle[j], bounds.speed[j], bounds.acceleration[j])
        q *= min(bound / peak for bound, peak in zip(most, peaks, strict=True))
    s = np.clip(np.minimum(time, seconds - time) / 1.2, 0, 1)
    return path * (s**3 * (10 - 15 * s + 6 * s * s))[:, None]


def moves(rng: np.random.Generator, seconds: float, bounds: Bounds) -> np.ndarray:
    """Every joint for itself from point to point, with smoothed trapezoids of speed."""
    ticks = int(seconds * 1000)
    each = zip(bounds.angle, bounds.speed, bounds.acceleration, strict=True)
    path = np.stack([_smooth(_smooth(_joint_moves(rng, ticks, *b), 61), 41) for b in each], 1)
    path[-80:] = 0
    return path


def _joint_moves(rng, ticks, angle, speed, acceleration):
    q, place, tick = np.zeros(ticks), 0.0, int(rng.uniform(50, 400))
    levels: list[float] = []
    while True:
        levels = levels or list(rng.permutation(LEVELS))
        top, rise = levels.pop() * speed, acceleration * rng.uniform(0.4, 1)
        target = _target(rng, place, angle, top)
        last = tick > ticks - HOME
        if last:
            target, top = 0.0, 0.7 * speed
        if abs(target - place) < 1e-3 and not last:
            continue
        way = _way(abs(target - place), top, rise)
        if not last and tick + len(way) > ticks - HOME + 100:
            # A draw that decides nothing any more; without it every seed would be another case.
            if tick + 60 < ticks - HOME + 1 and rng.uniform() < 0.5:
                levels = [1.0]
            tick = ticks - HOME + 1
            continue
        way = way[: ticks - tick]
        q[tick : tick + len(way)] = place + (target - place) * way
        q[tick + len(way) :] = target
        place, tick = target, tick + len(way) + int(rng.uniform(20, 150))
        if last:
            return q


def _target(rng: np.random.Generator, place: float, angle: float, top: float) -> float:
    """Where to go next: mostly back over the middle, as far as the speed makes sense."""
    stroke = min(2 * angle, max(0.1 * angle, top * rng.uniform(1.2, 2.2)))
    back = abs(place) > 0.35 * angle and rng.uniform() < 0.8
    way = -np.sign(place) if back else rng.choice([-1, 1])
    return float(np.clip(place + way * stroke * rng.uniform(0.6, 1), -angle, angle))


def _way(distance: float, top: float, rise: float) -> np.ndarray:
    """Shares of a move tick by tick: its speed rises, stays and falls."""
    if distance == 0:
        return np.zeros(1)
    ramp = top / rise
    if top * ramp > distance:
        ramp = np.sqrt(distance / rise)
        top = rise * ramp
    lasts = distance / max(top, 1e-9) + ramp
    time = np.arange(int(lasts * 1000) + 1) * TICK
    speed = np.minimum(1, np.minimum(time / ramp, np.maximum(0, lasts - time) / ramp))
    way = np.cumsum(speed)
    return way / way[-1] if way[-1] > 0 else way


def _smooth(path: np.ndarray, width: int) -> np.ndarray:
    window = np.hanning(width + 2)[1:-1]
    padded = np.pad(path, (width, width), "edge")
    return np.convolve(padded, window / window.sum(), "same")[width:-width]
