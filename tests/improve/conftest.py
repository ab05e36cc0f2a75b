"""The demonstration arm of the diagnoses, its runs, and commands about it."""

from tests.diagnose.conftest import arm as arm, case as case, run as run
