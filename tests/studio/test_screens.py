"""Every screen in this process: what it says, and what its buttons make of the project."""

import asyncio
import io
import json
import re
import shutil
import zipfile
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import load, simulate
from modeler.robot import parse_robot_text, read_limit_texts
from modeler.studio import commands
from modeler.studio.commands import build_command_words
from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import TimeRange
from tests.coroutines import run_coroutine
from tests.rotation import slow_rotating
from tests.studio.hubs import hub_of, run_tasks
from tests.studio.texts import GERMAN, URDF


def story(folder: Path, told: Callable[[Any], Awaitable[None]], place: str = "/") -> None:
    """What one person does in one window."""
    from tests.studio.in_process import windows

    async def all_of_it() -> None:
        async with windows(folder) as window:
            await told(await window().open(place))

    run_coroutine(all_of_it())


@pytest.mark.rotating("long tests of studio")
def test_a_fit_is_judged_joint_by_joint(arm: Path) -> None:
    async def told(page: Any) -> None:
        text = page.texts()
        assert "25 values" in text and text.count("not essential") >= 1
        assert text.count("\ngood\n") == 3, text  # values are doubtful, and no joint's prediction
        hints = [one.props["title"] for one in page.every() if "title" in one.props]
        assert "ZZ2R = ZZ2 + Ia2 + D3**2*M3" in hints
        page.change("method", "robust")
        page.change("cutoff [Hz]", 30.0)
        page.change("effects, in place of the robot file's", ["viscous"])
        (line,) = [one for one in page.texts().splitlines() if "--method" in one]
        assert "--method robust --cutoff 30 --effects viscous --out models/8.json" in line
        await page.sees("this fit leaves out coulomb of joint 1, 2, 3")
        gone = arm / "results/5.json"
        content = gone.read_bytes()
        gone.unlink()
        await page.go("Fit")
        await page.sees("results/5.json: cannot be read (No such file or directory); put the file")
        gone.write_bytes(content)
        (arm / "robot.toml").write_text((arm / "robot.toml").read_text() + "\n# edited\n")
        await page.go("Fit")
        await page.sees("the robot was changed since this model was fitted; fit again")

    story(arm, told, "/fit")


@pytest.mark.rotating("long tests of studio")
def test_an_effect_is_banned_previewed_and_added(arm: Path) -> None:
    async def told(page: Any) -> None:
        project = page.project
        tried = project.steps[-1]
        assert tried.verb == "add" and (arm / tried.model_file).is_file() and project.current == 5
        result = next(step for step in project.steps if step.verb == "diagnose")
        words = ("diagnose", "models/5.json", "logs/train.parquet")
        assert build_command_words(project, result) == (
            *words,
            "--holdout",
            "logs/held_out.parquet",
        )
        await page.sees("friction that grows with the load on the gear: joint 2")
        await page.sees("Confirmed")
        await page.sees("Preview. Joint 2: measured and predicted")
        await page.click("Not on this joint")
        await page.sees("segments or bans were changed since this was found; diagnose again")
        assert page.project.without == ("load_friction@2",)
        await page.sees("--without load_friction@2")
        await page.click("take back the ban of load_friction@2")
        assert page.project.without == () and not page.every(text="--without")
        page.change("effect", "spring")
        page.change("joint", "3")
        await page.sees("modeler add models/5.json spring logs/train.parquet")
        await page.click("Add")
        await page.sees("History")
        assert page.project.current == tried.number and page.project.steps == project.steps

    story(arm, told, "/missing")


def test_the_error_falls_and_undo_loses_nothing(axis_project: Path) -> None:
    with hub_of(axis_project) as hub:
        run_tasks(hub, commands.fit, lambda project: commands.add(project, "spring", "1"))

    async def told(page: Any) -> None:
        steps = page.project.steps
        await page.sees("Error after every effect")
        await page.click("Undo to step 1")
        await page.sees("Other branches")
        assert page.project.steps == steps and page.project.collect_path() == [steps[0]]
        await page.click("Go to step 2")
        assert (page.project.steps, page.project.current) == (steps, 2)
        await page.sees("joint 1: error")
        (bars,) = page.listeners("plotly_click")
        page.trigger(bars, "plotly_click", {"points": [{"pointNumber": 0}]})  # "as fitted"
        await page.sees("Other branches")
        assert page.project.collect_path() == [steps[0]]

    story(axis_project, told, "/fall")


