"""The torque of a model along a log, in the names, the units and the kind of table of the log."""

from __future__ import annotations  # what a signature names need not be loaded

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from modeler import regression, validation
from modeler.api.log_maps import Mapped, build_log_maps, parse_time_range
from modeler.api.workflow import AnyLog
from modeler.core.manifest import JointSpec
from modeler.core.table import label_values
from modeler.estimation import IdentifiedModel
from modeler.logs import LogTable, split_joints
from modeler.runtime import CompiledModel
from modeler.simulation import SimulatedLog


def predict_torque(
    model: IdentifiedModel, compiled: CompiledModel, log: AnyLog, mapping: Mapped
) -> Any:
    """Predicts the torque at every row; see `Model.predict`."""
    spec = compiled.spec
    if isinstance(log, SimulatedLog):
        log = {"time": log.time, "q": log.q, **log.further}
    if isinstance(log, regression.Log):
        read, names = log, {f"tau{joint.name}": joint.name for joint in spec.joints}
        values = _predict_reliable_rows(model, compiled, read)
        columns = {name: values[:, k] for k, name in enumerate(names)}
    else:
        read, columns = _predict_table(model, compiled, log, mapping)
    if isinstance(log, Mapping):
        return _gather_arrays(columns, log, spec.joints)
    if isinstance(log, str | Path | regression.Log):
        return label_values(
            np.column_stack([*columns.values()]), {"time": read.time}, list(columns)
        )
    kind: Any = type(log)
    if kind.__module__.startswith("pandas"):
        return kind(columns, index=log.index)  # type: ignore[attr-defined]
    return getattr(kind, "from_pydict", kind)(columns)  # of Arrow, and of Polars


def _predict_table(
    model: IdentifiedModel, compiled: CompiledModel, log: Any, mapping: Mapped
) -> tuple[regression.Log, dict[str, np.ndarray]]:
    """The motion of a log, and the torque under the names of its columns, in their units."""
    spec, names, span = compiled.spec, build_log_maps(compiled, [log], mapping)[0], None
    if isinstance(log, str | Path):
        path, span = parse_time_range(log)
        table = LogTable(Path(path), names, spec.joints)
    else:
        table = regression.build_table(log, spec.joints, names, "log")
    read = regression.build_log(table, spec, measured=False)
    if span is not None:
        read = regression.cut_window(read, *span)
    values, columns = _predict_reliable_rows(model, compiled, read), {}
    for k, joint in enumerate(spec.joints):
        tau, current = f"tau{joint.name}", f"current{joint.name}"
        if not joint.actuated and tau not in table:
            continue
        by_current = tau not in table and current in table
        name, gain = (current, joint.drive_gain or 1.0) if by_current else (tau, 1.0)
        torque_column = values[:, k] / gain
        columns[table.find_file_column(name)] = (
            table.convert_to_logged(name, torque_column) if name in table else torque_column
        )
    return read, columns


def _predict_reliable_rows(
    model: IdentifiedModel, compiled: CompiledModel, log: regression.Log
) -> np.ndarray:
    torque, sure = validation.predict_every_row(model, log, compiled)
    return np.where(sure[:, None], torque, np.nan)


def _gather_arrays(
    columns: Mapping[str, np.ndarray], log: Mapping[str, Any], joints: tuple[JointSpec, ...]
) -> dict[str, np.ndarray]:
    """Columns of one array of the dict in an array of its shape; as they are if it has none."""
    arrays = dict(columns)
    rows = len(next(iter(columns.values())))
    for name, like in (("tau", "tau"), ("current", "current"), ("tau", "q")):
        column_names = split_joints(name, np.shape(log.get(like, ())), joints)
        if column_names and set(column_names) & set(arrays):
            none = np.zeros(rows)
            arrays[name] = np.column_stack([arrays.pop(each, none) for each in column_names])
    return arrays
