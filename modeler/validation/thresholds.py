"""The numbers that decide in `modeler.validation`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, tolerances and counts of the package."""

    zero_speed_share: float = 0.05
    """Share of the joint's largest speed within which it is around zero; no study."""
    fast_share: float = 0.4
    """Share of the joint's largest speed from which motion is fast; no study."""
    max_opposite_factor: float = -0.5
    """Factor of the prediction below which its sign is wrong; no study."""
    min_scale_error: float = 0.1
    """Difference of the factor from one from which the scale is wrong; no study."""
    min_scale_reduction: float = 0.75
    """Share of the squared residual that a wrong scale explains; no study."""
    min_scale_samples: int = 20
    """Samples below which no scale is estimated; no study."""
    scale_blocks: int = 5
    """Blocks of time; the factor for each is estimated on the others."""
    max_rows: int = 400000
    """Rows of a comparison after decimation; longer logs are decimated further."""
    creep_speed: float = 1e-09
    """Speed on either side of standstill at which dry friction is evaluated, rad/s or m/s."""
    max_still_speed: float = 1e-12
    """Speed below which a shaft stands, rad/s or m/s."""
    min_inertia_eigenvalue: float = 1e-06
    """Eigenvalue of M with unit diagonal below which M is no inertia matrix; no study."""
    difference_step: float = 1e-05
    """Step of difference quotients, rad or m and rad/s or m/s."""
    max_friction_sweeps: int = 60
    """Sweeps of the relaxation over shafts that stick or slip; no study."""
    friction_tolerance: float = 1e-10
    """Share of the speed that dry friction takes in a step: convergence."""
    max_step: float = 0.002
    """Seconds of the longest integration step; no study."""
    max_stiffness: float = 0.4
    """Step times the fastest eigenvalue: stability of Adams and Bashforth of order 2."""
    max_inner_steps: int = 200
    """Integration steps between two samples; no study."""
    followed_windows: float = 5.0
    """Windows that a start is followed for the horizon; no study."""
    max_windows: int = 100
    """Windows that are simulated; of more, as many evenly spread over the logs; no study."""
    max_whole_seconds: float = 60.0
    """Seconds of a log that are simulated from its start; no study."""
    max_distance_ranges: float = 10.0
    """Ranges of motion from the log at which a robot is lost; no study."""
    linearisation_points: int = 2000
    """States at which the motion is linearised, over all logs; no study."""
    halved_windows: int = 5
    """Windows that are run again at half the step."""
    max_numerical_error: float = 0.01
    """Share of the range: a larger numerical error is reported."""
    max_p_value: float = 0.0027
    """Chance that equally good models are distinguished on one joint: three standard deviations."""
    max_blocks: int = 24
    """Blocks of time: residuals are uncorrelated between them."""
    min_block_seconds: float = 1.0
    """Seconds of the shortest block of time in which models are compared; no study."""
    min_blocks: int = 6
    """Blocks below which no model is significantly better."""
    min_error_change: float = 0.01
    """Relative change of an error that is reported; no study."""
    min_bin_samples: int = 8
    """Samples of a bin whose mean is drawn."""
    band_deviations: float = 2.0
    """Half width of a band in standard deviations: 95 % of normal errors."""
    min_reversal: float = 0.001
    """Share of the stroke below which a reversal is noise; no study."""
    min_samples: int = 200
    """Samples below which the structure of a residual is not judged; no study."""
    parsimony_share: float = 0.9
    """Share of the best prediction from which a simpler function is named instead; no study."""
    max_structure_samples: int = 3000
    """Samples beyond which the rows are decimated."""
    min_stroke: float = 0.01
    """Share of the largest stroke below which a joint is held."""
    max_stroke_difference: float = 0.05
    """Share of the largest stroke by which logs of the same motion may differ."""
    min_overlap: float = 0.75
    """Share of the shorter log that must overlap."""
    max_shift_rows: int = 400
    """Rows by which the starts of two logs may differ."""
    max_laps: int = 20
    """Laps that are compared with one another."""
    motion_points: int = 4000
    """Points of a log at which two motions are compared."""
    shift_grid: int = 20
    """Shifts on either side of the best one so far."""
    min_repeated_share: float = 0.5
    """Share of the rows that must have been repeated."""
    min_repeated_rows: int = 50
    """Rows that must have been repeated."""
    neighbour_rows: int = 6
    """Rows that may share their noise."""
    min_pattern_share: float = 0.05
    """Share of the residual variance below which a pattern is not mentioned; no study."""
    min_concentration: float = 3.0
    """Energy share over time share from which a window is mentioned; no study."""
    min_further_share: float = 0.1
    """Share beyond simpler functions from which a prediction is mentioned; no study."""
    max_noise_samples: float = 3.5
    """Samples of correlation time that filter and decimation leave."""
    max_noise_error: float = 0.2
    """Relative error above which noise is no explanation; no study."""
    max_burst_share: float = 0.5
    """Share of the squared residual in one window above which it is an event; no study."""
    min_line_share: float = 0.3
    """Share of the power in one narrow line that is an oscillation; no study."""


THRESHOLDS = Thresholds()
