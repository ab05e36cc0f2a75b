"""Bounds and tolerances of the simulator, with unit, reason and study."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide in the simulator."""

    max_closure_error: float = 1e-11
    """Residual of a closed loop: positions over the size of the robot, and direction cosines; no
    study."""
    max_newton_iterations: int = 40
    """Newton steps by which a loop must be closed; else it counts as open; no study."""
    max_newton_step: float = 0.2
    """rad or m; longest motion of a joint in one Newton step; no study."""
    max_joint_jump: float = 0.8
    """rad or m; a joint that moves further between near postures is in another assembly mode; no
    study."""
    anchor_spacing: float = 0.02
    """rad or m of travel between postures that are closed one after the other; those between are
    closed all at once; no study."""
    posture_stride: float = 0.1
    """rad or m; longest motion of a coordinate in one of the steps by which a posture is closed
    from the one before; no study."""
    min_relative_singular_value: float = 1e-10
    """Share of the largest singular value of a loop Jacobian below which least squares take one as
    0; no study."""
    min_independent_share: float = 1e-6
    """Singular value of a loop Jacobian, or diagonal entry of its R, over the largest, up to which
    the passive joints are not determined; no study."""
    samples_per_chunk: int = 2000
    """Samples of a motion for which the loops are evaluated at a time; no study."""
    range_reduction: float = 0.85
    """Factor on the range of motion from one attempt at a motion with closed loops to the next; no
    study."""
    min_range_share: float = 0.03
    """Share of the range of motion at which the attempts at a motion with closed loops end; no
    study."""
    home_path_spacing: float = 0.02
    """rad or m; distance of the postures at which the way from home to the start of a motion is
    checked; no study."""
    checked_rate: float = 100.0
    """Hz; rate at which a motion is checked for closed loops and singular postures; no study."""
    top_speed_quantile: float = 0.98
    """Quantile of the absolute speed of a passive joint that is taken as its top speed; no
    study."""
    lively_rms_share: float = 0.29
    """Rms speed and acceleration of a joint over their limits, with which its stated friction and
    rotor enter its torque scale; those from which the scale of the links is drawn have as much; no
    study."""
    max_stated_rounding: float = 1e-13
    """Relative difference of stated numbers up to which it is rounding and counts as 0; no
    study."""
    min_strict_eigenvalue: float = 1e-7
    """Smallest eigenvalue of a scaled pseudo-inertia, its diagonal near 1, above which a body has
    volume; else it is a plate, a rod or a point; no study."""
    max_edge_violation: float = 1e-8
    """Amount below 0 of that eigenvalue that is the rounding of a plate, a rod or a point; no
    study."""
    max_final_violation: float = 1e-10
    """Amount below 0 of that eigenvalue at which the Newton steps for a plate, a rod or a point
    end; no study."""
    max_thin_eigenvalue: float = 1e-5
    """Eigenvalue of a scaled pseudo-inertia below which its direction is one without extent, of a
    plate, a rod or a point; no study."""
    newton_steps: int = 5
    """Full Newton steps of the completion of a body, each of which doubles the correct digits; no
    study."""
    max_damped_steps: int = 500
    """Most steps of the damped Newton method of the completion of a body, the full ones counted; no
    study."""
    trace_weight: float = 1e-3
    """Weight of the trace of a pseudo-inertia beside its smallest eigenvalue, which keeps entries
    that nothing bounds from growing; no study."""
    random_states: int = 64
    """Random states from which the typical torque and inertia of a joint are taken; no study."""
    max_idle_torque_share: float = 1e-9
    """Share of the largest rms torque up to which a joint moves no mass, as a motor on the base
    does; no study."""
    idle_torque_share: float = 0.02
    """Share of the largest rms torque that is taken as the torque scale of a joint that moves no
    mass; no study."""
    mass_per_squared_reach: float = 30.0
    """kg/m2; mass of the longest chain over its squared reach: an arm of 1 m weighs 30 kg; no
    study."""
    link_mass_reduction: float = 0.7
    """Mass per length of a link over that of the link before it; no study."""
    default_link_length: float = 0.15
    """m; length of the links where the table holds no length at all; no study."""
    short_link_share: float = 0.35
    """Least length of a link over the mean of the links that have one; no study."""
    speed_overshoot: float = 1.3
    """Speed over the top speed at which the internal states of friction must still be integrated
    stably; no study."""
    bristle_damping_ratio: float = 0.5
    """Damping ratio of the oscillation of a joint on its bristles; no study."""
    bouc_wen_beta: float = 0.7
    """Shape parameter beta of Bouc and Wen's hysteresis, with beta + gamma = 1; no study."""
    friction_halving_temperature: float = 30.0
    """K of warming that halve the friction of a joint; no study."""
    backlash_edge_share: float = 0.005
    """Width of the smooth transition where gear teeth come into contact, over the gap; no study."""
    max_ripple_share_of_rate: float = 0.2
    """Frequency of a hidden ripple at top speed over the sampling rate: a log would not show a
    faster one; no study."""
    load_friction_passes: int = 3
    """Fixed-point passes for friction that depends on the load; friction of a share mu of the load
    is then exact to about mu^4; no study."""
    max_step: float = 5e-4
    """s; longest integration step: rigid motion of an arm is then exact to some 1e-10; no study."""
    max_step_times_rate: float = 1.5
    """Integration step times the fastest eigenvalue; Runge-Kutta 4 is stable up to 2.78; no
    study."""
    max_steps_per_tick: int = 400
    """Integration steps in one tick of the controller; a robot that needs more is refused; no
    study."""
    max_exponent: float = 700.0
    """Magnitude of the argument of exp to which a larger one is clipped; no study."""
    logarithm_roots: int = 6
    """Square roots that bring 1e-12 to 1e12 near to 1, where the series of atanh is short; no
    study."""
    max_inertia_rounding: float = 1e-11
    """Share of the trace of the second moments of mass by which rounding may make a plate or a rod
    no body; no study."""
    encoder_inversion_passes: int = 30
    """Passes of the fixed point that inverts an eccentric encoder; each leaves about a hundredth of
    the error; no study."""
    speed_filter_hz: float = 150.0
    """Hz; cut-off of the low-pass on the speed that is differenced from the encoder position; no
    study."""
    loop_delay_ticks: float = 2.0
    """Ticks by which the velocity loop is delayed: zero-order hold 0.5, latency 1, difference 0.5;
    no study."""
    max_delay_phase: float = 0.6
    """rad; phase that this delay and the speed filter may take at the bandwidth of the velocity
    loop; where it is more, the bandwidth is lowered; no study."""
    outer_loop_share: float = 0.25
    """Gains of the position loop and of the integral action over those of the velocity loop; no
    study."""
    process_noise_time: float = 0.03
    """s; correlation time of the random torque on the machine, as from seals, cables and the air;
    no study."""
    ticks_per_report: int = 500
    """Ticks between checks of the tracking error, and calls of the callback; no study."""
    thermometer_resolution: float = 0.01
    """K; resolution to which simulated thermometers are rounded; no study."""
    checked_postures: int = 8
    """Commanded postures of a closed robot at which its fastest eigenvalue is looked for; no
    study."""
    max_tracking_error_share: float = 0.5
    """Tracking error over the range of motion above which the controller has lost the robot; no
    study."""
    dry_friction_core_share: float = 1e-3
    """Width of the smooth core of dry friction, relative to the top speed; no study."""
    push_rise_time: float = 5e-3
    """s; time constant of the tanh with which a push begins and ends; no study."""
    max_sag: float = 0.3
    """rad or m; bound of the distance between a link and its motor at rest; no study."""
    sag_halvings: int = 60
    """Bisections of the interval of `max_sag` to both sides in which that distance is found; no
    study."""
    sag_sweeps: int = 4
    """Sweeps over all elastic transmissions: gravity couples the links behind them weakly; no
    study."""
    range_margin: float = 0.92
    """Share of the limits that a commanded motion uses: the joints overshoot the command a little;
    no study."""
    move_speeds: tuple[float, ...] = (1.0, 0.6, 0.25, 1.0, 0.4, 0.1)
    """Shares of the top speed of the moves of an exciting motion, taken in turn; no study."""
    max_move_time: float = 1.4
    """s; longest move of an exciting motion, so that slow moves are short ones; no study."""
    pause_time: float = 0.05
    """s of rest before, between and after point-to-point moves; no study."""
    harmonics: int = 6
    """Harmonics of the series of each joint in an exciting motion; no study."""
    min_fundamental_hz: float = 0.1
    """Hz; lowest fundamental of that series; a shorter motion has one over its duration; no
    study."""
    rest_time: float = 0.2
    """s of rest after each move of a joint that moves alone; no study."""
    single_joint_speeds: tuple[float, ...] = (1.0, 0.5)
    """Shares of the top speed of the moves of a joint that moves alone; no study."""
    max_motion_bytes: int = 2**30
    """Bytes of a file of a commanded motion; a larger one is not read; no study."""
    max_motion_number: float = 1e12
    """s, rad, m and their rates; a commanded motion with a number of this size or more is refused:
    its fourth power is still finite; no study."""
    loop_range_share: float = 0.2
    """Range of a joint without limits in a robot with loops, to both sides of home, over the
    default range; no study."""


THRESHOLDS = Thresholds()
