"""What the studio types parses; what it retells makes the same values in an empty folder."""

import asyncio
import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from modeler.api import load, simulate
from modeler.cli.commands import parser
from modeler.core.builtin import builtin_text
from modeler.studio import commands, recipe
from modeler.studio.missing_screen import tried
from modeler.studio.project import Project, ProjectLog, Step, Stretch, Workspace
from modeler.studio.studio import Hub
from tests.turns import in_turn

LOGS = (
    ProjectLog("logs/day one.csv", (Stretch(0.0, 4.0), Stretch(4.5)), out=(Stretch(2.0, 2.5),)),
    ProjectLog("logs/b.csv", test=(Stretch(end=6.0),)),
)
PROJECT = Project(
    robot="robot.toml", current=1, mapping=("q<j>=angle_{j}:deg",), logs=LOGS,
    without=("backlash", "time_delay", "stribeck@2"),
    steps=(Step(1, 0, "fit", ("fit", "robots/1.toml", "x.csv", "--out", "models/1.json"),
                "fit", "models/1.json", "results/1.json"),),
)  # fmt: skip


@pytest.mark.parametrize(
    "asked",
    [
        commands.fit(PROJECT),
        commands.fit(PROJECT, ("--method", "robust", "--cutoff", "30", "--essential-below", "15")),
        commands.fit(PROJECT, ("--effects", "viscous,coulomb", "--derivatives", "position")),
        commands.compare(PROJECT),
        commands.diagnose(PROJECT),
        commands.add(PROJECT, "spring", "1"),
        commands.add(PROJECT, "auto", None),
        commands.again(PROJECT, PROJECT.steps[0]),
        commands.generate(PROJECT, "single"),
        commands.export(PROJECT, "mjcf"),
        commands.export(PROJECT, "urdf", "arm.urdf"),
        commands.demo(PROJECT, "logs/train.parquet", 1),
        commands.look(PROJECT, "logs/b.csv"),
        commands.new_robot(3),
    ],
    ids=lambda asked: f"{asked.kind} {len(asked.words)}",
)
def test_what_is_typed_parses(asked):
    more, result, _ = commands.bookkeeping(asked.words, 2)
    given = parser().parse_args([*asked.words, *more])
    assert given.command == asked.words[0] and given.json == result
    if asked.model:
        assert asked.model in (getattr(given, "out", ""), getattr(given, "report", ""))


def test_a_step_is_known_again_but_for_its_number():
    one = commands.add(PROJECT, "spring", "1")
    step = Step(2, 1, "add", one.words, model=one.model)
    later = dataclasses.replace(PROJECT, steps=(*PROJECT.steps, step))
    assert commands.add(later, "spring", "1").words != one.words
    assert tried(later, "spring", "1") == step
    assert tried(later, "spring", "2") is None
    assert tried(dataclasses.replace(later, logs=LOGS[:1]), "spring", "1") is None
    assert tried(dataclasses.replace(later, current=2), "spring", "1") is None


def write_log(path: Path, seed: int) -> None:
    """A log of an arm with friction that its model lacks, in degrees, under other names."""
    run = simulate(load("two-link"), duration=7.0, rate=250.0, seed=seed, hide=["load_friction@1"])
    columns = {"time": run.time}
    for j in range(2):
        columns |= {f"angle_{j + 1}": np.degrees(run.q[:, j]), f"tau{j + 1}": run.tau[:, j]}
    table = np.column_stack(list(columns.values()))
    np.savetxt(path, table, delimiter=",", header=",".join(columns), comments="", fmt="%.12g")


@pytest.fixture(scope="module")
def worked(tmp_path_factory) -> Workspace:
    """A project with a mapping, stretches, a gap and bans: fitted, looked at, added, set aside."""
    folder = tmp_path_factory.mktemp("worked") / "it's a project"
    (folder / "logs").mkdir(parents=True)
    (folder / "robot.toml").write_text(builtin_text("two-link"), encoding="utf-8")
    for seed, log in enumerate(LOGS, start=31):
        write_log(folder / log.file, seed)
    workspace = Workspace(folder)
    project = dataclasses.replace(PROJECT, current=0, steps=())
    workspace.save(dataclasses.replace(project, without=("backlash", "time_delay")))

    async def work() -> None:
        hub = Hub(workspace, (), {})
        await hub.run(commands.fit(hub.project, ("--method", "robust", "--essential-below", "20")))
        await hub.run(commands.diagnose(hub.project))
        await hub.run(commands.add(hub.project, "offset", "2"), current=False)  # a preview
        (found,) = json.loads((folder / "results/2.json").read_text())["effects"][:1]
        await hub.run(commands.add(hub.project, found["effect"], found["joint"]))
        await hub.run(commands.compare(hub.project))

    asyncio.run(work())
    return workspace


