"""The equation of motion, and the regressor, in closed form with the words that explain them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, get_args

from modeler.core.errors import DerivationError, RobotError
from modeler.core.formula import Formulas
from modeler.derivation import (
    ALL,
    LOOP_JOINTS,
    BaseParameters,
    Closure,
    Expr,
    ShaftColumn,
    SymbolicModel,
    combine_along_shaft,
    compute_loop_frames,
    compute_poses,
    plus,
    times,
)
from modeler.formulas import short_form
from modeler.formulas.function_sheet import FormulaForm, Sheet, SheetWriter, format_sheet
from modeler.formulas.ring import TrigRing, evaluate_polynomial
from modeler.formulas.thresholds import THRESHOLDS

# Loops that tie the free variables: J_t, J_p and the closure's Jacobian in closed form.
#
# The closure equations f(u) = 0 of the free variables u give df = 0. Where the robot has a
# platform, its coordinates p are taken as given first: then every leg stands alone,
#
#     B_leg d(u_leg) = -A_leg dp,    L = -B^-1 A  (the inverse Jacobian of the leg),
#
# the rows of L that belong to the motors are the inverse Jacobian of the robot, K = J_p^-1, and
#
#     p' = J_p q',   u' = J_t q' = L J_p q',   tau = J_t' t_legs + J_p' t_p
#
# with the torques t of the opened tree, those along p being the force on the platform
# (Guegan, Khalil and Lemoine 2003, eqs. 11 and 23 to 30; their G of eq. 42 is what the relations
# say). Without a platform the actuated joints are given at once and J_t = -B^-1 A. Blocks of up to
# four equations are inverted by cofactors, so that only singular postures divide by 0.


Matrix = list[list[Expr]]


Block = tuple[list[int], list[int]]
"""Numbers of equations that share unknown speeds, and the places of these in u."""


def write_loops(model: SymbolicModel, writer: SheetWriter) -> list[str]:
    """Writes the closure, its Jacobian, J_p, J_t and the bias of the accelerations on a sheet.

    Results, with joints a (actuated), p (given first), u: f<r>, F<r>_<u> = df_r/dq_u, h<r> =
    d/dt(F) u', L<u>_<p>, Jp<p>_<a>, Jt<u>_<a>, b<u> with u'' = J_t q'' + b.

    Args:
        model: of a robot with loops, on the graph of the sheet.
        writer: of the sheet.
    """
    closure = model.closure
    assert closure is not None
    return _LoopWriter(model, closure, writer).write()


def find_connected_blocks(closure: Closure, independent: Sequence[int], count: int) -> list[Block]:
    """Returns blocks of connected equations, in the order of their unknowns."""
    unknown = [k for k in range(count) if k not in independent]
    components: list[tuple[set[int], set[int]]] = []
    for r, line in enumerate(closure.jacobian):
        reads = {k for k in unknown if not line[k].is_zero}
        touched = [part for part in components if part[1] & reads]
        components = [part for part in components if part not in touched]
        rows = {r}.union(*(part[0] for part in touched))
        components.append((rows, reads.union(*(part[1] for part in touched))))
    blocks = [(sorted(rows), sorted(reads)) for rows, reads in components]
    return sorted(blocks, key=lambda block: block[1])


def multiply_rows(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """Returns sum_k a_k b_k, of expressions or of other elements of a field."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def invert_matrix(B: Matrix, name: str, writer: SheetWriter) -> Matrix:
    """Returns the inverse by cofactors over the determinant, which gets the name."""
    n = len(B)
    if n == 1:
        return [[1 / B[0][0]]]
    cofactors = [[compute_cofactor(B, i, j) for j in range(n)] for i in range(n)]
    determinant = multiply_rows(B[0], cofactors[0])
    writer.propose_quantity(name, determinant)
    return [[cofactors[j][i] / determinant for j in range(n)] for i in range(n)]


