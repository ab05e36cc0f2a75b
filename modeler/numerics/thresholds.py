"""The numbers that decide in `modeler.numerics`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, tolerances and counts of the package."""

    rows_per_cutoff_period: float = 2.5
    """Rows per period of the cut-off: neighbours then correlate by 0.1."""
    kernel_reach: float = 3.0
    """Standard deviations of the Gaussian kernel on either side of a row; beyond, weights are
    below 1.2 %."""
    clock_rounding: float = 1.0 + 1e-06
    """Factor of a step that the rounding of a clock from 1970 can make."""
    min_kernel_samples: float = 0.02
    """Samples: narrower kernels have a weight of one in double precision."""
    min_pivot: float = 1e-08
    """Share of the first pivot below which a column is dependent, columns scaled to length one:
    structural dependencies come out near 1e-15, weakly excited parameters of real logs above
    1e-4."""
    min_column_norm: float = 1e-12
    """Share of the longest column below which a column counts as zero: rounding."""
    min_named_share: float = 0.001
    """Share of a dependent column that another must carry to be named; no study."""
    normal_equation_ridge: float = 1e-11
    """Ridge of normal equations with columns of length one."""
    min_joint_eigenvalue: float = 1e-11
    """Eigenvalue of the Gram matrix over the largest below which columns are dependent: rounding
    of squares."""
    weight_rounding: float = 1e-06
    """Share of all weight that is rounding: a median must not depend on it."""
    armijo_share: float = 0.0001
    """Share of the promised descent that a step must bring (Armijo)."""
    min_step_share: float = 1e-06
    """Shortest step of a line search, of the full one; no study."""
    max_boundary_share: float = 0.95
    """Share of the way to the boundary that a step may take; no study."""
    stall_steps: int = 10
    """Steps that together must bring the tolerance; no study."""
    min_outlier_steps: float = 5.0
    """Steps of the lattice that an outlier exceeds; no study."""
    spread_quantiles: tuple[float, float] = (0.01, 0.99)
    """Quantiles between which the spread of a channel lies: a fault is no part of it."""
    top_step_quantile: float = 0.98
    """Quantile of the changes from row to row that is the top one: no short transient."""
    max_outliers_nearby: int = 3
    """Outliers that a neighbourhood may hold; with more it is rough motion."""
    unjudged_ends: int = 10
    """Samples at both ends of a segment that are not judged: the filter's start-up."""
    median_half_width: int = 5
    """Samples on either side of a running median: a few wrong ones do not move it."""
    min_correlation_time: float = 0.2
    """Seconds after which unfiltered torque noise and quantisation are uncorrelated."""
    correlation_periods: float = 2.0
    """Periods of the cut-off after which filtered noise is uncorrelated."""
    min_even_energy: float = 0.3
    """Median block energy over the mean from which noise is stationary: joints without hidden
    effects have 0.4 to 1."""
    min_t_ratio: float = 2.0
    """Standard errors beyond which a share is significant."""
    min_burst_rows: int = 100
    """Rows below which bursts are not judged; no study."""
    min_log_rows: int = 20
    """Rows of a log below which recurrence is not judged; no study."""
    recurrence_parts: int = 40
    """Parts of the rows from which the standard error of a recurring share comes; no study."""
    max_lattice_deviation: float = 0.04
    """Share of a step by which 90 % of the differences may miss whole multiples; no study."""
    min_lattice_gaps: int = 8
    """Differences that show a lattice; no study."""
    max_new_levels: float = 0.9
    """Share of new levels, or of differences of one step, below which values lie on a lattice; no
    study."""
    max_lattice_steps: float = 10.0
    """Steps above which the rounding of a difference says less; no study."""
    min_repeated_rows: float = 0.04
    """Share of repeated rows from which a recorder is faster than the robot: an arm at 30 Hz had a
    stale row in 50, and left out they raised the error of its fit by 16 %."""
    min_joint_repeats: float = 0.5
    """Share of repeated positions in which all other channels repeat too; no study."""
    min_new_values: float = 0.8
    """Share of the other rows in which some channel changes; else each is held by itself; no
    study."""
    min_frozen_length: float = 4.0
    """Factor over the other runs of equal values that a frozen channel lasts; no study."""
    min_channel_samples: int = 20
    """Samples below which a channel is not judged, or a run is not frozen; no study."""
    min_motion_deviations: float = 15.0
    """Noise standard deviations that motion exceeds over a few rows; no study."""
    ignored_long_runs: int = 3
    """Long runs of equal values that may be faults."""
    min_hold_runs: int = 8
    """Runs of equal values between coarse changes that show a hold; no study."""
    max_short_runs: float = 0.15
    """Share of shorter runs: encoder counts change at any row; no study."""
    min_end_speed: float = 0.75
    """Speed over the last rows before a clip over the speed before: a joint that reverses slows
    down."""
    min_single_stay: int = 20
    """Rows of one stay that shows a clip by itself; else two stays are needed; no study."""
    max_welch_samples: int = 1024
    """Samples of one Welch window at most; it is a quarter of the longest segment."""
    max_lag: float = 2.0
    """Seconds, longest lag of the autocorrelation."""
    uncorrelated_below: float = 0.2
    """Autocorrelation below which samples count as uncorrelated."""
    min_waves: float = 3.0
    """Waves in the stroke below which gravity and springs look alike."""
    max_order: float = 1200.0
    """Waves per unit of position, highest order of a spectrum."""
    cells_per_wave: int = 4
    """Cells per wave of the highest order."""
    min_peak_power: float = 12.0
    """Power of a peak over the median around it; no study."""
    max_peaks: int = 3
    """Peaks reported per joint."""
    min_order_samples: int = 100
    """Samples below which no order spectrum is made; no study."""
    min_repeat_correlation: float = 0.98
    """Correlation of the motion with itself one period later from which it repeats."""
    min_lap_seconds: float = 2.0
    """Seconds of the shortest lap; no study."""
    min_pause_steps: int = 10
    """Steps per row of the whole time from which pauses fill a log; no study."""
    noise_exceedance: float = 5.0
    """White noise exceeds ln(n) + this many means at none of n frequencies in 99 of 100
    spectra."""
    band_window: float = 4.0
    """Seconds of a window of a band spectrum."""
    bands_per_octave: int = 3
    """Bands per octave in which the power of a spectrum is averaged."""
    min_share_t_ratio: float = 2.0
    """Share over its standard error that is significant."""
    fold_count: int = 8
    """Folds of the cross-validation: parts of equal length into which each log is cut."""
    share_parts: int = 40
    """Parts of the rows from which the standard error of a share comes; no study."""
    sum_knots: int = 7
    """Knots of a curve within a sum over all joints; no study."""


THRESHOLDS = Thresholds()