@pytest.mark.rotating("long tests of studio")
def test_what_is_taken_away(arm: Path) -> None:
    async def told(page: Any) -> None:
        await page.click("Write C")
        content = await page.saves("Download demo-arm_c.zip")
        names = zipfile.ZipFile(io.BytesIO(content)).namelist()
        assert {"demo-arm_c/Makefile", "demo-arm_c/demo_arm.c"} <= {*names}
        page.change("format", "mjcf")
        await page.click("Export")
        assert b"<mujoco" in await page.saves("Download demo-arm.xml")
        robot = parse_robot_text((await page.saves("Robot file")).decode(), "taken")
        assert robot.name == "demo-arm"
        assert (await page.saves("Shell script")).startswith(b"#!/bin/sh")
        assert json.loads(await page.saves("Notebook"))["nbformat"] == 4
        await page.click("Report page")
        await page.sees("Open the report page")
        step = page.project.steps[-1]
        assert step.parent == 5 and "models/5.json" not in build_command_words(page.project, step)
        (link,) = page.every("link", "Open the report page")
        shown = await page.user.http_client.get(link.props["href"])
        assert "<title>demo-arm" in shown.text
        await page.click(next(b.text for b in page.every("button") if b.text.startswith("Tidy")))
        assert 7 not in [step.number for step in page.project.steps]
        assert not (arm / "models/7.json").exists()
        for name in ("x", "robot.toml"):  # no address but that of what was made
            assert (await page.user.http_client.get(f"/download/{name}")).status_code == 404

    story(arm, told, "/take")


def plots(page: Any, name: str) -> list[Any]:
    """Pictures with a series of that name."""
    return [
        plot
        for plot in page.every("plotly")
        if any(trace.get("name") == name for trace in plot.figure["data"])
    ]


@slow_rotating("long tests of studio")
def test_where_it_fails_is_seen_by_joint_and_channel(arm: Path) -> None:
    async def told(page: Any) -> None:
        await page.sees("Joint 2: measured and predicted")  # the worst one at first
        await page.sees("modeler compare models/5.json logs/held_out.parquet")
        joints = [one for one in page.every() if "fails-joint" in one.classes]
        assert [one.props["data-rows"] for one in joints] == ["1", "2", "3"]
        await page.sees("joint 2: error")
        page.trigger(joints[0], "click")
        await page.sees("Joint 1: measured and predicted")
        heat = next(e for e in page.every("plotly") if e.figure["data"][0]["type"] == "heatmap")
        page.trigger(heat, "plotly_click", {"points": [{"x": "load", "y": "2"}]})
        await page.sees("Joint 2: residual over |predicted| x direction of motion [N m]")
        page.change("residual over", "velocity")
        await page.sees("Joint 2: residual over velocity")
        frame = next(one for one in page.every() if one.tag == "iframe")
        page.trigger(frame, "joint", {"detail": "3"})  # a click on it
        await page.sees("Joint 3: measured and predicted")
        # A zoom is requested anew, and has only rows of that window.
        (plot,) = plots(page, "measured")
        page.trigger(plot, "plotly_relayout", {"xaxis.range[0]": 2.0, "xaxis.range[1]": 3.0})

        def times() -> list[float]:
            trace = next(one for one in plot.figure["data"] if one["name"] == "measured")
            return [x for x in trace["x"] if x is not None]

        await page.until(lambda: min(times()) > 1.9 and max(times()) < 3.1)
        page.trigger(plot, "plotly_relayout", {"xaxis.autorange": True})
        await page.until(lambda: max(times()) > 6.0)
        page.choose("switch", True)
        await page.until(lambda: len(plots(page, "measured")) == 3)
        await page.click("Compare")
        page.choose("expansion", True, "All that the command drew")
        await page.sees("Joint 3: does the residual still have structure?")
        page.choose("toggle", "train")
        await page.sees("modeler compare models/5.json logs/train.parquet")
        # A log that went away is reported in place.
        (arm / "logs/train.parquet").rename(arm / "away")
        await page.go("Where it fails")
        await page.sees("logs/train.parquet: cannot be read")
        (arm / "away").rename(arm / "logs/train.parquet")
        await page.go("Where it fails")
        await page.sees("Joint 3: measured and predicted")

    story(arm, told, "/fails")


