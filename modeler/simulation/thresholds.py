"""Bounds and tolerances of the simulator, with unit, reason and study."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide in the simulator."""

    max_closure_error: float = 1e-11
    """Sizes of the robot, and of direction cosines; no study."""
    max_newton_iterations: int = 40
    """Max newton iterations; no study."""
    max_newton_step: float = 0.2
    """rad or m, of one Newton step; no study."""
    max_joint_jump: float = 0.8
    """rad or m: a joint that moves so far at once is in another assembly mode; no study."""
    anchor_spacing: float = 0.02
    """rad or m, between postures found one after the other; those between, all at once; no
    study."""
    posture_stride: float = 0.1
    """rad or m, of the coordinates between two postures found one after the other; no study."""
    min_relative_singular_value: float = 1e-10
    """Of singular values; no study."""
    min_independent_share: float = 1e-6
    """Of the sizes of the passive joints' columns, one after the other; no study."""
    samples_per_chunk: int = 2000
    """Samples; no study."""
    range_reduction: float = 0.85
    """Of the range, from one attempt to the next; no study."""
    min_range_share: float = 0.03
    """Min range share; no study."""
    home_path_spacing: float = 0.02
    """rad or m, between postures looked at on the way from home to the first one; no study."""
    checked_rate: float = 100.0
    """Hz, at which a motion is tried; no study."""
    top_speed_quantile: float = 0.98
    """Top speed quantile; no study."""
    lively_rms_share: float = 0.29
    """Of the limits: rms of what the scale of the links is drawn from; no study."""
    max_stated_rounding: float = 1e-13
    """Relative; differences of stated numbers below it are 0; no study."""
    min_strict_eigenvalue: float = 1e-7
    """Least eigenvalue, of a matrix near ones on its diagonal, of a body with an inside; no
    study."""
    max_edge_violation: float = 1e-8
    """Below 0 by so little is the rounding of a plate, a rod or a point; no study."""
    max_final_violation: float = 1e-10
    """Below 0 by less is no matter; no study."""
    max_thin_eigenvalue: float = 1e-5
    """Eigenvalues below it are those of a plate, a rod or a point; no study."""
    newton_steps: int = 5
    """Of Newton, each of which doubles the digits; no study."""
    max_damped_steps: int = 500
    """Steps before those at most; no study."""
    trace_weight: float = 1e-3
    """Weight of the trace beside the least eigenvalue; no study."""
    random_states: int = 64
    """Random states from which the typical torque of a joint is taken; no study."""
    max_idle_torque_share: float = 1e-9
    """Of the largest torque: joints below it move no mass; no study."""
    idle_torque_share: float = 0.02
    """Their scale instead; no study."""
    mass_per_squared_reach: float = 30.0
    """kg per squared metre of reach: an arm of 1 m weighs 30 kg; no study."""
    link_mass_reduction: float = 0.7
    """Mass per length of a link, relative to the link before it; no study."""
    default_link_length: float = 0.15
    """m, where the table holds no length at all; no study."""
    short_link_share: float = 0.35
    """Length of a link without extent, relative to the mean of the others; no study."""
    speed_overshoot: float = 1.3
    """Of the top speed, that inner states must follow; no study."""
    bristle_damping_ratio: float = 0.5
    """Of the oscillation of a joint on its bristles, of the critical one; no study."""
    bouc_wen_beta: float = 0.7
    """Bouc and Wen's beta of beta + gamma = 1; no study."""
    friction_halving_temperature: float = 30.0
    """K, by which friction falls to a half; no study."""
    backlash_edge_share: float = 0.005
    """Of the gap: width of the edge where gear teeth come to bear; no study."""
    max_ripple_share_of_rate: float = 0.2
    """Of the sampling rate: faster ripples are not hidden, no log would show them; no study."""
    load_friction_passes: int = 3
    """Friction of a share mu of the load is then exact to about mu^4; no study."""
    max_step: float = 5e-4
    """s: rigid motion of an arm is then exact to some 1e-10; no study."""
    max_step_times_rate: float = 1.5
    """Of a step times the fastest mode; Runge-Kutta 4 is stable up to 2.78; no study."""
    max_steps_per_tick: int = 400
    """Per tick; no study."""
    max_exponent: float = 700.0
    """Argument of exp; no study."""
    logarithm_roots: int = 6
    """Square roots that bring 1e-12 to 1e12 near to 1, where the series of atanh is short; no
    study."""
    max_inertia_rounding: float = 1e-11
    """Of the moments of inertia; no study."""
    encoder_inversion_passes: int = 30
    """Of the fixed point that inverts an eccentric encoder; contracts to a hundredth; no
    study."""
    speed_filter_hz: float = 150.0
    """Hz, on the differenced encoder position; no study."""
    loop_delay_ticks: float = 2.0
    """Loop delay ticks; no study."""
    max_delay_phase: float = 0.6
    """Max delay phase; no study."""
    outer_loop_share: float = 0.25
    """Position loop and integral action, relative to the velocity loop; no study."""
    process_noise_time: float = 0.03
    """s; no study."""
    ticks_per_report: int = 500
    """Ticks between looks at the tracking error, and calls of the callback; no study."""
    thermometer_resolution: float = 0.01
    """K, resolution; no study."""
    checked_postures: int = 8
    """Postures of a closed robot, for the stiffest of its motions; no study."""
    max_tracking_error_share: float = 0.5
    """Tracking error, in ranges of motion, at which the controller has lost the robot; no
    study."""
    dry_friction_core_share: float = 1e-3
    """Width of the smooth core of dry friction, relative to the top speed; no study."""
    push_rise_time: float = 5e-3
    """s, in which a push sets in; no study."""
    max_sag: float = 0.3
    """rad or m, that a link may be ahead of its motor at rest; no study."""
    sag_halvings: int = 60
    """Sag halvings; no study."""
    sag_sweeps: int = 4
    """Gravity couples what lies behind several transmissions, weakly; no study."""
    range_margin: float = 0.92
    """Of the limits: the joints overshoot the command a little; no study."""
    move_speeds: tuple[float, ...] = (1.0, 0.6, 0.25, 1.0, 0.4, 0.1)
    """Of the top speed, taken in turn; no study."""
    max_move_time: float = 1.4
    """s, of one move: slow moves are short ones; no study."""
    pause_time: float = 0.05
    """s, between moves; no study."""
    harmonics: int = 6
    """Harmonics; no study."""
    min_fundamental_hz: float = 0.1
    """Hz, fundamental of the series; no study."""
    rest_time: float = 0.2
    """s, before and after a joint moves alone; no study."""
    single_joint_speeds: tuple[float, ...] = (1.0, 0.5)
    """Of the top speed, of a joint that moves alone; no study."""
    max_motion_bytes: int = 2**30
    """bytes; no study."""
    max_motion_number: float = 1e12
    """Of s, rad, m and their rates: squares of squares of it are numbers still; no study."""
    loop_range_share: float = 0.2
    """Of the defaults' range, for robots with loops; no study."""


THRESHOLDS = Thresholds()
