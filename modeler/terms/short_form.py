r"""Inertia matrix, Christoffel coefficients and gravity by composite bodies, each quantity once.

Let I_k be the inertia of link k and of all that it carries, held together, in frame k (mass,
first moments, inertia at the origin), S_i the screw of joint i in frame k (rotation e_i, velocity
m_i of the origin, for unit speed). For joints i <= j <= k of one chain

    J_ik = S_i . I_k S_k,
    A_ijk = dJ_ij/dq_k = S_i . (dI_k/dq_k) S_j,    B_ijk = dJ_ik/dq_j = -(S_j x S_i) . I_k S_k,
    dJ_jk/dq_i = 0,

because J_ij changes with q_k only where I_k turns about axis k, J_ik with q_j only where all
behind j turns against axis i, and what is behind i does not see q_i. So of the three Christoffel
symbols of three joints two are independent, with the full coefficients

    S_ijk = A + B,    S_jik = A - B = -S_kij    (i < j < k),
    S_iik = A_iik = -2 S_kii,                   S_ijj = B_ijj,    S_jij = 0.

Composite bodies: Walker and Orin 1982, Khalil and Dombre 2002, 9.7.2. Joints that follow others
by q = E u + constant give J_u = E' J E, and the Christoffel symbols of u likewise.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement

from modeler.base import BaseParameters
from modeler.effects import EnergyBlock
from modeler.symbolic import Expr, SymbolicModel, in_block
from modeler.symbolic.inertia_matrix import Composite
from modeler.symbolic.kinematics import Screw, Vector, cross, dot, gravity_in_frames, plus, screws
from modeler.terms.closed_form import function_name
from modeler.terms.fresh import named_columns, symbols_of, write_effects
from modeler.terms.sheet import SheetWriter

_INERTIA = (("XX", 0, 0), ("XY", 0, 1), ("XZ", 0, 2), ("YY", 1, 1), ("YZ", 1, 2), ("ZZ", 2, 2))
_AXES = "xyz"

Triple = tuple[int, int, int]


@dataclass(frozen=True)
class _Rows:
    """Tree quantities by the index of the row's variable, zeros left out.

    Attributes:
        inertia: {(i, k): J_ik}, i <= k.
        turned: {(i, j, k): A_ijk}, i <= j <= k.
        carried: {(i, j, k): B_ijk}.
        gravity: {i: g_i}.
    """

    inertia: Mapping[tuple[int, int], Expr]
    turned: Mapping[Triple, Expr]
    carried: Mapping[Triple, Expr]
    gravity: Mapping[int, Expr]


def write_short_form(model: SymbolicModel, base: BaseParameters, writer: SheetWriter) -> None:
    """Results J_ij (i <= j), S_ijk (j <= k), g_i, e_i by composite bodies, and what they need.

    Where all joints are free, S_kij = -S_jik and S_kii = -S_iik/2 spare their lines.
    """
    beta = symbols_of(model, named_columns(base))
    bodies = _composites(model, beta, writer)
    rows = _rows(model, bodies, writer)
    names = [joint.name for joint in model.robot.free]
    shafts = _shafts(model, beta)
    if model.geometry.tied:
        _name_rows(model, rows, writer)
        _write_tied(model, rows, shafts, names, writer)
    else:
        _write_chain(rows, shafts, names, writer)
    write_effects(model, beta, writer)


def _composites(
    model: SymbolicModel, beta: Mapping[int, Expr], writer: SheetWriter
) -> list[Composite]:
    """Every link with all that it carries, in its frame."""
    zero = model.graph.constant(0)
    links = [Composite(p, zero) for p in model.link_parameters(beta)]
    rows = model.geometry.rows
    for k in reversed(range(len(links))):
        body, name = links[k], rows[k].joint.name
        writer.section(f"link {name} and all that it carries, in frame {name}")
        writer.propose(f"M{name}c", body.M)
        for axis, moment in zip("XYZ", body.MS, strict=True):
            writer.propose(f"M{axis}{name}c", moment)
        for prefix, i, j in _INERTIA:
            writer.propose(f"{prefix}{name}c", body.J[i][j])
        parent = rows[k].parent
        if parent is not None:
            links[parent].carry(body, model.frames[k])
    return links


def _rows(model: SymbolicModel, bodies: Sequence[Composite], writer: SheetWriter) -> _Rows:
    """J, A, B and g of the rows that move."""
    geometry = model.geometry
    down = gravity_in_frames(geometry, model.frames, model.algebra)
    inertia: dict[tuple[int, int], Expr] = {}
    turned: dict[Triple, Expr] = {}
    carried: dict[Triple, Expr] = {}
    gravity: dict[int, Expr] = {}
    everything = screws(geometry, model.frames, model.algebra)
    for row, body, g, chain in zip(geometry.rows, bodies, down, everything, strict=True):
        name, k = row.joint.name, row.index
        if k is None:
            continue
        writer.section(f"axes and gravity in frame {name}")
        for i, screw in sorted(chain.items()):
            other = geometry.robot.moving[i].name
            _name_vector(writer, f"e{other}{{}}_{name}", screw.e)
            _name_vector(writer, f"m{other}{{}}_{name}", screw.m)
        _name_vector(writer, f"g{{}}_{name}", g)
        n, f = _momentum(body, row.joint.angular, row.rate)
        gravity[k] = -_along(chain[k], [*cross(body.MS, g)], [x * body.M for x in g])
        for i, j in combinations_with_replacement(sorted(chain), 2):
            turned[i, j, k] = _turned(body, chain[i], chain[j], row.joint.angular) * row.rate
            if j == k:
                inertia[i, k] = _along(chain[i], n, f)
            if i < j:
                carried[i, j, k] = -_along(_moved(chain[j], chain[i]), n, f)
    return _Rows(inertia, turned, carried, gravity)


def _name_vector(writer: SheetWriter, pattern: str, vector: Vector) -> None:
    for axis, entry in zip(_AXES, vector, strict=True):
        writer.propose(pattern.format(axis), entry)


def _momentum(body: Composite, angular: bool, rate: int) -> tuple[Vector, Vector]:
    """(angular, linear) momentum of a composite body for unit speed of its own joint."""
    zero = body.M * 0
    if angular:
        n = [line[2] * rate for line in body.J]
        return n, [-body.MS[1] * rate, body.MS[0] * rate, zero]
    return [body.MS[1] * rate, -body.MS[0] * rate, zero], [zero, zero, body.M * rate]


def _along(screw: Screw, n: Vector, f: Vector) -> Expr:
    total: Expr = dot(screw.e, n) + dot(screw.m, f)
    return total


def _moved(a: Screw, b: Screw) -> Screw:
    """A x b: how screw b changes while all turns by a."""
    return Screw(cross(a.e, b.e), plus(cross(a.e, b.m), cross(a.m, b.e)))


def _turned(body: Composite, a: Screw, b: Screw, angular: bool) -> Expr:
    """a . (dI/dq) b, where the body turns about z or moves along it."""
    zero = body.M * 0
    x, y, z = body.MS
    J = body.J
    if angular:
        moments = [-y, x, zero]
        slope = [
            [-2 * J[0][1], J[0][0] - J[1][1], -J[1][2]],
            [J[0][0] - J[1][1], 2 * J[0][1], J[0][2]],
            [-J[1][2], J[0][2], zero],
        ]
    else:
        moments = [zero, zero, body.M]
        slope = [[2 * z, zero, -x], [zero, 2 * z, -y], [-x, -y, zero]]
    total: Expr = dot(a.e, [dot(line, b.e) for line in slope])
    return total + dot(moments, plus(cross(a.m, b.e), cross(b.m, a.e)))


def _shafts(model: SymbolicModel, beta: Mapping[int, Expr]) -> dict[tuple[int, int], Expr]:
    """Inertia that turns with shafts: {(i, j): value}, i <= j, of free variables."""
    found: dict[tuple[int, int], Expr] = {}
    for place, value in beta.items():
        for part in model.columns[place].parts:
            if in_block(part, EnergyBlock.KINETIC):
                for i, j in combinations_with_replacement(sorted(part.shaft), 2):
                    added = value * (part.shaft[i] * part.shaft[j])
                    found[i, j] = found.get((i, j), model.graph.constant(0)) + added
    return found


def _write_chain(
    rows: _Rows,
    shafts: Mapping[tuple[int, int], Expr],
    names: Sequence[str],
    writer: SheetWriter,
) -> None:
    """Results where every joint is free."""
    writer.section("inertia matrix, J_ji = J_ij")
    for (i, k), value in sorted(rows.inertia.items()):
        total = value + shafts[i, k] if (i, k) in shafts else value
        writer.result(function_name("J", [names[i], names[k]]), total)
    writer.section("Christoffel coefficients; S_kij = -S_jik and S_kii = -S_iik/2 for i <= j <= k")
    for i, j, k in sorted(rows.turned):
        A, B = rows.turned[i, j, k], rows.carried.get((i, j, k))
        x, y, z = names[i], names[j], names[k]
        if B is None or j == k:
            writer.result(function_name("S", [x, y, z]), A)
            continue
        writer.propose(function_name("A", [x, y, z]), A)
        writer.propose(function_name("B", [x, y, z]), B)
        writer.result(function_name("S", [x, y, z]), A + B)
        writer.result(function_name("S", [y, x, z]), A - B)
    writer.section("gravity")
    for i, value in sorted(rows.gravity.items()):
        writer.result(function_name("g", [names[i]]), value)


def _name_rows(model: SymbolicModel, rows: _Rows, writer: SheetWriter) -> None:
    """Proposals for the tree's entries, whose rows follow the free joints."""
    names = [joint.name for joint in model.robot.moving]
    writer.section("as if every joint were free")
    for letter, entries in (("T", rows.inertia), ("A", rows.turned), ("B", rows.carried)):
        for at, value in sorted(entries.items()):
            writer.propose(function_name(letter, [names[i] for i in at]), value)


