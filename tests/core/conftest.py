"""What the tests of the core share with those of commands."""

from tests.cli.conftest import axis, robots_derived_once

__all__ = ["axis", "robots_derived_once"]