@pytest.mark.rotating("long tests of studio")
def test_days_and_models_are_compared_and_drift_is_looked_for(arm: Path) -> None:
    async def told(page: Any) -> None:
        await page.sees("Joint 1: residual over velocity")
        assert re.search(r"joint 2\s+[\d.]+ %\s+[\d.]+ %", page.texts())
        page.choose("tabs", "models")
        await page.click("Compare both")
        await page.sees("7.json predicts joint 2 significantly better")
        await page.sees("Joint 2: measured and predicted")
        words = ("compare", "models/5.json", "models/7.json", "logs/held_out.parquet")
        assert build_command_words(page.project, page.project.steps[-1]) == words
        assert page.project.current == 5  # a comparison makes no model
        page.choose("tabs", "drift")
        await page.sees("File name pattern")
        page.change("File name pattern", "{period}.parquet")
        await page.click("Detect drift")
        await page.sees("Drift, steps and outliers")
        await page.sees("nothing drifts")

    story(arm, told, "/days")


@pytest.mark.rotating("screens of the studio")
def test_a_motion_is_found_and_taken(arm: Path) -> None:
    async def told(page: Any) -> None:
        page.change("duration, s", 2.0)
        await page.sees("modeler excite models/5.json --duration 2 --out")
        await page.click("Find the motion")
        step = page.project.steps[-1]
        data = json.loads((arm / step.result_file).read_text())
        await page.sees(f"Condition number {data['condition_scaled']:.4g}")
        motion = np.loadtxt(arm / step.output, delimiter=",", skiprows=1)
        table = pq.read_table(io.BytesIO(await page.saves("Download Parquet")))
        columns = np.column_stack([table[name] for name in ("time", "q1", "q2", "q3")])
        np.testing.assert_allclose(columns, motion[:, :4])

    story(arm, told, "/motion")


TABLES = ("table", "letters", "limits")


def test_a_table_is_pasted_edited_and_nothing_is_lost(tmp_path: Path) -> None:
    folder = tmp_path / "arm"
    file, draft = folder / "robot.toml", folder / "robot.draft.toml"

    async def told(page: Any) -> None:
        async def edit(table: str, event: str, **detail: Any) -> str:
            page.trigger(page.listeners("cell")[TABLES.index(table)], event, {"detail": detail})
            await page.idle()
            await asyncio.sleep(0.05)
            return file.read_text()

        page.change("table", GERMAN)
        await page.click("Take this table")
        await page.sees("taken as a table of convention classical")
        assert '"270.5 mm"' in file.read_text()
        assert '"400 mm"' in await edit("table", "cell", row=1, column=3, text="400 mm")
        # A mistake is reported; the file stays, and so does what was typed.
        good = file.read_text()
        assert await edit("table", "cell", row=1, column=3, text="400 m m") == good
        await page.sees('[mdh], row "2", column a: got "400 m m"')
        assert '"400 m m"' in draft.read_text()
        assert "0.3," in await edit("table", "cell", row=1, column=3, text="0.3")
        assert not draft.exists()
        assert '"q7"' in await edit("table", "row", row=5, what="add")
        await page.click("undo the edit")
        assert '"q7"' not in file.read_text()
        await page.click("redo the edit")
        assert '"q7"' in file.read_text()
        await edit("table", "row", row=6, what="remove")
        assert '"q7"' not in file.read_text()
        text = await edit("table", "block", row=0, column=3, text="0,25\t45\u00b0\r\n0,5\t0\r\n")
        assert '"45 deg"' in text and "0.25," in text
        assert "9.7" in await edit("letters", "cell", row=0, column=1, text="9.7")
        for column, value in enumerate(("-0.1", "0.2", "1", "2"), start=1):
            text = await edit("limits", "cell", row=0, column=column, text=value)
        assert read_limit_texts(text)["1"] == ("-0.1", "0.2", "1", "2")
        page.choose("tabs", "Effects")
        page.change("viscous of joint 1", False)
        await page.idle()
        await page.until(
            lambda: not parse_robot_text(file.read_text(), "").has_effect("viscous", "1")
        )
        # A file of another program.
        await page.click("Another robot or table")
        urdf = tmp_path / "two.urdf"
        urdf.write_text(URDF, encoding="utf-8")
        await page.drops(urdf)
        await page.until(lambda: 'name = "two"' in file.read_text(), "the URDF")
        await page.until(lambda: page.project.robot == "robot.toml")

    story(folder, told, "/robot")


