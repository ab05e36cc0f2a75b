"""Bounds and tolerances of robot files, with unit, reason and study."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide in reading robot files."""

    min_fine_angle_decimals: int = 3
    """Decimals that an angle in rad must have to be taken for a multiple of pi/12 that is none of
    pi/2; with fewer, a measured angle is near one by chance too often; no study."""
    min_coarse_angle_decimals: int = 2
    """Decimals that an angle in rad must have to be taken for a multiple of pi/2; with fewer, a
    measured angle is near one by chance too often; no study."""
    max_joint_ratio: float = 1e4
    """Largest ratio of the motion of a joint or motor to that of a joint that it follows; a larger
    coefficient is refused; no study."""
    max_name_length: int = 63
    """Characters of a name that goes into C, where as many are significant (C99, 5.2.4.1); no
    study."""
    max_right_angle_rounding: float = 1e-9
    """rad; an angle nearer to a multiple of pi/2 than this is that multiple; no study."""
    max_home_change: float = 1e-6
    """rad or m; values of [home] that differ by less are left as they are written: -pi/2 stays
    -pi/2; no study."""
    max_loops: int = 50
    """Loops of a robot, those of all legs counted: as many as legs; no study."""
    max_full_turn_excess: float = 1e-3
    """rad by which a full turn may be rounded up before an angle of [home] is refused; no study."""
    max_legs: int = 50
    """Legs of a robot: as many as fill the longest table with three rows each; no study."""
    max_ratio_denominator: int = 10**6
    """Largest denominator of a ratio that is taken as a fraction, such as 1/3; no study."""
    max_angle_in_rad: float = 6.3
    """rad; a column of angles without unit that holds a larger number is taken in degrees: it would
    be more than a turn; no study."""
    max_length_in_m: float = 20.0
    """m; a column of lengths without unit that holds a larger number is taken in mm; no study."""
    placeholder_length: float = 0.1
    """m or rad; placeholder for a symbol whose value a pasted table does not state; no study."""
    max_template_joints: int = 20
    """Joints of a robot made from a template; more are refused; no study."""
    max_gain_over_k_e: float = 1.1
    """Drive gain over k_e above which k_e is questioned: without losses both are one number; no
    study."""
    max_rows: int = 150
    """Rows of a table. Deriving and the C grow with their square (docs/explanation/theory.md); no
    study."""
    max_silent_length: float = 20.0
    """m; a longer length that is written without unit is reported, because it may be in mm; no
    study."""


THRESHOLDS = Thresholds()
