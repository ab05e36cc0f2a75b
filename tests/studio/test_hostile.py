"""A project that somebody else made to do harm: nothing of it is run, nothing outside touched."""

import ast
import asyncio
import json
from dataclasses import replace
from pathlib import Path

import pytest

from modeler import studio
from modeler.core.errors import DataError, ModelerError
from modeler.studio.commands import Asked
from modeler.studio.places import Roots
from modeler.studio.project import (
    Project,
    ProjectLog,
    Step,
    Stretch,
    Workspace,
    project_from_text,
    project_text,
)
from modeler.studio.recipe import notebook, recipe
from modeler.studio.studio import Hub


@pytest.mark.parametrize(
    "file",
    [
        "/etc/passwd", "../robot.toml", "models/../../x.json", "models/..", "..", "~/x", "a\nb",
        "models/1;import os.json", 'x"y', "-x y", "models//x", "./x",
    ],
)  # fmt: skip
@pytest.mark.parametrize("field", ["robot", "model", "result", "pictures"])
def test_a_project_names_no_file_outside(file: str, field: str) -> None:
    step = Step(1, 0, "fit", ("fit",))
    project = Project(steps=(step,))
    project = (
        Project(robot=file)
        if field == "robot"
        else replace(project, steps=(replace(step, **{field: file}),))
    )
    with pytest.raises(DataError, match=r"is no file of this folder; expected a file that"):
        project_from_text(project_text(project), "project.toml")


def test_files_of_the_studio_itself_are_its_own() -> None:
    step = Step(
        3, 0, "fit", ("fit",), "", "models/3.json", "results/3.json", "results/3.pictures.json"
    )
    project = Project(robot="robot.toml", steps=(step, replace(step, number=4, model="taken/4_c")))
    assert project_from_text(project_text(project), "project.toml") == project


@pytest.mark.parametrize(
    ("words", "outside"),
    [
        (("fit", "robots/1.toml", "logs/a.csv@1:2", "--out", "models/1.json"), False),
        (("log", "{0}/data/a.csv", "--map", "q1=/joint_states.position[0]:rad"), False),
        (("log", "{0}/data/a.csv@0:5"), False),
        (("log", "{0}/other/a.csv"), True), (("log", "{0}/other/a.csv@0:5"), True),
        (("log", "../other/a.csv"), True), (("log", "logs/../../other/a.csv"), True),
        (("derive", "emps", "--coefficients-out", "{0}/.bashrc.md"), True),
        (("derive", "emps", "--coefficients-out=../.bashrc.md"), True),
        (("log", "logs/a.csv", "--map", "/etc/passwd"), True),
        (("fit", "emps", "logs/a.csv", "--out", "models/out.json"), True),
        (("fit", "emps", "linked/a.csv", "--out", "models/1.json"), True),
    ],
)  # fmt: skip
def test_words_lead_nowhere_else(tmp_path: Path, words: tuple[str, ...], outside: bool) -> None:
    """Neither those of a project.toml, nor links that came with the folder."""
    folder = tmp_path / "project"
    for name in ("project/models", "project/logs", "data", "other"):
        (tmp_path / name).mkdir(parents=True)
    given = tuple(word.format(tmp_path) if "{0}" in word else word for word in words)
    hub = Hub(Workspace(folder), (tmp_path / "data",), {})
    (folder / "models/out.json").symlink_to(tmp_path / ".profile")
    (folder / "linked").symlink_to(tmp_path / "other")
    if not outside:
        Roots((folder, tmp_path / "data")).check_words(folder, given)
        return
    with pytest.raises(ModelerError, match=r"outside the folders that this studio may use; start"):
        asyncio.run(hub.run(Asked(given[0], given, "do harm")))
    assert not (tmp_path / ".profile").exists() and not list(folder.glob("results/*"))


@pytest.mark.parametrize(
    "name",
    ["robot.toml", "robot.draft.toml", "project.toml", "models", "robots/1.toml", "taken/3_c"],
)
def test_a_project_whose_places_are_links_is_not_opened(tmp_path: Path, name: str) -> None:
    """They would be written over: a robot that is edited ended in somebody's profile."""
    place = tmp_path / "project" / name
    place.parent.mkdir(parents=True)
    place.symlink_to(tmp_path / ".profile")
    folder = tmp_path / "project"
    with pytest.raises(DataError, match=r"outside the folders that this studio may use"):
        Hub(Workspace(folder), (), {})
    Hub(Workspace(folder), (tmp_path,), {}).close()  # --allow


def test_no_file_outside_is_downloaded(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("x")
    (tmp_path / "p" / "sub").mkdir(parents=True)
    (tmp_path / "p/own").write_text("x")
    (tmp_path / "p/sub/link").symlink_to(tmp_path / "secret")
    hub = Hub(Workspace(tmp_path / "p"), (), {})
    assert hub.download(tmp_path / "p/own", "own").startswith("/download/")
    for name in ("../secret", "sub/link", "none"):
        with pytest.raises(DataError, match=r"outside|no such file"):
            hub.download(tmp_path / "p" / name, "x")


def test_a_notebook_holds_words_as_words(tmp_path: Path) -> None:
    """What is taken away is run elsewhere, by somebody who trusts it."""
    evil = "__import__('pathlib').Path('evil').write_text('x')"
    simulate = ("simulate", f"robots/1.toml{evil}", "--out", f"logs/{evil}.csv", "--hide", evil)
    fit = ("fit", "robots/2.toml", f"logs/{evil}.csv", "--map", f"q1={evil}", "--method", evil,
           "--out", "models/2.json")  # fmt: skip
    add = (
        "add",
        "models/2.json",
        evil,
        f"logs/{evil}.csv",
        "--joint",
        evil,
        "--out",
        "models/3.json",
    )
    steps = (
        Step(1, 0, "simulate", simulate, f"a\n{evil}"),
        Step(2, 0, "fit", fit, evil, "models/2.json"),
        Step(3, 2, "add", add, evil, "models/3.json"),
    )
    project = Project("robot.toml", 3, steps=steps, logs=(ProjectLog("logs/a.csv", (Stretch(),)),))
    book = json.loads(notebook(recipe(project, tmp_path / evil, {})))
    for cell in book["cells"]:
        if cell["cell_type"] == "code":
            for node in ast.walk(ast.parse("".join(cell["source"]))):
                assert not (isinstance(node, ast.Name) and node.id == "__import__")
    number = replace(
        steps[0], words=("simulate", "emps", "--duration", evil, "--out", f"logs/{evil}.csv")
    )
    with pytest.raises(ValueError, match="could not convert"):
        notebook(recipe(replace(project, steps=(number, *steps[1:]), logs=()), tmp_path, {}))


# Parts of an attribute that are no names of anybody's.
OURS = {
    "kind", "endings", "named", "NAME", "address", "'-alone' * alone", "number",
    "'true' if here else 'false'", "'pause' if event.args else 'play_arrow'",
}  # fmt: skip


def test_names_are_no_part_of_a_text_of_attributes() -> None:
    """What stands in `props(...)` is parsed: a quote in a name would begin a program there."""
    found = set()
    for path in Path(studio.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "props":
                for part in (part for word in node.args for part in ast.walk(word)):
                    if isinstance(part, ast.FormattedValue):
                        found.add(ast.unparse(part.value))
                    assert not isinstance(part, ast.BinOp | ast.Mod) or "alone" in ast.unparse(part)
    assert found <= OURS, "write element.props[NAME] = TEXT, which is not parsed"
    assert len(found) > 4
