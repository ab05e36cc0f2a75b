"""Inertia matrix, Christoffel coefficients and gravity as trigonometric polynomials.

Everything is linear in the standard parameters; what is computed here is the factor of each
parameter. With the screws (e_i, m_i) of a link (rotation, and velocity of the frame's origin, for
unit speed of joint i) the kinetic energy qd' M qd / 2 and the power of gravity give

    M_ij = e_i.J e_j + MS.(m_i x e_j + m_j x e_i) + M m_i.m_j,    g_i = -MS.(gv x e_i) - M m_i.gv
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

import sympy
from sympy.polys.domains import QQ

from modeler.core.errors import DerivationError
from modeler.derivation import (
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
    times,
)
from modeler.effects import EnergyBlock
from modeler.formulas.ring import Poly, TrigRing
from modeler.formulas.thresholds import THRESHOLDS

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
    return EnergyDynamics(
        _drop_zeros(inertia),
        _drop_zeros(_derive_christoffel(inertia, model.geometry.coordinate_count, ring)),
        _drop_zeros(_derive_gravity(carried, down, wanted, ring)),
    )


def compute_normal_screws(
    geometry: Geometry, frames: Sequence[Pose], ring: TrigRing
) -> list[dict[int, Screw]]:
    """Returns for every row, the screw of each free variable that moves it, in normal form."""
    row_screws: list[dict[int, Screw]] = []
    for total in compute_free_screws(
        geometry, frames, ring, lambda c: QQ(c.numerator, c.denominator)
    ):
        normal = {
            k: Screw(normalise_vector(x.e, ring), normalise_vector(x.m, ring))
            for k, x in total.items()
        }
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
        (at, k): {
            p: slope
            for p, factor in entry.items()
            if (slope := ring.differentiate_polynomial(factor, k))
        }
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
