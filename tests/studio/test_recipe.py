"""What the studio types parses; what it retells makes the same values in an empty folder."""

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from modeler.api import load, simulate
from modeler.cli.parser import build_parser
from modeler.core.choices import read_builtin_robot
from modeler.studio import commands, export_screen
from modeler.studio.project import Project, ProjectLog, Workspace
from modeler.studio.tasks import LogPart, Step, Task, TimeRange, build_bookkeeping_words
from tests.coroutines import run_coroutine
from tests.rotation import slow_rotating, with_cases
from tests.studio.hubs import hub_of, run_tasks

LOGS = (
    ProjectLog(
        "logs/day one.csv", (TimeRange(0.0, 4.0), TimeRange(4.5)), out=(TimeRange(2.0, 2.5),)
    ),
    ProjectLog("logs/b.csv", test=(TimeRange(end=6.0),)),
)
PROJECT = Project(
    robot="robot.toml",
    current=1,
    mapping=("q<j>=angle_{j}:deg",),
    logs=LOGS,
    without=("backlash", "time_delay", "stribeck@2"),
    steps=(Step(1, 0, Task("fit", (LogPart("x.csv"),))),),
)


@with_cases(
    "task",
    commands.fit(PROJECT),
    commands.fit(PROJECT, (("method", "robust"), ("cutoff", 30.0), ("low_speed", 0))),
    commands.fit(PROJECT, (("effects", ("viscous", "coulomb")), ("derivatives", "position"))),
    commands.fit(PROJECT, (("joint", ""),)),
    commands.compare_models(PROJECT, (1, 1)),
    commands.diagnose(PROJECT),
    commands.add(PROJECT, "spring", "1"),
    commands.add(PROJECT, "auto", None),
    commands.fleet(PROJECT, PROJECT.collect_parts("train"), "{machine}-{period}.csv"),
    commands.inspect_log(PROJECT, "logs/b.csv"),
    Task("page", step=1),
    Task("export", to="mjcf"),
    Task("simulate", file="logs/train.parquet", seed=1),
    Task("new", joints="RPR", template="serial", convention="craig"),
    Task("convert", file="originals/arm.urdf"),
    Task("excite", between="spring@1,stribeck@2", duration=5.0, limit=("1=-0.3,0.3,0.5,4",)),
    ids=lambda task: task.title,
)
def test_what_is_typed_parses(task):
    step = PROJECT.make_next_step(task)
    known = build_parser().parse_args(
        [*commands.build_command_words(PROJECT, task), *build_bookkeeping_words(step)]
    )
    assert known.json == "results/2.json"
    if step.output:
        assert step.output in (getattr(known, "out", ""), getattr(known, "report", ""))


def test_a_step_is_known_again_but_for_its_number():
    from modeler.studio.diagnosis_screens import find_trial

    one = commands.add(PROJECT, "spring", "1")
    step = Step(2, 1, one)
    later = dataclasses.replace(PROJECT, steps=(*PROJECT.steps, step))
    assert commands.build_command_words(later, one) != commands.build_command_words(later, step)
    assert find_trial(later, "spring", "1") == step
    assert find_trial(later, "spring", "2") is None
    assert find_trial(dataclasses.replace(later, logs=LOGS[:1]), "spring", "1") is None
    assert find_trial(dataclasses.replace(later, current=2), "spring", "1") is None


def write_log(path: Path, seed: int) -> None:
    """A log of an arm with friction that its model lacks, in degrees, under other names."""
    run = simulate(load("two-link"), duration=7.0, rate=200.0, seed=seed, hide=["load_friction@1"])
    columns = {"time": run.time}
    for j in range(2):
        columns |= {f"angle_{j + 1}": np.degrees(run.q[:, j]), f"tau{j + 1}": run.tau[:, j]}
    table = np.column_stack(list(columns.values()))
    np.savetxt(path, table, delimiter=",", header=",".join(columns), comments="", fmt="%.12g")


OPTIONS = (("method", "robust"), ("essential_below", 20.0))


@pytest.fixture(scope="module")
def worked(tmp_path_factory) -> Workspace:
    """A project with a mapping, segments, a gap and bans: fitted, looked at, added, set aside."""
    folder = tmp_path_factory.mktemp("worked") / "it's a project"
    (folder / "logs").mkdir(parents=True)
    (folder / "robot.toml").write_text(read_builtin_robot("two-link"), encoding="utf-8")
    for seed, log in enumerate(LOGS, start=31):
        write_log(folder / log.file, seed)
    workspace = Workspace(folder)
    project = dataclasses.replace(PROJECT, current=0, steps=())
    workspace.save(dataclasses.replace(project, without=("backlash", "time_delay")))

    def added(project: Project) -> Task:
        (result,) = json.loads((folder / "results/2.json").read_text())["effects"][:1]
        return commands.add(project, result["effect"], result["joint"])

    with hub_of(folder) as hub:
        run_tasks(hub, lambda project: commands.fit(project, OPTIONS), commands.diagnose)
        preview = commands.add(hub.project, "offset", "2")
        run_coroutine(hub.run(preview, current=False))
        run_tasks(hub, added, commands.compare)
    return Workspace(folder)


def retold(workspace: Workspace) -> export_screen.Recipe:
    """As the screen asks for it."""
    folder, project = workspace.folder, workspace.project
    copies = {step.robot_copy for step in project.steps} - {""}
    robots = {name: (folder / name).read_text(encoding="utf-8") for name in copies}
    return export_screen.build_recipe(project, folder, robots)


