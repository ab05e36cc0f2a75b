"""Whether a model file still says what was saved: checksums of its entries, values that fit.

A checksum tells an edited value from a saved one; it is no proof of who saved the file.
"""

import hashlib
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from modeler.core.errors import ManifestError
from modeler.core.json_text import shown
from modeler.fit.result import FitResult

CHECKSUMS = "checksums"
"""Name of the entry with the checksums of all others."""

_SAME = 1e-6  # relative, of sigma; it is the root of a variance that was saved with all its digits
_SYMMETRIC = 1e-9  # of a correlation
_INDEFINITE = -1e-6  # smallest eigenvalue of the correlations: rounding of singular ones

_REMEDY = "take the file as it was saved, or fit the model again"
_MEANING = {
    "fit": "fit (the values and how they were found)",
    "covariance": "covariance (how sure the values are)",
    "robot_text": "robot_text (the robot file; to change the robot, fit the changed file)",
    "manifest": "manifest (what the C looks like)",
    "sources": "sources (the C)",
    "logs": "logs (what was fitted)",
    "history": "history (the effects added)",
}


def checksums(content: Mapping[str, Any]) -> dict[str, str]:
    """{entry: checksum} of every entry of a model file but the checksums themselves."""
    return {name: _checksum(value) for name, value in content.items() if name != CHECKSUMS}


def check_checksums(content: Mapping[str, Any], where: str) -> None:
    """Refuse a model file of which anything was changed since it was saved.

    Raises:
        ManifestError: names the entries that do not fit.
    """
    given = content.get(CHECKSUMS)
    if not isinstance(given, dict):
        raise ManifestError(
            f"{where}: damaged, {CHECKSUMS} is "
            f"{'missing' if CHECKSUMS not in content else 'not as saved'}; fit the model again"
        )
    expected = checksums(content)
    wrong = [name for name in dict.fromkeys([*expected, *given]) if _differs(name, expected, given)]
    if wrong:
        told = ", ".join(_MEANING.get(name, shown(name)) for name in wrong[:3])
        more = f" and {len(wrong) - 3} more" if len(wrong) > 3 else ""
        raise ManifestError(
            f"{where}: changed since it was saved, the checksum does not fit: {told}{more}; "
            f"{_REMEDY}"
        )


def _differs(name: str, expected: Mapping[str, str], given: Mapping[str, Any]) -> bool:
    return name not in expected or name not in given or given[name] != expected[name]


def _checksum(value: Any) -> str:
    # Entries stay in their order: that of the joints says which torque is whose.
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def check_estimate(fit: FitResult, where: str) -> None:
    """Refuse values, deviations and a covariance that no fit gives.

    Raises:
        ManifestError: names the first parameter that is wrong, and how.
    """
    for p in (*fit.gains, *fit.parameters, *fit.loads):
        for what, number in (("value", p.value), ("sigma", p.sigma)):
            if number is not None and not np.isfinite(number):
                raise _wrong(where, f"the {what} of {p.name} is {number!r}; expected a finite one")
        if p.sigma is not None and p.sigma < 0.0:
            raise _wrong(where, f"the sigma of {p.name} is {p.sigma:g}; expected 0 or more")
    _check_variances(fit, where)
    _check_correlations(fit, where)


def _check_variances(fit: FitResult, where: str) -> None:
    names, C = [p.name for p in fit.parameters], fit.covariance
    if not np.isfinite(C).all():
        i, j = np.argwhere(~np.isfinite(C))[0]
        raise _wrong(where, f"the covariance of {names[i]} and {names[j]} is not finite")
    for p, variance in zip(fit.parameters, np.diag(C), strict=True):
        if variance < 0.0:
            raise _wrong(where, f"the variance of {p.name} is {variance:g}; expected 0 or more")
        deviation = float(np.sqrt(variance))
        if abs((p.sigma or 0.0) - deviation) > _SAME * deviation:
            got = "none" if p.sigma is None else f"{p.sigma:g}"
            raise _wrong(
                where, f"the sigma of {p.name} is {got}, the root of its variance {deviation:g}"
            )


def _check_correlations(fit: FitResult, where: str) -> None:
    names, C = [p.name for p in fit.parameters], fit.covariance
    deviations = np.sqrt(np.diag(C))
    still = np.flatnonzero(deviations == 0.0)
    if len(still) and np.any(C[still] != 0.0):
        i = still[int(np.argmax(np.any(C[still] != 0.0, axis=1)))]
        raise _wrong(where, f"{names[i]} varies with others, but its variance is 0")
    known = deviations > 0.0
    correlation = (
        C / np.outer(np.where(known, deviations, 1.0), np.where(known, deviations, 1.0))
    )[np.ix_(known, known)]
    if not correlation.size:
        return
    uneven = np.abs(correlation - correlation.T)
    if uneven.max() > _SYMMETRIC:
        i, j = np.flatnonzero(known)[list(np.unravel_index(int(np.argmax(uneven)), uneven.shape))]
        raise _wrong(where, f"the covariance of {names[i]} and {names[j]} is not symmetric")
    if np.linalg.eigvalsh(correlation)[0] < _INDEFINITE:
        raise _wrong(where, "the covariance gives a sum of parameters a negative variance")


def _wrong(where: str, what: str) -> ManifestError:
    return ManifestError(f"{where}: {what}; fit the model again")
