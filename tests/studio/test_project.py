"""A project folder: what its file says, what stretches are left, which steps lead to a model."""

import dataclasses
import math
import random
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from modeler.core.errors import DataError, ModelerError
from modeler.studio.project import (
    FILE,
    Project,
    ProjectLog,
    Step,
    Stretch,
    Workspace,
    project_from_text,
    project_text,
)
from modeler.studio.timeline import told

_TEXT = st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
_FILE = st.from_regex(r"([a-z][\w.+-]{0,9}/){0,2}[a-z][\w.+-]{0,9}", fullmatch=True) | st.just("")
_SECOND = st.floats(0.0, 1e4, allow_nan=False) | st.sampled_from([-math.inf, math.inf])
_STRETCHES = st.lists(st.builds(Stretch, _SECOND, _SECOND), max_size=3).map(tuple)
_LOGS = st.lists(st.builds(ProjectLog, _TEXT, _STRETCHES, _STRETCHES, _STRETCHES), max_size=3)
_STEPS = st.lists(
    st.builds(
        Step, st.integers(1, 99), st.integers(0, 99), _TEXT, st.lists(_TEXT, max_size=4).map(tuple),
        _TEXT, _FILE, _FILE, _FILE, st.floats(0.0, 1e5, allow_nan=False), _TEXT,
    ),
    max_size=3,
)  # fmt: skip


@given(
    st.builds(
        Project, _FILE, st.integers(0, 99), st.lists(_TEXT, max_size=3).map(tuple),
        st.lists(_TEXT, max_size=3).map(tuple), _LOGS.map(tuple), _STEPS.map(tuple),
    )
)  # fmt: skip
def test_whatever_a_project_holds_is_read_back(project: Project) -> None:
    text = project_text(project)
    assert set(tomllib.loads(text)) >= {"robot", "current", "mapping", "without"}
    assert project_from_text(text, FILE) == project


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("robot = ", "Invalid value"),
        ("robot = 3", "robot is 3, expected text"),
        ("color = 'blue'", "'color' is unknown"),
        ("[[logs]]\ntrain = []", "logs[0].file is missing"),
        ("[[steps]]\nnumber = 1.5", "steps[0]"),
        ("logs = [1]", "logs[0] is 1, expected an object"),
    ],
)
def test_a_file_that_is_no_project_is_told_in_one_line(text: str, told: str) -> None:
    with pytest.raises(DataError) as caught:
        project_from_text(text, "here/project.toml")
    line = str(caught.value)
    assert line.startswith("here/project.toml: ") and told in line and "\n" not in line


def test_what_is_left_of_a_stretch_is_all_but_its_gaps() -> None:
    # Counted on a fine grid, which knows nothing of ends.
    draw = random.Random(5)
    grid = [k / 10.0 + 0.05 for k in range(200)]
    for _ in range(200):
        own = Stretch(*sorted(draw.choices(range(21), k=2)))
        gaps = [Stretch(*sorted(draw.choices(range(21), k=2))) for _ in range(draw.randrange(4))]
        left = own.without(gaps)

        def holds(parts: list[Stretch], t: float) -> bool:
            return any(part.start < t < part.end for part in parts)

        for t in grid:
            assert holds(left, t) == (holds([own], t) and not holds(gaps, t))
        assert all(one.end < other.start for one, other in pairwise(left))


def test_stretches_are_written_as_commands_take_them() -> None:
    whole, middle = Stretch(), Stretch(2.0, 8.5)
    log = ProjectLog("logs/a.csv", train=(whole,), test=(middle,), out=(Stretch(3.0, 4.0),))
    assert log.words("train") == ["logs/a.csv@:3", "logs/a.csv@4:"]
    assert log.words("test") == ["logs/a.csv@2:3", "logs/a.csv@4:8.5"]
    assert ProjectLog("a.csv", train=(whole,)).words("train") == ["a.csv"]
    assert ProjectLog("a.csv", train=(whole,), out=(whole,)).words("train") == []


def _steps() -> Project:
    steps = (
        Step(1, 0, "simulate", ()), Step(2, 0, "fit", (), model="models/2.json"),
        Step(3, 2, "diagnose", ()), Step(4, 2, "add", (), model="models/4.json"),
        Step(5, 2, "diagnose", ()), Step(6, 2, "add", (), model="models/6.json"),
        Step(7, 6, "compare", ()),
    )  # fmt: skip
    return Project(steps=steps, current=6)


def test_the_path_is_that_of_the_current_model() -> None:
    project = _steps()
    assert [step.number for step in project.path()] == [2, 6]
    assert [step.number for step in project.path(4)] == [2, 4]
    assert project.path(99) == []
    assert project.model == "models/6.json" and project.next_number == 8
    about = project.about("diagnose", 2)
    assert about is not None and about.number == 5
    assert project.about("diagnose") is None
    back = dataclasses.replace(project, current=2)
    assert [step.number for step in back.path()] == [2] and len(back.steps) == 7


def test_a_step_that_claims_to_come_from_itself_ends_the_path() -> None:
    project = Project(steps=(Step(3, 3, "fit", (), model="m.json"),), current=3)
    assert [step.number for step in project.path()] == [3]


def test_a_workspace_saves_in_one_piece_and_reads_only_where_it_must(tmp_path: Path) -> None:
    own = Workspace(tmp_path / "arm")
    (tmp_path / "arm").mkdir()
    own.save(_steps())
    assert Workspace(tmp_path / "arm").project == _steps()
    other = Workspace(tmp_path / "arm", writable=False)
    with pytest.raises(DataError, match="open in another window"):
        other.save(Project())
    own.save(Project(robot="robot.toml"))
    assert other.project == _steps()
    other.reread()
    assert other.project == Project(robot="robot.toml")


def test_a_place_that_cannot_be_written_leaves_the_project_as_it_was(tmp_path: Path) -> None:
    own = Workspace(tmp_path)
    (tmp_path / FILE).mkdir()
    with pytest.raises(ModelerError):
        own.save(_steps())
    assert own.project == Project()


def test_a_stretch_of_a_clock_that_counts_from_1970_keeps_its_ends() -> None:
    begun = 1732600000.25
    log = ProjectLog(
        "a.csv", (Stretch(end=begun + 8.4123),), out=(Stretch(begun + 3.1, begun + 3.35),)
    )
    assert log.words("train") == ["a.csv@:1732600003.35", "a.csv@1732600003.6:1732600008.6623"]
    assert told(log) == (
        "training: up to 1732600008.662 s; left out: 1732600003.35 s to 1732600003.6 s"
    )
    assert Stretch(0.1, 14.7).word("b.csv") == "b.csv@0.1:14.7"
