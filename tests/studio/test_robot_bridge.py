"""The page of a robot in a frame: it heeds its parent of the same origin, and nobody else."""

import json
import threading
from collections.abc import Callable, Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.robot.read import parse_robot_text
from modeler.views.robot_page import build_page_content, render_robot_page, serialise_posture
from modeler.views.robot_skeleton import Skeleton, build_skeleton, compute_gaps, find_home_posture
from tests.browser.chromium import until

PARENT = """<!DOCTYPE html><title>parent</title><link rel="icon" href="data:,">
<style>html, body {margin: 0; height: 100%}</style>
<iframe src="robot.html#bare" style="border: 0; width: 100%; height: 100%"></iframe>
<script>
window.heard = [];
const frame = document.querySelector("iframe");
addEventListener("message", (e) => { if (e.source === frame.contentWindow) heard.push(e.data); });
const send = (content) => frame.contentWindow.postMessage(content, "*");
const last = (kind) => heard.filter((m) => m.modeler === kind).at(-1) ?? null;
</script>"""
DRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
PUMA = read_builtin_robot("puma560")


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:
        pass


def skeleton(text: str) -> Skeleton:
    return build_skeleton(parse_robot_text(text, "robot"))


def content_of(robot: Skeleton) -> str:
    return json.dumps(build_page_content(robot, find_home_posture(robot)))


@pytest.fixture
def opened(window, tmp_path: Path) -> Iterator[Callable[..., tuple[Any, Any]]]:
    """Opens a robot in a frame of a page; under another name of this machine it is a stranger."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(tmp_path)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    port = server.server_port

    def open_robot(text: str, parent: str = "localhost") -> tuple[Any, Any]:
        robot = skeleton(text)
        page = render_robot_page(robot, find_home_posture(robot))
        (tmp_path / "robot.html").write_text(page, encoding="utf-8")
        source = PARENT.replace('src="', f'src="http://localhost:{port}/')
        (tmp_path / "parent.html").write_text(source, encoding="utf-8")
        item = window(viewport={"width": 900, "height": 700})
        item.page.goto(f"http://{parent}:{port}/parent.html")
        frame = item.page.frame_locator("iframe").owner.element_handle().content_frame()
        until(frame, "window.modelerShow && modelerShow.view.items.length > 0")
        return item, frame

    yield open_robot
    server.shutdown()
    server.server_close()


@pytest.mark.rotating("screens of the studio")
def test_postures_are_taken_and_loops_follow(opened) -> None:
    robot = skeleton(read_builtin_robot("orthoglide-2003"))
    item, frame = opened(read_builtin_robot("orthoglide-2003"))
    page, inputs, home = item.page, list(robot.independent_places), find_home_posture(robot)
    assert not frame.locator("header").is_visible() and not frame.locator("#mdh").is_visible()
    drives = [robot.free[k] for k in inputs]
    targets = dict(zip(drives, home.u[inputs] + [0.03, -0.05, 0.02], strict=True))
    page.evaluate(f"send({{modeler: 'posture', q: {json.dumps(targets)}}})")
    until(frame, f"Math.abs(modelerShow.u[{inputs[0]}] - {targets[drives[0]]}) < 1e-9")
    u = np.array(frame.evaluate("modelerShow.u"))
    np.testing.assert_allclose(u[inputs], list(targets.values()), atol=1e-9)
    assert max(gap.distance for gap in compute_gaps(robot, u)) < 1e-8
    # Out of reach: the joints stop, with closed loops, and the way back is open.
    page.evaluate(f"send({{modeler: 'posture', q: {{'{drives[0]}': 9}}}})")
    until(frame, "document.getElementById('message').textContent.startsWith('cannot')")
    u = np.array(frame.evaluate("modelerShow.u"))
    assert u[inputs[0]] < 9 and max(gap.distance for gap in compute_gaps(robot, u)) < 1e-7
    page.evaluate(f"send({{modeler: 'posture', q: {json.dumps(targets)}}})")
    until(frame, "document.getElementById('message').textContent === ''")
    assert item.complaints == []


@pytest.mark.rotating("screens of the studio")
def test_rows_are_lit_clicks_are_told_and_another_robot_keeps_the_eye(opened) -> None:
    item, frame = opened(PUMA)
    page = item.page
    page.evaluate("send({modeler: 'light', rows: ['3', 'nobody']})")
    until(frame, "[...modelerShow.view.lit].join() === '2'")
    place = "(() => { const v = modelerShow.view; return v.flat(v.point([2, 0, 0, -0.07505])); })()"
    at = frame.evaluate(place)
    page.mouse.move(at["x"], at["y"])
    page.wait_for_function("last('pointed')?.name === '3'")
    page.mouse.down()
    page.mouse.move(at["x"] + 30, at["y"])  # that turns the picture
    page.mouse.up()
    assert page.evaluate("last('joint')") is None
    at = frame.evaluate(place)
    page.mouse.click(at["x"], at["y"])
    page.wait_for_function("last('joint')?.name === '3'")
    # Another robot: the eye stays, and so does a joint that was moved; one of another size fits.
    eye = frame.evaluate("[modelerShow.view.rotation, modelerShow.view.scale]")
    longer = skeleton(PUMA.replace("D3 = 0.4318", "D3 = 0.50"))
    page.evaluate(f"send({{modeler: 'robot', content: {content_of(longer)}}})")
    page.wait_for_function("last('drawn') !== null")
    value = page.evaluate("last('drawn').frames")
    for expected in serialise_posture(longer, find_home_posture(longer))["frames"]:
        np.testing.assert_allclose(value[expected["name"]], expected["pose"], atol=1e-12)
    assert frame.evaluate("[modelerShow.view.rotation, modelerShow.view.scale]") == eye
    page.evaluate("send({modeler: 'posture', q: {'2': 0.4}})")
    until(frame, "modelerShow.u[1] === 0.4")
    page.evaluate(f"send({{modeler: 'robot', content: {content_of(skeleton(PUMA))}}})")
    page.wait_for_function("last('drawn')?.q['2'] === 0.4")
    small = skeleton(read_builtin_robot("five-bar"))
    page.evaluate(f"heard.length = 0, send({{modeler: 'robot', content: {content_of(small)}}})")
    page.wait_for_function("last('drawn') !== null")
    assert frame.evaluate("modelerShow.view.filled(modelerShow.poses()) > 0.3")
    assert frame.locator("#loops").is_visible() and frame.locator(".joint").count() == 2
    assert item.complaints == []


@pytest.mark.rotating("long tests of studio")
def test_nobody_else_is_heard(opened) -> None:
    message = "{modeler: 'posture', q: {'1': 1}}"
    page, frame = opened(PUMA, parent="127.0.0.1")  # another origin
    page.page.evaluate(f"send({message})")
    frame.evaluate(DRAWN)
    assert frame.evaluate("modelerShow.u[0]") == 0 and page.page.evaluate("heard.length") == 0
    _, frame = opened(PUMA)
    frame.evaluate(f"window.postMessage({message}, '*'), 0")  # not the parent
    frame.evaluate(DRAWN)
    assert frame.evaluate("modelerShow.u[0]") == 0
