"""The data screen as a person uses it: logs come in, are mapped, cut, doubted and played."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest

from modeler.cli import main
from modeler.core.builtin import builtin_text
from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import Stretch
from tests.studio.window import Served, Window, served

JOINTS = (1, 2, 3)


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """A run of the arm: time, positions and torques, SI."""
    place = tmp_path_factory.mktemp("run") / "run.parquet"
    words = ["simulate", "demo-arm", "--duration", "8", "--seed", "11", "--out", str(place)]
    assert main([*words, "--quiet"]) == 0
    read = pa.parquet.read_table(place).to_pydict()
    return {name: np.array(values) for name, values in read.items()}


def as_logged(run: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """As a German logger might write it: its own names, degrees."""
    found = {"Zeit": run["time"]}
    found |= {f"Winkel_{j}": np.rad2deg(run[f"q{j}"]) for j in JOINTS}
    return found | {f"Drehmoment_{j}": run[f"tau{j}"] for j in JOINTS}


def german(place: Path, columns: dict[str, np.ndarray]) -> Path:
    rows = np.column_stack(list(columns.values())).tolist()
    lines = [";".join(columns), *(";".join(repr(x).replace(".", ",") for x in row) for row in rows)]
    place.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return place


def parquet(place: Path, columns: dict[str, np.ndarray]) -> Path:
    pa.parquet.write_table(pa.table(columns), place)
    return place


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Served]:
    folder = tmp_path / "arm"
    folder.mkdir()
    (folder / "robot.toml").write_text(builtin_text("demo-arm"), encoding="utf-8")
    Workspace(folder).save(Project("robot.toml"))
    with served(folder) as running:
        yield running


def drop(w: Window, files: list[Path]) -> None:
    """On the page; the files are chosen as the browser's dialog does, which is the same request."""
    w.page.set_input_files(".data-drop input[type=file]", [str(file) for file in files])
    w.page.wait_for_function(
        f"document.querySelectorAll('.data-log .data-name').length >= {len(files)}"
    )


def pictured(w: Window) -> None:
    w.page.wait_for_selector(".data-pictures .main-svg .scatterlayer .trace")


def curves(w: Window) -> dict[str, Any]:
    """What the picture draws: name and panel -> x and y."""
    return w.page.evaluate(
        """() => Object.fromEntries(document.querySelector('.data-pictures .js-plotly-plot').data
             .map((d) => [d.name + d.yaxis, {x: [...d.x], y: [...d.y]}]))"""
    )


def until(w: Window, served_: Served, holds: Callable[[Any], bool]) -> Any:
    """The project, as soon as its file says so."""
    for _ in range(1200):
        if holds(served_.project):
            return served_.project
        w.page.wait_for_timeout(50)
    raise AssertionError(served_.project)


@pytest.mark.rotating("screens of the studio")
def test_logs_are_dropped_dragged_brushed_and_played(
    window: Callable[..., Window], studio: Served, measured: dict[str, np.ndarray], tmp_path: Path
) -> None:
    w = window().open(studio)
    page = w.page
    w.go("Data")
    clean = as_logged(measured)
    spoilt = {**clean, "Drehmoment_2": clean["Drehmoment_2"].copy()}
    spoilt["Drehmoment_2"][3000] += 300.0
    drop(w, [german(tmp_path / "a.csv", spoilt), parquet(tmp_path / "b.parquet", clean)])
    pictured(w)
    found = studio.project
    assert found.mapping == ("time=Zeit", "q<j>=Winkel_{j}:deg", "tau<j>=Drehmoment_{j}")
    drawn = curves(w)["joint 1y"]
    at = np.interp(drawn["x"], measured["time"], measured["q1"])
    np.testing.assert_allclose(drawn["y"], at, atol=1e-5)
    assert len(drawn["x"]) <= 1500

    # By dragging a column onto our name, and back.
    page.locator(".mapping-chip", has_text="Winkel_1").drag_to(page.locator("[data-own=q2]"))
    until(w, studio, lambda p: "q2=Winkel_1:deg" in p.mapping)
    page.locator(".mapping-chip", has_text="Winkel_2").drag_to(page.locator("[data-own=q2]"))
    until(w, studio, lambda p: p.mapping == found.mapping)

    # The spike is a mark on the line: why, and leave it out.
    mark = page.locator(".timeline-active .timeline-mark")
    mark.first.click()
    w.sees("No machine does that")
    page.get_by_role("dialog").get_by_role("button", name="Leave out").click()
    log = until(w, studio, lambda p: p.logs[0].out).logs[0]
    assert len(log.out) == 1 and log.out[0].start < 3.0 < log.out[0].end < 3.1
    # Half of what comes before is held out, by brushing.
    page.get_by_role("dialog").wait_for(state="detached")
    page.locator(".timeline-active").scroll_into_view_if_needed()
    box = page.locator(".timeline-active").bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.1 * box["width"], y)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.3 * box["width"], y, steps=4)
    page.mouse.up()
    page.get_by_role("button", name="held out", exact=True).click()
    log = until(w, studio, lambda p: p.logs[0].test).logs[0]
    assert log.test[0].start == pytest.approx(0.8, abs=0.03)
    assert log.test[0].end == pytest.approx(2.4, abs=0.03)
    # By the keyboard: numbers, and a key on the line.
    page.get_by_label("from s").fill("5")
    page.get_by_label("to s").fill("6.5")
    page.locator(".timeline-active").press("o")
    log = until(w, studio, lambda p: len(p.logs[0].out) == 2).logs[0]
    assert log.out[1] == Stretch(5.0, 6.5)

    plays(w, measured)
    assert w.complaints == []


def plays(w: Window, run: dict[str, np.ndarray]) -> None:
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
        own, message = page.evaluate("posed.at(-1)")
        at = float(line.get_attribute("aria-valuenow"))
        assert own and at == pytest.approx(8.0 * share, abs=0.02)
        for j in JOINTS:
            expected = np.interp(at, run["time"], run[f"q{j}"])
            assert message["q"][str(j)] == pytest.approx(expected, abs=1e-3)
        stands = page.frames[-1].evaluate(
            "Object.fromEntries(robot.free.map((n, k) => [n, modelerShow.u[k]]))"
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