def compute_cofactor(B: Sequence[Sequence[Any]], i: int, j: int) -> Any:
    """Returns the signed minor of B without row i and column j; 1 of a matrix of one entry."""
    if len(B) == 1:
        return 1
    rest = [[x for k, x in enumerate(line) if k != j] for r, line in enumerate(B) if r != i]
    minors = [compute_cofactor(rest, 0, k) for k in range(len(rest))]
    minor = multiply_rows(rest[0], minors)  # the graph shares them
    return minor if (i + j) % 2 == 0 else -minor


class _LoopWriter:
    """Writes the loops of a model: speeds and bias of the joints that follow, block by block."""

    def __init__(self, model: SymbolicModel, closure: Closure, writer: SheetWriter) -> None:
        self.model, self.closure, self.writer = model, closure, writer
        self.names = [joint.name for joint in model.robot.free_joints]
        self.zero, one = model.graph.constant(0), model.graph.constant(1)
        self.independent = closure.platform or closure.actuated
        self.rates: dict[int, dict[int, Expr]] = {p: {p: one} for p in self.independent}
        self.bias: dict[int, Expr] = {}

    def write(self) -> list[str]:
        """Returns what the names mean."""
        blocks = find_connected_blocks(self.closure, self.independent, len(self.names))
        self._write_closure()
        spheres = self._write_spheres()
        small = [b for b in blocks if len(b[1]) <= THRESHOLDS.max_block_equations]
        for equations, unknown in small:
            self._write_block(equations, unknown)
        complete = len(small) == len(blocks)
        if self.closure.platform and complete:
            complete = self._write_platform(self.closure.platform, self.closure.actuated)
        if complete:
            self.writer.open_section("accelerations where the motors' are 0: u'' = J_t q'' + b")
            for u in self.closure.solved:
                self.writer.add_result(f"b{self.names[u]}", self.bias[u])
        return self._describe_loops(complete, spheres)

    def _write_closure(self) -> None:
        closure, writer = self.closure, self.writer
        writer.open_section("closure equations, 0 where the loops are closed")
        for r, equation in enumerate(closure.equations, start=1):
            writer.add_result(f"f{r}", equation)
        lines = zip(closure.jacobian, closure.drift, strict=True)
        for r, (line, drift) in enumerate(lines, start=1):
            writer.open_section(f"Jacobian of f{r}, and d/dt(Jacobian) u'")
            for name, entry in zip(self.names, line, strict=True):
                writer.add_result(f"F{r}_{name}", entry)
            writer.add_result(f"h{r}", drift)

    def _write_spheres(self) -> bool:
        """|e|^2 - |w|^2 of e + w = 0, all passive joints in w; True if any |w| is without them."""
        model, closure, writer = self.model, self.closure, self.writer
        try:
            ring = TrigRing(model.geometry)
        except DerivationError:  # lengths that are no polynomials
            return False
        writer.open_section("closure equations without the passive joints")
        passive = {*closure.solved} - {*(closure.platform or ())}
        places = [(m.sine, m.cosine, m.variable) for m in ring.motions if passive & {*m.form}]
        turned = [k for each in places for k in each if k is not None]
        generators = list[Expr]()  # of the ring, as expressions of the graph
        call = model.graph.call
        for motion in ring.motions:
            at = combine_along_shaft(model, motion.form, "q")
            generators += (
                [at] if motion.variable is not None else [call("sin", at), call("cos", at)]
            )
        generators += [model.algebra.static(atom) for atom in ring.static_atoms]
        frames, is_written = compute_poses(model.geometry, ring), False
        for number, loop in enumerate(model.robot.loops, start=1):
            joint = LOOP_JOINTS[loop.kind]
            one, other = compute_loop_frames(model.geometry, loop, frames, ring)
            square, total = ring.ring.zero, model.graph.constant(0)
            for entry in plus(one[1], times(-1, other[1])) if joint.velocity == ALL else ():
                entry = ring.normalise_polynomial(ring.ring(entry))
                moved = {e: x for e, x in entry.items() if any(e[k] for k in turned)}
                w = ring.ring.zero.new(moved)
                e = evaluate_polynomial(entry - w, generators)
                square, total = square + w**2, total + e * e
            square = ring.normalise_polynomial(square)
            if square and not any(at[k] for at in square for k in turned):
                writer.add_result(f"fp{number}", total - evaluate_polynomial(square, generators))
                is_written = True
        return is_written

    def _write_block(self, equations: Sequence[int], unknown: Sequence[int]) -> None:
        """L = -B^-1 A and -B^-1 h of one block."""
        jacobian, names = self.closure.jacobian, self.names
        sides = (", ".join(names[k] for k in at) for at in (unknown, self.independent))
        self.writer.open_section("speeds of {} by those of {}".format(*sides))
        B = [[jacobian[r][k] for k in unknown] for r in equations]
        inverse = invert_matrix(B, f"D{names[unknown[0]]}", self.writer)
        letter = "L" if self.closure.platform else "Jt"
        for u, line in zip(unknown, inverse, strict=True):
            self.rates[u] = {}
            for p in self.independent:
                value = -multiply_rows(line, [jacobian[r][p] for r in equations])
                if not value.is_zero:
                    self.rates[u][p] = value
                    self.writer.add_result(f"{letter}{names[u]}_{names[p]}", value)
            self.bias[u] = -multiply_rows(line, [self.closure.drift[r] for r in equations])

    def _write_platform(self, platform: Sequence[int], motors: Sequence[int]) -> bool:
        """J_p, J_t and the bias, if the inverse of K is worth printing."""
        if len(motors) > THRESHOLDS.max_block_equations:
            return False
        names, rates, bias = self.names, self.rates, self.bias
        zero, writer = self.zero, self.writer
        writer.open_section("J_p, inverse of the motors' rows of L")
        K = [[rates[a].get(p, zero) for p in platform] for a in motors]
        inverse = invert_matrix(K, "Dp", writer)
        for p, line in zip(platform, inverse, strict=True):
            for a, value in zip(motors, line, strict=True):
                writer.add_result(f"Jp{names[p]}_{names[a]}", value)
        offsets = [bias.get(a, zero) for a in motors]
        for p, line in zip(platform, inverse, strict=True):
            bias[p] = -multiply_rows(line, offsets)
        writer.open_section("J_t of the legs' passive joints")
        for u in [k for k in rates if k not in platform and k not in motors]:
            row = [rates[u].get(p, zero) for p in platform]
            for i, a in enumerate(motors):
                value = multiply_rows(row, [line[i] for line in inverse])
                writer.add_result(f"Jt{names[u]}_{names[a]}", value)
            bias[u] = bias[u] + multiply_rows(row, [bias[p] for p in platform])
        return True

    def _describe_loops(self, complete: bool, spheres: bool) -> list[str]:
        """What the names mean."""
        closure, names, relations = self.closure, self.names, self.model.robot.relations
        motors = ", ".join(f"q{names[k]}" for k in closure.actuated)
        free = ", ".join(f"q{name}" for name in names)
        lines = [f"motors: {motors}; free variables u of the opened tree: {free}"]
        if relations:
            ties = [f"q{name} = {text.text}" for name, text in relations.items()]
            lines.append("joints that follow (matrix G): " + "; ".join(ties))
        lines.append("f_r(u) = 0, F<r>_<u> = df_r/dq_u, h<r> = d/dt(F_r) u'")
        if spheres:
            lines.append(
                "fp<k> = 0: loop k without its passive joints (Briot and Gautier 2012: f_p)"
            )
        platform_names = ", ".join(f"q{names[k]}" for k in closure.platform or ())
        if platform_names:
            lines.append(f"legs by the platform: u' = L p', p = ({platform_names}); L<u>_<p>")
        if complete:
            rows = "Jp<p>_<a> of p, Jt<u>_<a> of the others" if platform_names else "Jt<u>_<a>"
            lines.append(f"u' = J_t q', u'' = J_t q'' + b; rows of J_t: {rows}; of motors: 1 and 0")
        else:
            lines.append(
                "u' = J_t q', u'' = J_t q'' + b by a solver, too large to write: F J_t = 0, "
                "F b = -h, motors' rows of J_t 1 and 0, of b 0"
            )
        lines.append("tau = J_t' t, t: torques of the opened tree along u")
        return lines


