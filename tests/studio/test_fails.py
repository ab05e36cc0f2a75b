"""Where it fails, in a browser: zoom and cursor are shared, the robot plays along."""

from pathlib import Path
from typing import Any

import pytest

from tests.browser.chromium import until
from tests.studio.window import served

RANGES = """() => [...document.querySelectorAll('.js-plotly-plot')]
    .filter((p) => p._fullLayout && p._fullLayout.meta.time)
    .map((p) => p._fullLayout.xaxis.range.map(Number))"""


@pytest.mark.rotating("screens of the studio")
def test_one_zoom_one_cursor_and_the_robot_plays_along(arm: Path, window) -> None:
    with served(arm) as studio:
        file = window(viewport={"width": 1280, "height": 2400}).open(studio)
        file.go("Where it fails")
        one_zoom(file.page)
        assert file.complaints == []


def one_zoom(page: Any) -> None:
    page.locator(".picture", has_text="Joint 2: measured").locator(".main-svg").first.wait_for()
    page.get_by_role("switch", name="all joints").click()
    page.locator(".picture", has_text="Joint 3: measured").locator(".main-svg").first.wait_for()
    page.wait_for_function(f"({RANGES})().length === 3")
    whole = page.evaluate(RANGES)[0]
    box = page.locator(".picture", has_text="Joint 1: measured").locator(".nsewdrag").first
    where = box.bounding_box()
    assert where is not None
    middle = where["y"] + 0.5 * where["height"]
    page.mouse.move(where["x"] + 0.4 * where["width"], middle)
    page.mouse.down()
    page.mouse.move(where["x"] + 0.6 * where["width"], middle + 3, steps=6)
    page.mouse.up()
    low, high = (whole[0] + share * (whole[1] - whole[0]) for share in (0.4, 0.6))
    page.wait_for_function(
        f"({RANGES})().every(([a, b]) => Math.abs(a - {low}) < 0.3 && Math.abs(b - {high}) < 0.3)"
    )
    # What is drawn then is requested anew: it has only rows of that window.
    page.wait_for_function(
        f"""() => [...document.querySelectorAll('.js-plotly-plot')]
        .filter((p) => p._fullLayout && p._fullLayout.meta.time)
        .every((p) => {{ const x = p._fullData.find((t) => t.name === 'measured').x;
            return x[0] > {low - 0.5} && x[x.length - 1] < {high + 0.5}; }})"""
    )
    page.mouse.move(where["x"] + 0.5 * where["width"], middle)
    page.wait_for_function("document.querySelectorAll('.studio-cursor:not([hidden])').length === 3")
    lines = {line.inner_text() for line in page.locator(".studio-cursor").all()}
    assert len(lines) == 1
    assert abs(float(lines.pop().removesuffix(" s")) - 0.5 * (low + high)) < 0.1
    page.mouse.dblclick(where["x"] + 0.5 * where["width"], middle)
    length = 0.95 * (whole[1] - whole[0])
    page.wait_for_function(f"({RANGES})().every(([a, b]) => b - a > {length})")
    frame = page.locator("iframe.studio-robot").element_handle().content_frame()
    until(frame, "window.modelerShow && modelerShow.view.lit.size === 1")
    before = frame.evaluate("[...modelerShow.u]")
    page.get_by_role("button", name="play").click()
    page.wait_for_function("document.querySelector('.studio-cursor:not([hidden])')")
    until(frame, f"modelerShow.u.some((u, k) => Math.abs(u - {before}[k]) > 0.02)")
    page.get_by_role("button", name="pause").click()
    frame.evaluate("tell('joint', { name: '3' })")  # what a click on it does
    until(frame, "[...modelerShow.view.lit].join() === '2'")
