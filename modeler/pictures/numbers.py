"""The numbers of all pictures of a page in one compressed block, each array once."""

import base64
import gzip
from typing import Any

import numpy as np

_LEVELS = 65534  # between the smallest and the largest value; one more level is NaN
_SINGLE = 1e-6  # of the range of x: less than a pixel of any screen


class Numbers:
    """Arrays by number; `block()` holds them all.

    What a screen shows is kept: values on linear axes to 1/65534 of their range, those that must
    stay apart (x of a curve) or span decades in single precision, or double where that is too
    coarse (a clock that counts from 1970). Of an array the bytes of one significance stand
    together, highest first, so that they compress.
    """

    def __init__(self) -> None:
        self._places: dict[bytes, int] = {}
        self._kinds: list[list[float]] = []
        self._bytes: list[bytes] = []

    def seen(self, values: np.ndarray) -> int:
        """The number of an array that a linear axis shows; what is not finite becomes NaN."""
        exact = np.asarray(values, dtype=np.float64)
        held = np.isfinite(exact)
        low, span = (float(exact[held].min()), float(np.ptp(exact[held]))) if held.any() else (0, 0)
        step = span / _LEVELS or 1.0
        levels = np.full(exact.shape, _LEVELS + 1, dtype="<u2")
        levels[held] = np.round((exact[held] - low) / step)
        return self._add(levels, [float(low), float(step)])

    def exact(self, values: np.ndarray) -> int:
        """The number of an array in single or double precision."""
        whole = np.asarray(values, dtype=np.float64)
        held = whole[np.isfinite(whole)]
        with np.errstate(over="ignore"):
            single = whole.astype(np.float32)
        away = np.abs(held - held.astype(np.float32)).max() if held.size else 0.0
        enough = not held.size or away <= _SINGLE * np.ptp(held) or np.ptp(held) == 0.0
        return self._add(single if enough else whole, [])

    def _add(self, values: np.ndarray, scale: list[float]) -> int:
        count, size = values.size, values.itemsize
        content = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<")).tobytes()
        key = repr((size, scale)).encode() + content
        if key not in self._places:
            self._places[key] = len(self._kinds)
            self._kinds.append([count, size, *scale])
            planes = np.frombuffer(content, np.uint8).reshape(count, size).T[::-1]
            self._bytes.append(planes.tobytes())
        return self._places[key]

    def block(self) -> dict[str, Any]:
        """What the page holds.

        `arrays`: of each its count, the bytes of a value, and of two-byte levels the lowest value
        and the step. `data`: gzip of them all, as base64.
        """
        return {"arrays": self._kinds, "data": packed(b"".join(self._bytes))}


def packed(content: bytes) -> str:
    """gzip as base64, the same for the same content."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")
