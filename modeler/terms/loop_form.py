"""Loops that tie the free variables: J_t, J_p and the closure's Jacobian in closed form.

The closure equations f(u) = 0 of the free variables u give df = 0. Where the robot has a platform,
its coordinates p are taken as given first: then every leg stands alone,

    B_leg d(u_leg) = -A_leg dp,    L = -B^-1 A  (the inverse Jacobian of the leg),

the rows of L that belong to the motors are the inverse Jacobian of the robot, K = J_p^-1, and

    p' = J_p q',   u' = J_t q' = L J_p q',   tau = J_t' t_legs + J_p' f_p

with the torques t of the opened tree, those along p being the force f_p of the platform
(Guegan, Khalil and Lemoine 2003, eqs. 11 and 23 to 30; their G of eq. 42 is what the relations
say). Without a platform the actuated joints are given at once and J_t = -B^-1 A. Blocks of up to
four equations are inverted by cofactors, so that only singular postures divide by 0.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from modeler.symbolic import Closure, Expr, SymbolicModel
from modeler.terms.sheet import SheetWriter

_SOLVED = 4
"""Equations up to which a block is inverted by cofactors."""

Matrix = list[list[Expr]]


@dataclass(frozen=True)
class Block:
    """Equations that share unknown speeds.

    Attributes:
        equations: their numbers.
        unknown: places in u.
    """

    equations: tuple[int, ...]
    unknown: tuple[int, ...]

    @property
    def solved(self) -> bool:
        """True if its inverse is worth printing."""
        return len(self.unknown) <= _SOLVED


@dataclass(frozen=True)
class LoopForm:
    """What is printed of the loops.

    Attributes:
        lines: what the names mean, in words and formulas.
        complete: True if J_t is written out; else its rows follow from the blocks by a solver.
    """

    lines: tuple[str, ...]
    complete: bool


def write_loops(model: SymbolicModel, writer: SheetWriter) -> LoopForm:
    """The closure, its Jacobian, J_p, J_t and the bias of the accelerations on a sheet.

    Results, with joints a (actuated), p (given first), u: f<r>, F<r>_<u> = df_r/dq_u, h<r> =
    d/dt(F) u', L<u>_<p>, Jp<p>_<a>, Jt<u>_<a>, b<u> with u'' = J_t q'' + b.

    Args:
        model: of a robot with loops, on the graph of the sheet.
        writer: of the sheet.
    """
    closure = model.closure
    assert closure is not None
    names = [joint.name for joint in model.robot.free]
    given = closure.platform or closure.given
    blocks = _blocks(closure, given, len(names))
    _write_closure(closure, names, writer)
    rates: dict[int, dict[int, Expr]] = {p: {p: model.graph.constant(1)} for p in given}
    bias: dict[int, Expr] = {}
    letter = "L" if closure.platform else "Jt"
    for block in blocks:
        if block.solved:
            _write_block(closure, block, given, names, letter, writer, rates, bias)
    complete = all(block.solved for block in blocks)
    if closure.platform and complete:
        complete = _write_platform(model, closure, names, writer, rates, bias)
    elif complete:
        _write_bias(closure.solved, names, bias, writer)
    return LoopForm(tuple(_words(model, closure, blocks, complete)), complete)


def _blocks(closure: Closure, given: Sequence[int], count: int) -> list[Block]:
    """Connected equations, in the order of their unknowns."""
    unknown = [k for k in range(count) if k not in given]
    found: list[tuple[set[int], set[int]]] = []
    for r, line in enumerate(closure.jacobian):
        reads = {k for k in unknown if not line[k].is_zero}
        touched = [part for part in found if part[1] & reads]
        found = [part for part in found if part not in touched]
        rows = {r}.union(*(part[0] for part in touched))
        found.append((rows, reads.union(*(part[1] for part in touched))))
    blocks = [Block(tuple(sorted(rows)), tuple(sorted(reads))) for rows, reads in found]
    return sorted(blocks, key=lambda block: block.unknown)


def _write_closure(closure: Closure, names: Sequence[str], writer: SheetWriter) -> None:
    writer.section("closure equations, 0 where the loops are closed")
    for r, equation in enumerate(closure.equations, start=1):
        writer.result(f"f{r}", equation)
    for r, (line, drift) in enumerate(zip(closure.jacobian, closure.drift, strict=True), start=1):
        writer.section(f"Jacobian of f{r}, and d/dt(Jacobian) u'")
        for name, entry in zip(names, line, strict=True):
            writer.result(f"F{r}_{name}", entry)
        writer.result(f"h{r}", drift)


def _write_block(
    closure: Closure, block: Block, given: Sequence[int], names: Sequence[str], letter: str,
    writer: SheetWriter, rates: dict[int, dict[int, Expr]], bias: dict[int, Expr],
) -> None:  # fmt: skip
    """L = -B^-1 A and -B^-1 h of one block."""
    told = ", ".join(names[k] for k in block.unknown)
    writer.section(f"speeds of {told} by those of {', '.join(names[k] for k in given)}")
    B = [[closure.jacobian[r][k] for k in block.unknown] for r in block.equations]
    inverse = _inverse(B, f"D{names[block.unknown[0]]}", writer)
    for u, line in zip(block.unknown, inverse, strict=True):
        rates[u] = {}
        for p in given:
            value = -_along(line, [closure.jacobian[r][p] for r in block.equations])
            if not value.is_zero:
                rates[u][p] = value
                writer.result(f"{letter}{names[u]}_{names[p]}", value)
        bias[u] = -_along(line, [closure.drift[r] for r in block.equations])


def _along(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def _inverse(B: Matrix, name: str, writer: SheetWriter) -> Matrix:
    """The inverse by cofactors over the determinant, which gets the name."""
    n = len(B)
    if n == 1:
        return [[1 / B[0][0]]]
    cofactors = [[_cofactor(B, i, j) for j in range(n)] for i in range(n)]
    determinant = _along(B[0], cofactors[0])
    writer.propose(name, determinant)
    return [[cofactors[j][i] / determinant for j in range(n)] for i in range(n)]


def _cofactor(B: Matrix, i: int, j: int) -> Expr:
    rest = [[x for k, x in enumerate(line) if k != j] for r, line in enumerate(B) if r != i]
    minor = _determinant(rest)
    return minor if (i + j) % 2 == 0 else -minor


def _determinant(B: Matrix) -> Expr:
    """By the first row; the graph shares minors."""
    if len(B) == 1:
        return B[0][0]
    return _along(B[0], [_cofactor(B, 0, j) for j in range(len(B))])


def _write_platform(
    model: SymbolicModel, closure: Closure, names: Sequence[str], writer: SheetWriter,
    rates: Mapping[int, Mapping[int, Expr]], bias: dict[int, Expr],
) -> bool:  # fmt: skip
    """J_p, J_t and the bias, if the inverse of K is worth printing."""
    given, motors = closure.platform, closure.given
    assert given is not None
    if len(motors) > _SOLVED:
        return False
    zero = model.graph.constant(0)
    writer.section("J_p, inverse of the motors' rows of L")
    K = [[rates[a].get(p, zero) for p in given] for a in motors]
    inverse = _inverse(K, "Dp", writer)
    for p, line in zip(given, inverse, strict=True):
        for a, value in zip(motors, line, strict=True):
            writer.result(f"Jp{names[p]}_{names[a]}", value)
    offsets = [bias.get(a, zero) for a in motors]
    for p, line in zip(given, inverse, strict=True):
        bias[p] = -_along(line, offsets)
    writer.section("J_t of the legs' passive joints")
    passive = [k for k in rates if k not in given and k not in motors]
    for u in passive:
        row = [rates[u].get(p, zero) for p in given]
        for i, a in enumerate(motors):
            value = _along(row, [line[i] for line in inverse])
            writer.result(f"Jt{names[u]}_{names[a]}", value)
        bias[u] = bias[u] + _along(row, [bias[p] for p in given])
    _write_bias(closure.solved, names, bias, writer)
    return True


def _write_bias(
    solved: Sequence[int], names: Sequence[str], bias: Mapping[int, Expr], writer: SheetWriter
) -> None:
    writer.section("accelerations where the motors' are 0: u'' = J_t q'' + b")
    for u in solved:
        writer.result(f"b{names[u]}", bias[u])


def _words(
    model: SymbolicModel, closure: Closure, blocks: Sequence[Block], complete: bool
) -> list[str]:
    """What the names mean."""
    names = [joint.name for joint in model.robot.free]
    motors = ", ".join(f"q{names[k]}" for k in closure.given)
    lines = [
        f"motors: {motors}; free variables u of the opened tree: "
        + ", ".join(f"q{name}" for name in names)
    ]
    if model.robot.relations:
        ties = [f"q{name} = {text.text}" for name, text in model.robot.relations.items()]
        lines.append("joints that follow (matrix G): " + "; ".join(ties))
    lines.append("f_r(u) = 0, F<r>_<u> = df_r/dq_u, h<r> = d/dt(F_r) u'")
    if closure.platform:
        lines += _platform_words(closure, names, complete)
    elif complete:
        lines.append("u' = J_t q', u'' = J_t q'' + b; Jt<u>_<a>; the motors' own rows are 1 and 0")
        lines.append("tau_a = t_a + sum_u Jt_ua t_u, t: torques of the opened tree along u")
    if not complete and not closure.platform:
        large = [block for block in blocks if not block.solved]
        told = "; ".join(", ".join(names[k] for k in block.unknown) for block in large)
        lines.append(f"J_t = -B^-1 A of F = [A | B] by a solver for {told}: too large to invert")
        lines.append("tau = J_t' t, t: torques of the opened tree along u")
    return lines


def _platform_words(closure: Closure, names: Sequence[str], complete: bool) -> list[str]:
    assert closure.platform is not None
    given = ", ".join(f"q{names[k]}" for k in closure.platform)
    lines = [f"legs by the platform: u' = L p', p = ({given}); L<u>_<p>"]
    if complete:
        lines.append("p' = J_p q', u' = J_t q', u'' = J_t q'' + b; Jp<p>_<a>, Jt<u>_<a>")
    else:
        lines.append("J_p = K^-1, K: the motors' rows of L, by a solver; J_t = L J_p")
    lines.append(
        "tau_a = t_a + sum_u Jt_ua t_u + sum_p Jp_pa f_p, t and f_p: torques of the opened tree "
        "along u and p"
    )
    return lines
