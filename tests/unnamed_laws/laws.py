"""Laws of joint torque that no catalogue of effects holds: what they are, drawn and as a column.

The simulated arm has them in its differential equation (`tests/hidden_effects/unnamed.c`); the
columns here are the same equations on measured signals, written apart from it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.signal import lfilter

from tests.hidden_effects.effects import Draw, Impossible

LONG_AGO = 1e3  # s since a joint has turned back that has not moved yet


@dataclass(frozen=True)
class Motion:
    """Signals of one segment at even steps; (rows, n), SI, n joints.

    Attributes:
        q, v, a: position, speed, acceleration.
        load: torque that the links ask for, inertia and gravity together.
        t: (rows,) s.
    """

    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    load: np.ndarray
    t: np.ndarray


@dataclass(frozen=True)
class TrueForm:
    """The law of a machine: torque of its joint = size * column.

    Attributes:
        law: its name in `LAWS`.
        joint: index.
        other: index of the joint whose motion it reads besides; its own where it reads none.
        size: of the column.
        shapes: by name.
        width: speed within which dry friction changes its sign.
        turns: way from the farthest place, from which on the joint has turned back.
    """

    law: str
    joint: int
    other: int
    size: float
    shapes: Mapping[str, float]
    width: float
    turns: float

    def column(self, motion: Motion) -> np.ndarray:
        """(rows,) column of the torque of its joint."""
        return LAWS[self.law].column(_Seen(motion, self), **self.shapes)


@dataclass(frozen=True)
class _Seen:
    """What the equation of a law reads."""

    motion: Motion
    form: TrueForm

    @property
    def q(self) -> np.ndarray:
        return self.motion.q[:, self.form.joint]

    @property
    def v(self) -> np.ndarray:
        return self.motion.v[:, self.form.joint]

    @property
    def load(self) -> np.ndarray:
        return self.motion.load[:, self.form.joint]

    @property
    def other_q(self) -> np.ndarray:
        return self.motion.q[:, self.form.other]

    @property
    def other_v(self) -> np.ndarray:
        return self.motion.v[:, self.form.other]

    @property
    def sign(self) -> np.ndarray:
        """Of the speed, rounded as dry friction is."""
        return np.tanh(self.v / self.form.width)

    @property
    def since(self) -> np.ndarray:
        """s since the joint has turned back: since it is `turns` from the farthest place."""
        since, began = np.empty(len(self.q)), -LONG_AGO
        way, farthest = 0.0, self.q[0]
        for k, (q, t) in enumerate(zip(self.q, self.motion.t, strict=True)):
            on = q - farthest
            if on * way > 0:
                farthest = q
            elif abs(on) >= self.form.turns:
                began = began if way == 0 else t
                way, farthest = np.sign(on), q
            since[k] = t - began
        return since

    def lagging(self, x: np.ndarray, tau: float) -> np.ndarray:
        """z of z' = (x - z) / tau, x straight between samples; z = x at first."""
        keeps = np.exp(-(self.motion.t[1] - self.motion.t[0]) / tau)
        between = np.append(x[0], 0.5 * (x[1:] + x[:-1]))
        return lfilter([1 - keeps], [1, -keeps], between, zi=[keeps * x[0]])[0]


@dataclass(frozen=True)
class Law:
    """A law.

    Attributes:
        number: in `unnamed.c`.
        draw: shapes by name, in the order of `unnamed.c`; changes the joint of the draw where only
            some joints can have it.
        column: of what is seen, by the shapes.
        neighbour: True if it reads the motion of another joint.
        dry: True if it follows the sign of the speed.
    """

    number: int
    draw: Callable[[Draw, int], dict[str, float]]
    column: Callable[..., np.ndarray]
    neighbour: bool = False
    dry: bool = False


LAWS: dict[str, Law] = {}
"""By name."""


