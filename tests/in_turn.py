"""Cases of `parametrize` that run in turn, beside those that always run."""

from typing import Any

import pytest


def in_turn(*cases: Any) -> list[Any]:
    """Marked as rotating; a tuple is a case of several parameters."""
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.rotating)
        for case in cases
    ]
