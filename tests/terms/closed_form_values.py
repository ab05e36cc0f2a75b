"""Closed forms as numbers: what the formulas say at one configuration."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin
from typing import Any

from modeler.formulas.closed_form import ClosedForm, Form
from modeler.formulas.ring import TrigRing, evaluate_monomial, evaluate_polynomial


@dataclass(frozen=True)
class Evaluation:
    """Numbers at one configuration.

    Attributes:
        inertia: {(i, j): value}, both triangles.
        christoffel: {(i, j, k): value}, j <= k.
        gravity: {i: value}, with the factored-out letter.
    """

    inertia: Mapping[tuple[int, int], float]
    christoffel: Mapping[tuple[int, int, int], float]
    gravity: Mapping[int, float]

    def torque(self, qd: Sequence[float], qdd: Sequence[float]) -> list[float]:
        """(joints,) torques in N m, forces in N."""
        tau = [self.gravity.get(i, 0.0) for i in range(len(qd))]
        for (i, j), value in self.inertia.items():
            tau[i] += value * qdd[j]
        for (i, j, k), value in self.christoffel.items():
            tau[i] += value * qd[j] * qd[k]
        return tau


def evaluate(closed: ClosedForm, q: Sequence[float], parameters: Mapping[str, float]) -> Evaluation:
    """The functions in floating point at the nominal geometry.

    Args:
        closed: the formulas.
        q: (joints,) positions of the free joints, rad or m.
        parameters: values of the standard parameters by name; those left out are 0.
    """
    algebra = closed.algebra
    moving = motion_values(algebra, q)
    static = algebra.evaluate_static(algebra.geometry.values)
    chi = [parameters.get(name, 0.0) for name in closed.parameters]
    inertia, christoffel, gravity = {}, {}, {}
    factor = closed.algebra.geometry.values.get(closed.gravity_factor, 1.0)
    for function in closed.functions:
        value = sum(
            evaluate_monomial(exponents, moving) * form_value(form, chi, static)
            for exponents, form in function.terms.items()
        )
        if function.kind == "gravity":
            gravity[function.joints[0]] = factor * value
        elif function.kind == "inertia":
            i, j = function.joints
            inertia[i, j] = inertia[j, i] = value
        else:
            i, j, k = function.joints
            christoffel[i, j, k] = value
    return Evaluation(inertia, christoffel, gravity)


def motion_values(algebra: TrigRing, q: Sequence[float]) -> list[float]:
    """Values of the motion generators."""
    values: list[float] = []
    for motion in algebra.motions:
        at = sum(float(coefficient) * q[k] for k, coefficient in motion.form.items())
        values += [at] if motion.variable is not None else [sin(at), cos(at)]
    return values


def form_value(form: Form, chi: Sequence[Any], static: Sequence[Any]) -> Any:
    """The linear form's value."""
    return sum(evaluate_polynomial(poly, static) * chi[column] for column, poly in form.items())
