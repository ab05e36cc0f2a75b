"""Numbers that decide what is emitted: limits of lines, pivots, postures, digits."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Numbers that decide what is emitted: limits of lines, pivots, postures, digits."""

    # block
    max_expression_length: int = 74
    """Characters of an expression; with indent and name a line stays below 100. No study."""
    # casadi_functions
    max_compared_depth: int = 1000
    """Nodes to which two speeds are compared. No study."""
    # advance
    reset_turns: int = 2
    """Corrections of e of elastic joints at rest, each by the gravity of the one before: gravity
    changes by about 1 % of K e over e, so that what is left is 1e-4 of e."""
    # context
    max_relative_rounding: float = 1e-12
    """A cell and its exact entry differ by rounding, 1e-16 an operation. No study."""
    # elimination
    min_pivot_share: float = 0.0937
    """Of the largest entry in the column: large enough for a pivot. No study."""
    max_sampled_residual: float = 1e-9
    """Residual of a closed posture, relative to the size of the robot. No study."""
    # functions
    max_single_zeros: int = 16
    """Outputs that are always 0, up to which each is written in its own line. No study."""
    zeros_per_statement: int = 8
    """Of more, as many as one statement writes: a line of the cache, 64 bytes."""
    # vectors
    state_bits: int = 192
    """Bits of the numbers of the stored states: 58 digits, of which doubles show 17. No study."""
    posture_grid: float = 2.0**-14
    """rad or m; coordinates of postures are multiples of it, exact in single precision."""
    posture_reaches: tuple[float, ...] = (0.1, 0.02, 0.004)
    """rad, or share of the size of the robot; near a singularity the last. No study."""
    # wrappers
    max_fmu_step: float = 1e-3
    """s, of co-simulation at the start. No study."""
    fmu_friction_width: float = 1e-2
    """rad/s or m/s, of Coulomb friction at the start. No study."""
    controller_bandwidth: float = 4.0 * 3.141592653589793
    """rad/s, of the computed torque of ROS 2 at the start: 2 Hz. No study."""


THRESHOLDS = Thresholds()