def _law(number: int, draw: Callable[[Draw, int], dict[str, float]], **kind: bool) -> Any:
    """Puts the column that follows, as `_name`, into `LAWS`."""

    def add(column: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
        LAWS[column.__name__.removeprefix("_")] = Law(number, draw, column, **kind)
        return column

    return add


def _bell(x: np.ndarray) -> np.ndarray:
    return np.exp(-(x**2))


def _loaded(draw: Draw) -> None:
    """Only joints that bear a good part of the load."""
    load = draw.scales.load
    draw.joint = draw.pick([k for k in range(draw.n) if load[k] > 0.35 * load.max()])


def _draw_two_dips(draw: Draw, other: int) -> dict[str, float]:
    return {
        "v1": draw.between(0.05, 0.12) * draw.speed,
        "c": draw.between(0.6, 1.2),
        "v2": draw.between(0.35, 0.6) * draw.speed,
        "w": draw.between(0.08, 0.16) * draw.speed,
    }


@_law(1, _draw_two_dips, dry=True)
def _two_dips(x: _Seen, v1: float, c: float, v2: float, w: float) -> np.ndarray:
    """sign(v) (exp(-(|v| / v1)^2) - c exp(-((|v| - v2) / w)^2)).

    Gear and seal leave their mixed lubrication at two speeds: friction falls twice.
    """
    speed = np.abs(x.v)
    return x.sign * (_bell(speed / v1) - c * _bell((speed - v2) / w))


def _draw_load_speed(draw: Draw, other: int) -> dict[str, float]:
    _loaded(draw)
    return {}


@_law(2, _draw_load_speed)
def _load_speed(x: _Seen) -> np.ndarray:
    """|load| v.

    The oil film between loaded teeth is sheared: viscous friction in proportion to the load.
    """
    return np.abs(x.load) * x.v


def _draw_loaded_cogging(draw: Draw, other: int) -> dict[str, float]:
    _loaded(draw)
    return {"n": float(draw.rng.integers(4, 13)), "phi": draw.between(-np.pi, np.pi)}


@_law(3, _draw_loaded_cogging)
def _loaded_cogging(x: _Seen, n: float, phi: float) -> np.ndarray:
    """|load| sin(n q + phi).

    Planets of a gear that share the load unevenly: a ripple in proportion to the load.
    """
    return np.abs(x.load) * np.sin(n * x.q + phi)


def _draw_reversal_memory(draw: Draw, other: int) -> dict[str, float]:
    return {"tau": draw.between(0.2, 0.8)}


@_law(4, _draw_reversal_memory, dry=True)
def _reversal_memory(x: _Seen, tau: float) -> np.ndarray:
    """sign(v) exp(-since / tau).

    After turning back, grease has to be carried into the contact again: friction is larger for
    a while.
    """
    return x.sign * np.exp(-x.since / tau)


def _draw_neighbour_drag(draw: Draw, other: int) -> dict[str, float]:
    angle = draw.scales.bounds.angle[other]
    return {"q0": draw.between(-0.4, 0.4) * angle, "w": draw.between(0.25, 0.5) * angle}


@_law(5, _draw_neighbour_drag, neighbour=True, dry=True)
def _neighbour_drag(x: _Seen, q0: float, w: float) -> np.ndarray:
    """sign(v) exp(-((q_k - q0) / w)^2).

    Cables to the tool lie in a bend that another joint makes, and rub most where it is
    tightest.
    """
    return x.sign * _bell((x.other_q - q0) / w)


def _draw_thixotropy(draw: Draw, other: int) -> dict[str, float]:
    return {"v0": draw.between(0.12, 0.3) * draw.speed, "tau": draw.between(0.4, 2.0)}


@_law(6, _draw_thixotropy, dry=True)
def _thixotropy(x: _Seen, v0: float, tau: float) -> np.ndarray:
    """sign(v) exp(-z / v0), tau z' = |v| - z.

    Grease that is kneaded thins, and thickens again at rest: friction falls with the mean speed
    of the last seconds.
    """
    return x.sign * np.exp(-x.lagging(np.abs(x.v), tau) / v0)


def _draw_eddy_peak(draw: Draw, other: int) -> dict[str, float]:
    return {"vc": draw.between(0.1, 0.3) * draw.speed}


@_law(7, _draw_eddy_peak)
def _eddy_peak(x: _Seen, vc: float) -> np.ndarray:
    """2 v vc / (v^2 + vc^2): largest at vc.

    Currents that a brake disc's motion induces: drag that is largest at one speed.
    """
    ratio = x.v / vc
    return 2 * ratio / (1 + ratio**2)


def _draw_bumper(draw: Draw, other: int) -> dict[str, float]:
    side = draw.sign()
    return {"q1": side * draw.between(0.2, 0.5) * draw.angle, "side": side}


@_law(8, _draw_bumper)
def _bumper(x: _Seen, q1: float, side: float) -> np.ndarray:
    """side max(0, side (q - q1))^1.5.

    A rubber buffer, or a bundle of hoses that is pressed flat, towards one end (Hertz).
    """
    return side * np.maximum(0, side * (x.q - q1)) ** 1.5


def _draw_dither(draw: Draw, other: int) -> dict[str, float]:
    return {"v0": draw.between(0.1, 0.3) * draw.scales.bounds.speed[other]}


@_law(9, _draw_dither, neighbour=True, dry=True)
def _dither(x: _Seen, v0: float) -> np.ndarray:
    """sign(v) / (1 + (v_k / v0)^2).

    The joint next to it shakes the contact while it runs: friction falls.
    """
    return x.sign / (1 + (x.other_v / v0) ** 2)


def _draw_maxwell_hose(draw: Draw, other: int) -> dict[str, float]:
    return {"tau": draw.between(0.3, 1.5)}


@_law(10, _draw_maxwell_hose)
def _maxwell_hose(x: _Seen, tau: float) -> np.ndarray:
    """q - z, tau z' = q - z.

    A hose that creeps: a spring in series with a damper (Maxwell).
    """
    return x.q - x.lagging(x.q, tau)


def neighbour_of(draw: Draw) -> int:
    """Index of a joint next to the one that is drawn."""
    near = [k for k in (draw.joint - 1, draw.joint + 1) if 0 <= k < draw.n]
    if not near:
        raise Impossible
    return draw.pick(near)
