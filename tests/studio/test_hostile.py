"""A project that somebody else made to do harm: nothing of it is run, nothing outside touched."""

import ast
import dataclasses
import itertools
import json
import os
import random
import subprocess
from collections.abc import Awaitable
from pathlib import Path
from typing import Any, get_args

import pytest

from modeler import studio
from modeler.cli import main
from modeler.cli.parser import build_parser
from modeler.core.errors import DataError, ModelerError
from modeler.estimation import load_model, save_model
from modeler.studio.export_screen import build_recipe, format_notebook, format_script
from modeler.studio.places import Roots
from modeler.studio.project import Project, ProjectLog, Workspace, format_project, parse_project
from modeler.studio.tasks import FIELDS, LogPart, Step, Task, TimeRange, Verb, build_command_line
from tests.coroutines import run_coroutine
from tests.rotation import with_cases
from tests.studio.hubs import hub_of, run_tasks

# What a project of somebody else may do, once it is accepted: these commands, with these options.
FIT = "--map --method --derivatives --cutoff --parallel-cutoff --low-speed --essential-below "
ALLOWED = {
    "fit": f"{FIT} --effects --out",
    "add": "--holdout --map --joint --out",
    "compare": "--map",
    "contest": "--map",
    "diagnose": "--holdout --map --without",
    "excite": "--between --duration --limit --out",
    "generate": "--precision --out",
    "export": "--to --like --out",
    "log": "--robot --map",
    "convert": "--out --force",
    "page": f"{FIT} --effects --holdout --without --joint --out --report",
    "new": "--joints --template --convention --force",
    "derive": "--no-terms",
    "simulate": "--duration --noise --hide --seed --out",
    "fleet": "--name --map",
}
WORDS = {
    **{"mapping": "q1=a:deg", "limit": "1=-1,1,2,3", "between": "a@1,b@2", "effects": "viscous"},
    **{"without": "spring@1", "effect": "spring", "joint": "2", "method": "robust"},
    **{"derivatives": "log", "precision": "single", "to": "urdf", "like": "arm.urdf"},
    **{"joints": "RRR", "template": "serial", "convention": "craig"},
    "name": "{machine}-{period}.csv",
}
HARM = (
    *"--run-embedded-c -x --out=../x --report - ../../x a/../../x /etc/passwd".split(),
    *("a\nb", "\x00", "--", "logs/../../a.csv", "..", " --run-embedded-c", "\u2212-x", "a\\..\\b"),
)
PUT = (b"", b'"', b"-", b"\xff", b"[", b"1e999", b"--out", b"\n", b"{", b"../")
MAY_BE = {"file", "like", "logs", "held", "mapping", "limit", "between", "name", "without"}


def task_of(verb: Verb, **harm: object) -> Task:
    """One with all the values that its verb may have."""
    logs = (LogPart("logs/a.csv", TimeRange(0.0, 2.0)),)
    known = {"logs": logs, "held": logs, "file": "logs/a.csv", "robot": True, "models": (1, 2)}
    local: dict[str, object] = {}
    for field in dataclasses.fields(Task)[1:]:
        if field.name in FIELDS[verb].split():
            word = known.get(field.name, WORDS.get(field.name, 1))
            many = field.name in WORDS and isinstance(field.default, tuple)
            local[field.name] = (word,) if many else word
    if verb == "export":
        del local["like"]
    return Task(verb, **{**local, **harm})  # type: ignore[arg-type]


PLACES = (
    *"robot.toml robot.draft.toml models robots/1.toml taken/3_c logs originals".split(),
    "taken/4_c/deep/model.c",
)
STEPS = tuple(
    Step(n, min(n - 1, 1), task_of(verb))
    for n, verb in enumerate(("fit", "add", "compare", "diagnose"), start=1)
)


PARSER = build_parser()


