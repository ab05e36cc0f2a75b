"""From the symbolic model to the base parameters and their proof."""

from functools import cache, partial

import numpy as np

from modeler.derivation.certificate import PRIME, ModularState, modular_rank
from modeler.derivation.columns import StandardColumn, in_block
from modeler.derivation.field import ExactField, TooLarge, geometry_field
from modeler.derivation.geometry import Geometry, exact_geometry
from modeler.derivation.grouping import (
    GroupingRelations,
    base_from_relations,
    column_relations,
    friction_relations,
    with_closure_relations,
)
from modeler.derivation.model import SymbolicModel
from modeler.derivation.numeric_rank import (
    NumericRank,
    Sample,
    numeric_grouping,
    numeric_rank,
    sampled,
    torque_agreement,
)
from modeler.derivation.result import (
    BallRank,
    BaseParameter,
    BaseParameters,
    Certificate,
    ModularRank,
    Proof,
    SampledRank,
    Sampling,
)
from modeler.effects import EnergyBlock

SEED = 20030914
_AGREEMENT = 1e-9
_EXACT = (
    "Relations: energy rows (kinetic energy, power of gravity), link by link over the exact field; "
    "they are checked modulo a prime at random states and geometry. Independence: the energy rows "
    "of the base columns have full rank modulo the prime, which is a lower bound of the true rank."
)
_TIED = (
    "Relations: energy rows (kinetic energy, power of gravity) of the tied joints modulo "
    "2**127 - 1; coefficients interpolated as functions of the lengths and angles and checked at "
    "fresh ones; then checked again modulo another prime at random states and geometry. "
    "Independence: the energy rows of the base columns have full rank modulo that prime, which is "
    "a lower bound of the true rank."
)
_LOOPS = (
    "Relations: those of the opened tree ({tree}), for every joint that closes a loop those of the "
    "bodies that move alike with both its sides, and around loops those whose energies are "
    "multiples of the closure equations; all exact in the symbols."
)
_IN_BALLS = (
    " Independence: at {where}, a minor of the torques of the base columns is not 0, for all "
    "numbers that rounding leaves possible (ball arithmetic)."
)
_WHERE = {
    True: "closed postures, proven to exist next to those of the walk (Krawczyk)",
    False: "states of few digits",
}
_SAMPLED = (
    " Independence is not proven: {why}. At random states the torques of the base columns have "
    "full rank; the last singular value kept is {margin:.0e} times the rounding, and a "
    "perturbation must be as large as a singular value to lower a rank (Weyl)."
)
_OPEN = {
    False: "link by link over the exact field",
    True: "interpolated modulo 2**127 - 1 and checked at fresh lengths and angles",
}
_AT_NOMINAL = (
    " This rank belongs to the lengths and angles as given: {why}; so they stand as numbers."
)
_UNPROVEN = " Joints that seemed to follow others, but not provably, are solved for: {joints}."
_NUMERIC = (
    "No exact proof: {why}. Rank and coefficients come from the torques at random states in "
    "floating point; every relation holds there to {bound:.1e} of its column."
)


def base_parameters(model: SymbolicModel, seed: int = SEED) -> BaseParameters:
    """Base parameters of a serial or tree robot, with their relations and proof.

    The relations are exact in the symbols of the robot file. Where the given values make more
    parameters group than general ones would, the relations are exact in those values; where
    the exact answer cannot be had or does not stand the checks, they are numbers, and the proof
    says so.

    Raises:
        DerivationError: a priority pattern matches nothing.
    """
    samples = max(60, 3 * len(model.columns) // max(1, len(model.robot.coordinates)))
    sample = sampled(model, samples, seed)
    numeric = numeric_rank(sample, range(len(model.columns)))
    try:
        if model.special:  # loops that close at the given values only
            joints = "joint" if len(model.special) == 1 else "joints"
            raise NotProved(
                f"the loops tie {joints} {', '.join(model.special)} to others at the given values "
                "only"
            )
        return _exact(model, model.geometry, sample, numeric, seed, "")
    except (NotProved, TooLarge) as error:
        why = str(error)
    try:
        nominal = exact_geometry(model.robot, at_nominal=True)
        statement = _AT_NOMINAL.format(why=why)
        return _exact(model, nominal, sample, numeric, seed, statement)
    except (NotProved, TooLarge) as error:
        if str(error) != why:
            why += f"; with these, {error}" if model.special else f"; in numbers, {error}"
        return _numeric(model, sample, numeric, seed, why)


def _exact(
    model: SymbolicModel,
    geometry: Geometry,
    sample: Sample,
    numeric: NumericRank,
    seed: int,
    statement: str,
) -> BaseParameters:
    """Raises NotProved or TooLarge unless everything agrees."""
    K = geometry_field(geometry)
    relations = _relations(model, geometry, K, numeric, seed)
    proved: Certificate
    if model.closure is not None:
        from modeler.derivation.enclosed import ball_rank  # most robots have no loops

        proved = ball_rank(model, relations.kept, sample, seed)
    else:
        proved = certificate(geometry, model.columns, K, relations, seed)
    found = base_from_relations(model.columns, relations, K, model.robot.halves)
    kind = "exact at the given values" if statement else "exact"
    if isinstance(proved, SampledRank):
        kind = f"relations {kind}, rank sampled"
    tied = model.geometry.tied
    if model.closure is None:
        argument = _TIED if tied else _EXACT
    else:
        argument = _LOOPS.format(tree=_OPEN[tied])
    statement = argument + _independent(model, proved, numeric) + statement
    base = _proved(model, found, kind, statement, proved, sample, numeric, seed)
    if base.proof.agreement > _AGREEMENT:
        raise NotProved(f"base and standard torque differ by {base.proof.agreement:.1e}")
    return base


def _proved(
    model: SymbolicModel, found: tuple[tuple[BaseParameter, ...], tuple[str, ...]], kind: str,
    statement: str, proved: Certificate, sample: Sample, numeric: NumericRank, seed: int,
) -> BaseParameters:  # fmt: skip
    """The base parameters and those without effect, with their proof."""
    parameters, unidentifiable = found
    if model.unproven:
        statement += _UNPROVEN.format(joints=", ".join(model.unproven))
    sampling, walk = None, sample.walk
    if walk is not None:
        assert model.closure is not None
        moved = walk.postures[:, list(model.closure.given)]
        ends = zip(model.robot.coordinates, moved.min(axis=0), moved.max(axis=0), strict=True)
        ranges = {joint.name: (float(low), float(high)) for joint, low, high in ends}
        sampling = Sampling(len(walk.postures), ranges, walk.distance)
    proof = Proof(
        kind, statement, proved, seed, numeric.rank, numeric.gap, numeric.tolerance,
        numeric.scale, torque_agreement(model, parameters, seed), sampling,
    )  # fmt: skip
    return BaseParameters(model.columns, parameters, unidentifiable, proof)


def _relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField, numeric: NumericRank, seed: int
) -> GroupingRelations:
    """All relations; raises NotProved where they are not as many as the torques say."""
    relations = column_relations(model, geometry, K, seed)
    if model.closure is not None and len(relations.kept) > numeric.rank:
        relations = with_closure_relations(model, geometry, K, relations, seed)
    if len(relations.kept) != numeric.rank:
        raise NotProved(
            f"the symbols give rank {len(relations.kept)}, the torques at the given values "
            f"{numeric.rank}"
        )
    return relations


