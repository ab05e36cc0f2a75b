"""Bounds and tolerances of robot files, with unit, reason and study."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide in reading robot files."""

    min_fine_angle_decimals: int = 3
    """Decimals that an angle must have to be taken for a multiple of pi/12, and of pi/2: with
    fewer, a measured angle is near one by chance too often; no study."""
    min_coarse_angle_decimals: int = 2
    """Decimals that an angle must have to be taken for a multiple of pi/12, and of pi/2: with
    fewer, a measured angle is near one by chance too often; no study."""
    max_joint_ratio: float = 1e4
    """Of the motion of a joint or motor and that of a joint which it follows; no study."""
    max_name_length: int = 63
    """Of a name that goes into C, which tells names apart by as many letters (C99, 5.2.4.1); no
    study."""
    max_right_angle_rounding: float = 1e-9
    """rad; nearer to a multiple of pi/2 than this is that multiple; no study."""
    max_home_change: float = 1e-6
    """Values that differ by less are left as they are written: -pi/2 stays -pi/2; no study."""
    max_loops: int = 50
    """As many as legs; no study."""
    max_full_turn_excess: float = 1e-3
    """rad by which a full turn may be rounded up; no study."""
    max_legs: int = 50
    """Legs of three rows fill the longest table; no study."""
    max_ratio_denominator: int = 10**6
    """Largest denominator of a ratio that is taken as a fraction, such as 1/3; no study."""
    max_angle_in_rad: float = 6.3
    """rad: a larger angle is in degrees; no study."""
    max_length_in_m: float = 20.0
    """m: a larger length is in mm; no study."""
    placeholder_length: float = 0.1
    """m, of a length whose value the table does not tell; no study."""
    max_template_joints: int = 20
    """Max template joints; no study."""
    max_gain_over_k_e: float = 1.1
    """Gain over k_e; the same number of a motor without losses; no study."""
    max_rows: int = 150
    """Rows of a table. Deriving and the C grow with their square (docs/explanation/theory.md); no
    study."""
    max_silent_length: float = 20.0
    """m, of a robot; longer ones are told, for they may be mm; no study."""


THRESHOLDS = Thresholds()
