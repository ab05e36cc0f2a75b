"""The gallery of effects: every effect has its page, and what stands on it can be done."""

import re
import shlex
import struct
import tomllib
from functools import cache
from pathlib import Path

import pytest

from docsite import days
from docsite.effects import SCENES, Portrait, Scene, effects_index, portrait
from docsite.gallery import exhibit, gallery_front
from docsite.hooks import on_config
from modeler.cli import main
from modeler.cli.parser import build_parser
from modeler.core.choices import read_builtin_robot
from modeler.effects import CATALOGUE, Effect
from modeler.robot import parse_robot_text, replace_effects
from modeler.simulation import HIDDEN
from tests.rotation import ROTATING, rotating, with_cases

QUICK = ("stribeck", "payload")
"""A column and a body; the others rotate."""


@cache
def made(name: str) -> Portrait:
    return portrait(name)


def code_blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page, re.MULTILINE | re.DOTALL)


def size(png: bytes) -> tuple[int, int]:
    assert png.startswith(b"\x89PNG")
    width, height = struct.unpack(">II", png[16:24])
    return width, height


@pytest.mark.parametrize("effect", CATALOGUE, ids=lambda effect: effect.id)
def test_the_commands_of_every_effect_parse(effect: Effect) -> None:
    assert {*SCENES} <= {effect.id for effect in CATALOGUE}
    commands = SCENES.get(effect.id, Scene()).commands(effect.id)
    parsed = [build_parser().parse_args(shlex.split(line)[1:]) for line in commands]
    hidden = next(words for words in parsed if getattr(words, "hide", None))
    assert [text.partition("@")[0] for text in hidden.hide] == [effect.id]
    assert parsed[-1].logs == [hidden.out] and parsed[-1].model == parsed[-2].out


@pytest.mark.rotating("long tests of docsite")
@with_cases(
    "name",
    "stribeck",
    *rotating("payload"),
    *(pytest.param(e.id, marks=ROTATING) for e in CATALOGUE if e.id not in QUICK),
)
def test_an_effect_has_its_page(name: str) -> None:
    result = made(name)
    effect, page = result.effect, result.page
    assert page.startswith(f"# {effect.title[0].upper()}") and f"`{name}`" in page
    assert code_blocks(page, "text")[0].strip() == effect.equation
    for column in effect.columns if effect.acts.name in ("JOINT", "MOTOR", "POSITION") else ():
        assert f"| `{column.prefix}` | `{column.equation.text}` |".replace("\\", "") in page
    for words in (effect.signature, effect.source):
        assert words.split(";")[0].split("_")[0].split("|")[0].split("*")[0] in page
    assert effect.confounders[1:].split("(")[0] in page
    if name not in HIDDEN:
        assert result.picture is None and "Nothing simulates" in page
        return
    assert result.picture is not None and result.thumbnail is not None
    assert size(result.picture)[0] > 900 and size(result.thumbnail)[0] < 500
    assert f"]({name}.png)" in page
    verdict = code_blocks(page, "text")[1]
    assert name in verdict, "the diagnosis names something else"
    for line in "".join(code_blocks(page, "sh")).splitlines():
        build_parser().parse_args(shlex.split(line)[1:])


@pytest.mark.rotating("long tests of docsite")
@pytest.mark.parametrize("name", ["stribeck", *rotating("position_friction")])
def test_the_lines_of_a_robot_file_are_those_of_a_robot(name: str) -> None:
    (lines,) = code_blocks(made(name).page, "toml")
    text = replace_effects(read_builtin_robot("two-link"), tomllib.loads(lines)["effects"])
    assert {use.effect for use in parse_robot_text(text, "two-link").effects} == {name}


@pytest.mark.rotating("pages of effects")
def test_a_picture_is_what_its_commands_draw(tmp_path: Path, monkeypatch, capsys) -> None:
    """End to end: the file that the page names is written, and the values are those it shows."""
    monkeypatch.chdir(tmp_path)
    page = made("stribeck").page
    for line in code_blocks(page, "sh")[0].splitlines():
        capsys.readouterr()
        assert main(shlex.split(line)[1:]) == 0
    (drawn,) = re.findall(r"`(pictures/[\w.]+\.png)`", page)
    assert size(Path(drawn).read_bytes())[0] > 900
    printed = " ".join(capsys.readouterr().out.split())
    for line in " ".join(code_blocks(page, "text")[1].split()).split(": error")[:1]:
        assert line in printed


def test_pictures_of_effects_take_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every effect has its picture on one of so many days."""
    monkeypatch.setenv("EVERY", "3")
    turns: list[int] = []
    for day in range(3):
        monkeypatch.setattr(days.time, "time", lambda day=day: 86400.0 * day + 1)
        turns += [place for place in range(len(CATALOGUE)) if days.has_its_turn(place)]
    assert sorted(turns) == [*range(len(CATALOGUE))]
    monkeypatch.delenv("EVERY")
    assert all(days.has_its_turn(place) for place in range(3))


@pytest.mark.rotating("pages of effects")
def test_the_indices_lead_to_all() -> None:
    shown = [made(name) for name in QUICK]
    index = effects_index(shown)
    front = gallery_front([exhibit("two-link")], shown)
    for name in QUICK:
        assert f"]({name}.md)" in index and f"](effects/{name}.md)" in front
    assert "](robots/two-link.md)" in front and "studies/measured-sets.md" in front
    assert "](../../robots/wrist.md)" in exhibit("wrist").page
    assert "../../robots/" not in exhibit("scara").page
    config = {"nav": [{"Effects": ["gallery/effects/index.md"]}]}
    entries = on_config(type("Config", (), config)()).nav[0]["Effects"][1:]
    assert entries == [{e.id: f"gallery/effects/{e.id}.md"} for e in CATALOGUE]