_AXES = "xyz"


@dataclass(frozen=True, eq=False)
class Equation:
    """Formulas, and the equation in which they stand.

    Attributes:
        words: sentences: the equation in which they stand.
        sheet: the formulas, with their abbreviations.
        loops: what the names of its loops mean; empty without loops.
    """

    words: tuple[str, ...]
    sheet: Sheet
    loops: tuple[str, ...]

    def format_formulas(self) -> Formulas:
        """Returns the formulas as text, LaTeX and Markdown."""
        text, latex, markdown = (format_sheet(self.sheet, form) for form in get_args(FormulaForm))
        return Formulas("; ".join(self.words), text, latex, markdown)


def derive_short_form(model: SymbolicModel, base: BaseParameters) -> Equation:
    """Derives J(q), S(q), g(q) and the effects' torques in abbreviated closed form."""
    return derive_equation(model, base, motion=True)


def derive_regressor_form(model: SymbolicModel, base: BaseParameters) -> Equation:
    """Returns the columns of the base parameters in closed form."""
    return derive_equation(model, base, columns=True)


def derive_equation(
    model: SymbolicModel, base: BaseParameters, *, motion: bool = False, columns: bool = False
) -> Equation:
    """Derives the equation of motion, the columns, or both on one sheet."""
    model = short_form.copy_model(model)
    letters = short_form.collect_symbol_names(model, short_form.get_base_columns(base))
    writer = SheetWriter(model.graph, letters, model.robot.has_binary_fractions)
    loops = write_loops(model, writer) if model.closure is not None else []
    words = []
    if motion:
        short_form.write_short_form(model, base, writer)
        words.append(
            f"{'t_i' if loops else 'tau_i'} = sum_j J_ij qdd_j + sum_{{j<=k}} S_ijk qd_j qd_k + "
            "g_i + e_i; e: friction, offsets and all other effects but rotor inertias, which are "
            "in J; what is not listed is 0"
        )
        kinds = {column.name: column.kind for column in base.columns}
        both = {"inertial", "offset"}
        mixed = [
            p.name for p in base.parameters if {kinds[term.parameter] for term in p.terms} >= both
        ]
        if mixed:
            words.append(f"constant gravity and an offset in one, in e or in g: {', '.join(mixed)}")
    if columns:
        write_columns(model, base, writer)
        tau = "t" if loops else "tau"
        words.append(f"{tau} = phi beta, phi<joint>_<parameter>; what is not listed is 0")
    if model.windups:
        words.append("q, qd, qdd of links behind elastic joints are those of the links: q - e")
    words += [*_describe_signals(model), *_describe_laws(model), *loops]
    return Equation(tuple(words), writer.build_sheet(), tuple(loops))


