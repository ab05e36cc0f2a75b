"""`modeler show` in a real browser: the same poses and loops as in Python, moved as a user does."""

import json
import re
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.robot.read import parse_robot_text, read_robot
from modeler.views.robot_page import build_page_content, render_robot_page, show
from modeler.views.robot_skeleton import (
    Posture,
    Skeleton,
    build_skeleton,
    compute_gaps,
    compute_jacobian,
    compute_poses,
    compute_residuals,
    find_home_posture,
)
from tests.browser.chromium import Chromium
from tests.robots import ROBOTS
from tests.rotation import rotating

WIDE, NARROW = (1280, 900), (400, 800)
DRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
MESSAGE = "document.getElementById('message').textContent"
STATE = "document.getElementById('state').textContent"


def shown(browser: Chromium, place: Path, text: str, size: tuple[int, int] = WIDE) -> Skeleton:
    """The page of a robot in the browser, drawn."""
    skeleton = build_skeleton(parse_robot_text(text, "robot"))
    page = place / "page.html"
    page.write_text(render_robot_page(skeleton, find_home_posture(skeleton)), encoding="utf-8")
    browser.open(page, *size)
    browser.until("window.modelerShow && modelerShow.view.items.length > 0")
    return skeleton


def moved(browser: Chromium, joint: str, value: float) -> np.ndarray:
    """The slider of a joint dragged to a value and let go; u afterwards."""
    browser.value(
        f"(() => {{ const s = modelerShow.sliders.find((s) => modelerShow.robot.variables[s.k] === "
        f"'{joint}'); s.range.min = Math.min(s.range.min, {value}); "
        f"s.range.max = Math.max(s.range.max, {value}); s.range.value = {value};"
        "for (const name of ['input', 'change']) s.range.dispatchEvent(new Event(name)); })()"
    )
    return np.array(browser.value("modelerShow.u"))


def largest_gap(skeleton: Skeleton, u: np.ndarray) -> float:
    """Of all loops at u, by Python: m and rad."""
    return max(max(gap.distance, gap.angle) for gap in compute_gaps(skeleton, u))


@pytest.fixture(scope="module")
def calculator(browser: Chromium, tmp_path_factory: pytest.TempPathFactory) -> Chromium:
    """A page whose functions are asked about any robot."""
    shown(browser, tmp_path_factory.mktemp("calculator"), read_builtin_robot("five-bar"))
    return browser


@pytest.mark.parametrize("name", ROBOTS)
def test_poses_and_loops_are_those_of_python(calculator: Chromium, name: str) -> None:
    skeleton = build_skeleton(read_robot(name))
    home = find_home_posture(skeleton)
    content = json.dumps(build_page_content(skeleton, home))
    u = home.u + np.random.default_rng(5).uniform(-1.0, 1.0, len(home.u))
    calculator.value(f"window.asked = {content}, window.at = {u.tolist()}, 0")
    value = calculator.value("posesAt(asked, at)")
    for pose, expected in zip(value, compute_poses(skeleton, u), strict=True):
        np.testing.assert_allclose(np.array(pose["R"]).T, expected[:3, :3], atol=1e-12)
        np.testing.assert_allclose(pose["p"], expected[:3, 3], atol=1e-12)
    if skeleton.robot.loops:
        check_loops(calculator, skeleton, u, home.size)


def check_loops(calculator: Chromium, skeleton: Skeleton, u: np.ndarray, size: float) -> None:
    """Residuals, slopes and gaps of what was asked about are those of Python."""
    f, J = calculator.value("equations(asked, at)")
    np.testing.assert_allclose(f, compute_residuals(skeleton, u, size), atol=1e-12)
    np.testing.assert_allclose(J, compute_jacobian(skeleton, u, size, range(len(u))), atol=1e-11)
    for gap, ours in zip(
        calculator.value("gapsAt(asked, at)"), compute_gaps(skeleton, u), strict=True
    ):
        assert gap["distance"] == pytest.approx(ours.distance, abs=1e-12)
        assert gap["angle"] == pytest.approx(ours.angle, abs=1e-7)


