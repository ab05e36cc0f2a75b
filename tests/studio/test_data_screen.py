"""The data screen as a person uses it: a log comes in, is dragged, brushed and played."""

from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest

from modeler.api import load, simulate
from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import TimeRange
from tests.studio.window import Served, Window, served

JOINTS = (1, 2, 3)


@pytest.mark.rotating("screens of the studio")
def test_a_log_is_dropped_dragged_brushed_and_played(window, tmp_path):
    run, folder = simulate(load("demo-arm"), duration=8.0, seed=11), tmp_path / "arm"
    columns = {"Zeit": run.time}
    columns |= {f"Winkel_{j}": np.rad2deg(run.q[:, j - 1]) for j in JOINTS}
    columns |= {f"Drehmoment_{j}": run.tau[:, j - 1] for j in JOINTS}
    pa.parquet.write_table(pa.table(columns), tmp_path / "a.parquet")
    folder.mkdir()
    (folder / "robot.toml").write_text(load("demo-arm").text, encoding="utf-8")
    Workspace(folder).save(Project("robot.toml"))
    with served(folder) as studio:
        w = window().open(studio)
        w.go("Data")
        w.page.set_input_files(".data-drop input[type=file]", str(tmp_path / "a.parquet"))
        w.page.wait_for_selector(".data-pictures .main-svg .scatterlayer .trace")
        drags_and_brushes(w, studio)
        plays(w, run)
        assert w.complaints == []


def drags_and_brushes(w: Window, studio: Served) -> None:
    page, result = w.page, studio.project
    # By dragging a column onto our name, and back.
    page.locator(".mapping-chip", has_text="Winkel_1").drag_to(page.locator("[data-own=q2]"))
    w.until(lambda: "q2=Winkel_1:deg" in studio.project.mapping)
    page.locator(".mapping-chip", has_text="Winkel_2").drag_to(page.locator("[data-own=q2]"))
    w.until(lambda: studio.project.mapping == result.mapping)

    # A stretch is held out, by brushing.
    page.locator(".timeline-active").scroll_into_view_if_needed()
    box = page.locator(".timeline-active").bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.1 * box["width"], y)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.3 * box["width"], y, steps=4)
    page.mouse.up()
    page.get_by_role("button", name="held out", exact=True).click()
    w.until(lambda: studio.project.logs[0].test[0].start < 5.0)
    (held, _) = studio.project.logs[0].test
    assert (held.start, held.end) == pytest.approx((0.8, 2.4), abs=0.03)
    # By the keyboard: numbers, and a key on the line.
    page.get_by_label("from s").fill("5")
    page.get_by_label("to s").fill("6.5")
    page.locator(".timeline-active").press("o")
    w.until(lambda: studio.project.logs[0].out == (TimeRange(5.0, 6.5),))


def plays(w: Window, run: Any) -> None:
    """The robot stands where the log says, at the cursor and while it plays."""
    page = w.page
    page.wait_for_function("document.querySelector('iframe.studio-robot')?.ready")
    page.evaluate(
        """() => {
          const frame = document.querySelector('iframe.studio-robot'), tell = window.toRobot;
          window.posed = [];
          window.toRobot = (id, m) => { posed.push([id === frame.id, m]); tell(id, m); };
        }"""
    )
    line = page.locator(".timeline-active")
    line.scroll_into_view_if_needed()
    box = line.bounding_box()
    for share in (0.15, 0.83):
        page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)
        page.wait_for_function("posed.length > 0")
        actual, message = page.evaluate("posed.at(-1)")
        at = float(line.get_attribute("aria-valuenow"))
        assert actual and at == pytest.approx(8.0 * share, abs=0.02)
        for j in JOINTS:
            expected = np.interp(at, run.time, run.q[:, j - 1])
            assert message["q"][str(j)] == pytest.approx(expected, abs=1e-3)
        stands = page.frames[-1].evaluate(
            "Object.fromEntries(robot.variables.map((n, k) => [n, modelerShow.u[k]]))"
        )
        assert stands == pytest.approx(message["q"], abs=1e-9)
        page.evaluate("posed.length = 0")
    page.get_by_role("button", name="play", exact=True).click()
    page.wait_for_function("posed.length > 3")
    page.get_by_role("button", name="pause", exact=True).click()
    page.wait_for_timeout(200)
    count = page.evaluate("posed.length")
    assert float(line.get_attribute("aria-valuenow")) > 8.0 * 0.83
    page.wait_for_timeout(200)
    assert page.evaluate("posed.length") == count
    cursor = page.locator(".data-pictures .studio-cursor span").inner_text()
    assert cursor == f"{float(line.get_attribute('aria-valuenow')):.3f} s"
