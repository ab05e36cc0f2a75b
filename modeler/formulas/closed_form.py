"""Inertia matrix, Christoffel coefficients and gravity as trigonometric polynomials.

Everything is linear in the standard parameters; what is computed here is the factor of each
parameter. With the screws (e_i, m_i) of a link (rotation, and velocity of the frame's origin, for
unit speed of joint i) the kinetic energy qd' M qd / 2 and the power of gravity give

    M_ij = e_i.J e_j + MS.(m_i x e_j + m_j x e_i) + M m_i.m_j,    g_i = -MS.(gv x e_i) - M m_i.gv
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, combinations_with_replacement
from typing import TypeAlias

import sympy
from sympy.polys.domains import QQ

from modeler.core.errors import DerivationError, RobotError
from modeler.derivation import (
    BaseParameters,
    Composite,
    Geometry,
    LinkColumn,
    Pose,
    Screw,
    StandardColumn,
    SymbolicModel,
    Vector,
    compute_frame_gravity,
    compute_free_screws,
    compute_poses,
    cross,
    dot,
    is_in_block,
    plus,
    project_wrench,
    replace_square,
    times,
)
from modeler.effects import EnergyBlock
from modeler.formulas.function_sheet import Sheet
from modeler.formulas.ring import Poly, TrigRing
from modeler.formulas.short_form import build_effects_sheet, format_function_name
from modeler.formulas.thresholds import THRESHOLDS
from modeler.robot import Robot

Entries = Mapping[tuple[int, ...], Mapping[int, Poly]]
"""{indices: {column of the standard parameter: factor}}, in normal form; zeros left out."""


@dataclass(frozen=True)
class EnergyDynamics:
    """tau_i = sum_j M_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k + g_i.

    Attributes:
        inertia: (i, j), i <= j.
        christoffel: (i, j, k), j <= k: the full coefficient of qd_j qd_k in the torque of joint i.
        gravity: (i,).
    """

    inertia: Entries
    christoffel: Entries
    gravity: Entries


def derive_energy_dynamics(
    model: SymbolicModel, ring: TrigRing, columns: Sequence[int]
) -> EnergyDynamics:
    """Returns the entries of the dynamics for those columns; friction and offsets have none.

    Raises:
        DerivationError: more than `THRESHOLDS.max_products` products; says how many.
    """
    frames = compute_poses(model.geometry, ring)
    carried = compute_normal_screws(model.geometry, frames, ring)
    wanted = [(place, part) for place in columns for part in model.columns[place].parts]
    _check_size(model, carried, wanted)
    inertia: dict[tuple[int, ...], dict[int, Poly]] = {}
    for place, column in wanted:
        if isinstance(column, LinkColumn):
            link, body = carried[column.row], _build_unit_body(column, ring)
            for i, j in _enumerate_pairs(link):
                factor = ring.normalise_polynomial(_compute_kinetic_factor(body, link[i], link[j]))
                _add_entry(inertia, (i, j), place, factor)
    for place, column in wanted:  # inertia that turns with a shaft: constant entries c_i c_j
        if is_in_block(column, EnergyBlock.KINETIC):
            for i, j in _enumerate_pairs(column.shaft):
                value = column.shaft[i] * column.shaft[j]
                factor = ring.static(sympy.Rational(value.numerator, value.denominator))
                _add_entry(inertia, (i, j), place, factor)
    down = [normalise_vector(v, ring) for v in compute_frame_gravity(model.geometry, frames, ring)]
    christoffel = _derive_christoffel(inertia, model.geometry.coordinate_count, ring)
    gravity = _derive_gravity(carried, down, wanted, ring)
    return EnergyDynamics(*(_drop_zeros(x) for x in (inertia, christoffel, gravity)))


def compute_normal_screws(
    geometry: Geometry, frames: Sequence[Pose], ring: TrigRing
) -> list[dict[int, Screw]]:
    """Returns for every row, the screw of each free variable that moves it, in normal form."""
    row_screws: list[dict[int, Screw]] = []
    screws = compute_free_screws(geometry, frames, ring, lambda c: QQ(c.numerator, c.denominator))
    for total in screws:
        pairs = ((k, [normalise_vector(v, ring) for v in (x.e, x.m)]) for k, x in total.items())
        normal = {k: Screw(*pair) for k, pair in pairs}
        row_screws.append({k: x for k, x in normal.items() if any(x.e) or any(x.m)})
    return row_screws


def normalise_vector(vector: Vector, ring: TrigRing) -> Vector:
    """Returns the vector in normal form."""
    return [ring.normalise_polynomial(ring.ring(x)) for x in vector]


def _check_size(
    model: SymbolicModel,
    carried: Sequence[Mapping[int, Screw]],
    wanted: Sequence[tuple[int, StandardColumn]],
) -> None:
    products = 0
    for k in {column.row for _, column in wanted if isinstance(column, LinkColumn)}:
        sizes = {i: (sum(map(len, x.e)), sum(map(len, x.m))) for i, x in carried[k].items()}
        for i, j in _enumerate_pairs(sizes):
            (e, m), (f, n) = sizes[i], sizes[j]
            products += e * f + e * n + m * f + m * n
    if products > THRESHOLDS.max_products:
        raise DerivationError(
            f"robot {model.robot.name}: its closed form takes about {products:,} products of "
            f"monomials, at most {THRESHOLDS.max_products:,} are worth printing; use the "
            "generated code, or cut the robot to the joints of interest"
        )


def _enumerate_pairs(places: Mapping[int, object]) -> Iterator[tuple[int, int]]:
    return combinations_with_replacement(sorted(places), 2)


def _add_entry(
    entries: dict[tuple[int, ...], dict[int, Poly]], at: tuple[int, ...], place: int, factor: Poly
) -> None:
    """Parts of one parameter add up: similar legs share theirs."""
    entry = entries.setdefault(at, {})
    entry[place] = entry[place] + factor if place in entry else factor


def _build_unit_body(column: LinkColumn, ring: TrigRing) -> Composite:
    """A link of which only that parameter is there, and is 1."""
    return Composite({column.prefix: ring.ring.one}, ring.ring.zero)


def _compute_kinetic_factor(body: Composite, a: Screw, b: Screw) -> Poly:
    """Along screw a, the momentum of the body for unit speed along b."""
    f = plus(times(body.M, b.m), cross(b.e, body.MS))
    return project_wrench(a, f, plus([dot(line, b.e) for line in body.J], cross(body.MS, b.m)))


def _derive_gravity(
    carried: Sequence[Mapping[int, Screw]],
    down: Sequence[Vector],
    wanted: Sequence[tuple[int, StandardColumn]],
    ring: TrigRing,
) -> dict[tuple[int, ...], dict[int, Poly]]:
    entries: dict[tuple[int, ...], dict[int, Poly]] = {}
    for place, column in wanted:
        if isinstance(column, LinkColumn):
            g, body = down[column.row], _build_unit_body(column, ring)
            for i, screw in carried[column.row].items():
                factor = -project_wrench(screw, times(body.M, g), cross(body.MS, g))
                _add_entry(entries, (i,), place, ring.normalise_polynomial(factor))
    return entries


def _derive_christoffel(
    inertia: Entries, joints: int, ring: TrigRing
) -> dict[tuple[int, ...], dict[int, Poly]]:
    """S_ijk = dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i for j < k, half of that for j = k."""
    slopes = {
        (at, k): {p: ring.differentiate_polynomial(factor, k) for p, factor in entry.items()}
        for at, entry in inertia.items()
        for k in range(joints)
    }
    half = -ring.static(sympy.Rational(1, 2))
    entries: dict[tuple[int, ...], dict[int, Poly]] = {}
    for i in range(joints):
        for j, k in combinations_with_replacement(range(joints), 2):
            parts = [((i, j), k, 1), ((j, k), i, -1), ((i, k), j, 1)]
            for at, by, factor in parts if j < k else [parts[0], ((j, j), i, half)]:
                for place, slope in slopes.get((tuple(sorted(at)), by), {}).items():
                    _add_entry(entries, (i, j, k), place, slope * factor)
    return entries


def _drop_zeros(
    entries: Mapping[tuple[int, ...], Mapping[int, Poly]],
) -> dict[tuple[int, ...], dict[int, Poly]]:
    nonzero = {at: {p: f for p, f in entry.items() if f} for at, entry in entries.items()}
    return {at: nonzero[at] for at in sorted(nonzero) if nonzero[at]}


# Inertia matrix, Christoffel coefficients and gravity by composite bodies, each quantity once.
#
# Let I_k be the inertia of link k and of all that it carries, held together, in frame k (mass,
# first moments, inertia at the origin), S_i the screw of joint i in frame k (rotation e_i, velocity
# m_i of the origin, for unit speed). For joints i <= j <= k of one chain
#
#     J_ik = S_i . I_k S_k,
#     A_ijk = dJ_ij/dq_k = S_i . (dI_k/dq_k) S_j,    B_ijk = dJ_ik/dq_j = -(S_j x S_i) . I_k S_k,
#     dJ_jk/dq_i = 0,
#
# because J_ij changes with q_k only where I_k turns about axis k, J_ik with q_j only where all
# behind j turns against axis i, and what is behind i does not see q_i. So of the three Christoffel
# symbols of three joints two are independent, with the full coefficients
#
#     S_ijk = A + B,    S_jik = A - B = -S_kij    (i < j < k),
#     S_iik = A_iik = -2 S_kii,                   S_ijj = B_ijj,    S_jij = 0.
#
# Composite bodies: Walker and Orin 1982, Khalil and Dombre 2002, 9.7.2. Joints that follow others
# by q = E u + constant give J_u = E' J E, and the Christoffel symbols of u likewise.


# A model on a graph of its own, prepared for formulas that people read; torques of its effects.


# The dynamics as formulas with as few trigonometric monomials as we find.


Exponents: TypeAlias = tuple[int, ...]
Form: TypeAlias = Mapping[int, Poly]
"""Linear form of standard parameters: {column: factor, a polynomial of the geometry}."""

KINDS = {"g": "gravity", "J": "inertia", "S": "christoffel"}


@dataclass(frozen=True)
class ConfigurationFunction:
    """One function of the configuration.

    Attributes:
        name: "g1", "J12", "S213"; joints with longer names are joined as in "J1_12".
        kind: "gravity" (N m per unit of the factored-out letter), "inertia" or "christoffel".
        joints: indices of the joint variables.
        terms: {exponents of the motion generators: linear form of the parameters}, in the order
            in which they are printed.
    """

    name: str
    kind: str
    joints: tuple[int, ...]
    terms: Mapping[Exponents, Form]


@dataclass(frozen=True)
class ClosedForm:
    """tau_i = sum_j J_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k + g_i + e_i, where they are not zero.

    J is the inertia matrix, S_ijk the full coefficient of qd_j qd_k, e what effects take.

    Attributes:
        robot: its description.
        parameters: names of the parameters by column: the standard ones, or the base parameters at
            the columns that they have.
        algebra: the generators of the functions.
        gravity_factor: name of the letter taken out of all gravity functions, "" if there is none:
            the gravity torque of joint i is that letter times g_i.
        functions: g, J, S in order of their indices.
        effects: e, which is no polynomial.
    """

    robot: Robot
    parameters: tuple[str, ...]
    algebra: TrigRing
    gravity_factor: str
    functions: tuple[ConfigurationFunction, ...]
    effects: Sheet

    @cached_property
    def by_name(self) -> Mapping[str, ConfigurationFunction]:
        """Returns the functions of the configuration by name."""
        return {function.name: function for function in self.functions}

    @property
    def monomial_count(self) -> int:
        """Returns number of monomials of all functions."""
        return sum(len(function.terms) for function in self.functions)


def derive_closed_form(model: SymbolicModel, base: BaseParameters | None = None) -> ClosedForm:
    """Returns the dynamics of a robot as polynomials in sines and cosines of its joints.

    Per function and per joint, either squares of the sine or squares of the cosine are eliminated,
    whichever leaves fewer monomials; where both leave as many, squares of cosines are kept. All
    choices are tried for up to four joints, beyond that one joint after the other. A robot file may
    fix the choice: the functions of `[terms] keep_sine_squares` keep squares of sines, all others
    squares of cosines.

    Args:
        model: any serial or tree-structured robot; joints may follow others by linear relations.
            Of a robot with loops, the opened tree: torques are those along its free variables.
        base: write it in the base parameters: factors of their columns only.

    Raises:
        DerivationError: too many joints to be printed; lengths that are not polynomials.
        RobotError: `keep_sine_squares` names a function that is not there.
    """
    algebra = TrigRing(model.geometry)
    everything: Sequence[int] = range(len(model.columns))
    columns = everything if base is None else [p.column for p in base.parameters]
    full = derive_energy_dynamics(model, algebra, columns)
    factor = _find_gravity_factor(algebra)
    names = [joint.name for joint in model.robot.free_joints]
    keep = _read_sine_squares(model.robot)
    gravity = full.gravity
    if factor is not None:
        letter_of = algebra.ring.gens[factor]
        gravity = {
            at: {column: poly.exquo(letter_of) for column, poly in entry.items()}
            for at, entry in gravity.items()
        }
    functions = [
        _build_function(letter, names, at, entry, algebra, keep)
        for letter, entries in (("g", gravity), ("J", full.inertia), ("S", full.christoffel))
        for at, entry in entries.items()
    ]
    known = [function.name for function in functions]
    for name in sorted((keep or set()) - set(known)):
        raise RobotError(
            f"robot {model.robot.name}, [terms], keep_sine_squares: got {name}, which is zero or "
            f"no function of this robot; expected names among {', '.join(known)}"
        )
    letter = str(algebra.ring.symbols[factor]) if factor is not None else ""
    parameters = list(model.names)
    for parameter in base.parameters if base is not None else ():
        parameters[parameter.column] = parameter.name
    effects = build_effects_sheet(model, {column: parameters[column] for column in columns})
    return ClosedForm(model.robot, tuple(parameters), algebra, letter, tuple(functions), effects)


def _build_function(
    letter: str,
    names: Sequence[str],
    at: tuple[int, ...],
    entry: Form,
    algebra: TrigRing,
    keep: frozenset[str] | None,
) -> ConfigurationFunction:
    name = format_function_name(letter, [names[i] for i in at])
    if keep is None:
        entry = _minimise_monomials(entry, algebra)
    elif name in keep:
        turning = [i for i, motion in enumerate(algebra.motions) if motion.sine is not None]
        entry = _keep_sine_squares(entry, algebra, turning)
    terms = collect_monomials(entry, algebra)
    order = sorted(terms, reverse=True)
    terms = {exponents: terms[exponents] for exponents in order}
    return ConfigurationFunction(name, KINDS[letter], at, terms)


def collect_monomials(entry: Form, algebra: TrigRing) -> dict[Exponents, dict[int, Poly]]:
    """Returns {parameter: polynomial} sorted by monomials: {monomial: {parameter: factor}}."""
    terms: dict[Exponents, dict[int, Poly]] = {}
    for column, poly in entry.items():
        for exponents, factor in algebra.separate_motion(poly).items():
            terms.setdefault(exponents, {})[column] = factor
    return terms


def _minimise_monomials(entry: Form, algebra: TrigRing) -> Form:
    """The same function with the squares of sines kept where that saves monomials."""
    monomials = [exponents for poly in entry.values() for exponents in poly]
    cosines = [(index, motion.cosine) for index, motion in enumerate(algebra.motions)]
    squared = [i for i, c in cosines if c is not None and any(at[c] > 1 for at in monomials)]
    if len(squared) <= THRESHOLDS.exhaustive_joints:
        sets = [c for n in range(len(squared) + 1) for c in combinations(squared, n)]
        choices = [_keep_sine_squares(entry, algebra, chosen) for chosen in sets]
        return min(choices, key=lambda choice: _count_monomials(choice, algebra))
    best, count = entry, _count_monomials(entry, algebra)
    for index in squared:
        other = _keep_sine_squares(best, algebra, (index,))
        if (fewer := _count_monomials(other, algebra)) < count:
            best, count = other, fewer
    return best


def _keep_sine_squares(entry: Form, algebra: TrigRing, joints: Sequence[int]) -> Form:
    for index in joints:
        motion = algebra.motions[index]
        assert motion.sine is not None and motion.cosine is not None
        square = 1 - algebra.ring.gens[motion.sine] ** 2
        entry = {c: replace_square(poly, motion.cosine, square) for c, poly in entry.items()}
    return entry


def _count_monomials(entry: Form, algebra: TrigRing) -> int:
    return len({exponents[: algebra.moving] for poly in entry.values() for exponents in poly})


def _find_gravity_factor(algebra: TrigRing) -> int | None:
    """Place of the first letter that divides every component of gravity."""
    entries = [algebra.static(entry) for entry in algebra.geometry.gravity]
    terms = [exponents for entry in entries for exponents in entry]
    places = range(algebra.moving, len(algebra.ring.symbols))
    if not terms:
        return None
    return next((place for place in places if all(t[place] for t in terms)), None)


def _read_sine_squares(robot: Robot) -> frozenset[str] | None:
    names = robot.terms.get("keep_sine_squares")
    if names is None:
        return None
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise RobotError(
            f"robot {robot.name}, [terms], keep_sine_squares: got {names!r}; expected a list of "
            'functions such as ["J11", "J12"]'
        )
    return frozenset(names)
