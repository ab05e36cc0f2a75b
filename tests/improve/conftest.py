"""The demonstration arm of the diagnoses, its runs, and commands about it."""

from tests.diagnose.conftest import arm as arm
from tests.diagnose.conftest import case as case
from tests.diagnose.conftest import run as run
