"""Base torque against standard torque at random states."""

from collections.abc import Mapping

import numpy as np
import sympy

from modeler.base.numeric import random_states, regressor_values
from modeler.base.result import BaseParameter, BaseParameters
from modeler.symbolic import SymbolicModel


def torque_agreement(
    model: SymbolicModel, parameters: tuple[BaseParameter, ...], seed: int
) -> float:
    """Largest |tau_base - tau_standard| / max |tau_standard| at random states and parameters."""
    rng = np.random.default_rng(seed)
    phi = regressor_values(model, random_states(model, 50, rng))
    chi = rng.normal(size=len(model.columns))
    beta = _matrix(model, parameters) @ chi
    kept = [parameter.column for parameter in parameters]
    standard = phi @ chi
    largest = float(np.max(np.abs(standard)))
    return float(np.max(np.abs(phi[:, :, kept] @ beta - standard))) / largest if largest else 0.0


def grouping_matrix(model: SymbolicModel, base: BaseParameters) -> np.ndarray:
    """(rank, columns): beta = K chi at the nominal geometry."""
    return _matrix(model, base.parameters)


def _matrix(model: SymbolicModel, parameters: tuple[BaseParameter, ...]) -> np.ndarray:
    place = {name: i for i, name in enumerate(model.names)}
    K = np.zeros((len(parameters), len(model.columns)))
    known: dict[sympy.Expr, float] = {}
    for i, parameter in enumerate(parameters):
        for term in parameter.terms:
            value = known.get(term.coefficient)
            if value is None:
                value = coefficient_value(term.coefficient, model.geometry.values)
                known[term.coefficient] = value
            K[i, place[term.parameter]] = value
    return K


def coefficient_value(coefficient: sympy.Expr, values: Mapping[str, float]) -> float:
    """A coefficient at the nominal geometry."""
    return float(coefficient.subs({s: values[s.name] for s in coefficient.free_symbols}))
