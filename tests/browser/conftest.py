"""One browser for all tests of the folder: while it runs, those of others could run no loop."""

from collections.abc import Iterator

import pytest

from tests.browser.chromium import Chromium, chromium


@pytest.fixture(scope="package")
def browser() -> Iterator[Chromium]:
    with chromium() as running:
        yield Chromium(running)
