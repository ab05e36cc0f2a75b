"""The numbers that decide in `modeler.derivation`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, tolerances, counts and seeds of the package."""

    assembly_starts: int = 300
    """Random postures from which assembly modes are searched; no study."""
    start_seed: int = 1955
    """Seed of the random postures from which assembly modes are searched."""
    newton_iterations: int = 60
    """Newton steps until a start is given up; no study."""
    max_search_step: float = 0.5
    """Longest step of a joint in a search, rad or robot sizes; no study."""
    min_damping: float = 1e-13
    """Lower bound of the Levenberg-Marquardt damping, which is the squared residual of the loops;
    no study."""
    max_damping: float = 1e-2
    """Upper bound of the same damping; no study."""
    rough_residual: float = 1e-7
    """Residual in robot sizes from which Newton's method ends a search; no study."""
    travel_reach: float = 2.0
    """Range of a travel without [limits], robot sizes; no study."""
    uncoupled_column: float = 1e-8
    """Jacobian column in robot sizes that counts as zero: rounding."""
    hint_spreads: tuple[float, ...] = (0.05, 0.2, 0.6)
    """Standard deviations of starts around hints, rad or robot sizes; no study."""
    same_shape: float = 1e-6
    """Difference of frame positions in robot sizes up to which two shapes are one:
    rounding."""
    copy_residual: float = 1e-9
    """Residual in robot sizes of a symmetric copy: rounding."""
    speeds_per_joint: int = 2
    """Sampled speeds per joint, so that half of the postures are enough."""
    min_ratio_postures: int = 8
    """Fewest postures at which constant ratios are counted; no study."""
    ratio_seed: int = 1784
    """Seed of the steps to the postures at which constant ratios are counted."""
    ratio_step: float = 0.02
    """Motion of the actuated joints between them, rad or robot sizes; no study."""
    ratio_rank: float = 1e-7
    """Relative singular value that counts as zero in the count of ratios: rounding."""
    min_singularity_share: float = 0.2
    """Share of the best singularity distance that a start posture must have; no study."""
    limit_rounding: float = 1e-9
    """Excess over [limits] that is rounding, rad or robot sizes."""
    rank_key_digits: int = 5
    """Decimals by which postures are ranked, so that rounding never ranks them."""
    rounding_steps: tuple[float, ...] = (0.1, 0.01, 1e-3, 1e-4, 1e-6, 1e-9)
    """Steps in rad or powers of ten of the robot size to which actuated joints are rounded."""
    counted_postures: int = 24
    """Postures for which ratios are counted, because each count is slow; no study."""
    proof_seed: int = 20030914
    """Seed of all random states of a proof."""
    max_torque_difference: float = 1e-9
    """Relative difference of base and standard torque that is rounding."""
    proof_checks: int = 3
    """Random geometries at which relations are checked; one fails with probability degree /
    prime."""
    min_singular_value: float = 1e-4
    """Singularity distance that counts as singular: the square root of the closed residual
    1e-9."""
    closed_residual: float = 1e-12
    """Residual of a closed loop, robot sizes: rounding."""
    zero_row: float = 1e-9
    """Length of a Jacobian row over the longest that counts as zero: rounding."""
    posture_steps: int = 12
    """Steps, each with the loops closed, in which a random nearby posture is reached; no study."""
    restart_seed: int = 7
    """Seed of restarts with other passive angles."""
    restarts: int = 200
    """Restarts where the first closed posture has opposite axes; no study."""
    row_scale_seed: int = 1876
    """Seed of the postures that scale Jacobian rows."""
    row_scale_samples: int = 32
    """Postures of which the median row length is taken; no study."""
    posture_decimals: int = 6
    """Decimals of rad and m in which two closed postures differ."""
    polish_step: float = 1e-25
    """Last Newton step of [home], robot sizes or rad: far below the digits of a double."""
    polish_iterations: int = 20
    """Newton steps until [home] counts as singular; no study."""
    mobility_rank: float = 1e-9
    """Singular value of a scaled Jacobian that counts as zero at generic postures:
    rounding."""
    pivot_tie: float = 1e-6
    """Relative difference of row lengths below which the first row is the pivot: rounding."""
    mobility_postures: int = 12
    """Postures at which the degrees of freedom are counted; no study."""
    mobility_seed: int = 20120
    """Seed of the postures at which the degrees of freedom are counted."""
    min_motion_share: float = 0.1
    """Share of the largest joint motion from which a message lists the joint."""
    max_home_move: float = 0.5
    """Motion of a joint up to which [home] stays as stated, rad or robot sizes; no study."""
    listed_moves: int = 6
    """Joints that a message lists."""
    stated_shape: float = 1e-3
    """Difference of frame positions in robot sizes up to which a mode is the stated one; no
    study."""
    enclosure_iterations: int = 40
    """Newton steps until a posture is not enclosed; no study."""
    max_enclosure_shift: float = 1e-6
    """Distance of a passive joint from where it was stated, rad or m; no study."""
    ball_bits: tuple[int, ...] = (128, 256, 512)
    """Precisions of ball arithmetic that are tried, bits."""
    enclosed_decimals: int = 6
    """Decimals of rad or m of the postures in a proof."""
    spare_states: int = 4
    """States beyond those that the rank needs; no study."""
    speed_eighths: int = 16
    """Largest speed and acceleration of a proof, eighths of rad or m."""
    exhaustive_angles: int = 4
    """Angles up to which all choices of sine or cosine are tried: 2**4 forms."""
    max_coefficient_terms: int = 400
    """Terms of a coefficient beyond which nobody reads it."""
    max_pi_denominator: int = 12
    """Denominator q up to which p pi / q is a multiple of pi / q."""
    max_angle_terms: int = 4
    """Angles in a sum that is expanded: its cosine has 2**(angles - 1) terms."""
    quoted_letters: int = 60
    """Letters of a robot file that a message quotes."""
    right_angle: float = 1e-9
    """Difference from a right angle that is rounding, rad and quarters."""
    max_constant_terms: int = 1000
    """Terms of a constant written out as a sum of products; no study."""
    max_constant_depth: int = 60
    """Operations inside each other above which a constant is refused as too long; no study."""
    max_number_bits: int = 10_000
    """Bits of an exact number above which a power is refused as too long; no study."""
    max_angle_multiple: int = 64
    """Multiple of an angle whose sine is composed of that of the angle."""
    cached_plans: int = 16
    """Evaluation plans that a graph keeps; no study."""
    constant_tolerance: float = 1e-9
    """Difference of a constant from its symbols that is rounding, rad or m."""
    perturbation: float = 1e-4
    """Change of a symbol, m or rad, by which its share in a constant is found; no study."""
    max_perturbed_move: float = 0.1
    """Motion of a joint after that change, rad or robot sizes; no study."""
    perturbed_iterations: int = 5
    """Newton steps after that change: quadratic from 1e-4."""
    slope_tolerance: float = 1e-6
    """Error of a share that is the curvature of the change."""
    max_constant_denominator: int = 4
    """Largest denominator of the fraction of a symbol that is looked for in a constant; no
    study."""
    constant_decimals: int = 10
    """Decimals, of rad or m, to which a constant is looked for as a decimal number."""
    decimal_tolerance: float = 1e-13
    """Difference from such a decimal: [home] has the digits of a double."""
    max_pi_twelfths: int = 24
    """Multiples of pi / 12 in a constant: one turn."""
    implied_seed: int = 47
    """Seed of the postures and lengths of a proof of relations."""
    spare_rows: int = 3
    """Rows beyond the rank that a proof compares; no study."""
    proof_digits: int = 25
    """Digits of 40 to which a rank of that proof is computed."""
    max_proof_tries: int = 64
    """Sets of relations that are tried; no study."""
    symbol_change: float = 0.1
    """Relative change of lengths and angles where a relation shall hold in letters."""
    relation_postures: int = 16
    """Postures at which relations are looked for; no study."""
    relation_seed: int = 31
    """Seed of the postures at which relations are looked for."""
    relation_rank: float = 1e-9
    """Relative singular value, and error of a ratio, that is rounding."""
    max_ratio_denominator: int = 24
    """Largest denominator of a ratio of joint speeds that is looked for as a fraction; no study."""
    relation_residual: float = 1e-7
    """Deviation from a relation over all postures, rad or m: rounding."""
    distinct_points: int = 4
    """Random points at which two products are compared modulo the prime."""
    max_loop_functions: int = 800
    """Functions among which relations around loops are looked for: more take minutes."""
    rank_tolerance: float = 1e-9
    """Relative singular value of the scaled regressor that counts as zero without loops."""
    zero_column: float = 1e-13
    """Length of a column over the longest that is rounding of a zero column."""
    rounding_margin: float = 10.0
    """Multiple of the measured rounding that a singular value must exceed with loops."""
    min_distance_share: float = 0.3
    """Share of home's singularity distance that states keep: rounding grows by 1 / 0.3**2 at
    most."""
    double_digits: int = 17
    """Digits that print a double exactly."""
    zero_factor: float = 1e-9
    """Factor that counts as zero, and difference from a whole number that is rounding."""
    max_letter_degree: int = 12
    """Degree in one letter above which a coefficient is not interpolated; no study."""
    max_quotient_terms: int = 160
    """Terms of a coefficient that is interpolated; no study."""
    interpolation_checks: int = 2
    """Fresh points at which a coefficient is checked, modulo 2**127 - 1."""
    spare_points: int = 6
    """Points beyond the functions whose dependence is decided."""
    extra_points: int = 3
    """Points beyond the unknown coefficients, which check them."""
    walkers: int = 32
    """Fewest random walks along the loops from home at the same time; no study."""
    walk_steps: int = 40
    """Steps of each of these random walks; no study."""
    max_walk_step: float = 0.25
    """Longest step of a joint, rad or robot sizes; no study."""
    moving_share: float = 0.3
    """Share of the actuated joints that a walker moves at a time, besides one of them; no
    study."""
    max_open_residual: float = 0.02
    """Residual in robot sizes at which a step was too long; no study."""
    min_pace: float = 1 / 64
    """Pace below which a walker starts again at home; no study."""
    closing_steps: int = 4
    """Newton steps that close a reached posture; no study."""
    min_walk_distance: float = 1e-3
    """Singularity distance below which a posture is left out: rounding of accelerations grows
    with its inverse square."""


THRESHOLDS = Thresholds()
