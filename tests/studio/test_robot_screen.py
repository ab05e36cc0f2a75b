"""The screens "robot" and "next motion", driven in a browser as a person does."""

import json
import signal
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.cli import build_parser
from modeler.core.choices import read_builtin_robot
from modeler.robot import parse_robot_text
from modeler.studio.commands import build_command_words
from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import Step, Task
from modeler.views import serialise_posture, show
from tests.browser.chromium import until
from tests.rotation import slow_rotating
from tests.studio.texts import GERMAN
from tests.studio.window import Window, served

STANDING = "document.querySelector('iframe.studio-robot').standing"


def inside(window: Window) -> Any:
    """The page in the frame of the robot, drawn."""
    drawn = "window.modelerShow && modelerShow.view.items.length > 0"
    for _ in range(300):
        window.page.wait_for_timeout(100)
        with suppress(Exception):  # a screen that is drawn anew has another frame
            frame = window.page.query_selector("iframe.studio-robot").content_frame()
            if window.page.evaluate(f"{STANDING} !== undefined") and frame.evaluate(drawn):
                return frame
    raise TimeoutError("no robot is drawn")


def cell(window: Window, row: int, column: str) -> Any:
    name = f"row {row}, column {column}"
    return window.page.get_by_role("textbox", name=name, exact=True)


def poses_are_those_of(window: Window, place: Path) -> None:
    """What the frame reported last is what `modeler show --json` says of the file."""
    shown = show(parse_robot_text(place.read_text(encoding="utf-8"), "robot.toml"))
    value = window.page.evaluate(f"{STANDING}.frames")
    for frame in serialise_posture(shown.skeleton, shown.posture)["frames"]:
        np.testing.assert_allclose(value[frame["name"]], frame["pose"], atol=1e-9)


@pytest.mark.rotating("screens of the studio")
def test_a_pasted_table_is_edited_and_nothing_is_lost(window, tmp_path) -> None:
    folder = tmp_path / "arm"
    file, draft = folder / "robot.toml", folder / "robot.draft.toml"
    with served(folder) as studio:
        w = window().open(studio)
        w.click("Start from a table")
        w.page.get_by_role("textbox", name="table").fill(GERMAN)
        w.click("Take this table")
        frame = inside(w)
        w.sees("taken as a table of convention classical")
        assert cell(w, 2, "a").input_value() == "270.5 mm"
        poses_are_those_of(w, file)
        frame.evaluate("modelerShow.view.turn(0.4, 0.1), 0")
        eye = frame.evaluate("modelerShow.view.rotation")
        # An edit moves the skeleton; the eye stays.
        w.page.evaluate(f"{STANDING.rpartition('.')[0]}.standing = undefined")
        cell(w, 2, "a").fill("400 mm")
        w.page.wait_for_function(f"{STANDING} !== undefined")
        poses_are_those_of(w, file)
        assert '"400 mm"' in file.read_text()
        assert frame.evaluate("modelerShow.view.rotation") == eye
        # A mistake is at its cell; picture and file stay, and so does what was typed.
        good, seen = file.read_text(), frame.evaluate("modelerShow.poses()")
        cell(w, 2, "a").fill("400 m m")
        w.page.wait_for_selector("td.wrong")
        assert w.page.locator("td.wrong input").input_value() == "400 m m"
        w.sees('[mdh], row "2", column a: got "400 m m"')
        cell(w, 5, "alpha").focus()  # lights its row
        until(frame, "[...modelerShow.view.lit].join() === '4'")
        assert file.read_text() == good and frame.evaluate("modelerShow.poses()") == seen
        studio.end(signal.SIGKILL)
        assert '"400 m m"' in draft.read_text()
    with served(folder) as studio:
        w = window().open(studio)
        frame = inside(w)
        w.page.wait_for_selector("td.wrong")
        assert cell(w, 2, "a").input_value() == "400 m m"
        poses_are_those_of(w, file)
        # By keyboard: another value, a row more, back again.
        cell(w, 2, "a").fill("0.3")
        w.page.wait_for_selector("td.wrong", state="detached")
        w.page.keyboard.press("ArrowDown")
        assert w.page.evaluate("document.activeElement.ariaLabel") == "row 3, column a"
        cell(w, 6, "d").press("Control+Enter")
        assert cell(w, 7, "theta").input_value() == "q7"
        cell(w, 7, "theta").press("Control+z")
        cell(w, 7, "theta").wait_for(state="detached")
        cell(w, 2, "a").press("Control+z")
        w.page.wait_for_selector("td.wrong")
        cell(w, 2, "a").press("Control+y")
        w.page.wait_for_selector("td.wrong", state="detached")
        assert "0.3," in file.read_text() and not draft.exists()
        # A block from a spreadsheet goes into the cells from the one that has the cursor.
        block = json.dumps("0,25\t45\u00b0\r\n0,5\t0\r\n")
        cell(w, 1, "a").evaluate(
            "(input) => { const data = new DataTransfer(); "
            f"data.setData('text/plain', {block}); input.dispatchEvent("
            "new ClipboardEvent('paste', {clipboardData: data, cancelable: true})); }"
        )
        w.page.wait_for_function(
            'document.querySelector(\'.studio-cells input[data-row="1"]'
            "[data-column=\"3\"]').value === '0.5'"
        )
        assert cell(w, 1, "alpha").input_value() == "45 deg"
        assert w.complaints == []


