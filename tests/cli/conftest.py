"""What the tests of commands share: robots that are derived once, logs and models."""

from collections.abc import Iterator

import pytest

from tests.cli.derived_once import derived_once
from tests.cli.inputs import axis, two_link

__all__ = ["axis", "two_link"]


@pytest.fixture(scope="package", autouse=True)
def robots_derived_once() -> Iterator[None]:
    with derived_once():
        yield