def test_base_parameters_are_derived_of_a_built_in_robot(tmp_path: Path) -> None:
    async def told(page: Any) -> None:
        page.change("robot", "five-bar")
        await page.click("Take it")
        page.choose("tabs", "Base parameters")
        await page.click("Derive")
        step = page.project.steps[-1]
        data = json.loads((tmp_path / step.result_file).read_text())
        page.choose("tabs", "Base parameters")
        await page.sees(f"{len(data['base'])} base parameters (")
        assert page.texts().count("of an earlier table: derive again") == 0
        (tmp_path / "robot.toml").rename(tmp_path / "kept")
        (tmp_path / "robot.toml").mkdir()  # nothing can be written there
        page.choose("tabs", "Text")
        page.every("codemirror")[0].value += "# more\n"
        await page.sees("robot.toml: ")
        (tmp_path / "robot.toml").rmdir()
        page.every("codemirror")[0].value += "# and more\n"
        await page.until(lambda: (tmp_path / "robot.toml").is_file(), "the robot file")
        assert "and more" in (tmp_path / "robot.toml").read_text()

    story(tmp_path, told, "/robot")


@pytest.mark.rotating("long tests of studio")
def test_logs_are_dropped_mapped_cut_and_doubted(tmp_path: Path) -> None:
    run = simulate(load("two-link"), duration=6.0, rate=250.0, seed=11)
    columns = {"Zeit": run.time}
    columns |= {f"Winkel_{j + 1}": np.rad2deg(run.q[:, j]) for j in range(2)}
    columns |= {f"Drehmoment_{j + 1}": run.tau[:, j].copy() for j in range(2)}
    folder, spoilt = tmp_path / "arm", {**columns, "Drehmoment_2": columns["Drehmoment_2"].copy()}
    spoilt["Drehmoment_2"][750] += 300.0
    folder.mkdir()
    (folder / "robot.toml").write_text(load("two-link").text, encoding="utf-8")
    Workspace(folder).save(Project("robot.toml"))
    rows = np.column_stack([*spoilt.values()]).tolist()
    lines = [";".join(spoilt), *(";".join(repr(x).replace(".", ",") for x in row) for row in rows)]
    (tmp_path / "a.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    pq.write_table(pa.table(columns), tmp_path / "b.parquet")
    shutil.copy(tmp_path / "b.parquet", tmp_path / "c.parquet")
    (tmp_path / "broken.parquet").write_bytes(b"PAR1 this is none")

    async def told(page: Any) -> None:
        def mapping() -> str:
            return " ".join(page.project.mapping)

        await page.drops(*(tmp_path / name for name in ("a.csv", "b.parquet", "c.parquet")))
        await page.until(lambda: page.project.mapping, "a mapping")
        guess = ("time=Zeit", "q<j>=Winkel_{j}:deg", "tau<j>=Drehmoment_{j}")
        await page.until(lambda: page.project.mapping == guess, "the guess")
        train = ["logs/a.csv", "logs/b.parquet"]
        await page.until(lambda: page.project.collect_words("train") == train, "roles")
        assert page.project.collect_words("test") == ["logs/c.parquet"]
        await page.sees("A guess by names")
        await page.until(lambda: plots(page, "joint 1") and page.hub.running is None, "curves")
        await page.until(lambda: page.every(text="why"), "a warning")

        def drawn() -> np.ndarray:
            trace = next(
                t for t in plots(page, "joint 1")[0].figure["data"] if t["name"] == "joint 1"
            )
            at = np.interp(trace["x"], run.time, run.q[:, 0])
            return np.abs(np.array(trace["y"]) - at).max()

        assert drawn() < 1e-4
        # Another unit, another sign, a unit that cannot be, a column that is dragged.
        page.change("unit of q1", "rad")
        await page.until(lambda: "q1=Winkel_1" in mapping() and drawn() > 10.0, "the unit")
        assert "q2=Winkel_2:deg" in mapping()
        await page.click("sign of q1")
        await page.until(lambda: "q1=-Winkel_1" in mapping(), "the sign")
        before = page.project.mapping
        page.change("unit of q1", "kg")
        await page.sees('got unit "kg"')
        assert page.project.mapping == before
        await page.click("sign of q1")
        chip = next(one for one in page.every(text="Winkel_1") if "mapping-chip" in one.classes)
        cell = next(one for one in page.every() if one.props.get("data-own") == "q2")
        page.trigger(chip, "dragstart")
        page.trigger(cell, "drop")
        await page.until(lambda: "q2=Winkel_1:deg" in mapping(), "what was dragged")
        page.change("column of q2", "Winkel_2")
        await page.until(lambda: "q2=Winkel_2:deg" in mapping(), "the column")
        page.change("all in", "deg")
        await page.until(lambda: page.project.mapping == guess, "the unit of all")
        # The spike: why, and leave it out; then a segment is held out, and another one left out.
        await page.click("why")
        await page.sees("No machine does that")
        await page.click("Leave out")
        (out,) = page.project.logs[0].out
        assert out.start < 3.0 < out.end < 3.1
        line = next(one for one in page.every() if one.props.get("active") is True)
        page.trigger(line, "brush", [0.5, 1.5])
        page.trigger(line, "role", "test")
        assert page.project.logs[0].test == (TimeRange(0.5, 1.5),)
        page.change("from s", 4.0)
        page.change("to s", 5.0)
        await page.click("left out")
        assert page.project.logs[0].out[1] == TimeRange(4.0, 5.0)
        # A file that is broken, and one that goes away while it is looked at.
        await page.drops(tmp_path / "broken.parquet")
        await page.sees("cannot be read as PARQUET")
        (folder / "logs/a.csv").rename(tmp_path / "away")
        await page.go("Data")
        await page.sees("a.csv: cannot be read")
        (tmp_path / "away").rename(folder / "logs/a.csv")
        await page.click("take logs/broken.parquet off the list")
        assert len(page.project.logs) == 3 and (folder / "logs/broken.parquet").exists()
        # One that is chosen where it lies.
        shutil.copy(folder / "logs/b.parquet", folder / "far.parquet")
        await page.click("Browse (no copy)")
        await page.click(str(folder))
        page.choose("checkbox", True, "far.parquet")
        await page.click("Take")
        await page.until(lambda: page.project.logs[-1].file == "far.parquet", "the log")

    story(folder, told, "/data")


def test_a_second_window_reads_until_it_takes_over(tmp_path: Path) -> None:
    from tests.studio.in_process import windows

    async def both() -> None:
        async with windows(tmp_path / "arm") as window:
            first, second = await window().open(), await window().open()
            await second.sees("this window only reads")
            await second.click("Try the demo")
            assert second.project.steps == ()
            with second.user:
                assert not second.hub.studios[1].change_project(without=("offset",))
            assert second.project.without == ()
            await second.click("Take over")
            await first.sees("this window only reads")
            await second.until(lambda: not second.every(text="Take over"))
            await first.go("Robot")
            assert not [b for b in first.every("button", "undo the edit") if b.enabled]

    run_coroutine(both())


@pytest.mark.rotating("long tests of studio")
def test_nothing_of_a_foreign_project_is_run_before_it_is_accepted(arm, tmp_path, monkeypatch):
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "theirs"))

    async def told(page: Any) -> None:
        steps = page.project.steps
        await page.sees("the project was made by another user or on another machine")
        assert not [b for b in page.every("button", "Fit") if b.text == "Fit" and b.enabled]
        assert page.project.steps == steps
        await page.click("Accept the project")
        await page.click("Fit")
        assert len(page.project.steps) == len(steps) + 1

    story(arm, told, "/fit")