@pytest.mark.parametrize("meets", ["4{i}", "0"])
@pytest.mark.parametrize("kind", ["cylindrical", "prismatic", "planar", "universal", "rigid"])
def test_every_kind_of_loop_has_its_slopes(calculator: Chromium, kind: str, meets: str) -> None:
    text = read_builtin_robot("stewart").replace('"4{i}",  "spherical"', f'"{meets}", "{kind}"')
    assert f'"{kind}"' in text
    skeleton = build_skeleton(parse_robot_text(text, "stewart"))
    u = skeleton.stated + np.random.default_rng(6).uniform(-0.3, 0.3, len(skeleton.free))
    content = json.dumps(build_page_content(skeleton, Posture(u, 1.6, False, True)))
    calculator.value(f"window.asked = {content}, window.at = {u.tolist()}, 0")
    check_loops(calculator, skeleton, u, 1.6)


MOVES = {
    "five-bar": ("11", 2.6),
    "orthoglide-2003": ("12", 0.27),
    "stewart": ("33", 0.86),
    "delta": ("13", -0.25),
    "sr400": ("7", 0.35),
    "evra": ("s1", 0.6),
    "3rrr": None,
}


@pytest.mark.parametrize("name", ["five-bar", *rotating(*(n for n in MOVES if n != "five-bar"))])
def test_sliders_move_the_robot_with_its_loops_closed(browser, tmp_path, name: str) -> None:
    skeleton = shown(browser, tmp_path, read_builtin_robot(name))
    home = np.array(browser.value("modelerShow.u"))
    k = skeleton.independent_places[0]
    joint, value = MOVES[name] or (skeleton.free[k], home[k] + 0.3)
    k = skeleton.free.index(joint)
    u = moved(browser, joint, value)
    assert u[k] == pytest.approx(value) and largest_gap(skeleton, u) < 1e-7
    others = [i for i in skeleton.independent_places if i != k]
    np.testing.assert_array_equal(u[others], home[others])
    assert np.max(np.abs(np.delete(u - home, k))) > 1e-3  # the others follow
    assert browser.value(MESSAGE) == ""
    assert browser.value(STATE) == " · loops closed"
    np.testing.assert_allclose(moved(browser, joint, home[k]), home, atol=1e-7)  # the way back
    moved(browser, joint, value)
    browser.value("document.getElementById('home').click()")
    np.testing.assert_array_equal(browser.value("modelerShow.u"), home)
    assert browser.complaints == []


@pytest.mark.parametrize(
    ("name", "joint"), [("3rrr", "11"), *rotating(("stewart", "31"), ("delta", "11"))]
)
def test_a_slider_stops_where_the_loops_stop(browser, tmp_path, name: str, joint: str) -> None:
    skeleton = shown(browser, tmp_path, read_builtin_robot(name))
    k = skeleton.free.index(joint)
    home = browser.value(f"modelerShow.u[{k}]")
    u = moved(browser, joint, home + 6.0)
    assert home < u[k] < home + 6.0 and largest_gap(skeleton, u) < 1e-7
    message = browser.value(MESSAGE)
    assert message.startswith(f"cannot close there: q{joint} stops at ")
    thumb = browser.value(f"modelerShow.sliders.find((s) => s.k === {k}).range.valueAsNumber")
    assert thumb == pytest.approx(u[k])
    # It is the edge: one of the joints that follow is all but undetermined there.
    posture = find_home_posture(skeleton)
    follow = list(skeleton.dependent_places)
    sizes = [
        np.linalg.svd(compute_jacobian(skeleton, v, posture.size, follow), compute_uv=False)[-1]
        for v in (posture.u, u)
    ]
    assert sizes[1] < 0.1 * sizes[0]
    back = moved(browser, joint, home)
    np.testing.assert_allclose(back, posture.u, atol=1e-6)  # never another assembly mode


