"""The numbers that decide in `modeler.api`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, counts and delays of the package."""

    export_states: int = 200
    """States at which exported torques are compared; no study."""
    export_seed: int = 1
    """Seed of the random states at which exported torques are compared."""
    export_amplitude: float = 0.05
    """rad or m of random motion around home for them; no study."""
    chunks_per_job: int = 2
    """Chunks of a long log that one job reduces: each job decodes whole pages."""
    jobs_per_merge: int = 16
    """Jobs that are merged by the workers before results travel; no study."""
    max_guess_error_share: float = 0.5
    """Share of the plain mapping's error that a guess by range may have; no study."""
    link_clearance: float = 0.01
    """m between links of a robot with [capsules]; a convention."""
    next_log_rate: float = 1000.0
    """Hz of the log for which Python forecasts what a motion adds; a convention."""
    max_rate: float = 1e5
    """Hz of a table of a motion; no study."""
    max_determined_sigma: float = 10.0
    """Percent of sigma below which a parameter counts as determined; papers: 10."""
    named_parameters: int = 3
    """Worst determined parameters that are named."""
    min_logs_for_processes: int = 32
    """Logs from which several processes are worth their start; no study."""
    curve_points: int = 1500
    """Points of a curve that is drawn on a screen."""
    coarse_rows: int = 64
    """Rows of a long log by one least and one largest value."""
    max_whole_values: int = 25_000_000
    """Values of a log that is held as it is: 200 MB."""
    explained_bins: int = 24
    """Bins of a channel over which a residual is averaged; no study."""
    explained_folds: int = 8
    """Consecutive parts of the time, each predicted by the others; no study."""


THRESHOLDS = Thresholds()
