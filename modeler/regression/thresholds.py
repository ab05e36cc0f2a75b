"""Numbers that decide in this package: what each bounds, its unit, and why it is this one."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the bounds, tolerances and counts of the package; one instance, `THRESHOLDS`."""

    filter_memory: float = 12.0
    """Periods of the position filter after which 3e-13 of a motion is left: exp(-2.4 t cutoff)."""
    min_margin_rows: int = 64
    """Rows beside a chunk: detectors of faults see 30 to both sides."""
    min_half_window: int = 3
    """Samples: a step of the acceleration weighs 1/12 of itself."""
    max_delay_share: float = 0.02
    """Mean disagreement, as a share of the derivative, of a column that is used."""
    min_delay_steps: float = 0.75
    """Steps; a jump between two samples is half a step early or late."""
    max_delayed_error: float = 0.5
    """Share of the sum of errors that a delay may leave."""
    max_single_error: float = 0.25
    """Share of the derivative's mean that a delay of one joint may leave."""
    delay_iterations: int = 3
    """The equation is linear for small delays only."""
    scanned_disagreement: float = 0.3
    """Disagreement from which on delays are scanned."""
    delay_scan_step: float = 5e-3
    """s between the delays that are tried one by one where small ones do not explain the data."""
    contradiction_sigmas: float = 8.0
    """Robust standard deviations of a contradicted derivative, and"""
    contradiction_share: float = 0.25
    """its share of the derivative's size, and"""
    contradiction_steps: float = 5.0
    """resolution steps of the lower signal over the window."""
    max_column_error: float = 0.5
    """Mean disagreement of a column that is a derivative."""
    min_signal_to_noise: float = 10.0
    """Change of the lower signal over a window, in its noise."""
    max_noise_ratio: float = 2.0
    """Noise of a logged velocity over that of the differentiated position."""
    gap_steps: float = 5.0
    """Median steps that end a piece of motion."""
    time_resolution_share: float = 1e-7
    """Of a step; over the rows of a block, less than a row."""
    top_speed_quantile: float = 0.98
    """Quantile of the speeds that is the top speed: no short transient."""
    creep_speed: float = 1e-9
    """rad/s or m/s, to both sides of standstill."""
    home_halvings: int = 10
    """From positions anywhere to 1e-3 of home."""
    rest_travel_share: float = 0.02
    """Of a joint's travel in all logs, in a log in which it rests."""
    reversal_speed_share: float = 0.05
    """Share of its top speed below which a shaft is near a reversal, or"""
    reversal_speed_sigmas: float = 5.0
    """deviations of the noise of its speed, but"""
    max_reversal_share: float = 0.2
    """no more of its top speed."""
    reversal_periods: float = 0.7
    """Periods of the position filter over which a reversal is smeared."""
    max_cutoff_share: float = 0.4
    """Of the sampling rate: above, a Butterworth filter cannot fall."""
    short_bridge_periods: float = 0.4
    """Periods of the cut-off that a bridge may take."""
    edge_periods: float = 2.5
    """Periods of start-up of the position filter: 0.5 % of the kink in the acceleration is left."""
    floor_ratio: float = 3.0
    """Spectrum over its median above, at a floor: white noise is flat."""
    floor_octaves: float = 2.0
    """Over which a floor is flat."""
    max_position_cutoff: float = 80.0
    """Hz: more than twice the 30 Hz of a diagnosis."""
    min_position_bands: float = 5.0
    """Bands of the motion: closer, the filter damps the acceleration."""
    rest_steps: float = 5.0
    """Steps of its encoder that a joint at rest stays within."""
    exact_noise: float = 1e-8
    """rad or m, 28 bits of a turn."""
    coloured_slope: float = 1.0
    """Power of 1/f from which on noise is coloured."""
    max_noise_slope: float = 2.0
    """Power of 1/f: no sensor's noise falls faster."""
    band_energy_share: float = 0.99
    """Of the velocity's energy below the motion band."""
    valley_ratio: float = 4.0
    """Energy of motion over that of the octave above it."""
    fast_joint_bands: float = 4.0
    """Bands of the median joint: a faster joint may chatter."""
    max_chatter_share: float = 0.05
    """Rms position apart from the motion that is no motion."""
    min_motion_share: float = 0.01
    """Rms position over that of the joint that moves most."""
    steps_per_octave: int = 6
    """Points per octave at which the energy per octave of a spectrum is evaluated."""
    min_ringing_frequency: float = 30.0
    """Hz: below, it is motion."""
    ringing_gap: float = 4.0
    """Ratio of frequencies without energy below ringing."""
    min_motion_energy: float = 1e-3
    """Of the ringing: below, the robot only shakes."""
    max_gap_energy: float = 0.01
    """Energy between the motion and ringing, over that of the motion, below which ringing stands
    apart."""
    min_ringing_energy: float = 0.01
    """Energy above that gap over that of the motion, above which it is ringing."""
    complete_weight: float = 0.95
    """Share of the weights of a row on usable samples, of a whole row."""
    min_parallel_bands: float = 2.0
    """Bands of the motion that a parallel filter leaves, and"""
    min_parallel_cutoff: float = 0.5
    """Hz that it passes at least."""
    max_chatter_ratio: float = 4.0
    """High-frequency content of the predicted torque over the measured one; docs/studies."""
    min_coherence: float = 0.5
    """Of predicted and measured torque, if the motion is one."""
    cutoff_factor: float = 0.7
    """By which a cut-off is lowered."""
    position_cutoff_ratio: float = 2.5
    """Of the parallel cut-off, to which the position filter is lowered by itself."""
    min_rows_per_parameter: int = 10
    """A fit of fewer leaves less than their noise."""
    crossover_fits: int = 4
    """By which the parallel cut-off is found."""
    search_samples: int = 2**15
    """Of the logs, by which cut-offs are chosen."""
    min_residual_share: float = 1e-6
    """Share of a joint's rms torque that bounds its residual from below in the joint weights."""
    weight_iterations: int = 4
    """Fits in which joint weights converge."""
    min_singular_share: float = 1e-8
    """Of the largest singular value, columns scaled."""
    inertia_postures: int = 50
    """At which the inertia matrix is evaluated."""
    min_curvature_rows: int = 10
    """Rows of a joint, usable with both neighbours, below which second differences are not
    compared."""
    min_torque_noise_share: float = 0.1
    """Of the residual's variance that is the torque's own noise."""
    cutoff_tolerance: float = 0.03
    """Relative change of a cut-off at which its search ends."""
    max_position_spike: int = 10
    """Samples between two jumps that are a spike; more are another zero."""
    min_frozen: int = 3
    """Equal samples before a jump."""
    step_quantile: float = 0.8
    """Of the steps between rows that a recorder did not repeat."""
    max_return_share: float = 0.3
    """Of the larger jump, that two jumps there and back leave."""
    catch_up_share: float = 0.5
    """To which a jump makes up for frozen samples or lost rows."""
    min_shared_leap: float = 0.1
    """Of the leap of all joints, in each one's own speed, of a joint that leaps too. No study."""
    turn_tolerance: float = 0.1
    """Share of a turn by which a jump may miss a whole turn: what a joint moves meanwhile."""
    late_steps: float = 2.0
    """Median steps: across a longer one, a joint may move anywhere."""
    jerk_samples: int = 10
    """In which a joint that jerks is as fast as its jump."""
    jump_samples: int = 3
    """To both sides of a jump, over which that speed would carry it."""
    max_repair_ratio: float = 0.95
    """Held-out error of a repaired log over that as logged; false claims have 0.997."""
    max_noted_ratio: float = 0.99
    """The same, above which a claim is not worth a note."""
    max_value: float = 1e12
    """SI; larger values are damage."""
    ringing_width: float = 0.1
    """Of its frequency, within which most of the energy of ringing lies: 77 % of an arm that
    rings, 6 to 19 % of chatter."""
    min_ringing_coherence: float = 0.5
    """Coherence of torque and position at its frequency above which ringing is that of the
    robot."""
    parallel_bands: float = 4.0
    """Bands of the motion of the widest parallel filter, and"""
    min_widest_parallel: float = 5.0
    """Hz that it passes at least."""
    min_closed_share: float = 0.1
    """Of the samples: fewer are of another machine or in other units."""
    max_plain_step: float = 0.2
    """s; a longer median step is more likely in ms."""
    max_duty: float = 1.2
    """Share of the supply, with the noise of a converter."""
    max_plain_span: float = 30.0
    """rad; more are likely degrees."""
    header_rows: int = 1000
    """That show which columns a file has."""
    triangle_block_samples: int = 4096
    """Samples evaluated at a time for triangles."""
    time_blocks: int = 5
    """Of time; each is predicted from the others."""
    block_reweightings: int = 8
    """Fits in which joint weights converge."""
    block_tolerance: float = 1e-13
    """Of the eigenvalues of normal equations with columns of length one: rounding."""
    prior_postures: int = 200
    """Of a motion by which the torque of each parameter is measured."""
    prior_motion: float = 1.0
    """rad, rad/s, rad/s^2, rms of that motion where a log holds a robot at rest,"""
    rest_share: float = 0.1
    """which is to travel less than this share of it."""
    slide_share: float = 0.1
    """m for each rad of that."""
    plain_cutoffs: tuple[float, ...] = (2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 40.0)
    """Hz of the plain filters that the chosen ones are compared with, judged behind"""
    judged_cutoff: float = 5.0
    """Hz; benchmarks/textbook."""
    min_plain_error: float = 0.001
    """Held-out error of the chosen filters below which nothing is gained."""
    max_plain_ratio: float = 0.97
    """Held-out error of plain filters over that of the chosen ones, below which they are taken;
    benchmarks/textbook."""
    max_jitter: float = 0.01
    """Share of a step beyond which time stamps are resampled."""
    bridge_distance: float = 0.75
    """Steps from a grid point to the next measured row."""
    uneven_quantile: float = 0.95
    """Of the steps of an uneven clock, of which"""
    uneven_distance: float = 0.51
    """a grid point in the middle is no farther."""
    short_bridge: int = 3
    """Samples of a bridge that is a cubic."""
    min_piece_rows: int = 4
    """The second difference and its neighbours."""
    min_saturated_run: int = 5
    """Samples of a torque at its limit."""
    min_single_limit: int = 20
    """Samples of the only such run of a log: a crest in coarse steps had 16."""
    min_saturated_jump: float = 3.0
    """Resolution steps into or out of such a run."""
    max_switched_values: int = 3
    """Of a drive that knows full torque, none, and full torque back."""
    min_saturated_travel: float = 10.0
    """Deviations of position noise in such a run."""
    max_spike: int = 3
    """Samples of a spike; longer ones may be impacts."""
    min_spike_share: float = 0.2
    """Of a channel's range: a smaller spike vanishes in the filter."""
    max_spike_rate: float = 1e-3
    """Share of a channel's values that may be spikes, or"""
    max_spikes: int = 8
    """so many of a short log."""
    impact_ratio: float = 3.0
    """Departure of another torque over its neighbourhood, in an impact."""
    max_spike_step: float = 0.3
    """Of the spike, between the values on both sides of it."""
    impact_samples: int = 2
    """Between what two torques show of one impact."""
    speed_samples: int = 5
    """Before and after a spike over which the speed is taken."""
    speed_change_quantile: float = 0.95
    """Of the changes of the speed over that time."""
    speed_change_ratio: float = 2.0
    """Of the change across a spike and those before."""
    filter_block_samples: int = 4096
    """Samples evaluated at a time: 4096 x 7 joints x 60 columns is 14 MB."""
    max_window_logs: int = 64
    """Logs that are looked at; of more, every so many."""
    max_rate_ratio: float = 100.0
    """Of the time steps of two motions in a log."""
    min_window_travel: float = 1e-3
    """rad or m: less is rest."""
    max_state_doubt: float = 0.05
    """Of the state of a bristle, which is between -1 and 1: what its start may still make of it."""
    max_unsettled_share: float = 0.25
    """Of the travel in a segment: no more is left out for the state at its start. No study."""


THRESHOLDS = Thresholds()