def test_open_loops_are_closed_by_hand(browser, tmp_path) -> None:
    joints = "document.querySelectorAll('.joint').length"
    far = read_builtin_robot("five-bar").replace("L0 = 0.20", "L0 = 5.0")
    skeleton = shown(browser, tmp_path, far)
    assert "do not close near [home]" in browser.value(MESSAGE)
    assert browser.value(STATE) == " · 1 of 1 loops open"
    assert browser.value(joints) == len(skeleton.free)
    browser.value("document.getElementById('close').click()")
    assert browser.value(MESSAGE) == "the loops do not close near here"
    skeleton = shown(browser, tmp_path, read_builtin_robot("five-bar"))
    browser.value("document.getElementById('open').click()")
    u = moved(browser, "21", -1.0)
    assert u[1] == -1.0 and u[3] == browser.value("modelerShow.robot.home[3]")  # nothing follows
    assert browser.value("document.querySelector('#loops .bad') !== null")
    browser.value("document.getElementById('close').click()")
    assert largest_gap(skeleton, np.array(browser.value("modelerShow.u"))) < 1e-7
    assert browser.value(joints) == len(skeleton.independent_places)


def test_home_is_copied_as_lines_of_the_file(browser, tmp_path) -> None:
    shown(browser, tmp_path, read_builtin_robot("orthoglide-2003"))
    moved(browser, "11", 0.25)
    u, lines = browser.value("[modelerShow.u, modelerShow.homeLines()]")
    before, _, after = read_builtin_robot("orthoglide-2003").partition("[home]")
    text = f"{before}{lines}\n{after[after.index('[effects]') :]}"
    skeleton = build_skeleton(parse_robot_text(text, "copied"))
    home = find_home_posture(skeleton)
    assert home.is_closed and home.is_as_stated
    np.testing.assert_allclose(home.u, u, atol=1e-9)


LOOKED_AT = ("wrist", "stewart", "orthoglide-2003", "five-bar", "sr400")