def _write_tied(
    model: SymbolicModel,
    rows: _Rows,
    shafts: Mapping[tuple[int, int], Expr],
    names: Sequence[str],
    writer: SheetWriter,
) -> None:
    """Results along the free joints: J_u = E' J E, and so on."""
    forms, zero = model.geometry.forms, model.graph.constant(0)
    inertia: dict[tuple[int, int], Expr] = dict(shafts)
    for (i, k), value in rows.inertia.items():
        for at in [(i, k)] if i == k else [(i, k), (k, i)]:
            for (a, x), (b, y) in _pairs(forms, at):
                if a <= b:
                    inertia[a, b] = inertia.get((a, b), zero) + value * (x * y)
    writer.section("inertia matrix, J_ji = J_ij")
    for at, value in sorted(inertia.items()):
        writer.result(function_name("J", [names[i] for i in at]), value)
    writer.section("Christoffel coefficients")
    for triple, value in sorted(_tied_christoffel(model, rows).items()):
        writer.result(function_name("S", [names[i] for i in triple]), value)
    writer.section("gravity")
    for a, name in enumerate(names):
        total = zero
        for i, value in rows.gravity.items():
            total = total + value * forms[i].get(a, Fraction(0))
        writer.result(function_name("g", [name]), total)


def _pairs(
    forms: Sequence[Mapping[int, Fraction]], at: tuple[int, int]
) -> list[tuple[tuple[int, Fraction], tuple[int, Fraction]]]:
    return [(x, y) for x in forms[at[0]].items() for y in forms[at[1]].items()]


