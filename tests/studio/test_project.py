"""A project folder: what its file says, what segments are left, which steps lead to a model."""

import dataclasses
import math
import random
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from modeler.core.errors import DataError, ModelerError
from modeler.studio import project as projects
from modeler.studio.project import FILE, Project, ProjectLog, Workspace
from modeler.studio.tasks import LogPart, Step, Task, TimeRange
from tests.rotation import with_cases
from tests.texts import read_rows

_NAME = st.from_regex(r"[a-z]\w{0,9}", fullmatch=True)
_FILE = st.from_regex(r"([\w ][\w.+'\" -]{0,9}/){0,2}[a-z\u00e9][\w.+ ]{0,9}", fullmatch=True)
_SECOND = st.floats(0.0, 1e4, allow_nan=False) | st.sampled_from([-math.inf, math.inf])
_STRETCH = st.builds(TimeRange, _SECOND, _SECOND)
_STRETCHES = st.lists(_STRETCH, max_size=3).map(tuple)
_LOGS = st.lists(st.builds(ProjectLog, _FILE, _STRETCHES, _STRETCHES, _STRETCHES), max_size=3)
_PARTS = st.lists(st.builds(LogPart, _FILE, _STRETCH), max_size=3).map(tuple)
_MAPPING = st.lists(_NAME.map(lambda name: f'{name}=a "b" [{name}]:deg'), max_size=3).map(tuple)
_NUMBER = st.none() | st.floats(0.0, 1e5)
_NAMES = st.lists(_NAME, max_size=3).map(tuple)
_TASK = st.one_of(
    st.builds(
        Task,
        st.just("fit"),
        _PARTS,
        mapping=_MAPPING,
        method=_NAME,
        cutoff=_NUMBER,
        low_speed=_NUMBER,
        effects=_NAMES,
    ),
    st.builds(Task, st.just("add"), _PARTS, _PARTS, _MAPPING, effect=_NAME, joint=_NAME),
    st.builds(Task, st.just("diagnose"), _PARTS, _PARTS, without=_NAMES),
    st.builds(Task, st.just("log"), file=_FILE, robot=st.booleans(), mapping=_MAPPING),
    st.builds(Task, st.just("contest"), models=st.tuples(st.integers(1, 9), st.integers(1, 9))),
)
_STEPS = st.lists(
    st.builds(
        Step,
        st.integers(1, 99),
        st.integers(0, 99),
        _TASK,
        st.floats(0.0, 1e5, allow_nan=False),
        st.text(st.characters(exclude_categories=["Cs"]), max_size=12),
    ),
    max_size=3,
    unique_by=lambda step: step.number,
)


@settings(max_examples=30)
@given(
    st.builds(
        Project,
        st.sampled_from(["", "robot.toml"]),
        st.just(0),
        _MAPPING,
        st.booleans(),
        _NAMES,
        _LOGS.map(tuple),
        _STEPS.map(tuple),
    )
)
def test_whatever_a_project_holds_is_read_back(project: Project) -> None:
    text = projects.format_project(project)
    assert set(tomllib.loads(text)) >= {"robot", "current", "mapping", "without"}
    assert projects.parse_project(text, FILE) == project


@with_cases(
    "content, expected",
    (b"robot = ", "Invalid value"),
    (b"robot = 3", "robot is 3, expected"),
    (b"robot = '/etc/passwd'", "robot is '/etc/passwd', expected"),
    (b"current = 3", "current: got 3; expected a step that made a model, or 0"),
    (b"[[steps]]\nnumber = 1\nparent = 0\ntask = 3", "steps[0].task is 3, expected an object"),
    (b"[[steps]]\nnumber = 1\nparent = 0\ntask = { verb = 'rm' }", "steps[0].task.verb is 'rm'"),
    (2 * b"[[steps]]\nnumber = 1\nparent = 0\ntask = { verb = 'derive' }\n", "the same number"),
    (b"color = 'blue'", "'color' is unknown"),
    (b"[[logs]]\ntrain = []", "logs[0].file is missing"),
    (b"[[steps]]\nnumber = 1.5", "steps[0]"),
    (b"logs = [1]", "logs[0] is 1, expected an object"),
    (b"robot = '\xe9'", "is not valid UTF-8 (byte 10); put the file back"),
    (b"\xff\xfer\x00o\x00", "is not valid UTF-8 (byte 1)"),
    (b"\x00" * 9, "expected a file that `modeler studio` wrote"),
    (b"a = " + b"[" * 5000, "expected a file that `modeler studio` wrote"),
    (None, "cannot be read"),
    ids=lambda value: str(value)[:40],
)
def test_a_file_that_is_no_project_is_told_in_one_line(tmp_path, content, expected):
    place = tmp_path / FILE
    if content is None:
        place.mkdir()
    else:
        place.write_bytes(content)
    with pytest.raises(DataError) as caught:
        Workspace(tmp_path)
    line = str(caught.value)
    assert line.startswith(f"{place}: ") and expected in line and "\n" not in line


