"""What the tests of commands share: logs and models."""

from tests.cli.inputs import axis, two_link

__all__ = ["axis", "two_link"]
