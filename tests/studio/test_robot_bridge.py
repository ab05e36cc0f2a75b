"""The page of a robot in a frame: it heeds its parent of the same origin, and nobody else."""

import json
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.core.builtin import builtin_text
from modeler.report.robot_closing import gaps_of, home_posture
from modeler.report.robot_page import page_content, posture_json, robot_html
from modeler.report.robot_skeleton import Skeleton, poses, skeleton_of
from modeler.robot.read import robot_from_text
from tests.browser.chromium import NAMES, found
from tests.studio.window import until

playwright = pytest.importorskip("playwright.sync_api", reason="NOT CHECKED: no playwright")

PARENT = """<!DOCTYPE html><title>parent</title><style>html, body {margin: 0; height: 100%}</style>
<iframe src="robot.html#bare" style="border: 0; width: 100%; height: 100%"></iframe>
<script>
window.heard = [];
const frame = document.querySelector("iframe");
addEventListener("message", (e) => { if (e.source === frame.contentWindow) heard.push(e.data); });
const send = (content) => frame.contentWindow.postMessage(content, "*");
const last = (kind) => heard.filter((m) => m.modeler === kind).at(-1) ?? null;
</script>"""
DRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:
        pass


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    program = found()
    if program is None:
        pytest.skip(f"NOT CHECKED: no browser, none of {', '.join(NAMES)} is on the path")
    with playwright.sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield running
        running.close()


@pytest.fixture
def served(tmp_path: Path) -> Iterator[tuple[Path, int]]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(tmp_path)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield tmp_path, server.server_port
    server.shutdown()
    server.server_close()


def skeleton(text: str) -> Skeleton:
    return skeleton_of(robot_from_text(text, "robot"))


def opened(browser: Any, served: tuple[Path, int], text: str, parent: str = "localhost") -> Any:
    """The robot in a frame; the parent under another name of this machine is another origin."""
    place, port = served
    robot = skeleton(text)
    (place / "robot.html").write_text(robot_html(robot, home_posture(robot)), encoding="utf-8")
    source = PARENT.replace('src="', f'src="http://localhost:{port}/')
    (place / "parent.html").write_text(source, encoding="utf-8")
    page = browser.new_page(viewport={"width": 900, "height": 700})
    page.complaints = []
    page.on("pageerror", lambda error: page.complaints.append(str(error)))
    page.goto(f"http://{parent}:{port}/parent.html")
    frame = page.frame_locator("iframe").owner.element_handle().content_frame()
    until(frame, "window.modelerShow && modelerShow.view.items.length > 0")
    return page, frame


@pytest.mark.rotating("screens of the studio")
def test_postures_are_taken_and_loops_follow(browser, served) -> None:
    robot = skeleton(builtin_text("orthoglide-2003"))
    page, frame = opened(browser, served, builtin_text("orthoglide-2003"))
    page.wait_for_function("last('ready') !== null")
    home = home_posture(robot)
    told = page.evaluate("last('ready')")
    for row, expected in zip(robot.rows, poses(robot, home.u), strict=True):
        np.testing.assert_allclose(told["frames"][row.joint.name], expected, atol=1e-12)
    assert not frame.locator("header").is_visible() and not frame.locator("#mdh").is_visible()
    drives = [robot.free[k] for k in robot.given]
    targets = dict(zip(drives, home.u[list(robot.given)] + [0.03, -0.05, 0.02], strict=True))
    page.evaluate(f"send({{modeler: 'posture', q: {json.dumps(targets)}}})")
    until(frame, f"Math.abs(modelerShow.u[{robot.given[0]}] - {targets[drives[0]]}) < 1e-9")
    u = np.array(frame.evaluate("modelerShow.u"))
    np.testing.assert_allclose(u[list(robot.given)], list(targets.values()), atol=1e-9)
    assert max(gap.distance for gap in gaps_of(robot, u)) < 1e-8
    # Out of reach: the joints stop, with closed loops, and the way back is open.
    page.evaluate(f"send({{modeler: 'posture', q: {{'{drives[0]}': 9}}}})")
    until(frame, "document.getElementById('message').textContent.startsWith('cannot')")
    u = np.array(frame.evaluate("modelerShow.u"))
    assert u[robot.given[0]] < 9 and max(gap.distance for gap in gaps_of(robot, u)) < 1e-7
    page.evaluate(f"send({{modeler: 'posture', q: {json.dumps(targets)}}})")
    until(frame, "document.getElementById('message').textContent === ''")
    assert page.complaints == []
    page.close()


