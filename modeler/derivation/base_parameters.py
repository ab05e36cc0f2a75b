"""From the symbolic model to the base parameters and their proof."""

import numpy as np

from modeler.derivation.ball_rank import ball_rank
from modeler.derivation.elimination import TooLarge
from modeler.derivation.field import ExactField, geometry_field
from modeler.derivation.geometry import Geometry, exact_geometry
from modeler.derivation.grouping import (
    GroupingRelations,
    base_from_relations,
    column_relations,
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
from modeler.derivation.proof import NotProved, certificate
from modeler.derivation.result import (
    BallRank,
    BaseParameters,
    Certificate,
    Proof,
    SampledRank,
    Sampling,
)

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
        _check_general(model)
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


def _check_general(model: SymbolicModel) -> None:
    """Raises NotProved where the given values make the loops close, not any values."""
    if model.special:
        joints = "joint" if len(model.special) == 1 else "joints"
        raise NotProved(
            f"the loops tie {joints} {', '.join(model.special)} to others at the given values only"
        )


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
        proved = ball_rank(model, relations.kept, sample, seed)
    else:
        proved = certificate(geometry, model.columns, K, relations, seed)
    parameters, unidentifiable = base_from_relations(model.columns, relations, K)
    agreement = torque_agreement(model, parameters, seed)
    if agreement > _AGREEMENT:
        raise NotProved(f"base and standard torque differ by {agreement:.1e}")
    proof = Proof(
        kind=_kind(proved, at_nominal=bool(statement)),
        statement=_statement(model)
        + _independent(model, proved, numeric)
        + statement
        + _unproven(model),
        certificate=proved,
        seed=seed,
        numeric_rank=numeric.rank,
        gap=numeric.gap,
        tolerance=numeric.tolerance,
        scale=numeric.scale,
        agreement=agreement,
        sampling=_sampling(model, sample),
    )
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


def _kind(proved: Certificate, at_nominal: bool) -> str:
    """What is exact, in a word or few."""
    values = " at the given values" if at_nominal else ""
    if isinstance(proved, SampledRank):
        return f"relations exact{values}, rank sampled"
    return f"exact{values}"


def _statement(model: SymbolicModel) -> str:
    """The argument of an exact grouping."""
    tied = model.geometry.tied
    if model.closure is None:
        return _TIED if tied else _EXACT
    return _LOOPS.format(tree=_OPEN[tied])


def _independent(model: SymbolicModel, proved: Certificate, numeric: NumericRank) -> str:
    """The argument of the independence, where relations and independence have two."""
    if isinstance(proved, BallRank):
        return _IN_BALLS.format(where=_WHERE[model.closure is not None])
    if isinstance(proved, SampledRank):
        margin = numeric.gap[0] / max(numeric.gap[1], float(np.finfo(float).eps))
        return _SAMPLED.format(why=proved.why, margin=margin)
    return ""


def _unproven(model: SymbolicModel) -> str:
    return _UNPROVEN.format(joints=", ".join(model.unproven)) if model.unproven else ""


def _sampling(model: SymbolicModel, sample: Sample) -> Sampling | None:
    walk = sample.walk
    if walk is None:
        return None
    ends = zip(model.robot.coordinates, walk.lowest, walk.highest, strict=True)
    ranges = {joint.name: (float(low), float(high)) for joint, low, high in ends}
    return Sampling(len(walk.postures), ranges, walk.distance)


def _numeric(
    model: SymbolicModel, sample: Sample, numeric: NumericRank, seed: int, why: str
) -> BaseParameters:
    found = numeric_grouping(model, sample, numeric)
    proved = ball_rank(model, [p.column for p in found.parameters], sample, seed)
    proof = Proof(
        kind="numeric",
        statement=_NUMERIC.format(why=why, bound=found.bound)
        + _independent(model, proved, numeric)
        + _unproven(model),
        certificate=proved,
        seed=seed,
        numeric_rank=numeric.rank,
        gap=numeric.gap,
        tolerance=numeric.tolerance,
        scale=numeric.scale,
        agreement=torque_agreement(model, found.parameters, seed),
        sampling=_sampling(model, sample),
    )
    return BaseParameters(model.columns, found.parameters, found.unidentifiable, proof)
