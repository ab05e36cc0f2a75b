"""The numbers that decide in `modeler.views`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, tolerances and counts of the package."""

    max_bins: int = 40
    """Bins at most along the axis of a picture of the evidence for an effect."""
    min_bin_rows: int = 8
    """Rows below which a bin is joined with the next; no study."""
    min_bin_blocks: int = 4
    """Blocks of time in a bin: fewer give no standard error."""
    min_wild_deviations: float = 8.0
    """Robust standard deviations from which a row is wild; no study."""
    max_wild_blocks: float = 0.05
    """Share of the blocks that may hold wild rows: what recurs everywhere is no outlier."""
    tail_share: float = 0.005
    """Share of the rows, and of the squared effect, beyond either end of the x axis."""
    min_shown_rows: float = 0.25
    """Share of the rows that are shown around a narrow effect."""
    cut_interval_share: float = 0.05
    """Share of the intervals' ends beyond either end of the y axis."""
    axis_padding: float = 0.08
    """Padding of an axis on either side, of its range."""
    max_dots: int = 1500
    """Dots at which a cloud of rows is thinned."""
    torque_margin: float = 1.5
    """Seconds on either side of the worst window that are drawn."""
    reversal_margin: float = 0.5
    """Seconds around a change of sign that are drawn."""
    push_margin: float = 3.0
    """Seconds around a push that are drawn."""
    min_webgl_points: int = 5000
    """Points from which the graphics processor draws them; the thinned ones of a page are fewer."""
    max_bars: int = 40
    """Parameters that a chart of standard deviations shows."""
    min_correlation: float = 0.95
    """Correlation of two estimates from which the pair is reported; no study."""
    max_pairs: int = 12
    """Pairs of strongly correlated estimates that are reported."""
    max_findings: int = 12
    """Findings of a fleet that get a section with a picture."""
    max_map_machines: int = 24
    """Machines that one map of a fleet shows; more get further maps."""
    darkest_sigmas: float = 10.0
    """Sigmas at which cells are darkest."""
    full_bar_percent: float = 30.0
    """Percent of the value at which the bar of a sigma is full."""
    noise_line_decades: float = 3.0
    """Decades of a line of noise on either side of its crossing."""
    noise_level_factor: float = 10.0
    """Factor over a floor or level that is drawn beyond it."""
    max_curve_points: int = 600
    """Points of one curve of a log."""
    sampling_rows: int = 60
    """Rows of a channel that are drawn one by one."""
    sampling_panels: int = 3
    """Of such rows beside each other."""
    same_place_points: float = 4.0
    """Points of the paper: closer names are written together."""
    min_view_gain: float = 1.02
    """Factor by which a later azimuth must be better."""
    max_flatness: float = 0.0001
    """Share of the robot's size: thinner mechanisms are planar."""
    max_loop_residual: float = 1e-09
    """Residual of a closed loop, of the robot's size and of direction cosines."""
    newton_tolerance: float = 1e-13
    """Residual at which Newton's method ends: rounding."""
    newton_iterations: int = 100
    """Newton steps by which the loops of a drawn robot must be closed; no study."""
    max_newton_step: float = 0.3
    """Longest Newton step, rad or robot sizes; no study."""
    min_closure_pivot: float = 1e-09
    """Singular value over the largest below which a step ignores a direction."""
    min_loose_value: float = 1e-06
    """Singular value over the largest below which a joint is loose: a residual of 1e-13 leaves its
    square root."""
    complex_step: float = 1e-30
    """Imaginary step of the complex-step derivatives of the loop residuals."""


THRESHOLDS = Thresholds()
