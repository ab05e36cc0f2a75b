"""From the empty page to a named effect, its ghost, the fall of the error, and the C, by hand."""

import io
import json
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from modeler.studio.commands import words_of
from tests.rotation import rotating_with
from tests.studio.window import Served, Window, served

COUNT = "window.clicks = 0; document.addEventListener('click', () => window.clicks++, true)"


@pytest.fixture(scope="module")
def studio(tmp_path_factory) -> Iterator[Served]:
    """Of an empty folder."""
    with served(tmp_path_factory.mktemp("story") / "project") as running:
        yield running


@pytest.fixture(scope="module")
def seat(studio, window) -> Window:
    """The window that may change things."""
    seat = window(accept_downloads=True)
    seat.page.add_init_script(COUNT)
    return seat.open(studio)


def downloaded(seat: Window, button: str) -> tuple[str, bytes]:
    """What a button downloads: its name, its bytes."""
    with seat.page.expect_download() as coming:
        seat.click(button)
    return coming.value.suggested_filename, Path(coming.value.path()).read_bytes()


def drawn(seat: Window, count: int) -> None:
    """Waits for so many pictures: while they come, the page moves under the mouse."""
    seat.page.wait_for_function(
        f"document.querySelectorAll('.js-plotly-plot .draglayer').length >= {count}"
    )


def five_clicks_to_a_named_effect(studio, seat):
    seat.click("Try the demo")
    seat.page.wait_for_url("**/data")
    seat.page.get_by_role("button", name="3  Fit").click()
    seat.click("Fit", exact=True)
    seat.sees("What it is worth")
    for joint, light in (("joint 1", "good"), ("joint 2", "doubtful"), ("joint 3", "good")):
        card = seat.page.locator(".studio-joint", has_text=joint).first
        assert card.locator(f".studio-{light}").count() == 2  # its shape and its word
    assert seat.page.locator("tr.studio-faint", has_text="not essential").count() >= 1
    hint = seat.page.locator(".studio-hint", has_text="ZZ2R").get_attribute("title")
    assert hint == "ZZ2R = ZZ2 + Ia2 + D3**2*M3"
    seat.page.get_by_role("button", name="5  What is missing").click()
    seat.click("Look", exact=True)
    seat.sees("friction that grows with the load on the gear: joint 2")
    seat.sees("fact: it is stated as missing")
    assert seat.page.evaluate("window.clicks") <= 5
    drawn(seat, 2)  # evidence, and the torque before and after
    (step,) = [step for step in studio.project.steps if step.verb == "diagnose"]
    words = ("diagnose", "models/3.json", "logs/train.parquet")
    assert words_of(studio.project, step) == (*words, "--holdout", "logs/held_out.parquet")


def a_ban_is_remembered_and_taken_back(studio, seat):
    seat.click("Not on this joint")
    seat.sees("stretches or bans were changed since this was found; look again")
    assert studio.project.without == ("load_friction@2",)
    drawn(seat, 2)
    line = seat.page.locator(".studio-command", has_text="--without load_friction@2")
    line.first.wait_for()
    seat.click("take back the ban of load_friction@2")
    line.first.wait_for(state="detached")
    assert studio.project.without == ()


def a_preview_is_a_ghost_and_add_takes_it(studio, seat):
    before = studio.project
    drawn(seat, 2)
    seat.click("Preview", exact=True)
    seat.sees("Preview. Joint 2: measured and predicted")
    drawn(seat, 3)
    tried = studio.project.steps[-1]
    assert studio.project.current == before.current and tried.verb == "add"
    assert (studio.folder / tried.model).is_file()
    seat.click("Add", exact=True)
    seat.sees("The way of this model")
    assert studio.project.current == tried.number  # nothing was computed again
    assert studio.project.steps[-1] == tried


def the_error_falls_and_undo_loses_nothing(studio, seat):
    seat.sees("Error after every effect")
    drawn(seat, 2)
    steps, last = studio.project.steps, studio.project.current
    seat.click(f"Undo to step {studio.project.path()[0].number}")
    seat.sees("Set aside")
    assert studio.project.steps == steps
    assert studio.project.path()[-1].verb == "fit"
    seat.click(f"Go to step {last}")
    seat.sees("Error after every effect")
    assert (studio.project.steps, studio.project.current) == (steps, last)
    drawn(seat, 2)
    bar = seat.page.locator(".js-plotly-plot .bars .point path").first  # "as fitted"
    bar.scroll_into_view_if_needed()
    box = bar.bounding_box()
    seat.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    seat.sees("Set aside")
    assert studio.project.path()[-1].verb == "fit"
    seat.click(f"Go to step {last}")
    seat.sees("Error after every effect")


