"""A cascaded position and velocity controller, as drives have it."""

from dataclasses import dataclass

import numpy as np

from modeler.robot import Limits
from modeler.simulate.plant import Plant, sample_poses

_SPEED_FILTER = 150.0  # Hz, on the differenced encoder position
# Zero-order hold (0.5 tick), latency (1), difference (0.5), speed filter: seconds of delay by which
# the velocity loop stays stable; at 0.6 rad of phase some 45 degrees of margin are left.
_DELAY_TICKS = 2.0
_PHASE = 0.6
_LOWER_LOOPS = 0.25  # position loop and integral action, relative to the velocity loop


@dataclass(frozen=True, eq=False)
class Gains:
    """Of the P-PI cascade; arrays are (joints,), in the order of q.

    Attributes:
        position: rad/s of speed per rad of position error.
        speed: torque per speed error, N m s/rad or N s/m.
        integral: torque per integrated speed error, N m/rad or N/m.
        inertia: torque per commanded acceleration; 0 without feed-forward.
        speed_forward: 1 if the commanded speed is added to the speed the position loop asks for.
        highest: saturation, N m or N.
        filter_share: of the new difference in the filtered speed, per tick.
        tick: s.
    """

    position: np.ndarray
    speed: np.ndarray
    integral: np.ndarray
    inertia: np.ndarray
    speed_forward: float
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


def tuned_gains(
    plant: Plant,
    limits: tuple[Limits, ...],
    rate: float,
    bandwidth: float,
    feedforward: bool,
    highest: np.ndarray,
) -> Gains:
    """Gains from the plant's own inertia.

    Each velocity loop gets `bandwidth` [Hz] with the median inertia of its joint. The fastest mode
    of the coupled loops is the largest eigenvalue of inv(M) diag(gain); where delay and that mode
    together would take more than 0.6 rad of phase at some pose, all loops are slowed down.
    """
    masses = [plant.inertia(pose).full() for pose in sample_poses(limits)]
    own = np.median([np.diag(mass) for mass in masses], axis=0)
    omega = 2 * np.pi * bandwidth
    fastest = max(
        float(np.max(np.abs(np.linalg.eigvals(np.linalg.solve(mass, np.diag(own * omega))))))
        for mass in masses
    )
    delay = _DELAY_TICKS / rate + 1 / (2 * np.pi * _SPEED_FILTER)
    omega *= min(1.0, _PHASE / (delay * fastest))
    ones = np.ones(own.size)
    return Gains(
        position=_LOWER_LOOPS * omega * ones,
        speed=own * omega,
        integral=_LOWER_LOOPS * own * omega**2,
        inertia=own * feedforward,
        speed_forward=float(feedforward),
        highest=np.where(plant.driven, highest, 0.0),
        filter_share=1 - float(np.exp(-2 * np.pi * _SPEED_FILTER / rate)),
        tick=1 / rate,
    )


def control(
    gains: Gains,
    state: ControllerState,
    measured: np.ndarray,
    command: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> tuple[ControllerState, np.ndarray]:
    """The next state, and the torque the controller asks for; (joints,).

    tau = sat(kv (kp (qc - q) + qdc - v) + integral + J qddc); the integral stands still where the
    torque is saturated and the error would drive it further.

    Args:
        gains: of the cascade.
        state: after the last tick.
        measured: encoder position now.
        command: commanded q, qd, qdd now.
    """
    q, qd, qdd = command
    speed = state.speed + gains.filter_share * (
        (measured - state.measured) / gains.tick - state.speed
    )
    error = gains.position * (q - measured) + gains.speed_forward * qd - speed
    effort = state.effort + gains.integral * gains.tick * error
    wanted = gains.speed * error + effort + gains.inertia * qdd
    torque = np.minimum(np.maximum(wanted, -gains.highest), gains.highest)
    winding = (wanted != torque) & (np.sign(wanted) == np.sign(error))
    return ControllerState(measured, speed, np.where(winding, state.effort, effort)), torque
