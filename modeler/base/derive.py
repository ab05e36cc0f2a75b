"""From the symbolic model to the base parameters and their proof."""

import dataclasses
from collections.abc import Mapping

import numpy as np
import sympy

from modeler.base.certificate import PRIME, ModularState, modular_rank
from modeler.base.field import ExactField, geometry_field
from modeler.base.grouping import (
    Relations,
    base_from_relations,
    column_relations,
    has_unproved_columns,
)
from modeler.base.numeric import numeric_rank, random_states, regressor_values
from modeler.base.result import BaseParameters, Proof
from modeler.base.shafts import friction_relations
from modeler.core.errors import DerivationError
from modeler.effects import EnergyBlock
from modeler.symbolic import StandardColumn, SymbolicModel

SEED = 20030914
_CHECKS = 3
_EXACT = (
    "Relations: energy rows (kinetic energy, power of gravity), link by link over the exact field; "
    "they are checked modulo a prime at random states and geometry. Independence: the energy rows "
    "of the base columns have full rank modulo the prime, which is a lower bound of the true rank."
)


def base_parameters(model: SymbolicModel, seed: int = SEED) -> BaseParameters:
    """Base parameters of a serial or tree robot, with exact relations and their proof.

    Raises:
        DerivationError: a priority pattern matches nothing; the exact result and the certificate
            disagree (a defect, or a rotor shared by joints whose links hide it).
    """
    K = geometry_field(model.geometry)
    relations = column_relations(model, K)
    parameters, unidentifiable = base_from_relations(model.columns, relations, K)
    proof = prove(model, K, relations, seed)
    base = BaseParameters(model.columns, parameters, unidentifiable, proof)
    return dataclasses.replace(
        base, proof=dataclasses.replace(proof, agreement=torque_agreement(model, base, seed))
    )


def prove(model: SymbolicModel, K: ExactField, relations: Relations, seed: int) -> Proof:
    """Certificate of the relations: modulo a prime, and in floating point.

    Raises:
        DerivationError: they do not hold, or the base columns are dependent.
    """
    points = len(relations.kept) // 2 + len(model.columns) // 4 + 8
    for check in range(_CHECKS):
        state = ModularState(model.geometry, K, points, seed + check)
        _check_relations(model, K, relations, state)
    exact_rank = _modular_rank(model.columns, relations, state)
    if exact_rank != len(relations.kept):
        shared = has_unproved_columns(model.columns)
        raise DerivationError(
            f"{model.robot.name}: of {len(relations.kept)} columns kept only {exact_rank} are "
            "independent; "
            + (
                "a rotor shared by joints groups with their links: leave out coupled_inertia"
                if shared
                else "this is a defect of the derivation, please report the robot file"
            )
        )
    samples = max(60, 3 * len(model.columns) // max(1, model.geometry.joints))
    phi = regressor_values(model, random_states(model, samples, np.random.default_rng(seed)))
    numeric = numeric_rank(phi, range(len(model.columns)))
    return Proof(
        kind="exact" if numeric.rank == exact_rank else "exact for general lengths only",
        statement=_EXACT,
        prime=PRIME,
        points=_CHECKS * points,
        seed=seed,
        exact_rank=exact_rank,
        numeric_rank=numeric.rank,
        gap=numeric.gap,
        tolerance=numeric.tolerance,
        scale=numeric.scale,
        agreement=float("nan"),
    )


def _check_relations(
    model: SymbolicModel, K: ExactField, relations: Relations, state: ModularState
) -> None:
    rows = np.vstack([state.energy_rows(model.columns), state.rayleigh_rows(model.columns)])
    dry = {
        place
        for place, column in enumerate(model.columns)
        if column.column is not None and column.column.block is EnergyBlock.COULOMB
    }
    for relation, dropped in zip(relations.rows, relations.dropped, strict=True):
        total = np.zeros(rows.shape[0], dtype=np.int64)
        for place, coefficient in relation.items():
            total = (total + rows[:, place] * K.residue(coefficient, state.residues, PRIME)) % PRIME
        if np.any(total) and dropped not in dry:
            raise DerivationError(
                f"{model.robot.name}: the relation of {model.columns[dropped].name} does not hold "
                "modulo the prime; this is a defect of the derivation, please report the robot file"
            )


def _modular_rank(
    columns: tuple[StandardColumn, ...], relations: Relations, state: ModularState
) -> int:
    kept = list(relations.kept)
    energy = modular_rank(state.energy_rows(columns)[:, kept])
    rayleigh = modular_rank(state.rayleigh_rows(columns)[:, kept])
    dry = [
        c for c in (columns[i] for i in kept)
        if c.column is not None and c.column.block is EnergyBlock.COULOMB
    ]  # fmt: skip
    # Columns |v| of pairwise non-proportional speeds are independent: see `modeler.base.shafts`.
    return energy + rayleigh + len(dry) - len(friction_relations(dry))


def torque_agreement(model: SymbolicModel, base: BaseParameters, seed: int) -> float:
    """Largest |tau_base - tau_standard| / max |tau_standard| at random states and parameters."""
    rng = np.random.default_rng(seed)
    phi = regressor_values(model, random_states(model, 50, rng))
    chi = rng.normal(size=len(model.columns))
    beta = grouping_matrix(model, base) @ chi
    kept = [parameter.column for parameter in base.parameters]
    standard = phi @ chi
    return float(np.max(np.abs(phi[:, :, kept] @ beta - standard)) / np.max(np.abs(standard)))


def grouping_matrix(model: SymbolicModel, base: BaseParameters) -> np.ndarray:
    """(rank, columns): beta = K chi at the nominal geometry."""
    place = {name: i for i, name in enumerate(model.names)}
    K = np.zeros((base.rank, len(model.columns)))
    for i, parameter in enumerate(base.parameters):
        for term in parameter.terms:
            K[i, place[term.parameter]] = coefficient_value(term.coefficient, model.geometry.values)
    return K


def coefficient_value(coefficient: sympy.Expr, values: Mapping[str, float]) -> float:
    """A coefficient at the nominal geometry."""
    return float(coefficient.subs({s: values[s.name] for s in coefficient.free_symbols}))