def _describe_signals(model: SymbolicModel) -> list[str]:
    """What the letters are that effects read besides the motion."""
    letters = short_form.get_signal_letters(model)
    descriptions = [
        f"{letter}: {signal.kind}"
        + (f" of joint {model.robot.joints[signal.row].name}" if signal.row >= 0 else "")
        for letter, signal in zip(letters, model.signals, strict=True)
    ]
    return ["; ".join(descriptions)] if descriptions else []


def _describe_laws(model: SymbolicModel) -> list[str]:
    """What the functions are that no formula says."""
    parts = (p for c in model.columns if isinstance(c, ShaftColumn) for p in c.parts)
    effects = {part.equation.law: part.effect for part in parts}
    tables = (item for item in model.graph.tables.items() if item[1].along is None)
    text = "{} is the law of [own_effects.{}], held beyond its ends"
    descriptions = [text.format(name, effects[table.law]) for name, table in tables]
    return ["; ".join(descriptions)] if descriptions else []


def write_columns(model: SymbolicModel, base: BaseParameters, writer: SheetWriter) -> None:
    """Writes phi<joint>_<parameter>, N m or N per unit, and what they need.

    Each intermediate quantity once. Newton and Euler in screw form (Khalil and Dombre 2002, 9.5 and
    9.6), as in the emitted code: w, wd and vd are angular velocity, angular acceleration and
    acceleration of the origin less gravity of a link in its own frame, U = [wd x] + [w x][w x], e
    and m the rotation of the link and the velocity of its origin for unit speed of a joint. The
    wrench that one unit of a parameter needs, projected on these, is its column.

    With loops they are the opened tree's, and `write_loops` says how its variables are tied.
    """
    propose_motion(model, writer)
    names = [joint.name for joint in model.robot.free_joints]
    for parameter in base.parameters:
        writer.open_section(f"column of {parameter.name}")
        for i, name in enumerate(names):
            value = model.regressor.get((i, parameter.column))
            if value is not None:
                writer.add_result(f"phi{name}_{parameter.name}", value)