def test_what_is_left_of_a_stretch_is_all_but_its_gaps() -> None:
    # Counted on a fine grid, which knows nothing of ends.
    draw = random.Random(5)
    grid = [k / 10.0 + 0.05 for k in range(200)]
    for _ in range(200):
        item = TimeRange(*sorted(draw.choices(range(21), k=2)))
        gaps = [TimeRange(*sorted(draw.choices(range(21), k=2))) for _ in range(draw.randrange(4))]
        left = item.subtract_gaps(gaps)

        def holds(parts: list[TimeRange], t: float) -> bool:
            return any(part.start < t < part.end for part in parts)

        for t in grid:
            assert holds(left, t) == (holds([item], t) and not holds(gaps, t))
        assert all(one.end < other.start for one, other in pairwise(left))


def test_stretches_are_written_as_commands_take_them() -> None:
    whole, middle = TimeRange(), TimeRange(2.0, 8.5)
    log = ProjectLog("logs/a.csv", train=(whole,), test=(middle,), out=(TimeRange(3.0, 4.0),))
    project = Project(logs=(log, ProjectLog("a.csv", train=(whole,))))
    assert project.collect_words("train") == ["logs/a.csv@:3", "logs/a.csv@4:", "a.csv"]
    assert project.collect_words("test") == ["logs/a.csv@2:3", "logs/a.csv@4:8.5"]
    assert ProjectLog("a.csv", train=(whole,), out=(whole,)).get_parts("train") == []


def _steps() -> Project:
    way = tuple(
        read_rows("""
        1 0 simulate; 2 0 fit; 3 2 diagnose; 4 2 add; 5 2 diagnose; 6 2 add; 7 6 compare
    """)
    )
    simulated = Task("simulate", file="logs/a.csv")
    steps = (Step(n, p, simulated if n == 1 else Task(verb)) for n, p, verb in way)
    return Project(steps=tuple(steps), current=6)


def test_the_path_is_that_of_the_current_model() -> None:
    project = _steps()
    assert [step.number for step in project.collect_path()] == [2, 6]
    assert [step.number for step in project.collect_path(4)] == [2, 4]
    assert project.collect_path(99) == []
    ring = Project(steps=(Step(3, 3, Task("fit")),), current=3)  # claims to come from itself
    assert [step.number for step in ring.collect_path()] == [3]
    assert project.model_file == "models/6.json" and project.next_number == 8
    about = project.find_step_about("diagnose", 2)
    assert about is not None and about.number == 5
    assert project.find_step_about("diagnose") is None
    back = dataclasses.replace(project, current=2)
    assert [step.number for step in back.collect_path()] == [2] and len(back.steps) == 7


def test_a_workspace_saves_in_one_piece_and_reads_only_where_it_must(tmp_path: Path) -> None:
    work = Workspace(tmp_path / "arm")
    (tmp_path / "arm").mkdir()
    work.save(_steps())
    assert Workspace(tmp_path / "arm").project == _steps()
    other = Workspace(tmp_path / "arm", writable=False)
    with pytest.raises(DataError, match="open in another window"):
        other.save(Project())
    work.save(Project(robot="robot.toml"))
    assert other.project == _steps()
    other.reload_project()
    assert other.project == Project(robot="robot.toml")
    (tmp_path / "arm" / FILE).unlink()
    (tmp_path / "arm" / FILE).mkdir()  # nothing can be written there
    with pytest.raises(ModelerError):
        work.save(Project())
    assert work.project == Project(robot="robot.toml")


def test_a_stretch_of_a_clock_that_counts_from_1970_keeps_its_ends() -> None:
    from modeler.studio.timeline import describe_roles

    begun = 1732600000.25
    out = TimeRange(begun + 3.1, begun + 3.35)
    log = ProjectLog("a.csv", (TimeRange(end=begun + 8.4123),), out=(out,))
    words = [part.command_word for part in log.get_parts("train")]
    assert words == ["a.csv@:1732600003.35", "a.csv@1732600003.6:1732600008.6623"]
    assert describe_roles(log) == (
        "training: up to 1732600008.662 s; left out: 1732600003.35 s to 1732600003.6 s"
    )
    assert TimeRange(0.1, 14.7).format_word("b.csv") == "b.csv@0.1:14.7"


# Whose it is.


def test_a_project_of_this_user_is_known_wherever_it_lies(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    work = Workspace(tmp_path / "mine")
    assert not work.foreign  # an empty folder is nobody's
    work.save(_steps())
    assert not Workspace(tmp_path / "mine").foreign
    (tmp_path / "mine").rename(tmp_path / "moved")
    assert not Workspace(tmp_path / "moved").foreign


@pytest.mark.parametrize("how", ["edited", "without a seal", "another key", "another user"])
def test_a_project_of_somebody_else_is_only_read_until_it_is_accepted(tmp_path, monkeypatch, how):
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "cache"))
    Workspace(tmp_path).save(_steps())
    place, key = tmp_path / FILE, tmp_path / "cache/studio.key"
    assert key.stat().st_mode & 0o077 == 0 and len(key.read_bytes()) == 32  # nobody else reads it
    if how == "edited":
        place.write_text(place.read_text().replace("without = []", 'without = ["spring"]'))
    elif how == "without a seal":
        place.write_text(place.read_text().partition("\n")[2])
    elif how == "another key":
        key.write_bytes(bytes(32))
    else:
        monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "theirs"))
    here = Workspace(tmp_path)
    before = place.read_text()
    assert here.foreign and here.project.steps == _steps().steps
    with pytest.raises(DataError, match="made by another user or on another machine, or"):
        here.save(Project())
    assert place.read_text() == before
    here.accept()
    assert not here.foreign and not Workspace(tmp_path).foreign
