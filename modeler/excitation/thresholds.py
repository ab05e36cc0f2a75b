"""Numbers that decide in the design of a motion."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide; a docstring below each gives unit and reason."""

    max_contact_share: float = 0.95
    """Share of random postures; links that are too near in more are so by their shapes. No
    study."""
    contact_postures: int = 500
    """Random postures within the limits at which links that are too near by their shapes are
    found."""
    clearance_samples: int = 1500
    """Samples of a motion between which intervals are halved."""
    clearance_tolerance: float = 2e-3
    """Of the median radius, to which the least distance is found."""
    max_halvings: int = 20
    """Most rounds in which intervals of time are halved to find the least distance of links."""
    max_clearance_samples: int = 200_000
    """Samples above which no more intervals are halved. Bounds the time."""
    rest_speed: float = 1e-7
    """Of the top speed: dry friction alone remains of what speeds cause."""
    difference_step: float = 1e-5
    """Of half ranges and of top speeds, in difference quotients."""
    jump_states: int = 3
    """Random postures that show the jumps at rest."""
    jump_tolerance: float = 1e-6
    """SI; smaller jumps are rounding."""
    norm_power: int = 8
    """Power of the norm that stands for the largest singular value: log(c) / 4 from the maximum."""
    rank_tolerance: float = 1e-13
    """Ratio of singular values. Rounding."""
    samples_per_wave: int = 32
    """Samples per period of the highest harmonic."""
    markov_bound: float = 100.0
    """h^2 / 8 max|p''| of a quintic on a span of m samples is at most this / m^2 of max|p|
    (Markov)."""
    usual_excess: float = 0.01
    """Excess between samples met in a search; the last check takes enough samples for the bound. No
    study."""
    derivative_window: float = 0.02
    """s; over shorter ones the last digits of a file decide."""
    limit_tolerance: float = 1e-3
    """Share of a limit: what a search on samples leaves between them."""
    max_file_digits: int = 9
    """Digits after the point of a rounded file."""
    max_coupling_ratio: float = 2.0
    """Speed of passive joints per motor speed, over that at home. No study."""
    posture_step: float = 1e-5
    """Of the half ranges, in difference quotients."""
    max_listed_parameters: int = 12
    """Parameters of a gain that are listed."""
    sample_digits: int = 13
    """Digits after the point: rest is 0, not its rounding."""
    picture_samples: int = 800
    """Samples of a motion in its picture."""
    random_motions: int = 50
    """Random motions that the result is compared with; the best are improved."""
    stages: tuple[tuple[float, float, int], ...] = (
        (0.1, 0.1, 80),
        (0.01, 0.03, 120),
        (0.001, 0.01, 300),
    )
    """Height of the barrier, softness of dry friction, steps at most. No study."""
    criterion_tolerance: float = 5e-4
    """Least fall of the criterion in ten steps; a search that gains less ends."""
    samples_per_wave_in_loops: int = 16
    """Samples per period of the highest harmonic where loops are closed for each."""
    check_refinement: int = 10
    """Times as many samples in the last check."""
    checked_share: float = 0.999
    """Of the limits, at these samples."""
    clearance_shrinkage: float = 0.995
    """Of the size, as often as links come too near."""
    max_retreats: int = 20
    """Steps of a tenth towards rest where smooth dry friction exceeds a limit of torque."""
    random_share: float = 0.95
    """Share of the limits that a random motion uses."""
    discrimination_generations: int = 150
    """Generations of evolution. Bounds the time; no study."""
    first_step: float = 0.15
    """Of the half ranges: size of the first steps of evolution."""
    grid_entries: int = 5
    """Nonlinear parameters of an effect that are tried, spread over its grid."""
    rounding_share: float = 1e-14
    """Share of a column up to which what is left of it is rounding."""
    max_subsets: int = 20_000
    """Subsets that are compared one by one; of more, the best is built up and exchanged."""
    rest_postures: int = 200
    """Random postures among which one to rest in is looked for where the middle exceeds a limit."""
    rest_generations: int = 40
    """Generations of evolution from the best of them."""
    max_rest_offset: float = 0.9
    """Of the half ranges: distance of a rest posture from their middle."""
    size_halvings: int = 5
    """Bisections by which a motion is enlarged after it was halved until it kept the limits."""


THRESHOLDS = Thresholds()
