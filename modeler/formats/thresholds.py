"""Bounds and tolerances of files of other programs, with unit, reason and study."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide in reading and writing other formats."""

    stated_body_deviation: float = 0.3
    """How sure the values of a file are that says nothing of it, over the scale of a body; no
    study."""
    capsule_deviation: float = 1.0
    """The same of a capsule; no study."""
    unknown_value_deviation: float = 100.0
    """How sure a value is of which nothing is known, over what the torques allow; no study."""
    stated_value_tolerances: tuple[float, ...] = (1e-2, 0.1, 1.0)
    """Of what is known beforehand: by how much values of no body may move; no study."""
    max_relative_rounding: float = 1e-15
    """Of the size of a number; no study."""
    min_moment_of_inertia: float = 1e-14
    """kg m2: MuJoCo takes no smaller moment of inertia (its mjEPS of full inertias); no study."""
    min_rounded_eigenvalue: float = 1e-12
    """An eigenvalue of a pseudo-inertia that rounding does not explain; no study."""
    added_inertia_share: float = 1e-10
    """Of the inertia of a capsule of its mass: what a rod or a point gets; no study."""
    density_range: tuple[float, ...] = (1e-3, 1e3)
    """What a fit may say of a capsule's; no study."""
    max_rounded_zero: float = 1e-6
    """m, rad, and of a unit axis: smaller is what an exporter's arithmetic left of 0; no
    study."""
    max_names_in_note: int = 6
    """Names and numbers that a note tells: more nobody reads; no study."""
    max_quaternion_rounding: float = 4e-6
    """What 1.5708 instead of pi/2 leaves in the components of a quaternion with more digits; no
    study."""
    min_body_eigenvalue: float = 1e-7
    """Least eigenvalue of a body that could be built, a round one of its size being 1; no
    study."""
    min_solver_eigenvalue: float = 1e-6
    """That which is asked of the solver; no study."""
    min_relative_eigenvalue: float = 1e-13
    """Relative: an eigenvalue that is rounding; no study."""
    max_gravity_difference: float = 2e-3
    """Share of gravity: 9.80665 is 9.81 in other digits; no study."""
    max_loop_gap: float = 1e-9
    """m, rad: what may be left of a loop; no study."""
    capsule_density: float = 1000.0
    """kg/m3 of a link of which nothing is known; no study."""
    capsule_radius_share: float = 0.12
    """Radius over the middle length of the links; no study."""
    capsule_default_length: float = 0.2
    """m, of a robot without lengths; no study."""
    min_capsule_length_share: float = 0.02
    """Of the middle length: frames that are nearer stand at one place; no study."""
    max_parallel_angle: float = 1e-9
    """rad; a smaller angle is none, as it is none between an angle and a multiple of pi/12; no
    study."""
    max_foot_distance_ratio: float = 20.0
    """Distance of the foot of a common normal, over that of neighbouring joints, beyond which a
    fixed row takes its place. Torques lose as much as the square of it in accuracy; no study."""
    max_length_rounding: float = 1e-13
    """Of a length that is a decimal of at most `_DECIMALS` digits, relative from 1 m; no
    study."""
    max_length_decimals: int = 10
    """Max length decimals; no study."""
    gamma_or_b_cost: float = 3.0
    """What gamma or b costs, a cell of `theta` or `r` being 1: a serial table has none; no
    study."""
    max_included_files: int = 200
    """Max included files; no study."""
    placeholder_inertia: float = 1e-12
    """Of bodies that state nothing, kg and kg m2, for MuJoCo compiles no moving body without; no
    study."""
    min_stated_mass: float = 1e-9
    """kg; what weighs less states nothing; no study."""
    max_mjcf_number: float = 1e12
    """Max mjcf number; no study."""
    max_pose_difference: float = 1e-4
    """m, rad: rounded angles of a file are exact in the robot file; no study."""
    compared_postures: int = 5
    """Compared postures; no study."""
    usual_gravity: float = 9.81
    """m/s2; no study."""
    max_par_angle: float = 6.29
    """rad; no study."""
    min_lost_share: float = 1e-6
    """Of a torque: prints as 0 %; no study."""
    max_unchanged_difference: float = 1e-9
    """Of the size of its kind: what is nearer has not changed; no study."""
    max_same_body_difference: float = 1e-10
    """Of a body's scale: what is nearer has not changed; no study."""
    closure_difference_step: float = 1e-6
    """rad, m, of central differences; no study."""
    min_closure_singular_value: float = 1e-7
    """Of the largest singular value: differences are good to 1e-10; no study."""
    read_body_deviation: float = 0.3
    """How sure masses, centres and inertias of another program's file are, over their scale; no
    study."""
    min_mass_distance: float = 1e-3
    """m; where masses are nearer to an origin, digits below the rounding of that distance are
    none; no study."""
    default_acceleration_ratio: float = 4.0
    """Over the speed, 1/s, where a file states none; no study."""
    max_links: int = 5000
    """Max links; no study."""
    max_tag_bytes: int = 8 * 2**20
    """bytes of one tag, comment or declaration; no study."""
    max_element_depth: int = 256
    """Max element depth; no study."""
    max_elements: int = 200_000
    """Max elements; no study."""
    parsed_bytes: int = 2**20
    """bytes that expat gets at a time; no study."""
    max_element_notes: int = 40
    """Max element notes; no study."""


THRESHOLDS = Thresholds()