@pytest.mark.rotating("screens of the studio")
def test_rows_are_lit_and_clicks_are_told(browser, served) -> None:
    page, frame = opened(browser, served, builtin_text("puma560"))
    before = frame.evaluate("document.getElementById('picture').toDataURL()")
    page.evaluate("send({modeler: 'light', rows: ['3', 'nobody']})")
    until(frame, "modelerShow.view.lit.size === 1")
    frame.evaluate(DRAWN)
    assert frame.evaluate("[...modelerShow.view.lit]") == [2]
    assert frame.evaluate("document.getElementById('picture').toDataURL()") != before
    page.evaluate("send({modeler: 'light', rows: []})")
    until(frame, "modelerShow.view.lit.size === 0")
    frame.evaluate(DRAWN)
    assert frame.evaluate("document.getElementById('picture').toDataURL()") == before
    at = frame.evaluate(
        "(() => { const v = modelerShow.view; return v.flat(v.point([2, 0, 0, -0.07505])); })()"
    )
    page.mouse.move(at["x"], at["y"])
    page.wait_for_function("last('pointed') !== null")
    assert page.evaluate("last('pointed').name") == "3"
    page.mouse.down()
    page.mouse.move(at["x"] + 30, at["y"])  # that turns the picture
    page.mouse.up()
    assert page.evaluate("last('joint')") is None
    at = frame.evaluate(
        "(() => { const v = modelerShow.view; return v.flat(v.point([2, 0, 0, -0.07505])); })()"
    )
    page.mouse.click(at["x"], at["y"])
    page.wait_for_function("last('joint') !== null")
    assert page.evaluate("last('joint').name") == "3"
    page.close()


@pytest.mark.rotating("screens of the studio")
def test_another_robot_keeps_the_eye_and_the_joints(browser, served) -> None:
    text = builtin_text("puma560")
    page, frame = opened(browser, served, text)
    frame.evaluate("modelerShow.view.turn(0.3, 0.2), 0")
    eye = frame.evaluate("[modelerShow.view.rotation, modelerShow.view.scale]")
    longer = text.replace("D3 = 0.4318", "D3 = 0.50")
    assert longer != text
    robot = skeleton(longer)
    content = json.dumps(page_content(robot, home_posture(robot)))
    page.evaluate(f"send({{modeler: 'robot', content: {content}}})")
    page.wait_for_function("last('drawn') !== null")
    told = page.evaluate("last('drawn').frames")
    for frame_ in posture_json(robot, home_posture(robot))["frames"]:
        np.testing.assert_allclose(told[frame_["name"]], frame_["pose"], atol=1e-12)
    assert frame.evaluate("[modelerShow.view.rotation, modelerShow.view.scale]") == eye
    # A joint that was moved stays where it is; a robot of another size comes into the window.
    page.evaluate("send({modeler: 'posture', q: {'2': 0.4}})")
    until(frame, "modelerShow.u[1] === 0.4")
    small = skeleton(builtin_text("five-bar"))
    for other, expected in ((skeleton(text), 0.4), (small, None)):
        content = json.dumps(page_content(other, home_posture(other)))
        page.evaluate(f"heard.length = 0, send({{modeler: 'robot', content: {content}}})")
        page.wait_for_function("last('drawn') !== null")
        if expected is not None:
            assert page.evaluate("last('drawn').q['2']") == expected
    assert frame.evaluate("modelerShow.view.filled(modelerShow.poses()) > 0.3")
    assert frame.locator("#loops").is_visible() and frame.locator(".joint").count() == 2
    assert page.complaints == []
    page.close()


@pytest.mark.rotating("long tests of studio")
def test_nobody_else_is_heard(browser, served) -> None:
    text = builtin_text("puma560")
    page, frame = opened(browser, served, text, parent="127.0.0.1")  # another origin
    page.evaluate("send({modeler: 'posture', q: {'1': 1}})")
    frame.evaluate(DRAWN)
    assert frame.evaluate("modelerShow.u[0]") == 0 and page.evaluate("heard.length") == 0
    page.close()
    page, frame = opened(browser, served, text)
    frame.evaluate(
        "window.postMessage({modeler: 'posture', q: {'1': 1}}, '*'), 0"
    )  # not the parent
    frame.evaluate(DRAWN)
    assert frame.evaluate("modelerShow.u[0]") == 0
    page.close()
