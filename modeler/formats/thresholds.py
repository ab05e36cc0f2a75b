"""Bounds and tolerances of files of other programs, with unit, reason and study."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds the numbers that decide in reading and writing other formats."""

    stated_body_deviation: float = 0.3
    """Standard deviation of a stated body, over its scale, where the robot file states no
    uncertainty; no study."""
    capsule_deviation: float = 1.0
    """Standard deviation, over its scale, of the capsule that stands for a link of which no body is
    stated; no study."""
    unknown_value_deviation: float = 100.0
    """Standard deviation of a value of which nothing is known, over the largest value that the base
    parameters allow; no study."""
    stated_value_tolerances: tuple[float, ...] = (1e-2, 0.1, 1.0)
    """Shares of their prior standard deviations by which stated values that no body can have may
    move, tried in turn; no study."""
    max_relative_rounding: float = 1e-15
    """Share of the magnitude of its kind (mass, centre or inertia) up to which an entry is what
    differences leave of 0, and is set to 0; no study."""
    min_moment_of_inertia: float = 1e-14
    """kg m2: MuJoCo takes no smaller moment of inertia (its mjEPS of full inertias); no study."""
    min_rounded_eigenvalue: float = 1e-12
    """Amount below 0 of the smallest eigenvalue of a scaled pseudo-inertia that is rounding; beyond
    it, the stated values are of no body and are moved; no study."""
    added_inertia_share: float = 1e-10
    """Share of the largest entry of the inertia of a rod or a point that is added to it, because
    other programs refuse a body without; no study."""
    density_range: tuple[float, ...] = (1e-3, 1e3)
    """Densities over that of water between which a density fitted to the torques is used for links
    without a body; outside, they get that of water; no study."""
    max_rounded_zero: float = 1e-6
    """m, rad, and components of a unit axis; a smaller number is what an exporter's arithmetic left
    of 0; no study."""
    max_names_in_note: int = 6
    """Names and numbers that a note lists; of more, the count of the rest; no study."""
    max_quaternion_rounding: float = 4e-6
    """Error that 1.5708 instead of pi/2 leaves in a component of a quaternion with more digits; up
    to it, the exact quaternion is taken; no study."""
    min_body_eigenvalue: float = 1e-7
    """Smallest eigenvalue of the scaled pseudo-inertia of a body that can be built; a round body of
    its size has 1; no study."""
    min_solver_eigenvalue: float = 1e-6
    """The same eigenvalue, as it is required of the cone solver that looks for the nearest body; no
    study."""
    min_relative_eigenvalue: float = 1e-13
    """Share of the largest eigenvalue of a correlation matrix, or of 1 if that is larger, up to
    which an eigenvalue is rounding and is left out; no study."""
    max_gravity_difference: float = 2e-3
    """Relative difference of gravity that is reported: 9.80665 and 9.81 m/s2 differ by less; no
    study."""
    max_loop_gap: float = 1e-9
    """m, rad; largest residual of a loop that counts as closed near [home]; no study."""
    capsule_density: float = 1000.0
    """kg/m3; density of the capsule of a link of which nothing is known, that of water; no
    study."""
    capsule_radius_share: float = 0.12
    """Radius of a capsule that the robot file does not state, over the median length of the links;
    no study."""
    capsule_default_length: float = 0.2
    """m; stands for the median length of the links where all are 0; no study."""
    min_capsule_length_share: float = 0.02
    """Share of the median length of the links up to which a capsule has no length, and in whose
    steps two ends are compared; no study."""
    max_parallel_angle: float = 1e-9
    """rad; directions that differ by less are parallel, and an angle nearer to a multiple of pi/12
    is that multiple; no study."""
    max_foot_distance_ratio: float = 20.0
    """Distance of the foot of a common normal, over that of neighbouring joints, beyond which a
    fixed row takes its place. Torques lose as much as the square of it in accuracy; no study."""
    max_length_rounding: float = 1e-13
    """Difference, over the length or 1 m if that is larger, up to which a length is a decimal of at
    most `max_length_decimals` digits; no study."""
    max_length_decimals: int = 10
    """Digits after the point, of m or rad, up to which a length or an angle is looked for as a
    decimal; no study."""
    gamma_or_b_cost: float = 3.0
    """Weight of a cell of gamma or b, one of theta or r being 1, when frames are chosen: a serial
    table has neither; no study."""
    max_included_files: int = 200
    """Files that one MJCF file may include; a file that includes more is refused; no study."""
    placeholder_inertia: float = 1e-12
    """kg and kg m2; mass and inertia of a body that states none, because MuJoCo compiles no moving
    body without; no study."""
    min_stated_mass: float = 1e-9
    """kg and kg m2; a body of smaller mass and inertia states nothing; no study."""
    max_mjcf_number: float = 1e12
    """SI; a compiled MJCF model with a number of this size or more is refused; no study."""
    max_pose_difference: float = 1e-4
    """m, rad, and entries of a rotation; poses of the original file and of the robot that differ by
    less are equal, because rounded angles of the file are exact in the robot file; no study."""
    compared_postures: int = 5
    """Random postures at which the joints of the original file must place their links as the table
    of the robot does; no study."""
    usual_gravity: float = 9.81
    """m/s2; gravity that is assumed where an entry of G in a `.par` file holds a letter without a
    value; no study."""
    max_par_angle: float = 6.29
    """rad; a larger number in a column of angles of a `.par` file is refused as more than a turn;
    no study."""
    min_lost_share: float = 1e-6
    """Share of a joint's torque below which an effect that the format cannot hold is not listed: it
    prints as 0 %; no study."""
    max_unchanged_difference: float = 1e-9
    """Relative difference, for its kind of quantity, up to which a written value has not changed;
    no study."""
    max_same_body_difference: float = 1e-10
    """Difference of two bodies, over their scale, up to which they are the same; no study."""
    closure_difference_step: float = 1e-6
    """rad, m; step of the central differences of the residuals of loops; no study."""
    min_closure_singular_value: float = 1e-7
    """Share of the largest singular value up to which a singular value of these differences counts
    as 0: they are good to 1e-10; no study."""
    read_body_deviation: float = 0.3
    """Standard deviation of masses, centres and inertias read from another program's file, over
    their scale; no study."""
    min_mass_distance: float = 1e-3
    """m; radius of gyration below which the scale of an inertia is not taken: digits below the
    rounding of that distance mean nothing; no study."""
    default_acceleration_ratio: float = 4.0
    """1/s; limit of acceleration over that of speed where a file states none; no study."""
    max_links: int = 5000
    """Elements of one tag, as links, in a URDF file; a file with more is refused as no robot; no
    study."""
    max_tag_bytes: int = 8 * 2**20
    """Bytes of one tag, comment or declaration of an XML file; a longer one is refused; no
    study."""
    max_element_depth: int = 256
    """XML elements inside each other; a file with more is refused as no robot; no study."""
    max_elements: int = 200_000
    """XML elements of a file; a file with more is refused as no robot; no study."""
    parsed_bytes: int = 2**20
    """Bytes of an XML file that expat parses at a time; no study."""
    max_element_notes: int = 40
    """Different notes on elements that are not read; all further elements share one note; no
    study."""


THRESHOLDS = Thresholds()