def what_is_taken_away(studio, seat, tmp_path):
    seat.page.get_by_role("button", name="9  Take away").click()
    seat.click("Write C", exact=True)
    name, content = downloaded(seat, "Download demo-arm_c.zip")
    assert name == "demo-arm_c.zip"
    zipfile.ZipFile(io.BytesIO(content)).extractall(tmp_path)
    if shutil.which("make") and shutil.which("cc"):
        done = subprocess.run(["make", "check"], cwd=tmp_path / "demo-arm_c", capture_output=True)
        assert done.returncode == 0, done.stderr.decode()
    seat.click("Export", exact=True)
    name, content = downloaded(seat, "Download demo-arm.urdf")
    assert b"<robot" in content
    name, content = downloaded(seat, "Robot file")
    assert b"load_friction" in content
    assert not seat.complaints


def the_report_page_opens_in_a_tab(studio, seat):
    seat.page.get_by_role("button", name="9  Take away").click()
    seat.click("Report page")
    link = seat.page.get_by_role("link", name="Open the report page")
    link.wait_for()
    with seat.page.context.expect_page() as coming:
        link.click()
    coming.value.wait_for_load_state()
    assert coming.value.title() == "demo-arm: effects added"
    coming.value.close()
    kept = studio.project.path()[-1]
    page = studio.project.steps[-1]
    assert page.parent == kept.number
    assert kept.model not in words_of(studio.project, page)  # it wrote no model over that one


def the_script_of_the_demonstration_makes_the_same(studio, seat, tmp_path):
    name, content = downloaded(seat, "Shell script")
    assert name == "steps.sh" and content.startswith(b"#!/bin/sh")
    (tmp_path / name).write_bytes(content)
    environment = os.environ | {"MODELER": f"{sys.executable} -m modeler"}
    fresh = tmp_path / "fresh"
    fresh.mkdir()
    subprocess.run(["sh", f"../{name}"], cwd=fresh, env=environment, check=True)
    for step in studio.project.path():
        one, other = (values(place / step.model) for place in (studio.folder, fresh))
        assert one.keys() == other.keys()
        assert all(abs(one[key] - other[key]) <= 1e-12 * max(1.0, abs(one[key])) for key in one)


def values(model: Path) -> dict[str, float]:
    """Of the parameters of a model file."""
    fit = json.loads(model.read_text(encoding="utf-8"))["fit"]
    return {one["name"]: one["value"] for one in fit["parameters"]}


def a_result_that_is_gone_is_told_in_place(studio, seat):
    step = studio.project.path()[-1]
    place, aside = (studio.folder / f"{step.result}{end}" for end in ("", ".aside"))
    place.rename(aside)
    try:
        seat.page.get_by_role("button", name="3  Fit").click()
        seat.sees(f"{step.result}: cannot be read (No such file or directory); put the file back")
    finally:
        aside.rename(place)
    seat.page.get_by_role("button", name="3  Fit").click()
    seat.sees("What it is worth")


def no_address_but_that_of_what_was_made(studio, seat):
    for path in ("/download/x", "/download/..%2f..%2frobot.toml", "/download/robot.toml"):
        answer = seat.page.request.get(studio.root + path)
        assert answer.status in (403, 404), path


def test_from_the_empty_page_to_what_is_taken_away(studio, seat, tmp_path):
    """One story, in its order, in one process."""
    five_clicks_to_a_named_effect(studio, seat)
    a_ban_is_remembered_and_taken_back(studio, seat)
    a_preview_is_a_ghost_and_add_takes_it(studio, seat)
    the_error_falls_and_undo_loses_nothing(studio, seat)
    what_is_taken_away(studio, seat, tmp_path)
    a_result_that_is_gone_is_told_in_place(studio, seat)
    no_address_but_that_of_what_was_made(studio, seat)


@rotating_with("screens of the studio")
def test_the_report_and_the_script_of_the_story(studio, seat, tmp_path):
    if not studio.project.current:
        five_clicks_to_a_named_effect(studio, seat)
        a_preview_is_a_ghost_and_add_takes_it(studio, seat)
    the_report_page_opens_in_a_tab(studio, seat)
    the_script_of_the_demonstration_makes_the_same(studio, seat, tmp_path)
