"""A log that comes later changes neither the split nor the mapping of those that were there."""

from pathlib import Path
from typing import Any

from modeler.logs import parse_map_options
from modeler.studio.log_mapping import LogGuess, build_choices, build_default_joints
from modeler.studio.project import Project, ProjectLog, Workspace
from modeler.studio.tasks import TimeRange
from tests.studio.hubs import hub_of

ENDS = (0.0, 10.0)
GERMAN, ROS = ("Zeit", "Winkel_1", "Winkel_2"), ("stamp", "pos[0]", "pos[1]")


def guess(columns: tuple[str, ...]) -> LogGuess:
    """Of a log whose names are not ours."""
    time, first, second = columns
    words = [f"time={time}", f"q1={first}:deg", f"q2={second}:deg"]
    result = build_choices(parse_map_options(words), build_default_joints(2), columns)
    return LogGuess(dict.fromkeys(columns, ""), result, (), 2, "", ())


def screen(folder: Path, project: Project) -> Any:
    """The data screen as it is drawn, with the logs of the project read."""
    from modeler.studio.data_screen import DataScreen
    from modeler.studio.studio import Studio

    Workspace(folder).save(project)
    with hub_of(folder) as hub:
        hub.studios.append(Studio(hub, "data"))
    view = DataScreen(hub.studios[0])
    view.joints = build_default_joints(2)
    return view


def come(own: Any, **logs: tuple[str, ...]) -> Project:
    """Logs are there, read, and settled."""
    from modeler.studio.project_logs import KnownLog

    studio = own.studio
    for name, columns in logs.items():
        own.logs[name] = KnownLog(guess(columns), rows=100, ends=ENDS)
    there = [log.file for log in studio.project.logs]
    new = (*studio.project.logs, *(ProjectLog(name) for name in logs if name not in there))
    studio.change_project(logs=new)
    own._settle_mapping()
    return studio.project


def test_the_split_of_the_first_log_stays(tmp_path: Path) -> None:
    view = screen(tmp_path, Project())
    first = come(view, a=GERMAN)
    assert first.mapping == ("time=Zeit", "q<j>=Winkel_{j}:deg")
    assert (first.collect_words("train"), first.collect_words("test")) == (["a@:7"], ["a@7:"])
    second = come(view, b=GERMAN)
    assert second.logs[0] == first.logs[0]
    assert second.collect_words("train") == ["a@:7", "b"]
    third = come(view, c=ROS)
    assert third.logs[:2] == second.logs
    assert third.mapping == ("auto",)  # a guess for each log


def test_logs_that_come_together_hold_out_the_last_one(tmp_path: Path) -> None:
    project = come(screen(tmp_path, Project()), a=GERMAN, b=GERMAN, c=GERMAN)
    assert (project.collect_words("train"), project.collect_words("test")) == (["a", "b"], ["c"])


def test_the_mapping_that_was_chosen_stays(tmp_path: Path) -> None:
    """Also where it is what names say already, or is nothing: it is no guess."""
    for chosen in (("q<j>=Winkel_{j}:mrad",), (), ("time=Zeit", "q<j>=Winkel_{j}:deg")):
        logs = (ProjectLog("a", (TimeRange(),)),)
        view = screen(tmp_path, Project(mapping=chosen, mapped=True, logs=logs))
        assert come(view, a=GERMAN, b=ROS).mapping == chosen


def test_each_by_its_own_guess_keeps_what_was_chosen(tmp_path: Path) -> None:
    chosen = ("q<j>=Winkel_{j}:mrad",)
    view = screen(tmp_path, Project(mapping=chosen, mapped=True))
    come(view, a=GERMAN, b=ROS)
    view.apply_each_guess()
    project = view.studio.project
    assert project.mapping == ("auto", *chosen)
    assert view.resolve_columns(guess(GERMAN))["q1"].unit == "mrad"
    assert view.resolve_columns(guess(ROS))["q1"].unit == "deg"
