"""What a learned law, and equations that are proposed, do beside the true form of a law."""

from collections.abc import Callable

import numpy as np

from modeler import api
from modeler.core.toml_cells import TomlCell
from modeler.diagnosis import Candidate, analyse_logs, build_state, learn_law
from modeler.diagnosis.candidates import Rows, evaluate_equations
from modeler.diagnosis.state import SearchData
from modeler.effects import read_definition
from tests.unnamed_laws.judge import least_squares, matrices, rows_of_machine, true_column
from tests.unnamed_laws.machines import Machine

Column = Callable[[Rows], np.ndarray]
"""(rows of the joint, k) columns on rows."""

ENOUGH = 2.0  # % of the rms torque that an equation may differ from the true form


def what_is_learned(own: Machine) -> str:
    """A line for each joint that has a law, true or learned: errors without, learned, true."""
    model = api.open_model(own.model)
    compiled = api.compile(model)
    observation = analyse_logs(compiled, api.read_logs(compiled, own.train), model.processing)
    state = build_state(SearchData(compiled, observation), (), model.beta)
    lines = []
    for j, name in enumerate(state.joint_names):
        if own.joint not in (None, name):
            continue
        law = learn_law(state, j)
        if law is None or not law.is_significant:
            lines.append(f"{own.name} joint {name}: nothing is learned")
            continue
        keys = ("low", "high", "cells", "values")
        values = {key: list(getattr(law.law, key)) for key in keys}
        columns = {"x": law.coordinates.equation}
        table = {"columns": columns, **law.coordinates.further, "law": values}
        predicted = Predictions(own, j)
        without = predicted.error()
        learned = predicted.error(column_of(table, {}, state.joint_names, j))
        what = f"{own.name} joint {name}: {law.coordinates.equation}"
        line = f"{what}: {without:.2f} % -> {learned:.2f}"
        if own.truth is not None:
            true = predicted.error(predicted.true)
            line += f", true form {true:.2f}: {(without - learned) / (without - true):.2f} of it"
        lines.append(line)
    return "\n".join(lines)


def what_is_proposed(own: Machine) -> str:
    """The equations proposed on the joint of the law, by how much their torque is another."""
    assert own.truth is not None
    model = api.open_model(own.model)
    result = api.diagnose(model, list(own.train), list(own.holdout), discover=True)
    here = next((d for d in result.discoveries or () if d.joint == own.joint), None)
    predicted = Predictions(own, own.truth.joint)
    names, text = [joint.name for joint in model.spec.joints], []
    for proposal in () if here is None else here.proposals:
        column = column_of(proposal.definition, proposal.finding.parameters, names, own.truth.joint)
        differs = predicted.differs(column)
        text.append(f"{proposal.equation} ({differs:.2f} %{', found' * (differs < ENOUGH)})")
    return f"{own.name}: {'; '.join(text) or 'nothing'}"


def column_of(definition, shapes, names, j):
    """The columns of a definition of `[own_effects]` on joint j, at these shapes or its own."""
    law = read_definition("found", TomlCell("found").with_value(dict(definition)), {}, joints=names)
    local = {s.name: shapes.get(s.name, s.grid[0]) for s in law.forms[0].nonlinear_parameters}
    one = Candidate(law, law.forms[0], names[j], j, local)
    return lambda rows: rows.filter_samples(j, [evaluate_equations([one], s) for s in rows.signals])


class Predictions:
    """Of the held-out torque of joint j, by models with a column more."""

    def __init__(self, own: Machine, j: int) -> None:
        self.own, self.j = own, j
        self.train, self.held = rows_of_machine(own)
        self.size = float(np.sqrt((self.held.y[j] ** 2).mean()))

    def true(self, rows: Rows) -> np.ndarray:
        """The column of the true form."""
        assert self.own.truth is not None
        return true_column(rows, self.own.truth)

    def torque(self, column: Column | None = None) -> np.ndarray:
        """(rows,) of the model that is fitted with it."""
        beta = least_squares(self.train.y, self._with(self.train, column))
        return self._with(self.held, column)[self.j] @ beta

    def _with(self, rows: Rows, column: Column | None) -> list[np.ndarray]:
        return matrices(rows, self.j, None if column is None else column(rows))

    def error(self, column: Column | None = None) -> float:
        """% of the rms torque."""
        left = self.held.y[self.j] - self.torque(column)
        return 100.0 * float(np.sqrt((left**2).mean())) / self.size

    def differs(self, column: Column) -> float:
        """% of the rms torque from that with the true form."""
        left = self.torque(column) - self.torque(self.true)
        return 100.0 * float(np.sqrt((left**2).mean())) / self.size
