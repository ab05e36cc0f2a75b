"""The proof of a grouping modulo a prime."""

import numpy as np

from modeler.derivation.certificate import PRIME, ModularState, modular_rank
from modeler.derivation.columns import StandardColumn, in_block
from modeler.derivation.field import Element, ExactField
from modeler.derivation.geometry import Geometry
from modeler.derivation.grouping import GroupingRelations, friction_relations
from modeler.derivation.result import ModularRank
from modeler.effects.effect import EnergyBlock

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
    known: dict[Element, int] = {}
    for relation, dropped in zip(relations.rows, relations.dropped, strict=True):
        total = np.zeros(rows.shape[0], dtype=np.int64)
        for place, coefficient in relation.items():
            residue = known.get(coefficient)
            if residue is None:
                residue = known[coefficient] = K.residue(coefficient, state.residues, PRIME)
            total = (total + rows[:, place] * residue) % PRIME
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