def _independent(model: SymbolicModel, proved: Certificate, numeric: NumericRank) -> str:
    """The argument of the independence, where relations and independence have two."""
    if isinstance(proved, BallRank):
        return _IN_BALLS.format(where=_WHERE[model.closure is not None])
    if isinstance(proved, SampledRank):
        margin = numeric.gap[0] / max(numeric.gap[1], float(np.finfo(float).eps))
        return _SAMPLED.format(why=proved.why, margin=margin)
    return ""


def _numeric(
    model: SymbolicModel, sample: Sample, numeric: NumericRank, seed: int, why: str
) -> BaseParameters:
    from modeler.derivation.enclosed import ball_rank, enclosed_factors

    exact = partial(enclosed_factors, model, sample, seed)
    parameters, unidentifiable, bound = numeric_grouping(model, sample, numeric, exact)
    proved = ball_rank(model, [p.column for p in parameters], sample, seed)
    statement = _NUMERIC.format(why=why, bound=bound) + _independent(model, proved, numeric)
    found = parameters, unidentifiable
    return _proved(model, found, "numeric", statement, proved, sample, numeric, seed)


# The proof of a grouping modulo a prime.


_CHECKS = 3


class NotProved(Exception):
    """The certificate contradicts the relations; says how."""


def certificate(
    geometry: Geometry,
    columns: tuple[StandardColumn, ...],
    K: ExactField,
    relations: GroupingRelations,
    seed: int,
) -> ModularRank:
    """The relations hold at random states and geometries, and the kept columns are independent.

    Raises:
        NotProved: a relation does not hold, or the kept columns are dependent.
    """
    # Without gravity only the kinetic row of each point counts.
    points = len(relations.kept) + 8
    for check in range(_CHECKS):
        try:
            state = ModularState(geometry, K, points, seed + check)
            _check_relations(columns, K, relations, state)
        except ValueError as error:  # a constant whose denominator is a multiple of the prime
            raise NotProved(f"a constant has no value modulo {PRIME} ({error})") from None
    rank = _modular_rank(columns, relations, state)
    if rank != len(relations.kept):
        raise NotProved(f"of {len(relations.kept)} columns kept only {rank} are independent")
    return ModularRank(rank, PRIME, _CHECKS * points, seed)


def _check_relations(
    columns: tuple[StandardColumn, ...],
    K: ExactField,
    relations: GroupingRelations,
    state: ModularState,
) -> None:
    rows = np.vstack([state.energy_rows(columns), state.rayleigh_rows(columns)])
    dry = {place for place, c in enumerate(columns) if in_block(c, EnergyBlock.COULOMB)}
    residue = cache(partial(K.residue, values=state.residues, prime=PRIME))
    for relation, dropped in zip(relations.rows, relations.dropped, strict=True):
        total = np.zeros(rows.shape[0], dtype=np.int64)
        for place, coefficient in relation.items():
            total = (total + rows[:, place] * residue(coefficient)) % PRIME
        if np.any(total) and dropped not in dry:
            raise NotProved(f"the relation of {columns[dropped].name} does not hold")


def _modular_rank(
    columns: tuple[StandardColumn, ...], relations: GroupingRelations, state: ModularState
) -> int:
    kept = list(relations.kept)
    left = [columns[i] for i in kept]
    energy = modular_rank(state.energy_rows(columns)[:, kept])
    rayleigh = modular_rank(state.rayleigh_rows(columns)[:, kept])
    dry = [column for column in left if in_block(column, EnergyBlock.COULOMB)]
    own = sum(in_block(column, EnergyBlock.OWN) for column in left)
    # Columns |v| of pairwise non-proportional speeds are independent: see
    # `modeler.derivation.grouping`.
    return energy + rayleigh + own + len(dry) - len(friction_relations(dry))
