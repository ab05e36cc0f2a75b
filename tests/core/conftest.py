"""What the tests of the core share with those of commands."""

from tests.cli.inputs import axis

__all__ = ["axis"]