@pytest.mark.parametrize(
    ("name", "size"),
    [("puma560", NARROW), *rotating(("puma560", WIDE), *product(LOOKED_AT, (NARROW, WIDE)))],
)
def test_the_page_works_alone_at_any_width(browser, tmp_path, name: str, size) -> None:
    """No part is drawn under the buttons and the key, none outside."""
    skeleton = shown(browser, tmp_path, read_builtin_robot(name), size)
    assert browser.complaints == []
    assert browser.requests == [(tmp_path / "page.html").resolve().as_uri()]
    wide, room = browser.value(
        "[document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    assert wide <= room == size[0]
    for view in ("xy", "xz", "yz", "iso", "first"):
        browser.value(f"document.querySelector('[data-view={view}]').click()")
        browser.value(DRAWN)
        assert inked(browser) > 0.002, view
        hidden = browser.value(
            "(() => { const points = modelerShow.view.items.flatMap((i) => i.points || i.ends);"
            "const over = boxes(), { width, height } = modelerShow.view;"
            "return points.filter(({x, y}) => x < 0 || y < 0 || x > width || y > height ||"
            "over.some((b) => x > b.left && x < b.right && y > b.top && y < b.bottom)).length; })()"
        )
        assert hidden == 0, view
    frames = inked(browser)
    browser.value("document.querySelector('[data-layers=frames]').click()")
    browser.value(DRAWN)
    assert name == "five-bar" or inked(browser) < frames  # its names move to where frames were
    text = browser.value("document.body.innerText")
    for joint in skeleton.robot.joints:
        assert joint.name in text


def test_a_home_that_was_found_is_said_on_the_page(browser, tmp_path) -> None:
    page = tmp_path / "bare.html"
    text = re.sub(r"\[home\][^\[]*", "", read_builtin_robot("five-bar"))
    drawn = show(parse_robot_text(text, "five-bar"), page=page)
    browser.open(page, *WIDE)
    browser.until("window.modelerShow && modelerShow.view.items.length > 0")
    assert browser.value("document.getElementById('note').innerText") == drawn.posture.note
    assert drawn.posture.note.startswith("five-bar: [home] found: mode A at q11 = 2.2")
    assert browser.value(STATE) == " · loops closed"
    np.testing.assert_allclose(browser.value("modelerShow.u"), drawn.posture.u, atol=1e-12)


def inked(browser: Chromium) -> float:
    """Share of the picture that is not white."""
    share: float = browser.value(
        "(() => { const c = document.getElementById('picture');"
        "const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0;"
        "for (let i = 0; i < d.length; i += 4) n += d[i] + d[i + 1] + d[i + 2] < 740;"
        "return n / (c.width * c.height); })()"
    )
    return share


def test_what_the_file_says_is_text(browser, tmp_path) -> None:
    mark = "</script><img src=x onerror=window.ran=1>"
    text = read_builtin_robot("five-bar").replace('"tip"', f'"{mark}"')
    text = text.replace('title = "', f'title = "{mark}').replace('notes = "', f'notes = "{mark}')
    shown(browser, tmp_path, text)
    assert browser.value("document.querySelectorAll('img').length + (window.ran || 0)") == 0
    assert browser.value("document.querySelector('#loops td').textContent") == mark
    message = str(browser.value("document.querySelector('header p').textContent"))
    assert message.startswith(f"modeler show {mark}")


def test_pointing_at_a_joint_tells_its_row(browser, tmp_path) -> None:
    shown(browser, tmp_path, read_builtin_robot("puma560"))
    text: dict[str, Any] = browser.value(
        "(() => { const v = modelerShow.view, p = v.flat(v.point([2, 0, 0, -0.07505]));"
        "const c = document.getElementById('picture'), box = c.getBoundingClientRect();"
        "c.dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + p.x,"
        "clientY: box.top + p.y, pointerId: 1}));"
        "return {tip: document.getElementById('tip').innerText,"
        "row: document.querySelector('tr.pointed').cells[0].textContent}; })()"
    )
    assert text["row"] == "3"
    assert "row 3 · on 2 · revolute, actuated" in text["tip"]
    assert "D3" in text["tip"] and "0.4318 m" in text["tip"] and "0.1501 m" in text["tip"]


def test_a_classical_table_is_shown_in_its_letters(browser, tmp_path) -> None:
    """The cells behind the joint are those of the frame that follows, in table, values and tip."""
    rows = '["1", "q1", 0.2, 0.3, "90 deg"], ["2", "q2 + pi/2", 0, "A", 0]'
    text = (
        'name = "arm"\ngravity = [0, 0, -9.81]\n[symbols]\nA = 0.25\n[mdh]\n'
        'convention = "classical"\ncolumns = ["j", "theta", "d", "a", "alpha"]\n'
        f"rows = [{rows}]\n"
    )
    shown(browser, tmp_path, text)
    rows_of_it = "[...document.querySelectorAll('#mdh tr')]"
    body = f"{rows_of_it}.map((r) => [...r.cells].map((c) => c.textContent))"
    assert browser.value(body) == [
        ["j", "\u03bc", "\u03c3", "\u03b8", "d", "a", "\u03b1", "q"],
        ["1", "1", "0", "q1", "0.2", "0.3", "90 deg", "0"],
        ["2", "1", "0", "q2 + \u03c0/2", "0", "A", "0", "0"],
        ["tool", "0", "2", "0", "0", "0", "0", ""],
    ]
    browser.value("document.getElementById('numbers').click()")
    message = browser.value(body)
    assert message[1][3:7] == ["0", "0.2", "0.3", "1.5708"]
    assert message[2][3:7] == ["1.5708", "0", "0.25", "0"]
    browser.value("tip(1, 0, 0)")
    tip = browser.value("document.getElementById('tip').innerText")
    assert "a of 1" in tip and "alpha of 1" in tip and "theta" in tip
