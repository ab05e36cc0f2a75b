"""A cascaded position and velocity controller, as drives have it, scheduled with the inertia."""

from dataclasses import dataclass

import numpy as np

from modeler.simulate.elementary import exponential

_SPEED_FILTER = 150.0  # Hz, on the differenced encoder position
# Zero-order hold (0.5 tick), latency (1), difference (0.5), and the speed filter delay the velocity
# loop; where that takes more than 0.6 rad of phase at the bandwidth, the bandwidth is lowered.
_DELAY_TICKS = 2.0
_PHASE = 0.6
_LOWER_LOOPS = 0.25  # position loop and integral action, relative to the velocity loop


@dataclass(frozen=True, eq=False)
class Gains:
    """Of the P-PI cascade, for unit inertia.

    Attributes:
        position: rad/s of speed per rad of position error, 1/s.
        speed: acceleration per speed error, 1/s.
        integral: acceleration per integrated speed error, 1/s2.
        forward: 1 if commanded speed and acceleration are fed forward, else 0.
        highest: (joints,) saturation, N m or N; 0 for a joint without motor.
        filter_share: of the new difference in the filtered speed, per tick.
        tick: s.
    """

    position: float
    speed: float
    integral: float
    forward: float
    highest: np.ndarray
    filter_share: float
    tick: float


@dataclass(frozen=True, eq=False)
class ControllerState:
    """What the controller remembers from one tick to the next; (joints,) each.

    Attributes:
        measured: encoder position at the last tick.
        speed: filtered.
        effort: torque of the integral action.
    """

    measured: np.ndarray
    speed: np.ndarray
    effort: np.ndarray


def tuned_gains(rate: float, bandwidth: float, feedforward: bool, highest: np.ndarray) -> Gains:
    """Gains of a velocity loop of `bandwidth` [Hz], lowered where the delay asks for it."""
    delay = _DELAY_TICKS / rate + 1 / (2 * np.pi * _SPEED_FILTER)
    omega = min(2 * np.pi * bandwidth, _PHASE / delay)
    return Gains(
        position=_LOWER_LOOPS * omega,
        speed=omega,
        integral=_LOWER_LOOPS * omega**2,
        forward=float(feedforward),
        highest=highest,
        filter_share=1 - float(exponential(-2 * np.pi * _SPEED_FILTER / rate)),
        tick=1 / rate,
    )


def control(
    gains: Gains,
    state: ControllerState,
    inertia: np.ndarray,
    measured: np.ndarray,
    command: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> tuple[ControllerState, np.ndarray]:
    """The next state, and the torque the controller asks for; (joints,).

    tau = sat(M (kv (kp (qc - q) + qdc - v) + qddc) + effort), effort' = M ki (the same error). With
    fixed gains an arm without rotor inertias loses its wrist: its inertia varies a hundredfold.
    Gravity, Coriolis torques and friction are left to the integral action. The integral of a joint
    stands still while its torque is saturated and the error would drive it further.

    Args:
        gains: of the cascade.
        state: after the last tick.
        inertia: (joints, joints) M that the motors feel at the measured position.
        measured: encoder position now.
        command: commanded q, qd, qdd now.
    """
    q, qd, qdd = command
    difference = (measured - state.measured) / gains.tick
    speed = state.speed + gains.filter_share * (difference - state.speed)
    error = gains.position * (q - measured) + gains.forward * qd - speed
    rise = _product(inertia, gains.integral * gains.tick * error)
    effort = state.effort + rise
    wanted = _product(inertia, gains.speed * error + gains.forward * qdd) + effort
    torque = np.minimum(np.maximum(wanted, -gains.highest), gains.highest)
    winding = (wanted != torque) & (wanted * rise > 0)
    return ControllerState(measured, speed, np.where(winding, state.effort, effort)), torque


def _product(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """matrix vector, by sums in a fixed order: libraries of linear algebra round as they like."""
    return np.asarray(np.sum(matrix * vector, axis=1))