@slow_rotating("screens of the studio")
def test_base_parameters_light_their_links_and_loops_stay_closed(window, tmp_path) -> None:
    folder, text = tmp_path / "orthoglide", read_builtin_robot("orthoglide-2003")
    folder.mkdir()
    (folder / "robot.toml").write_text(text, encoding="utf-8")
    Workspace(folder).save(Project("robot.toml"))
    with served(folder) as studio:
        w = window().open(studio)
        w.go("Robot")
        inside(w)  # the screen stands
        robot = parse_robot_text(text, "robot.toml")
        w.page.get_by_role("tab", name="Base parameters").click()
        w.click("Derive")
        w.page.wait_for_selector(".studio-relations > li")
        frame = inside(w)
        step = studio.project.steps[-1]
        data = json.loads((folder / step.result_file).read_text())
        assert w.page.locator(".studio-relations > li").count() == len(data["base"]) == 43
        w.sees("43 base parameters (")
        rows = [row.joint.name for row in show(robot).skeleton.rows]
        # Each by the mouse or by the keyboard: exactly the rows of its terms, and all its terms.
        for k in (0, 7, 20, 42):
            item, entry = w.page.locator(".studio-relations > li").nth(k), data["base"][k]
            if k % 2:
                item.focus()
            else:
                item.hover()
            terms = [term["parameter"] for term in entry["terms"]]
            places = [
                k
                for k, row in enumerate(rows)
                if any(t.endswith(row) and t[: -len(row)].isalpha() for t in terms)
            ]
            lit = "[...modelerShow.view.lit].sort((a, b) => a - b).join()"
            until(frame, f"{lit} === '{','.join(map(str, places))}'")
            shown = item.locator(".studio-terms")
            assert shown.is_visible() and all(term in shown.inner_text() for term in terms)
        # Of an earlier table, once an effect is taken away.
        w.page.get_by_role("tab", name="Effects").click()
        w.page.get_by_role("checkbox", name="offset of joint 12").click()
        w.page.wait_for_function(
            "document.querySelector('[aria-label=\"offset of joint 12\"]').ariaChecked === 'false'"
        )
        w.page.get_by_role("tab", name="Base parameters").click()
        w.sees("of an earlier table: derive again")
        w.page.get_by_role("tab", name="Limits").click()
        cell(w, 2, "lower").fill("0.15")
        cell(w, 2, "lower").press("Tab")
        until(frame, "+document.querySelectorAll('.joint input')[2].min === 0.15")
        # A joint that is clicked in the picture is the row with the cursor.
        at = frame.evaluate(
            "(() => { const v = modelerShow.view, row = modelerShow.robot.rows.findIndex("
            "(r) => r.name === '12');"
            "for (let y = 0; y < v.height; y += 2) for (let x = 0; x < v.width; x += 2)"
            "if (v.rowAt(x, y) === row && v.rowAt(x + 1, y + 1) === row) return {x, y}; })()"
        )
        frame.locator("#picture").click(position=at)
        w.page.wait_for_function("document.activeElement.ariaLabel === 'row 2, column j'")
        assert w.complaints == []


def test_a_tie_of_a_diagnosis_becomes_the_words_of_a_motion() -> None:
    """Pairs on joints only, each once; the words are those that the command line takes."""
    from modeler.studio.motion_screen import find_questions

    ties = (
        ("load_friction", "2", "spring", "2"),
        ("spring", "2", "load_friction", "2"),
        ("base_tilt", None, "offset", "1"),
    )
    effects = [
        {"effect": one, "joint": j, "ties": [{"effect": other, "joint": k}]}
        for one, j, other, k in ties
    ]
    drift = {"effect": "drift", "joint": "3", "ties": []}
    pairs = dict(find_questions({"effects": [*effects, drift]}))
    (between,) = pairs
    assert between == "load_friction@2,spring@2"
    assert pairs[between] == "distinguish load friction on joint 2 from spring on joint 2"
    made = Project("robot.toml", 3, steps=(Step(3, 0, Task("fit")),))
    task = Task("excite", between=between, duration=5.0)
    parsed = build_parser().parse_args(build_command_words(made, task))
    assert (parsed.between, parsed.robot) == (between, "models/3.json")
    assert (parsed.duration, parsed.out) == (5.0, "motions/4.csv")
    first = build_command_words(Project("robot.toml"), Task("excite", duration=2.0))
    assert first[:2] == ("excite", "robots/1.toml")
