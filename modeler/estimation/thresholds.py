"""Numbers that decide in this package: what each bounds, its unit, and why it is this one."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the bounds, tolerances and counts of the package; one instance, `THRESHOLDS`."""

    reference_weight: float = 0.01
    """Weight gamma of the reference of an unknown link: moves no value that the data determine; no
    study."""
    known_reference_weight: float = 1.0
    """Weight gamma of a link that the robot file states: an error of its own size costs one
    standard deviation of a row; no study."""
    zero_share: float = 1e-6
    """Share of the torque below which a friction or rotor inertia is at its bound of 0; rounding of
    the solver."""
    plate_thickness: float = 1e-6
    """Relative thickness that a plate or a rod of a drawing gets so that it is a body; no study."""
    reported_sigma_factor: float = 1.2
    """Factor on a standard deviation from which on it is reported; no study."""
    max_lags: int = 60
    """Rows of autocorrelation, 24 periods of the parallel filter at 2.5 rows a cut-off."""
    white_lag_sigmas: float = 1.0
    """Standard deviations of a white autocorrelation at which the lags end (Newey and West
    1987)."""
    faded_correlation: float = 0.01
    """Autocorrelation of the parallel filter below which it ends."""
    reported_correlation: float = 0.2
    """Autocorrelation that is reported: filtering leaves 0.1."""
    split_sigmas: float = 4.5
    """Standard deviations between halves of a motion: noise alone exceeds them in one of 1e5
    differences."""
    coloured_split_sigmas: float = 3.0
    """The same where most of the residual is correlated; tests/estimators/coverage."""
    raised_split_sigmas: float = 2.0
    """Standard deviations from which on a further value of the same half is raised too;
    tests/estimators/coverage."""
    correlated_share: float = 0.5
    """Lag-1 autocorrelation from which on most of a residual lasts from row to row."""
    reversal_sigmas: float = 2.0
    """Standard deviations by which values may change without the rows near reversals."""
    reversal_variance_share: float = 0.1
    """Share of a variance that such a difference has beside its expected noise;
    tests/estimators/coverage."""
    max_step: float = 1e-3
    """s; longest integration step of the simulation that makes instruments."""
    max_loop_step: float = 0.4
    """Bandwidth kv times the step, at most: stability of Adams and Bashforth."""
    integral_share: float = 0.25
    """Integral action in units of kv^2; a cascade of drives."""
    reference_cutoff_share: float = 0.5
    """Low-pass of a reference made of the logged motion, over the position cut-off; no study."""
    window_seconds: float = 0.5
    """s, of a window that is simulated beside the others."""
    warm_up_seconds: float = 1.0
    """s, simulated before a window and left out: the start has decayed."""
    loop_windows: int = 5
    """Windows on which the control loop is chosen."""
    divergence_ranges: float = 10.0
    """Ranges of motion from the reference at which the simulation has diverged."""
    min_inertia_eigenvalue: float = 1e-2
    """To which eigenvalues of the inertia matrix are raised, its median diagonal being 1."""
    negative_sigmas: float = 3.0
    """Standard deviations below zero from which on a value is negative."""
    max_fit_error: float = 0.3
    """Relative error above which a model does not describe a joint: 9 % of the variance; no
    study."""
    half_variance_error: float = 0.5**0.5
    """Relative error above which half of a joint's variance is left."""
    max_error_ratio: float = 2.0
    """Cross-validated error over fit error above which rows are too few; tests/fit."""
    max_window_ratio: float = 3.0
    """Error on all rows over that in windows of them; logs of one kind have 0.6 to 1.3."""
    max_systematic_share: float = 0.03
    """Rms of the correlated residual over that of the torque; tests/hidden_effects."""
    max_joint_ratio: float = 2.0
    """Residual of logs together over that alone from which on they are not of one robot."""
    min_different_share: float = 0.02
    """Share of a joint's torque below which logs are not compared: machines differ by more."""
    different_log_sigmas: float = 4.0
    """Standard deviations between two logs with one load."""
    max_compared_samples: int = 20000
    """Samples of a set of logs that are compared with another set; no study."""
    min_block_eigenvalue: float = 1e-6
    """Eigenvalue, over the largest, of a block below which its rows show nothing; no study."""
    change_tolerance: float = 1e-10
    """Eigenvalue of normal equations with unit diagonal below which nothing is determined."""
    max_chance_misfit: float = 2.0
    """Misfit per parameter up to which two sets are of one machine; tests/changed_machines: at most
    1.9 of 40 machines that stayed, 0.3 to 1.6 where the change is named."""
    misfit_per_number: float = 6.0
    """Misfit that a number more must explain: half of log(rows), of 1e5 rows."""
    min_change_misfit: float = 200.0
    """Misfit that changes must explain to be named; tests/changed_machines: over 2000 on encoders
    of 65 536 counts, up to 190 for friction that the model lacks."""
    min_further_misfit: float = 40.0
    """Misfit that a further change must explain: warmth alone may; no study."""
    min_explained_misfit: float = 0.02
    """Share of the difference that a further change must explain; no study."""
    max_compared_error: float = 0.05
    """Relative error of a joint above which fits to other motion differ as machines do: a measured
    arm of 5 to 12 % was told as three changes. No further study."""
    max_changes: int = 3
    """Places that are named."""
    min_change_t: float = 5.0
    """Standard deviations of a changed quantity; tests/changed_machines."""
    min_friction_change: float = 0.1
    """Relative change of a friction parameter: warmth alone changes it by less; no study."""
    min_changed_share: float = 0.02
    """Share of a joint's rms torque that a changed offset, gain or load makes, or a difference
    that nothing explains; no study."""
    min_changed_friction_share: float = 0.005
    """The same of one friction parameter; no study."""
    max_attenuation: float = 3.0
    """Squares of the relative error of a joint by which noise of the motion may change its values;
    tests/changed_machines: 1.7 at an error of 47 %."""
    min_unexplained_ratio: float = 1.5
    """Residual of a joint across two sets, over that of fits of their own, from which a difference
    that nothing explains is reported; tests/changed_machines."""
    min_moment_share: float = 0.1
    """Share of the largest first moment that a moved load changes."""
    max_variance_iterations: int = 30
    """Of weights and gains, or variances; a dozen suffice where the data determine them."""
    weight_tolerance: float = 1e-9
    """Relative change of weights at which an iteration ends."""
    tiny_share: float = 1e-12
    """Share of a size below which a variance or a singular value is rounding."""
    max_gain_sigma: float = 0.1
    """Relative standard deviation of a drive gain: beyond, a data sheet is as good."""
    noise_gap_sigmas: float = 5.0
    """Standard deviations of a singular value of noise."""
    energy_block_samples: int = 4000
    """Samples evaluated at a time: 4000 x 8 joints x 122 columns is 31 MB."""
    variance_tolerance: float = 1e-6
    """Relative change of the variances of windows at which their iteration ends."""
    rounding_share: float = 1e-9
    """Share of a size below which a number is rounding."""
    significance_level: float = 0.05
    """Of the F-test for essential parameters (Gautier and Khalil 1991)."""
    max_reduced_error: float = 1.05
    """Fit error of a joint in the reduced model over that in the full one; docs/studies."""
    keep_all_percent: float = 1e300
    """Percent of sigma below which no parameter leaves."""
    equivalent_fault_ratio: float = 1.3
    """Error of another fault over the least, up to which it explains the logs as well."""
    min_error: float = 0.001
    """Relative error below which all are alike."""
    suspicious_error: float = 0.1
    """Relative error of a joint from which on its channels may be wrong."""
    wrong_channel_error: float = 0.5
    """Relative error of a joint that no physics explains."""
    min_evidence: float = math.log(3.0)
    """Fall of the sum of log errors by a fault whose value is fitted; missing physics reaches 1."""
    min_evidence_without_value: float = math.log(1.5)
    """The same by another clock or zero, with no value to fit; measured logs reach 0.21."""
    min_shared_evidence: float = math.log(1.2)
    """The same by the joints but the one that gains most, of another clock; tests/api."""
    max_delay_ratio: float = 0.75
    """Error of a joint, predicted, with a delay undone over that without, up to 20 ms; beyond, as
    many times less; half of the fall in all blocks but one; no measured joint has it."""
    min_torque_factor: float = 1.4
    """Factor of a torque from which on its scale is wrong; gains are not known better."""
    unit_factor: float = 5.0
    """Factor of a torque that is a matter of units, not of a drive gain or a load."""
    max_unit_factor: float = 1e9
    """Units are no farther apart."""
    min_exchanged_rows: int = 20
    """Rows of a joint whose torque may be exchanged."""
    min_rows_each: int = 3
    """Rows for every parameter: a fit of fewer describes anything."""
    fault_reweightings: int = 4
    """Rounds of weights; they gain a digit each time."""
    max_sign_joints: int = 8
    """Joints up to which every subset of signs is tried."""
    max_sign_subsets: int = 8
    """Subsets of signs that are projected onto physical parameters."""
    max_delay: float = 0.15
    """s, the largest delay that is searched: beyond it, channels are wrong in another way."""
    typical_delay: float = 0.02
    """s; a longer delay is rarer, and must explain more."""
    delay_difference: float = 0.01
    """s between the motions of which a slope is taken."""
    delay_steps: int = 4
    """Gauss-Newton steps by which the delay of a channel is refined."""
    min_shift_hint: float = 0.2
    """Fall of the sum of log errors that a shift of the fitted torques promises at least."""
    detectable_error_ratio: float = 4.0 / 3.0
    """Times the error of a joint that a fault makes of it before it is detectable."""
    reported_size_share: float = 0.1
    """Share of the largest size of a fault below which nobody asks for it; no study."""
    min_tilt: float = 0.3
    """rad between two directions of gravity: a tilted base has less."""
    min_gravity_change: float = 0.05
    """Share of the stated gravity: a smaller difference is none."""
    gravity_step: float = 1e-5
    """rad or m of numerical differences."""
    gravity_scans: int = 5
    """Scans of the factor of gravity, to 0.002."""
    equal_log_error: float = 0.5
    """Sum of log errors within which rounder values are preferred."""
    gravity_starts: int = 3
    """Axes from which a direction of gravity is searched."""
    gravity_steps: int = 6
    """Most Gauss-Newton steps by which the direction of gravity is refined."""
    max_gravity_columns: int = 150
    """Standard parameters; of larger robots only a factor is searched."""
    band_sigmas: float = 4.0
    """Standard deviations by which the widest cut-offs and the chosen ones may disagree."""
    folds: int = 8
    """Folds into which blocks of time are dealt for the cross-validated error."""
    min_singular_share: float = 1e-8
    """Share of the largest singular value, columns scaled: less is no direction."""
    max_reweightings: int = 200
    """Iterations of weights of instruments, and of robust weights."""
    min_instrument_cosine: float = 1e-6
    """Cosine between instruments and columns at which a parameter is lost."""
    weak_instrument_cosine: float = 0.3
    """The same below which instruments are weak; docs/studies."""
    max_simulations: int = 12
    """Of an estimator by the direct model."""
    max_misfit_ratio: float = 1.5
    """Error along the logged motion over that of the weighted fit."""
    settled_sigmas: float = 0.1
    """Step in standard deviations after which no simulation follows."""
    known_sigmas: float = 4.0
    """Standard deviations between a known quantity and the data."""
    min_known_share: float = 0.01
    """Share of a known quantity: a load is weighed to this."""
    max_weight_iterations: int = 500
    """Iterations by which the weights of the joints must converge; else a warning is given."""
    max_passes: int = 3
    """Over long logs: a pass may show what the windows did not."""
    sigma_tolerance: float = 1e-6
    """Relative: a sigma is the root of a variance saved with all digits."""
    symmetry_tolerance: float = 1e-9
    """Difference of a saved correlation from that with rows and columns exchanged, above which the
    covariance is refused as not symmetric."""
    min_eigenvalue: float = -1e-6
    """Of saved correlations: rounding of singular ones."""
    max_interval_ratio: float = 2.0
    """Ratio of the sides of an interval that a standard deviation still describes."""
    column_tolerance: float = 1e-8
    """Share of the length of a column that counts as zero."""
    fixed_sigma_share: float = 1e-5
    """Standard deviation of a fixed parameter over that which the data alone give."""
    chance_probability: float = 1e-3
    """Probability of a false alarm, of a prior or of physical consistency."""
    max_prior_share: float = 0.5
    """Standard deviation over that of the prior on the torque, from which on logs say nothing."""
    max_prior_error: float = 0.1
    """Share of a joint's fit error that a prior may add."""
    known_below_percent: float = 10.0
    """Percent of sigma below which a parameter counts as known."""
    max_bias_sigmas: float = 0.5
    """Standard deviations of a bias by integration."""
    different_sigma_ratio: float = 1.2
    """Ratio of two uncertainties that is a difference."""
    prior_widths: int = 601
    """Widths of the ridge's prior that are tried."""
    width_log_probability: float = 2.0
    """Log-probability from the best width, as of the 95 % interval."""
    robust_tolerance: float = 1e-8
    """Step in standard deviations of the parameters at which the iteration ends."""
    max_rejected_share: float = 0.05
    """Share of a joint's rows with less than half a weight; Gaussian noise has 1.7 %."""
    standstill_share: float = 0.02
    """Share of the top speed of the fastest joint of a unit below which a joint stands."""
    top_speed_quantile: float = 0.98
    """Quantile of the absolute speeds of a joint that is taken as its top speed."""
    sampled_points: int = 60
    """At which a torque is compared with known functions."""
    sampled_range: float = 1.5
    """rad or m, to both sides."""
    min_rows_per_column: int = 3
    """Rows for every column below which step 1 of the two-step method identifies no joint."""
    whole_weight: float = 1.0 - 1e-9
    """Share of the weights of a row inside a piece."""
    max_correlation: float = 1.0 - 1e-6
    """Of the noise of torques, so that it has an inverse."""
    min_seen_share: float = 0.9
    """Share of a joint's rows at which the torque of another must count."""
    poses_per_column: int = 4
    """At which the largest possible rank is computed."""
    max_time_step: float = 0.2
    """s; slower, neither accelerations nor reversals are seen."""
    max_pendulum_ratio: float = 100.0
    """Length of a joint's pendulum over the reach of the robot."""
    max_density: float = 3000.0
    """kg/m^3, mass of the links over the cube of the reach; robots have 5 to 500."""
    min_gravity_share: float = 0.1
    """Gravity over torque of a joint, from which on it is a pendulum."""
    pendulum_poses: int = 40
    """At which gravity and inertia are evaluated."""
    reported_error_ratio: float = 1.1
    """Fit error of the nearest consistent parameters over that of the fit, from which on it is
    reported."""
    good_error: float = 0.15
    """Cross-validated error of a joint that is good; docs/explanation/processing.md."""
    max_sample_error: float = 0.1
    """Error on all samples, also at low speed, of a joint that is good; the same page."""
    max_block_error: float = 0.3
    """Cross-validated error of a joint that is good in a fifth of the time."""
    max_cross_validated_error: float = 0.5
    """Cross-validated error above which a joint is not determined."""
    filter_correlation: float = 0.2
    """Lag-1 autocorrelation that the filter of the rows makes."""
    time_blocks: int = 5
    """In which errors are compared."""
    max_thinned_rows: int = 400
    """Rows on which faults are judged: enough for any fit."""
    max_thinned_cells: int = 8000
    """Joints times rows: many joints make many pairs to exchange."""
    filter_taps: int = 16
    """Samples of each thinned row."""
    windup_position_step: float = 1e-5
    """rad or m, of central differences of the links' torque."""
    windup_newmark_beta: float = 1.0 / 12.0
    """Newmark's beta: of fourth order, stable up to a resonance of 0.39 of the sampling rate."""
    windup_newton_steps: int = 8
    """Steps of Newton's method along a motion; two or three are needed."""
    windup_tolerance: float = 1e-4
    """Largest relative change of a windup at its last step."""
    windup_starts: tuple[float, ...] = (6.0, 12.0, 24.0)
    """Hz of the resonances from which stiffness and damping are sought: 32 machines of 5 to 40
    Hz."""
    windup_frequencies: tuple[float, float] = (1.0, 90.0)
    """Hz of resonances that a fit may reach. Wider than what is named."""
    windup_dampings: tuple[float, float] = (0.003, 1.0)
    """Damping ratios that a fit may reach. Wider than what is named."""
    max_windup_rate: float = 0.3
    """Resonance over the sampling rate that a fit may reach; Newmark's method is stable to 0.39."""
    max_windup: float = 1e6
    """rad or m, rad/s, rad/s2; beyond it an integration is of no use."""
    windup_damping: float = 0.1
    """Damping ratio from which it is sought. No study."""
    windup_band: float = 30.0
    """Hz of the parallel filter in which stiffness and damping are fitted, as that of a
    diagnosis."""
    windup_sampling: float = 0.004
    """s between samples from which columns are made, at least."""
    windup_block: float = 0.5
    """s of a block of time, beyond which residuals are independent."""
    start_damping_factor: float = 6.0
    """Damping of a second start over that of the file: two elastic joints were found from 0.4 to
    1.4 of their stiffness, without it from 0.6 to 1."""
    first_windup_turns: int = 3
    """Steps of Gauss-Newton of each start. No study."""
    max_windup_turns: int = 8
    """Steps of Gauss-Newton of the best start: 5 to 8 turns are needed."""
    max_windup_step: float = 0.7
    """Largest change of the logarithms of stiffness and damping in one step. No study."""
    windup_precision: float = 1e-3
    """Change of these at which a fit ends."""
    windup_rank_share: float = 1e-9
    """Singular value over the largest, of columns of length one, below which nothing is seen."""
    thinned_block_rows: int = 32
    """Thinned rows evaluated at a time: the columns of their samples stay in the cache."""


THRESHOLDS = Thresholds()
