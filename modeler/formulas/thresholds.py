"""The numbers that decide in `modeler.formulas`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, tolerances, counts and seeds of the package."""

    imaginary_step: float = 1e-30
    """Imaginary time step of a derivative, s: exact at any small size."""
    kane_seed: int = 1985
    """Seed of the parameters with which torques of Kane's form are compared."""
    false_alarm_rate: float = 0.01
    """Probability that a table of consistent values holds one that is called suspicious."""
    fit_rounds: int = 30
    """Gauss-Newton steps, and halvings of one; no study."""
    fitted_groups: int = 100
    """Groups of CAD entries that are fitted; no study."""
    fit_convergence: float = 1e-9
    """Relative decrease of chi^2 that ends a fit; no study."""
    exhaustive_joints: int = 4
    """Joints with squares up to which every choice of sine or cosine is tried: 2**4 forms."""
    max_products: int = 500_000
    """Products of monomials in an inertia matrix: 10,186 for a PUMA 560 (1 s), 252,027 for 5R
    with general angles (6 s)."""
    short_length: int = 7
    """Characters up to which a quantity is written wherever it is read."""
    single_use_length: int = 40
    """Characters up to which a quantity that is read once is written there."""
    unnamed_length: int = 14
    """Characters from which a quantity without a proposed name, read twice, gets one."""
    seed: int = 2000
    """Seed of the random points at which ranks are taken modulo a prime."""
    closed_form_joints: int = 3
    """Joints up to which coefficients of the closed form are derived unasked."""
    max_block_equations: int = 4
    """Equations up to which a block is inverted by cofactors."""
    zero_parameter: float = 1e-12
    """Sum over the sum of magnitudes of a base parameter's terms that is rounding."""
    max_angle_terms: int = 4
    """Whole multiples of angles in a sum that is expanded."""
    max_angle_parts: int = 4
    """Denominator of a multiple of a free angle: finer gear ratios are angles of their own."""
    max_determinant_monomials: int = 150
    """Monomials of a map whose determinant is expanded: 67 for a PUMA 560, 106 in 1 s, minutes
    at 216."""
    max_factored_terms: int = 400
    """Terms of a polynomial that is factored; no study."""
    sets_per_block: int = 4000
    """Sets that are reduced together; no study."""
    max_sets: int = 30_000_000
    """Sets of one component that are looked at: minutes."""
    real_root: float = 1e-6
    """Imaginary part over the magnitude of a root that is rounding."""
    sure_sigmas: float = 3.0
    """Standard deviations by which a denominator or a negative moment differs from zero."""
    verified_robots: int = 20
    """Random robots for which every formula is verified exactly."""


THRESHOLDS = Thresholds()
