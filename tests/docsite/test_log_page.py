"""The page on one measured log shows the numbers of a run of today."""

import re

import pytest

from docsite.log_page import PAGE, render_page, run_log
from tests.measured_sets.sets import DATA
from tests.test_docs import same

PICTURES = sorted(PAGE.parent.glob("log-to-rows-*.svg"))


@pytest.mark.measured
@pytest.mark.skipif(not DATA.is_dir(), reason=f"NOT CHECKED: no measured logs in {DATA}")
def test_the_numbers_are_those_of_the_run() -> None:
    shown = PAGE.read_text(encoding="utf-8").splitlines()
    rendered = render_page(run_log(DATA)).splitlines()
    differ = [pair for pair in zip(shown, rendered, strict=False) if not same(*pair)]
    first = "\n".join(differ[0]) if differ else ""
    remedy = f"run `python -m docsite.log_page --data {DATA}`"
    assert not differ and len(shown) == len(rendered), f"{first}\n{remedy}"


def test_the_pictures_are_small_and_shown() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert re.findall(r"\]\((log-to-rows-\w+\.svg)\)", text) and 4 <= len(PICTURES) <= 5
    for picture in PICTURES:
        assert f"]({picture.name})" in text
        assert picture.stat().st_size < 60_000, picture.name
