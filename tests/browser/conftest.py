"""One browser for all tests of a process."""

from collections.abc import Iterator

import pytest

from tests.browser.chromium import NAMES, Chromium, found


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chromium]:
    program = found()
    if program is None:
        pytest.skip(f"NOT CHECKED: no browser, none of {', '.join(NAMES)} is on the path")
    with Chromium(program, tmp_path_factory.mktemp("profile")) as running:
        yield running