def check_same(workspace: Workspace, fresh: Path) -> None:
    """Every model on the way has the same values, sigmas and effects."""
    folder = workspace.folder
    way = workspace.project.collect_path()
    assert [step.verb for step in way] == ["fit", "add"]
    for step in way:
        there, here = (json.loads((p / step.model_file).read_text()) for p in (folder, fresh))
        for key in ("value", "sigma"):
            a, b = (np.array([p[key] for p in m["fit"]["parameters"]]) for m in (there, here))
            np.testing.assert_allclose(b, a, rtol=1e-12, atol=1e-12)
        assert here["robot_text"] == there["robot_text"]
        effects = [[one["effect"] for one in m["history"]] for m in (there, here)]
        assert effects[0] == effects[1]
    assert effects[0][1] == "load_friction"


@pytest.mark.rotating("long tests of studio")
def test_the_script_makes_the_same_in_an_empty_folder(worked, tmp_path):
    """A shell reads it, so that its words are known; they are carried out here."""
    from tests.studio.in_process import run_command

    before = {p: p.stat().st_mtime_ns for p in worked.folder.rglob("*") if p.is_file()}
    (tmp_path / "steps.sh").write_text(
        export_screen.format_script(retold(worked)), encoding="utf-8"
    )
    fresh, recorder = tmp_path / "fresh", tmp_path / "recorder"
    fresh.mkdir()
    recorder.write_text("#!/bin/sh\nprintf '%s\\0' \"$@\" >> ../words\nprintf '\\n' >> ../words\n")
    recorder.chmod(0o755)
    environment = os.environ | {"MODELER": "../recorder"}
    subprocess.run(["sh", "../steps.sh"], cwd=fresh, env=environment, check=True)
    for words in (tmp_path / "words").read_text(encoding="utf-8").split("\0\n")[:-1]:
        assert run_command(fresh, words.split("\0"))[0] == 0, words
    check_same(worked, fresh)
    there, here = (json.loads((at / "results/2.json").read_text()) for at in (worked.folder, fresh))
    assert there == here  # the same diagnosis
    assert not (fresh / "models/3.json").exists()  # what was set aside is not reported again
    assert before == {p: p.stat().st_mtime_ns for p in worked.folder.rglob("*") if p.is_file()}


@slow_rotating("screens of the studio")
def test_the_notebook_makes_the_same_in_an_empty_folder(worked, tmp_path):
    book = json.loads(export_screen.format_notebook(retold(worked)))
    assert (book["nbformat"], book["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in book["cells"]}) == len(book["cells"])
    code = ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]
    program = "\n".join([*code[:-1], f"print(({code[-1]}).relative_error)"])
    said = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, check=True, capture_output=True, text=True
    ).stdout
    check_same(worked, tmp_path)
    compared = json.loads((worked.folder / "results/5.json").read_text())
    assert float(said.split()[-1]) == pytest.approx(compared["relative_error"], rel=1e-12)


def test_going_back_and_forth_loses_nothing(axis_project):
    """The robot file goes along with the model that is looked at, unless it was edited."""
    from modeler.studio.fit_screen import find_lost_effects
    from modeler.studio.studio import Studio

    folder, place = axis_project, axis_project / "robot.toml"
    with hub_of(folder) as hub:
        fit, added = run_tasks(hub, commands.fit, lambda p: commands.add(p, "spring", "1"))
        plain, text = ((folder / fit.robot_copy).read_text("utf-8"), place.read_text("utf-8"))
        assert "spring" in text and "spring" not in plain
        (refit,) = run_tasks(hub, commands.fit, keep=False)
        assert json.loads((folder / refit.model_file).read_text("utf-8"))["robot_text"] == text
        for step in (fit, added):  # back, and forth
            hub.take_step(step)
            again = Workspace(folder).project
            assert (
                again.steps == (fit, added) and again.collect_path() == [fit, added][: step.number]
            )
            assert all((folder / step.model_file).is_file() for step in again.collect_path())
            assert place.read_text("utf-8") == (plain if step == fit else text)
        edited = text.replace("[effects]", "# edited\n[effects]")
        place.write_text(edited, encoding="utf-8")
        hub.take_step(fit)
        assert place.read_text("utf-8") == edited
        assert [*find_lost_effects(Studio(hub, "fit"), commands.fit(hub.project))] == []
        hub.take_step(added)
        place.write_text(plain + "# edited\n", encoding="utf-8")
        (line,) = find_lost_effects(Studio(hub, "fit"), commands.fit(hub.project))
    assert line.startswith("this fit leaves out spring of joint 1, which the current model")


def test_the_notebook_guesses_where_the_commands_guess():
    """Logs that are called differently are mapped each by its own names."""
    a, b, auto = (LogPart("a.csv"),), (LogPart("b.csv"),), ("auto",)
    tasks = (
        Task("fit", a, mapping=auto),
        Task("add", a, b, auto, effect="spring"),
        Task("diagnose", a, mapping=auto),
        Task("compare", b, mapping=auto),
    )
    steps = tuple(Step(k, k - 1, task) for k, task in enumerate(tasks, start=1))
    text = export_screen.format_notebook(export_screen.Recipe(Path("here"), steps, {}, frozenset()))
    assert text.count("mapping=['auto']") == len(tasks)
