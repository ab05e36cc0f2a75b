"""The demonstration arm with its two runs, as the diagnosis has it."""

from tests.diagnose.conftest import case as case
