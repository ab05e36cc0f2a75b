"""The kept emitted files of the papers' robots: two letter by letter, the others by digest."""

import pytest

from tests.modules import module

KEPT = tuple(
    """
    wrist orthoglide-leg-tree sr400-tree sr400 orthoglide-2003 orthoglide-2012 evra five-bar
""".split()
)


@pytest.mark.parametrize("name", KEPT)
def test_emitted_files_are_those_that_are_kept(name, compare_with_generated):
    compare_with_generated(name, module(name).emitted.files)
