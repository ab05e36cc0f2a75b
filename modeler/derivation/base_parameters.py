"""From the symbolic model to the base parameters and their proof."""

from functools import cache, partial

import numpy as np

from modeler.derivation.certificate import PRIME, ModularState, compute_modular_rank
from modeler.derivation.columns import StandardColumn, is_in_block
from modeler.derivation.field import CoefficientTooLarge, ExactField, build_geometry_field
from modeler.derivation.geometry import Geometry, build_exact_geometry
from modeler.derivation.grouping import (
    GroupingRelations,
    add_closure_relations,
    build_base_parameters,
    derive_column_relations,
    find_friction_relations,
)
from modeler.derivation.model import SymbolicModel
from modeler.derivation.numeric_rank import (
    NumericRank,
    Sample,
    compare_torques,
    compute_numeric_rank,
    derive_numeric_grouping,
    draw_sample,
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
from modeler.derivation.thresholds import THRESHOLDS
from modeler.effects import EnergyBlock

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


def derive_base_parameters(
    model: SymbolicModel, seed: int = THRESHOLDS.proof_seed
) -> BaseParameters:
    """Returns base parameters of a serial or tree robot, with their relations and proof.

    The relations are exact in the symbols of the robot file. Where the given values make more
    parameters group than general ones would, the relations are exact in those values; where
    the exact answer cannot be had or does not stand the checks, they are numbers, and the proof
    says so.

    Raises:
        DerivationError: a priority pattern matches nothing.
    """
    samples = max(60, 3 * len(model.columns) // max(1, len(model.robot.coordinates)))
    sample = draw_sample(model, samples, seed)
    numeric = compute_numeric_rank(sample, range(len(model.columns)))
    try:
        if model.special:  # loops that close at the given values only
            joints = "joint" if len(model.special) == 1 else "joints"
            raise ProofError(
                f"the loops tie {joints} {', '.join(model.special)} to others at the given values "
                "only"
            )
        return _derive_exact(model, model.geometry, sample, numeric, seed, "")
    except (ProofError, CoefficientTooLarge) as error:
        why = str(error)
    try:
        nominal = build_exact_geometry(model.robot, at_nominal=True)
        statement = _AT_NOMINAL.format(why=why)
        return _derive_exact(model, nominal, sample, numeric, seed, statement)
    except (ProofError, CoefficientTooLarge) as error:
        if str(error) != why:
            why += f"; with these, {error}" if model.special else f"; in numbers, {error}"
        return _derive_numeric(model, sample, numeric, seed, why)


def _derive_exact(
    model: SymbolicModel,
    geometry: Geometry,
    sample: Sample,
    numeric: NumericRank,
    seed: int,
    statement: str,
) -> BaseParameters:
    """Raises NotProved or TooLarge unless everything agrees."""
    K = build_geometry_field(geometry)
    relations = _derive_relations(model, geometry, K, numeric, seed)
    independence: Certificate
    if model.closure is not None:
        from modeler.derivation.enclosed import prove_rank  # most robots have no loops

        independence = prove_rank(model, relations.kept_columns, sample, seed)
    else:
        independence = certify_relations(geometry, model.columns, K, relations, seed)
    grouping = build_base_parameters(model.columns, relations, K, model.robot.has_binary_fractions)
    kind = "exact at the given values" if statement else "exact"
    if isinstance(independence, SampledRank):
        kind = f"relations {kind}, rank sampled"
    tied = model.geometry.has_relations
    if model.closure is None:
        argument = _TIED if tied else _EXACT
    else:
        argument = _LOOPS.format(tree=_OPEN[tied])
    statement = argument + _describe_independence(model, independence, numeric) + statement
    base = _attach_proof(model, grouping, kind, statement, independence, sample, numeric, seed)
    if base.proof.agreement > THRESHOLDS.max_torque_difference:
        raise ProofError(f"base and standard torque differ by {base.proof.agreement:.1e}")
    return base


def _attach_proof(
    model: SymbolicModel, grouping: tuple[tuple[BaseParameter, ...], tuple[str, ...]], kind: str,
    statement: str, independence: Certificate, sample: Sample, numeric: NumericRank, seed: int,
) -> BaseParameters:  # fmt: skip
    """The base parameters and those without effect, with their proof."""
    parameters, unidentifiable = grouping
    if model.unproven:
        statement += _UNPROVEN.format(joints=", ".join(model.unproven))
    sampling, walk = None, sample.walk
    if walk is not None:
        assert model.closure is not None
        moved = walk.postures[:, list(model.closure.actuated)]
        ends = zip(model.robot.coordinates, moved.min(axis=0), moved.max(axis=0), strict=True)
        ranges = {joint.name: (float(low), float(high)) for joint, low, high in ends}
        sampling = Sampling(len(walk.postures), ranges, walk.distance)
    proof = Proof(
        kind, statement, independence, seed, numeric.rank, numeric.gap, numeric.tolerance,
        numeric.scale, compare_torques(model, parameters, seed), sampling,
    )  # fmt: skip
    return BaseParameters(model.columns, parameters, unidentifiable, proof)


def _derive_relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField, numeric: NumericRank, seed: int
) -> GroupingRelations:
    """All relations; raises NotProved where they are not as many as the torques say."""
    relations = derive_column_relations(model, geometry, K, seed)
    if model.closure is not None and len(relations.kept_columns) > numeric.rank:
        relations = add_closure_relations(model, geometry, K, relations, seed)
    if len(relations.kept_columns) != numeric.rank:
        raise ProofError(
            f"the symbols give rank {len(relations.kept_columns)}, the torques at the given values "
            f"{numeric.rank}"
        )
    return relations


def _describe_independence(
    model: SymbolicModel, independence: Certificate, numeric: NumericRank
) -> str:
    """The argument of the independence, where relations and independence have two."""
    if isinstance(independence, BallRank):
        return _IN_BALLS.format(where=_WHERE[model.closure is not None])
    if isinstance(independence, SampledRank):
        margin = numeric.gap[0] / max(numeric.gap[1], float(np.finfo(float).eps))
        return _SAMPLED.format(why=independence.why, margin=margin)
    return ""


def _derive_numeric(
    model: SymbolicModel, sample: Sample, numeric: NumericRank, seed: int, why: str
) -> BaseParameters:
    from modeler.derivation.enclosed import enclose_factors, prove_rank

    exact = partial(enclose_factors, model, sample, seed)
    parameters, unidentifiable, bound = derive_numeric_grouping(model, sample, numeric, exact)
    independence = prove_rank(model, [p.column for p in parameters], sample, seed)
    statement = _NUMERIC.format(why=why, bound=bound) + _describe_independence(
        model, independence, numeric
    )
    grouping = parameters, unidentifiable
    return _attach_proof(model, grouping, "numeric", statement, independence, sample, numeric, seed)


# The proof of a grouping modulo a prime.


class ProofError(Exception):
    """The certificate contradicts the relations; says how."""


def certify_relations(
    geometry: Geometry,
    columns: tuple[StandardColumn, ...],
    K: ExactField,
    relations: GroupingRelations,
    seed: int,
) -> ModularRank:
    """Proves that the relations hold and that the kept columns are independent.

    Raises:
        NotProved: a relation does not hold, or the kept columns are dependent.
    """
    # Without gravity only the kinetic row of each point counts.
    points = len(relations.kept_columns) + 8
    for check in range(THRESHOLDS.proof_checks):
        try:
            state = ModularState(geometry, K, points, seed + check)
            _check_relations(columns, K, relations, state)
        except ValueError as error:  # a constant whose denominator is a multiple of the prime
            raise ProofError(f"a constant has no value modulo {PRIME} ({error})") from None
    rank = _compute_kept_rank(columns, relations, state)
    if rank != len(relations.kept_columns):
        raise ProofError(
            f"of {len(relations.kept_columns)} columns kept only {rank} are independent"
        )
    return ModularRank(rank, PRIME, THRESHOLDS.proof_checks * points, seed)


def _check_relations(
    columns: tuple[StandardColumn, ...],
    K: ExactField,
    relations: GroupingRelations,
    state: ModularState,
) -> None:
    rows = np.vstack([state.compute_energy_rows(columns), state.compute_rayleigh_rows(columns)])
    coulomb_places = {
        place for place, c in enumerate(columns) if is_in_block(c, EnergyBlock.COULOMB)
    }
    residue = cache(partial(K.compute_residue, values=state.residues, prime=PRIME))
    for relation, dropped in zip(relations.rows, relations.dropped_columns, strict=True):
        total = np.zeros(rows.shape[0], dtype=np.int64)
        for place, coefficient in relation.items():
            total = (total + rows[:, place] * residue(coefficient)) % PRIME
        if np.any(total) and dropped not in coulomb_places:
            raise ProofError(f"the relation of {columns[dropped].name} does not hold")


def _compute_kept_rank(
    columns: tuple[StandardColumn, ...], relations: GroupingRelations, state: ModularState
) -> int:
    kept_columns = list(relations.kept_columns)
    left = [columns[i] for i in kept_columns]
    energy = compute_modular_rank(state.compute_energy_rows(columns)[:, kept_columns])
    rayleigh = compute_modular_rank(state.compute_rayleigh_rows(columns)[:, kept_columns])
    coulomb_columns = [column for column in left if is_in_block(column, EnergyBlock.COULOMB)]
    separate_rank = sum(is_in_block(column, EnergyBlock.OWN) for column in left)
    # Columns |v| of pairwise non-proportional speeds are independent: see
    # `modeler.derivation.grouping`.
    return (
        energy
        + rayleigh
        + separate_rank
        + len(coulomb_columns)
        - len(find_friction_relations(coulomb_columns))
    )
