"""Logs that are in memory: frames of pandas, Polars and all that speaks Arrow, dicts of arrays."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import numpy as np
import pyarrow as pa

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs.arrays import NamedArray, build_columns
from modeler.logs.blocks import build_arrow_columns
from modeler.logs.clock_times import find_origins, is_moment
from modeler.logs.columns import ColumnRequest, Columns
from modeler.logs.datasets import flatten_table

_PER_JOINT = ("q", "qd", "qdd", "qc", "tau", "current", "duty", "voltage")


@runtime_checkable
class Frame(Protocol):
    """A table that hands out its columns as Arrow does (the Arrow PyCapsule interface).

    Frames of pandas (2.2 and later) and of Polars, tables of Arrow and of DuckDB are such.
    """

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """A capsule with a stream of its rows."""


InMemory = Frame | Mapping[str, Any]
"""A frame, or arrays by name: one column each, or (rows, joints) for `q`, `tau` and the like."""


def build_frame_columns(frame: InMemory, where: str, joints: Sequence[JointSpec] = ()) -> Columns:
    """The columns of a frame, or of a dict of arrays.

    >>> build_frame_columns({"time": range(20), "q": np.zeros((20, 2))}, "run").rows
    20

    Args:
        frame: it; an index that is not just counted is a column too, dates without a name the time.
        where: what messages call it.
        joints: of the robot: an array (rows, joints) of our name has a column for each, one
            (rows, actuated joints) for each of those.

    Raises:
        DataError: no frame, or nothing that could be a log.
    """
    if isinstance(frame, Mapping):
        return build_columns(
            Path(where), "dict", list(_list_arrays(frame, where, joints)), ColumnRequest()
        )
    try:
        table = pa.table(frame)
        table = table.rename_columns([_name_column(field, table) for field in table.schema])
        return build_arrow_columns(flatten_table(table, None), 0, find_origins(table))
    except (pa.ArrowException, TypeError, ValueError) as error:
        message = " ".join(str(error).split())[:200]
        raise DataError(
            f"{where}: this frame has columns that Arrow does not know ({message}); expected "
            "numbers "
            "in every column; drop or convert the others"
        ) from None


def _name_column(field: pa.Field, table: pa.Table) -> str:
    """The name of a column; of an index of pandas without one, of dates or times, `time`."""
    nameless = field.name.startswith("__index_level_") and is_moment(field.type)
    return "time" if nameless and "time" not in table.column_names else str(field.name)


def _list_arrays(
    arrays: Mapping[str, Any], where: str, joints: Sequence[JointSpec]
) -> Iterator[NamedArray]:
    for name, values in arrays.items():
        array = np.asarray(values)
        if array.dtype.kind in "Mm" and array.size:  # dates and times: s since the first
            array = (array - array.flat[0]) / np.timedelta64(1, "s")
        if array.dtype.kind == "O" or not array.ndim:
            raise DataError(
                f"{where}: got {type(values).__name__} as {name}; expected an array of numbers, "
                "one for each row"
            )
        joint_columns = split_joints(str(name), array.shape, joints)
        if joint_columns:
            yield from (NamedArray(each, array[:, k]) for k, each in enumerate(joint_columns))
        else:
            yield NamedArray(str(name), array)


def split_joints(name: str, shape: tuple[int, ...], joints: Sequence[JointSpec]) -> list[str]:
    """The columns that an array of our name stands for; none of another one.

    Args:
        name: "q", "tau" ...
        shape: of it.
        joints: of the robot.
    """
    if name not in _PER_JOINT or len(shape) != 2:
        return []
    every = (joints, [joint for joint in joints if joint.actuated])
    selected_joints = next((some for some in every if len(some) == shape[1]), ())
    return [f"{name}{joint.name}" for joint in selected_joints]
