"""Packages that take long to load, and that few tests use: each is loaded by the first test."""

from typing import Any

import pytest


class WhenUsed:
    """A module that is imported where an attribute is first read.

    The test is skipped where there is no such module.
    """

    def __init__(self, name: str, reason: str | None = None) -> None:
        self._name, self._reason = name, reason

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # what pytest asks of all that stands in a module
            raise AttributeError(name)
        return getattr(pytest.importorskip(self._name, reason=self._reason), name)
