"""Arrays that callers give: shapes, numbers, and what a robot's functions do not read."""

from typing import Any

import numpy as np

from modeler.core.errors import ShapeError


def check_samples(value: Any, name: str, joints: int, finite: bool = True) -> np.ndarray:
    """Returns `value` as a C-contiguous float64 array (n, joints).

    A copy only if it is not that already.

    Args:
        value: anything numpy makes an array of.
        name: of the argument, for messages.
        joints: number of columns.
        finite: False to let values pass that are not finite.

    Raises:
        ShapeError: another shape, not real numbers, or a value that is not finite; says which row.
    """
    array = _convert_floats(value, name, f"an array (samples, {joints})")
    if array.ndim != 2 or array.shape[1] != joints:
        raise ShapeError(
            f"{name}: got shape {array.shape}, expected (samples, {joints})"
            f"{_suggest_shape(array, name, joints)}"
        )
    if finite and not (good := np.isfinite(array)).all():
        row, column = (int(i) for i in np.argwhere(~good)[0])
        raise ShapeError(
            f"{name}: got {array[row, column]} in row {row}, column {column} (counted from 0), "
            "expected finite numbers; leave such samples out"
        )
    return array


def check_mask(value: Any, name: str, shape: tuple[int, ...]) -> np.ndarray:
    """Returns `value` as a C-contiguous bool array of that shape.

    Raises:
        ShapeError: another shape, or anything but True and False.
    """
    array = np.asarray(value)
    if array.shape != shape or array.dtype != np.bool_:
        raise ShapeError(
            f"{name}: got shape {array.shape} of type {array.dtype}, expected {shape} of bool"
        )
    return np.ascontiguousarray(array)


def reject_signals(value: Any, robot: str) -> None:
    """Checks that `value` holds no signals, for a robot whose effects read none.

    Raises:
        ShapeError: it holds some.
    """
    if value is not None and np.size(value):
        raise ShapeError(f"{robot}: got s, but its effects read no signals; leave s out")


def check_vector(value: Any, name: str, length: int) -> np.ndarray:
    """Returns `value` as a C-contiguous float64 array (length,).

    Raises:
        ShapeError: another shape, not real numbers, or a value that is not finite.
    """
    array = _convert_floats(value, name, f"an array ({length},)")
    if array.shape != (length,):
        raise ShapeError(f"{name}: got shape {array.shape}, expected ({length},)")
    finite = np.isfinite(array)
    if not finite.all():
        entry = int(np.argmin(finite))
        raise ShapeError(
            f"{name}: got {array[entry]} in entry {entry} (counted from 0), expected finite numbers"
        )
    return array


def check_sample_counts(arrays: dict[str, np.ndarray]) -> int:
    """Returns the number of samples that all arrays (n, ...) have.

    Raises:
        ShapeError: they differ; says all names and numbers.
    """
    counts = {name: len(array) for name, array in arrays.items()}
    if len(set(counts.values())) > 1:
        got = ", ".join(f"{name} {count}" for name, count in counts.items())
        raise ShapeError(
            f"different numbers of samples ({got}); expected one row per sample in each"
        )
    return next(iter(counts.values()))


def _convert_floats(value: Any, name: str, expected: str) -> np.ndarray:
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiub":
            raise TypeError(f"type {array.dtype}")
        return np.ascontiguousarray(array, dtype=np.float64) if array.ndim else array
    except (TypeError, ValueError) as error:
        raise ShapeError(
            f"{name}: got no array of real numbers ({error}); expected {expected}"
        ) from None


def _suggest_shape(array: np.ndarray, name: str, joints: int) -> str:
    if array.ndim == 2 and array.shape[0] == joints:
        return f"; did you mean {name}.T?"
    if array.ndim == 1 and array.shape[0] == joints:
        return f"; for one sample write {name}[None, :]"
    if array.ndim == 1 and joints == 1:
        return f"; for one joint write {name}[:, None]"
    return "; one row per sample, one column per joint"