def _tied_christoffel(model: SymbolicModel, rows: _Rows) -> dict[Triple, Expr]:
    """S_abc, b <= c: sums over the rows of half the tree's coefficients, both orders of b, c."""
    forms, zero = model.geometry.forms, model.graph.constant(0)
    found: dict[Triple, Expr] = {}
    for (i, j, k), value in _symbols(rows).items():
        for a, x in forms[i].items():
            for (b, y), (c, z) in _pairs(forms, (j, k)):
                if b <= c:
                    twice = 1 if b == c else 2
                    at = (a, b, c)
                    found[at] = found.get(at, zero) + value * (x * y * z * twice)
    return found


def _symbols(rows: _Rows) -> dict[Triple, Expr]:
    """Christoffel symbols of the tree, {(i, j, k): [jk, i]}, both orders of j and k."""
    found: dict[Triple, Expr] = {}
    half = Fraction(1, 2)
    for (i, j, k), A in rows.turned.items():
        B = rows.carried.get((i, j, k))
        plus_, minus = (A * half, A * half) if B is None else ((A + B) * half, (A - B) * half)
        for at, value in (((i, j, k), plus_), ((j, i, k), minus), ((k, i, j), -minus)):
            found[at] = value
            found[at[0], at[2], at[1]] = value
    return found
