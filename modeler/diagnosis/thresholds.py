"""Numbers that decide in a diagnosis."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide; a docstring below each gives unit and reason."""

    max_parameter_shift: float = 2.0
    """Standard deviations; a learned law that shifts a parameter by more changes what it means. No
    study."""
    max_listed_shifts: int = 8
    """Count of parameters whose shifts are listed. A page holds as many; no study."""
    max_predictive_error: float = 1.0
    """Relative held-out error; a model above it predicts no better than zero torque. By
    definition."""
    max_rechecked_alternatives: int = 8
    """Count of alternatives that are scored again on other data. Bounds the time; no study."""
    min_duration: float = 5.0
    """s of motion; with less nothing is ruled out. No study."""
    min_stroke: Mapping[str, float] = field(default_factory=lambda: {"rad": 1e-3, "m": 1e-4})
    """rad or m by unit; a joint that moves less is at rest. Above encoder noise; no study."""
    max_one_way_share: float = 0.98
    """Share of the moving rows in one direction above which friction and offset are not separable;
    no study."""
    max_single_speed_ratio: float = 1.3
    """Ratio of the 90 % and 10 % quantiles of the speed below which a joint has one speed. No
    study."""
    min_inertia_share: float = 0.01
    """Share of a joint's rms torque that inertia must cause. No study."""
    max_explained_residual_share: float = 0.25
    """Share of a joint's squared residual; with less of it left its torque scale is right. No
    study."""
    min_delay_share: float = 0.2
    """Share of the error variance that the delay of one position must explain. No study."""
    min_delay_lead: float = 1.5
    """Ratio of that share to the share of the best effect of the catalogue. No study."""
    min_delay_t_ratio: float = 4.5
    """Reduction over its standard error. As min_t_ratio."""
    min_burst_share: float = 0.85
    """Share of the residual energy in short bursts that indicates impacts. No study."""
    min_faint_burst_ratio: float = 4.0
    """Burst ratio that indicates backlash where its column is significant too. No study."""
    min_faint_burst_ratio_beside: float = 5.0
    """The same beside other effects, whose residuals may contain bursts. No study."""
    min_recurrence_ratio: float = 5.0
    """Held-out error over the training error without the event; above it the event recurs. No
    study."""
    floor_backlash_share: float = 1e-3
    """Share that stands for a backlash column which explains nothing. Avoids a product of zero."""
    max_weak_gain: float = 0.5
    """Variance reduction below which an effect is secondary to backlash. No study."""
    min_refit_variance_ratio: float = 1.3
    """Ratio of the residual variances with fixed and with refitted parameters; above it the robot
    has changed. No study."""
    progress_step: float = 0.04
    """Share of the rest of a stage that one step of work advances. For the display only."""
    min_cutoff_ratio: float = 1.3
    """Ratio of two cut-off frequencies that makes a second band informative. No study."""
    nats_per_symbol: float = 4.0
    """Nats of a symbol or of a free number: 1/2 ln n (Schwarz 1978)."""
    min_formula_difference: float = 0.003
    """Share of its torque by which a formula must differ from a better one. No study."""
    max_second_term_residual: float = 0.9**2
    """Ratio of the squared residuals with and without a second term: a tenth of the error. No
    study."""
    max_column_correlation: float = 0.995
    """Correlation of two residual columns above which the shorter stands for both. No study."""
    max_start_correlation: float = 0.97
    """The same for columns whose parameters are still refined. No study."""
    product_chunk: int = 16
    """Columns multiplied at a time. Memory."""
    column_chunk: int = 512
    """Columns evaluated at a time. Memory."""
    beam_width: int = 30
    """Products of two factors that get a third one. Bounds the time; no study."""
    max_hint_products: int = 4
    """Products that are scored before the search. Bounds the time; no study."""
    max_exact_columns: int = 40
    """Columns that are evaluated exactly. Bounds the time; no study."""
    max_refined_formulas: int = 12
    """Formulas whose parameters are refined. Bounds the time; no study."""
    max_first_terms: int = 4
    """Formulas that get a second term. Bounds the time; no study."""
    max_second_products: int = 1500
    """Products tried as a second term. Bounds the time; no study."""
    max_second_terms: int = 8
    """Second terms refined for each first one. Bounds the time; no study."""
    max_formula_evaluations: int = 20
    """Evaluations of the residual in one refinement. Bounds the time; no study."""
    max_varied_formulas: int = 3
    """Formulas whose neighbours are tried. Bounds the time; no study."""
    max_variation_rounds: int = 3
    """Rounds of neighbours. Bounds the time; no study."""
    max_refined_neighbours: int = 14
    """Neighbours refined in a round. Bounds the time; no study."""
    max_gain_factor: float = 10.0
    """Factor of a drive gain, either way; more is an error of units. No study."""
    max_gain_iterations: int = 60
    """Newton steps of the gain equations. Far above what was needed; no study."""
    gain_tolerance: float = 1e-8
    """Relative change of a gain at convergence."""
    max_gain_reweightings: int = 5
    """Solutions of the gain equations with joint weights from the residuals; no study."""
    min_gain_residual_share: float = 1e-6
    """Share of a joint's rms torque that bounds its residual from below. Rounding."""
    max_gain_change: float = 1e-3
    """Relative change of a gain at the last step with which a solution still counts. No study."""
    max_gain_step: float = 0.5
    """Relative change of a gain in one step. Keeps Newton's method stable; no study."""
    max_sought_gain: float = 1e3
    """Factor of a gain beyond which none is sought. No study."""
    gain_ridge: float = 1e-10
    """Relative to the diagonal of the equations. Rounding."""
    weight_tolerance: float = 0.01
    """Relative change of the weights at convergence. No study."""
    min_parameter_column: float = 1e-12
    """Largest entry of a column, SI; smaller ones have no effect on any joint. Rounding."""
    push_margin: float = 0.5
    """s before and after a push that are excluded with it. No study."""
    push_cell: float = 0.1
    """s; width of the cells of time in which a push is looked for; no study."""
    prediction_cell: float = 0.05
    """s of a push that are predicted from the cells around. No study."""
    prediction_reach: int = 4
    """Cells before and after that predict one. No study."""
    push_separation: float = 2.0
    """s between a push and what counts as elsewhere: its torque changes sign as the robot moves. No
    study."""
    min_push_ratio: float = 5.0
    """Energy over the largest elsewhere; up to 4.2 was seen without a push, 20 with one of half the
    noise."""
    min_adjoining_ratio: float = 2.0
    """Energy of an adjoining window over the largest elsewhere. No study."""
    max_push_gap: float = 0.15
    """s between windows of one push. No study."""
    settling_time: float = 2.0
    """s of a log in which inner states of friction and cables are unknown. No study."""
    min_turn_samples: int = 4
    """In which a joint at its rms acceleration passes the travel of a bristle. No study."""
    burst_duration: float = 0.1
    """s after a sign change of the load. No study."""
    min_burst_ratio: float = 11.0
    """Energy in bursts over that elsewhere; above it backlash is named. No study."""
    min_loud_burst_ratio: float = 30.0
    """The same where named columns remove the bursts. No study."""
    min_load_reversals: int = 5
    """Count of sign changes of the load below which no energy ratio of bursts is computed; no
    study."""
    max_formula_parameters: int = 4
    """Nonlinear parameters of one definition. The format allows as many."""
    unit_scale: float = 1.37
    """Factor that reveals the exponent of a unit. Any number that is no power."""
    exponent_digits: int = 6
    """Digits after the point to which the exponent of a unit is rounded. Rounding."""
    min_resonance_ratio: float = 3.0
    """Resonance over the bandwidth of the motion, below which a joint moves as one body. No
    study."""
    max_stiffness_spread: float = 0.25
    """Standard deviation of the logarithm of a stiffness with which it is named: 32 clean machines
    had more."""
    max_resonance_step: float = 0.15
    """Periods of a resonance between samples, above which a windup along them is not exact."""
    min_windup_share: float = 0.1
    """Share of the leading reduction with which a joint is tried as elastic. No study."""
    max_fitted_windups: int = 2
    """Joints tried as elastic in one state. Bounds the time."""
    min_variance_reduction: float = 0.03
    """Share of the held-out residual variance that an effect must explain. No study."""
    min_torque_share: float = 0.002
    """Rms reduction over the rms torque of its joints: filters distort as much. No study."""
    min_t_ratio: float = 4.5
    """Reduction over its standard error: random signs of the blocks reach it with one candidate in
    100 000."""
    equivalence_share: float = 0.3
    """Share of its reduction that may remain with an equivalent effect put in. No study."""
    parsimony_share: float = 0.95
    """Share of the best reduction with which a simpler effect is preferred. No study."""
    plain_friction_share: float = 0.5
    """Share of the reduction of a friction refinement with which plain friction precedes it. No
    study."""
    min_confirmed_share: float = 0.2
    """Share of the expected reduction that held-out motion must confirm; it may excite the effect
    less. No study."""
    min_affected_share: float = 0.1
    """Reduction of a joint's squared residual over the largest one, above which it is affected. No
    study."""
    min_law_t_ratio: float = 3.0
    """Reduction of the error over its standard error; the law is scored again. No study."""
    cells_per_wave: int = 8
    """Cells for each wave that stands out in the residual. No study."""
    fine_cells: int = 100
    """Cells of a position that is resolved finely. No study."""
    max_cells: int = 240
    """Cells of one axis. Bounds the time; no study."""
    few_cells: int = 5
    """Cells of the second axis beside a fine one. No study."""
    min_refinement_factor: float = 1.1
    """Factor of a travel or a time below which it is not refined. No study."""
    spline_ridge: float = 1e-4
    """Relative to the mean square of a spline. Rounding."""
    outlying_share: float = 1e-3
    """Share of the samples beyond either end of an axis. No study."""
    law_digits: int = 6
    """Significant digits of the values of a law."""
    max_refined_coordinates: int = 4
    """Coordinates whose law is refined. Bounds the time; no study."""
    baseline_damping: float = 0.1
    """Damping ratio of the oscillators, excited by the accelerations, in the baseline; no study."""
    min_friction_share: float = 0.035
    """Friction over torque, rms: the lowest of measured robots with gears has 0.11."""
    min_friction_residual_ratio: float = 2.0
    """Friction over residual, rms; friction as clear as this was measured. No study."""
    max_body_misfit: float = 0.3
    """Share of the rms of a body on a link that a physical body may miss. No study."""
    max_friction_part: float = 1.3
    """Ratio of a part of the friction to all of it, with its uncertainty. No study."""
    min_balance_share: float = 0.1
    """Share of a balancing torque that gravity does not imitate. No study."""
    min_gravity_share: float = 0.02
    """Gravity over torque, rms; below it a joint has no load to balance. No study."""
    max_equal_residual_ratio: float = 1.1
    """Ratio of two squared residuals of filters that data do not distinguish. No study."""
    chi2_95: float = 3.841458820694124
    """95 % quantile of chi-square with one degree of freedom."""
    max_rise: float = 9.0
    """Rise of the squares that excludes a parameter: three standard deviations."""
    max_cell_share: float = 0.03
    """Share of the likelihood that one cell may hold. No study."""
    max_line_points: int = 64
    """Points along one parameter. Bounds the time; no study."""
    grid_points: int = 7
    """Values of each of several parameters. Bounds the time; no study."""
    grid_reach: float = 2.9
    """Standard deviations that these cover: the second of three to either side is within 95 %."""
    neighbouring_orders: int = 6
    """Half waves in the stroke to which other orders of a ripple are tried. No study."""
    slope_step: float = 1e-3
    """Step of an encoded parameter in a difference quotient."""
    max_proposals: int = 3
    """Equations proposed for one joint. A page holds as many."""
    min_likeness: float = 0.98
    """Share of a column that another explains, above which they are nearly equal. No study."""
    min_nearer_share: float = 0.01
    """Share by which an effect with more columns must be nearer. No study."""
    max_scored_formulas: int = 8
    """Formulas that are scored as effects. Bounds the time; no study."""
    gram_ridge: float = 1e-10
    """On orthonormal columns: keeps rounding harmless in a fold that lacks a direction."""
    candidate_chunk: int = 48
    """Candidates multiplied at a time: they stay in the cache."""
    min_visible_share: float = 0.005
    """Share of a candidate direction that the model does not hide. No study."""
    block_duration: float = 0.5
    """s of a block of time; longer in long logs."""
    max_blocks: int = 120
    """Blocks of time: statistics need no more."""
    folds: int = 8
    """Folds of the cross-validation. No study."""
    min_explained_fraction: float = 0.95
    """Share of the systematic residual that a stated cause must explain. No study."""
    min_error_reduction: float = 0.1
    """Relative reduction of the error of the joints that an effect affects. No study."""
    max_joint_error: float = 0.5
    """Relative error: of 139 joints of measured logs, 34 of 41 above it predict other motion to no
    better than 60 %."""
    min_expected_reduction: float = 0.02
    """Variance reduction expected on other data, above which it must show there. No study."""
    max_order_deviation: float = 3.0
    """Standard deviations from a whole number of waves: teeth and poles are counted."""
    min_systematic_torque: float = 0.005
    """Rms of the systematic residual over that of the torque. No study."""
    min_systematic_share: float = 0.15
    """Share of the residual variance that must be systematic before it is reported. No study."""
    min_addable_share: float = 0.01
    """Share of its columns that logs must show of an effect to be added. No study."""
    max_chance_t: float = 2.0
    """Standard errors of a difference over blocks that chance explains."""
    negligible_error: float = 1e-3
    """Relative error that counts as zero."""
    min_spoiling_ratio: float = math.sqrt(2.0)
    """Ratio of the errors of a joint: more than its own noise is added. sqrt(2): two equal
    variances."""
    refinement_steps: int = 8
    """Steps of the refinement of one nonlinear parameter. No study."""
    refinement_turns: int = 5
    """Restarts of the refinement. No study."""
    whole_order_share: float = 0.85
    """Share of the best reduction with which a whole number of waves is preferred: teeth and poles
    are counted."""
    max_starts: int = 4
    """Grid values from which two parameters are refined: the fit has several maxima. No study."""
    scan_chunk: int = 96
    """Candidates whose columns are in memory together."""
    start_share: float = 0.95
    """Share of the best reduction with which another start is refined. No study."""
    refinement_share: float = 0.7
    """Share of the best reduction with which alternatives are refined before the choice. No
    study."""
    max_refined_alternatives: int = 5
    """Alternatives refined before the choice. Bounds the time; no study."""
    max_reconsidered_residual: float = 0.5
    """Ratio of the residual of a rejected effect to that at its rejection, to be considered again.
    No study."""
    min_refined_gain: float = 0.02
    """Variance reduction below which nothing is refined. No study."""
    max_effects: int = 8
    """Effects that a diagnosis names unless another number is requested."""
    min_description_gain: float = 0.15
    """Variance reduction with which an implausible effect still describes the data. No study."""
    max_rejections: int = 20
    """Rejected effects that end a diagnosis: the held-out motion is another one, or nothing recurs.
    No study."""
    min_clear_ratio: float = 1.01
    """Ratio of two errors that decides between equals. No study."""
    max_short_delay: float = 0.01
    """s; a shorter delay is linear in the band of a diagnosis."""
    min_mentioned_gain: float = 0.15
    """Variance reduction with which a rejected effect is mentioned. No study."""
    max_listed_rejections: int = 3
    """Rejected effects that are listed."""
    position_step: float = 1e-5
    """rad or m, of central differences."""
    difference_reach: int = 2
    """Samples to either side that nested difference quotients read."""
    sample_window: int = 2048
    """Samples evaluated at a time. Memory."""
    tilt_states: int = 64
    """Random states that show which tilts have an effect."""
    tilt_step: float = 1e-5
    """rad or m, of central differences."""
    min_tilt_torque: float = 1e-6
    """Norm of a torque, SI; smaller ones are rounding."""
    max_prior_steps: int = 12
    """Times that the weight of a prior is doubled."""
    cached_references: int = 3
    """References whose rows are cached: those of a state and of the next."""
    max_cached_bytes: int = 2**27
    """Bytes of columns that do not depend on the model."""
    max_band: float = 30.0
    """Hz of the parallel filter: ripple, elasticity, delays and reversals show above the band of a
    fit. No study."""
    min_instrumental_t: float = 4.0
    """Instrumental estimate over its standard error. No study."""
    min_motion_band: float = 0.5
    """Hz; no motion is smoothed as if it were slower."""
    max_logger_delay: float = 0.55
    """Samples of delay that a convention of the logger explains. No study."""


THRESHOLDS = Thresholds()
