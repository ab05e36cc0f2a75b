"""Windows of one browser for the tests of a module."""

from collections.abc import Callable, Iterator

import pytest

from tests.studio.window import Window, opened, without_browser


@pytest.fixture(scope="module")
def window() -> Iterator[Callable[..., Window]]:
    """Opens a window; each call another one, as of another person."""
    if why := without_browser():
        pytest.skip(why)
    with opened() as open_window:
        yield open_window