def retold(workspace: Workspace) -> recipe.Recipe:
    """As the screen asks for it."""
    folder, project = workspace.folder, workspace.project
    copies = {w for step in project.steps for w in step.words if commands.is_copy(w)}
    robots = {name: (folder / name).read_text(encoding="utf-8") for name in copies}
    return recipe.recipe(project, folder, robots)


def check_same(workspace: Workspace, fresh: Path) -> None:
    """Every model on the way has the same values, sigmas and effects."""
    folder = workspace.folder
    way = workspace.project.path()
    assert [step.kind for step in way] == ["fit", "add"]
    for step in way:
        there, here = (json.loads((p / step.model).read_text()) for p in (folder, fresh))
        for key in ("value", "sigma"):
            a, b = (np.array([p[key] for p in m["fit"]["parameters"]]) for m in (there, here))
            np.testing.assert_allclose(b, a, rtol=1e-12, atol=1e-12)
        assert here["robot_text"] == there["robot_text"]
        effects = [[one["effect"] for one in m["history"]] for m in (there, here)]
        assert effects[0] == effects[1]
    assert effects[0][1] == "load_friction"


def test_the_script_makes_the_same_in_an_empty_folder(worked, tmp_path):
    before = {p: p.stat().st_mtime_ns for p in worked.folder.rglob("*") if p.is_file()}
    (tmp_path / "steps.sh").write_text(recipe.script(retold(worked)), encoding="utf-8")
    fresh = tmp_path / "fresh"
    fresh.mkdir()
    environment = os.environ | {"MODELER": f"{sys.executable} -m modeler.cli"}
    subprocess.run(["sh", "../steps.sh"], cwd=fresh, env=environment, check=True)
    check_same(worked, fresh)
    there, here = (
        json.loads((place / "results/2.json").read_text()) for place in (worked.folder, fresh)
    )
    assert there == here  # the same diagnosis
    assert not (fresh / "models/3.json").exists()  # what was set aside is not told again
    assert before == {p: p.stat().st_mtime_ns for p in worked.folder.rglob("*") if p.is_file()}


@in_turn("screens of the studio")
def test_the_notebook_makes_the_same_in_an_empty_folder(worked, tmp_path):
    book = json.loads(recipe.notebook(retold(worked)))
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


def test_going_back_and_forth_loses_nothing(worked):
    every = worked.project.steps
    fit, preview, added = (s for s in every if s.kind in ("fit", "add"))
    for number in (fit.number, preview.number, added.number):
        worked.save(dataclasses.replace(worked.project, current=number))
        again = Workspace(worked.folder).project
        assert again.steps == every and again.current == number
        assert all((worked.folder / step.model).is_file() for step in again.path())
    assert worked.project.path() == [fit, added]


def test_the_notebook_guesses_where_the_commands_guess():
    """Logs that are called differently are mapped each by its own names."""
    words = {"fit": ("fit", "robots/1.toml", "a.csv", "--out", "models/1.json", "--map", "auto"),
             "add": ("add", "models/1.json", "spring", "a.csv", "--holdout", "b.csv", "--map",
                     "auto", "--out", "models/2.json"),
             "diagnose": ("diagnose", "models/1.json", "a.csv", "--map", "auto"),
             "compare": ("compare", "models/2.json", "b.csv", "--map", "auto")}  # fmt: skip
    steps = tuple(Step(k, 0, kind, own) for k, (kind, own) in enumerate(words.items(), start=1))
    told = recipe.notebook(recipe.Recipe(Path("here"), steps, {}, frozenset()))
    assert told.count("mapping=['auto']") == len(words)