def check_harmless(verb: Verb, words: tuple[str, ...]) -> None:
    """No option but those of the list, and argparse finds no other one either."""
    options = {word for word in words if word.startswith("-")}
    assert options <= set(ALLOWED[verb].split()), words
    assert not vars(PARSER.parse_args(words)).get("run_embedded_c"), words


@pytest.mark.parametrize("verb", get_args(Verb))
def test_what_a_project_of_somebody_else_may_do(verb: Verb) -> None:
    """The whole list: a step holds values, and these are all options that they become."""
    assert set(FIELDS) == set(ALLOWED) == set(get_args(Verb))
    for of in STEPS if verb == "page" else STEPS[:1]:
        task = Task("page", step=of.number) if verb == "page" else task_of(verb)
        words = build_command_line(Step(9, 1, task), STEPS)
        check_harmless(verb, words)
        assert [word for word in words if word.startswith("-")]


@pytest.mark.parametrize("verb", get_args(Verb))
def test_no_value_is_an_option_or_leads_out(verb: Verb, tmp_path: Path) -> None:
    """A value is refused, or it is that value of that option, and its files are inside."""
    roots = Roots((tmp_path,))
    for field, harm in itertools.product(dataclasses.fields(Task)[1:], HARM):
        known = field.name in FIELDS[verb].split()
        if field.default in (0, False, None) or field.name == "models":
            continue  # numbers
        if not known and harm is not HARM[0]:
            continue  # of no task of that verb, whatever it is
        many = isinstance(field.default, tuple)
        value = LogPart(harm) if field.name in ("logs", "held") else harm
        step = Step(9, 1, task_of(verb, **{field.name: (value,) if many else value}))
        text = format_project(Project(steps=(*STEPS, step)))
        try:
            words = build_command_line(step, STEPS)
        except DataError:
            with pytest.raises(DataError):
                parse_project(text, "project.toml")
            continue
        assert parse_project(text, "project.toml").steps[-1] == step
        assert field.name in MAY_BE
        check_harmless(verb, words)
        if field.name in ("file", "like", "logs", "held") and harm.startswith("/"):
            with pytest.raises(DataError, match="outside the folders that this studio may use"):
                roots.check_words(tmp_path, words)


def test_a_step_that_holds_words_is_no_step() -> None:
    """The words of a step were run again for its report page: they compiled C of a model file."""
    for more in ('words = ["compare", "--run-embedded-c"]', 'model = "--run-embedded-c"'):
        text = f"[[steps]]\nnumber = 1\nparent = 0\ntask = {{ verb = 'compare' }}\n{more}\n"
        with pytest.raises(DataError, match="is unknown"):
            parse_project(text, "project.toml")
    page = Step(2, 1, Task("page", step=1))
    for of in (Task("generate"), Task("page", step=2), Task("simulate", file="logs/a.csv")):
        with pytest.raises(DataError, match="has no report page"):
            build_command_line(page, (Step(1, 0, of), page))


CONSTRUCTOR = """
#include <stdio.h>
__attribute__((constructor)) static void harm(void) {{
    FILE *file = fopen("{}", "w"); if (file) fclose(file);
}}
"""


def test_changed_c_of_a_model_is_never_run(axis_project: Path, tmp_path: Path) -> None:
    """All that a project may do with its model, and all that is drawn of it."""
    from modeler.studio.studio import Studio

    folder, mark = axis_project, tmp_path / "harmed"
    place, log = folder / "models/1.json", (LogPart("logs/a.csv"),)
    assert main(["fit", "emps", str(folder / "logs/a.csv"), "--out", str(place)]) == 0
    model, code = load_model(place), CONSTRUCTOR.format(mark)
    changed = {**model.sources, "emps.c": model.sources["emps.c"] + code}
    save_model(place, dataclasses.replace(model, sources=changed))  # with its checksum
    load_model(place).compile()
    assert mark.exists()  # it would do harm
    mark.unlink()
    Workspace(folder).save(Project("robot.toml", 1, steps=(Step(1, 0, Task("fit", log)),)))
    with hub_of(folder) as hub:
        tasks = (Task("compare", log), Task("page", step=2), Task("generate"))
        run_tasks(hub, *(lambda _, task=task: task for task in tasks))
        run_coroutine(Studio(hub, "fails").ask_viewer("verdict", "models/1.json", ["logs/a.csv"]))
        assert [step.verb for step in hub.project.steps] == ["fit", "compare", "page", "generate"]
    assert not mark.exists()
    written = [path.read_text() for path in (folder / "taken").rglob("*.[ch]")]
    assert written and not any(str(mark) in text for text in written)


