"""What a fit must have found on a good log, or said on a bad one."""

import json
from typing import Any

from tests.bad_input.row import Result
from tests.texts import read_pairs

TRUE = read_pairs("ZZ1R 0.48 MX1R 1.4 MY1 0 Fv1 0.8 Fs1 1.5 ZZ2 0.06 MX2 0.3 MY2 0 Fv2 0.4 Fs2 0.8")
"""Base parameters of two-link as simulated: ZZ1R = ZZ1 + L1**2 M2, MX1R = MX1 + L1 M2."""


def _written(result: Result) -> dict[str, Any]:
    raw = json.loads((result.workdir.work / "f.json").read_text())
    return raw.get("fit", raw)  # of a model file, or of --json


def _fitted(result: Result) -> dict[str, float]:
    return {p["name"]: p["value"] for p in _written(result)["parameters"]}


def farthest(found: dict[str, float]) -> tuple[str, float]:
    """The parameter that is farthest from the truth, and how far, in shares of its size."""
    off = {name: abs(found[name] - true) / max(abs(true), 0.2) for name, true in TRUE.items()}
    worst = max(off, key=lambda name: off[name])
    return worst, off[worst]


def true_values(result: Result) -> None:
    """Every base parameter within 5 % of the truth."""
    fit = _fitted(result)
    worst, off = farthest(fit)
    assert off < 0.05, f"{worst} = {fit[worst]:.4g}, truth {TRUE[worst]:g}"


def unusable_or_true(result: Result) -> None:
    """Values that are far from the truth are not called usable."""
    fit = _fitted(result)
    worst, off = farthest(fit)
    raw = _written(result)
    doubts = raw.get("warnings", [])
    assert off < 0.2 or raw.get("valid") is False or doubts, (
        f"{worst} = {fit[worst]:.4g} for {TRUE[worst]:g} without a warning"
    )