def propose_motion(model: SymbolicModel, writer: SheetWriter) -> None:
    """Proposes names for the quantities of the recursion, link after link."""
    geometry = model.geometry
    moved = model.derive_link_motions(model.get_inputs("qd"), model.get_inputs("qdd"))
    for row, motion, chain in zip(geometry.rows, moved, model.free_screws, strict=True):
        name = row.joint.name
        writer.open_section(f"motion of link {name}, in frame {name}")
        for letter, vector in (("w", motion.w), ("wd", motion.wd), ("vd", motion.vd)):
            short_form.propose_vector(writer, f"{letter}{{}}_{name}", vector)
        for axis, line in zip(_AXES, motion.U, strict=True):
            short_form.propose_vector(writer, f"U{axis}{{}}_{name}", line)
        for k, screw in sorted(chain.items()):
            free = model.robot.free_joints[k].name
            for axis, e, m in zip(_AXES, screw.e, screw.m, strict=True):
                writer.propose_quantity(f"e{free}{axis}_{name}", e)
                writer.propose_quantity(f"m{free}{axis}_{name}", m)


# Which base parameters are 0 at the nominal values: what printed models leave out.


def drop_zero_parameters(model: SymbolicModel, base: BaseParameters) -> BaseParameters:
    """Returns the base parameters that are not 0 at the nominal values of `[parameters]`.

    Parameters of effects stay: their values are rarely known beforehand. The formulas hold for any
    values of those that are left, the others being 0.

    Raises:
        RobotError: the robot file states no values of inertial parameters.
    """
    known, lengths = model.robot.parameters, model.geometry.values
    parameters = []
    for parameter in base.parameters:
        sizes = []
        for term in parameter.terms:
            letters = {s: lengths[s.name] for s in term.coefficient.free_symbols}
            sizes.append(float(term.coefficient.subs(letters)) * known.get(term.parameter, 0.0))
        link = base.columns[parameter.column].kind == "inertial"
        if not link or abs(sum(sizes)) > THRESHOLDS.zero_parameter * sum(map(abs, sizes)):
            parameters.append(parameter)
    if not any(base.columns[parameter.column].kind == "inertial" for parameter in parameters):
        raise RobotError(
            f"robot {model.robot.name}: all inertial base parameters are 0 at its nominal values; "
            "state them in [parameters], or leave out --nonzero"
        )
    return replace(base, parameters=tuple(parameters))