@pytest.mark.parametrize("place", ["mapping", "without", "logs"])
@pytest.mark.parametrize("harm", ["--run-embedded-c", "-x", "a\nb", "", "../x.toml"])
def test_nor_do_the_values_beside_the_steps(place: str, harm: str) -> None:
    if (place, harm) == ("without", "../x.toml"):
        return  # an effect, which there is not
    value = (ProjectLog(harm, (TimeRange(),)),) if place == "logs" else (harm,)
    project = dataclasses.replace(Project(), **{place: value})
    with pytest.raises(DataError, match=r"expected|empty"):
        parse_project(format_project(project), "project.toml")


def test_numbers_name_files() -> None:
    for number, parent in ((0, 0), (-1, 0), (10**9, 0), (1, -3)):
        text = format_project(Project(steps=(Step(number, parent, Task("derive")),)))
        with pytest.raises(DataError, match="expected 1 to 999999999"):
            parse_project(text, "project.toml")


def test_thousands_of_mutated_projects_end_in_a_line(tmp_path: Path) -> None:
    """Bytes of a sound file changed: it is read, or one line says what is wrong."""
    steps = (*STEPS, *(Step(n + 3, 1, task_of(verb)) for n, verb in enumerate(("add", "excite"))))
    log = ProjectLog("logs/a.csv", (TimeRange(0.0, 2.0),))
    sound = format_project(Project("robot.toml", 1, ("q1=a",), logs=(log,), steps=steps)).encode()
    draw = random.Random(45)
    place = tmp_path / "project.toml"
    for _ in range(300):
        content = bytearray(sound)
        for _ in range(draw.randrange(1, 4)):
            at = draw.randrange(len(content))
            content[at : at + draw.choice((0, 1, 9))] = draw.choice(PUT)
        place.write_bytes(content)
        try:
            project = Workspace(tmp_path).project
        except DataError as error:
            assert "\n" not in str(error)
        else:
            for step in project.steps:
                words = build_command_line(step, project.steps)
                assert "--run-embedded-c" not in words and "--out" not in words[1:-2]


def test_logs_outside_are_neither_run_nor_drawn(tmp_path: Path) -> None:
    """One rule for commands and for what is drawn, whoever lists the log."""
    from modeler.studio.studio import Studio

    folder = tmp_path / "project"
    rows = "\n".join(f"{0.01 * k},{0.1 * k},{k % 7}" for k in range(50))
    for name in ("project/logs", "data", "other"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "a.csv").write_text(f"time,q1,tau1\n{rows}\n")
    (folder / "logs/many").mkdir()
    (folder / "linked").symlink_to(tmp_path / "other")
    for name in ("logs/link.csv", "logs/run_q.csv", "logs/many/a.csv"):
        (folder / name).symlink_to(tmp_path / "other/a.csv")

    async def error_of(asked: Awaitable[object]) -> str:
        try:
            await asked
        except ModelerError as error:
            return str(error)
        return ""

    async def ask_all(hub: Any) -> None:
        view = Studio(hub, "data").ask_viewer
        for file in ("logs/a.csv", f"{tmp_path}/data/a.csv"):
            assert await error_of(view("log_facts", str(folder / file))) == ""
        linked = "linked/a.csv logs/link.csv logs/many logs/run".split()
        for file in (f"{tmp_path}/other/a.csv", *linked):
            for asked in (hub.run(Task("log", file=file)), view("log_facts", str(folder / file))):
                line = await error_of(asked)
                assert "outside the folders that this studio may use; start it with" in line

    with hub_of(folder, (tmp_path / "data",)) as hub:
        run_coroutine(ask_all(hub))


@with_cases("name", *PLACES)
def test_a_project_whose_places_are_links_is_not_opened(tmp_path: Path, name: str) -> None:
    """They would be written over: a robot that is edited ended in somebody's profile."""
    folder = tmp_path / "project"
    (folder / name).parent.mkdir(parents=True)
    (folder / name).symlink_to(tmp_path / ".profile")
    outside = r"outside the folders that this studio may use"
    with pytest.raises(DataError, match=outside), hub_of(folder):
        pass
    with hub_of(folder, (tmp_path,)):  # --allow
        pass


def test_no_file_outside_is_downloaded(tmp_path: Path) -> None:
    (tmp_path / "p" / "sub").mkdir(parents=True)
    for name in ("secret", "p/own"):
        (tmp_path / name).write_text("x")
    (tmp_path / "p/sub/link").symlink_to(tmp_path / "secret")
    with hub_of(tmp_path / "p") as hub:
        assert hub.register_download(tmp_path / "p/own", "own").startswith("/download/")
        for name in ("../secret", "sub/link", "none"):
            with pytest.raises(DataError, match=r"outside|no such file"):
                hub.register_download(tmp_path / "p" / name, "x")


def test_a_notebook_and_a_script_hold_values_as_values(tmp_path: Path) -> None:
    """What is taken away is run elsewhere, by somebody who trusts it."""
    evil = "__import__('pathlib').Path('evil').write_text('x') $(touch evil) `touch evil`"
    logs = (LogPart(f"logs/{evil}.csv"),)
    tasks = (
        Task("fit", logs, mapping=(f"q1={evil}",)),
        Task("diagnose", logs, without=(evil,)),
        Task("add", logs, logs, effect="spring"),
    )
    steps = tuple(Step(k, min(k - 1, 1), task) for k, task in enumerate(tasks, start=1))
    log = ProjectLog("logs/a.csv", (TimeRange(),))
    project = Project("robot.toml", 3, steps=steps, logs=(log,))
    local = build_recipe(project, tmp_path / evil, {})
    for cell in json.loads(format_notebook(local))["cells"]:
        if cell["cell_type"] == "code":
            for node in ast.walk(ast.parse("".join(cell["source"]))):
                assert not (isinstance(node, ast.Name) and node.id == "__import__")
    (tmp_path / "steps.sh").write_text(format_script(local))
    environment = {"PATH": os.environ["PATH"], "MODELER": "true"}
    (tmp_path / "fresh").mkdir()
    done = subprocess.run(["sh", "../steps.sh"], cwd=tmp_path / "fresh", env=environment)
    assert done.returncode == 0 and not list(tmp_path.rglob("evil"))


# Parts of an attribute that are no names of anybody's.
OURS = {
    *("kind", "endings", "named", "NAME", "address", "'-alone' * alone", "number"),
    *("'true' if here else 'false'", "'pause' if event.args else 'play_arrow'"),
}


def test_names_are_no_part_of_a_text_of_attributes() -> None:
    """What stands in `props(...)` is parsed: a quote in a name would begin a program there."""
    names = set()
    for path in Path(studio.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            called = isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2]
            if isinstance(node, ast.Call) and called in ("props", "add_button"):
                words = node.args[2:] if called == "add_button" else node.args
                for part in (part for word in words for part in ast.walk(word)):
                    if isinstance(part, ast.FormattedValue):
                        names.add(ast.unparse(part.value))
                    assert not isinstance(part, ast.BinOp | ast.Mod) or "alone" in ast.unparse(part)
    assert names <= OURS, "write element.props[NAME] = TEXT, which is not parsed"
    assert len(names) > 4
