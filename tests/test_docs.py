"""The documentation is run: all commands and programs shown work and print what is shown."""

import contextlib
import dataclasses
import io
import json
import os
import re
import shlex
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from modeler.cli import main
from modeler.cli.parser import read_families
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import RobotError
from modeler.effects.catalogue import CATALOGUE
from modeler.effects.effect import MOTION, EffectTarget
from modeler.regression.motion import Processing
from modeler.robot.read import _KEYS, parse_robot_text
from modeler.robot.table import COLUMNS
from modeler.simulation.physics import HIDDEN
from tests.rotation import ROTATING, with_cases

ROOT = Path(__file__).resolve().parents[1]
PAGES = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
PAGES = sorted(page.relative_to(ROOT).as_posix() for page in PAGES)
RUN = [
    page
    for page in PAGES
    if re.search(
        r"^```(?:console|python)$", (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE
    )
]
"""Every page that shows a command or a program; one that cannot run says `sh`, or is indented."""

TOLERANCE = 0.002  # of a shown number: a fit to the same log differs by less on any processor
# Decimal numbers, and counts of three digits and more (rows that survive a mask, say).
_FLOAT = re.compile(r"(?<![\w.*])-?(?:\d+\.\d+(?:e[-+]?\d+)?|\d{3,})(?![\w.]*\w)")


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, its lines, where it stands, and the text that follows."""

    kind: str
    lines: tuple[str, ...]
    line: int
    after: str


def blocks(text: str) -> Iterator[Block]:
    """The fenced blocks of a page."""
    lines = text.splitlines()
    fences = [i for i, line in enumerate(lines) if line.startswith("```")]
    assert len(fences) % 2 == 0, "a fence is not closed"
    for start, end in zip(fences[::2], fences[1::2], strict=True):
        kind = lines[start].removeprefix("```").strip()
        yield Block(kind, tuple(lines[start + 1 : end]), start + 1, "\n".join(lines[end + 1 :][:3]))


def same(shown: str, printed: str) -> bool:
    """True if two lines agree: texts and small counts exactly, other numbers nearly."""
    if _words(shown) != _words(printed):
        return False
    pairs = zip(_FLOAT.findall(shown), _FLOAT.findall(printed), strict=True)
    return all(_near(a, b) for a, b in pairs)


def _words(line: str) -> list[str]:
    return _FLOAT.sub(" # ", line).split()


def _bare(line: str) -> list[str]:
    """The words without counts."""
    return re.sub(r"\d+", "#", _FLOAT.sub("#", line)).split()


def _near(shown: str, printed: str) -> bool:
    a, b = float(shown), float(printed)
    mantissa, _, exponent = shown.partition("e")
    digit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    rounding = abs(a) < 1e-9 and abs(b) < 1e-9  # rounding errors differ from machine to machine
    return rounding or abs(a - b) <= digit + TOLERANCE * abs(a)


def missing(shown: list[str], printed: list[str]) -> str | None:
    """The first shown line that was not printed where it stands; "..." is any number of lines."""
    at, anywhere = 0, False
    for line in shown:
        if line == "...":
            anywhere = True
            continue
        while anywhere and at < len(printed) and not same(line, printed[at]):
            at += 1
        if at == len(printed) or not same(line, printed[at]):
            return line
        at, anywhere = at + 1, False
    if not anywhere and at < len(printed):
        return f'nothing, but "{printed[at]}" was printed'
    return None


def _place(words: Callable[[str], list[str]], line: str, printed: list[str], at: int) -> int | None:
    return next((i for i in range(at, len(printed)) if words(printed[i]) == words(line)), None)


def renewed(shown: list[str], printed: list[str]) -> list[str]:
    """The shown lines with the numbers that are printed now, where they differ by more than that.

    Lines are found by their words, in order; one whose words are not printed stays as it is.
    """
    at, lines = 0, []
    for line in shown:
        at_line = _place(_words, line, printed, at)
        if at_line is None:
            at_line = _place(_bare, line, printed, at)
        if at_line is None:
            lines.append(line)
            continue
        lines.append(line if same(line, printed[at_line]) else printed[at_line])
        at = at_line + 1
    return lines


class Reader:
    """Does what a reader of a page would do, block after block, in the current folder."""

    def __init__(self, page: str, regenerate: bool = False) -> None:
        self.page = page
        self.regenerate = regenerate
        self.replaced: dict[str, str] = {}
        self.printed: list[str] = []
        self.names: dict[str, object] = {"__name__": "__main__"}

    def do(self, block: Block) -> None:
        """One block."""
        where = f"{self.page}, line {block.line}"
        if block.kind in ("toml", "c", "par", "xml"):
            self._save(block, where)
        elif block.kind == "console":
            self._commands(block, where)
        elif block.kind == "python":
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile("\n".join(block.lines), where, "exec"), self.names)
            self.printed = out.getvalue().splitlines()
        elif block.kind == "text":
            self._check(list(block.lines), where)
        else:
            pytest.fail(f"{where}: blocks of kind {block.kind!r} are not run; use another")

    def _save(self, block: Block, where: str) -> None:
        suffix = f".{block.kind}"
        named = re.match(r"(?:#|/\*|\(\*|<!--) ([\w-]+\.\w+)", block.lines[0])
        saved = re.search(r"Save it as `([\w.-]+)`", block.after)
        name_line = named or saved
        name = name_line[1] if name_line else "snippet.c"
        suffixes = (".urdf", ".xml") if suffix == ".xml" else suffix
        assert name.endswith(suffixes) and (name_line or suffix == ".c"), f"{where}: its name?"
        Path(name).write_text("\n".join(block.lines) + "\n", encoding="utf-8")
        if suffix == ".c" and not any("main(" in line for line in block.lines):
            folders = sorted({f"-I{path.parent}" for path in Path().glob("*/*.h")})
            strict = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", name, *folders]
            subprocess.run(strict, check=True)

    def _commands(self, block: Block, where: str) -> None:
        starts = [i for i, line in enumerate(block.lines) if line.startswith("$ ")]
        assert starts and starts[0] == 0, f"{where}: a console block starts with a command"
        for start, end in zip(starts, [*starts[1:], len(block.lines)], strict=True):
            command, shown = block.lines[start][2:], list(block.lines[start + 1 : end])
            if command.startswith("make ") and not command.startswith("make -C "):
                continue  # of the checkout: sets everything up
            status, printed = run(command)
            refused = bool(shown) and shown[0].startswith("modeler: ")
            assert status == int(refused), f"{where}: {command}\n{printed}"
            self.printed = printed.splitlines()
            if shown:
                self._check(shown, f"{where}: {command}")

    def _check(self, shown: list[str], where: str) -> None:
        if self.regenerate:
            fresh = renewed(shown, self.printed)
            self.replaced |= {a: b for a, b in zip(shown, fresh, strict=True) if a != b}
            shown = fresh
        line = missing(shown, self.printed)
        printed = "\n".join(self.printed)
        assert line is None, f"{where}\nshown:   {line}\nprinted:\n{printed}"


def run(command: str) -> tuple[int, str]:
    """Exit status and output; `modeler` in this process, which saves the start of many others."""
    words = shlex.split(command)
    if words[0] != "modeler":
        done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, env=os.environ)
        return done.returncode, done.stdout + done.stderr
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        status = main(words[1:])
    return status, out.getvalue()


PICTURES = {
    "docs/explanation/motion-noise.md": "pictures/noise_of_the_motion.svg",
    "docs/how-to/reproduce.md": "pictures/figure_2.svg",
}
"""The picture of a page, written by its own commands."""


def _labels(picture: Path) -> list[str]:
    """All that is written in it; curves and numbers differ a little between machines."""
    return re.findall(r">([A-Za-z][^<]{2,})</", picture.read_text(encoding="utf-8"))


# Pages that take ten seconds and more: of their subjects, the README and the tutorial run some.
LONG = tuple(
    f"docs/{page}.md"
    for page in """
        how-to/servo-arms how-to/drive-gains how-to/diagnosis how-to/learned-law
        explanation/diagnosis how-to/free-run how-to/excitation how-to/motor-side
        explanation/least-squares explanation/motion-noise
    """.split()
)
DEAR = (
    "README.md",
    *(
        f"docs/{page}.md"
        for page in """
            explanation/paper how-to/better-urdf how-to/closed-forms how-to/controller
            how-to/energy-model how-to/estimators how-to/exporting how-to/fleet how-to/logs
            how-to/microcontrollers how-to/parallel-robots how-to/physical-parameters
            how-to/reproduce how-to/show reference/emitted-c reference/python robots/evra
            robots/orthoglide robots/parallel-examples tutorials/table-to-model
        """.split()
    ),
)
"""More than a second each: what they show is computed in tests of every day as well."""


def marks_of(page: str) -> Any:
    """When a page is run."""
    return ROTATING if page in LONG else [pytest.mark.rotating] * (page in DEAR)


@pytest.mark.parametrize("page", [pytest.param(page, marks=marks_of(page)) for page in RUN])
def test_a_reader_gets_what_the_page_shows(page, tmp_path, monkeypatch, regenerate):
    monkeypatch.chdir(tmp_path)
    reader = Reader(page, regenerate)
    text = (ROOT / page).read_text(encoding="utf-8")
    for block in blocks(text):
        reader.do(block)
    if page in PICTURES:
        drawn, shown = Path(PICTURES[page]), (ROOT / page).with_suffix(".svg")
        if regenerate:
            shown.write_bytes(drawn.read_bytes())
        assert _labels(shown) == _labels(drawn), f"{page}: make regenerate draws its picture anew"
    if reader.replaced:
        lines = [reader.replaced.get(line, line) for line in text.splitlines()]
        (ROOT / page).write_text("\n".join(lines) + "\n", encoding="utf-8")


def test_what_is_shown_is_renewed():
    shown, printed = ["a 1.50", "...", "b 2.500"], ["a 1.70", "x", "b 2.501"]
    assert renewed(shown, printed) == ["a 1.70", "...", "b 2.500"]
    assert renewed(["c 1.50"], ["d 1.70"]) == ["c 1.50"]


@with_cases(
    "shown, printed, missed",
    (["a 1.50", "b"], ["a 1.51", "b"], None),
    (["a 1.50"], ["a 1.70"], "a 1.50"),
    (["3 rows"], ["4 rows"], "3 rows"),
    (["run1.csv"], ["run2.csv"], "run1.csv"),
    (["at 1.20-1.65 s"], ["at 1.20-2.65 s"], "at 1.20-1.65 s"),
    (["4.7e-16 left"], ["1.2e-15 left"], None),
    (["4.7e-16 left"], ["1.2e-5 left"], "4.7e-16 left"),
    (["a", "...", "c"], ["a", "b", "c"], None),
    (["...", "c"], ["a", "c", "d"], 'nothing, but "d" was printed'),
    (["a", "c"], ["a", "b", "c"], "c"),
    (["b", "..."], ["a", "b", "c"], "b"),
)
def test_what_counts_as_shown(shown, printed, missed):
    assert missing(shown, printed) == missed


def anchors(page: Path) -> set[str]:
    """The headings of a page, as links spell them."""
    heads = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"https?://", target):
            continue
        file, _, anchor = target.partition("#")
        place = (ROOT / page).parent / file if file else ROOT / page
        assert place.is_file(), f"{page}: {target}"
        assert not anchor or anchor in anchors(place), f"{page}: {target}"
    for path in re.findall(r"`((?:modeler|docs|tests|csrc)/[\w/.-]+\.\w+)`", text):
        assert (ROOT / path).is_file(), f"{page}: {path}"


def text_of(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def test_every_key_of_a_robot_file_is_described():
    text = text_of("docs/reference/robot-file.md")
    for key in _KEYS.split():
        assert f"`{key}`" in text or f"`[{key}]`" in text, key
    for word in (*COLUMNS, "physical.<joint>"):
        assert re.search(rf"`\[?{re.escape(word)}\]?`", text), word
    for effect in CATALOGUE:
        assert effect.id in text, effect.id


def test_the_table_of_effects_on_loops_is_true():
    rows = dict(
        re.findall(
            r"^\| (in|not [^|]*|in [^|]*) \| ([a-z_, ]+) \|$",
            text_of("docs/how-to/parallel-robots.md"),
            re.MULTILINE,
        )
    )
    listed = {key: names.split(", ") for key, names in rows.items()}
    joints = [e for e in CATALOGUE if e.acts in (EffectTarget.JOINT, EffectTarget.MOTOR)]
    joints += [e for e in CATALOGUE if e.acts is EffectTarget.POSITION and not e.obstacle]
    has_c = [
        e for e in joints if e.acts is not EffectTarget.POSITION and e.forms[0].names <= {*MOTION}
    ]
    assert set(listed["in `[effects]`, and added"]) == {e.id for e in has_c}
    without = {e.id for e in joints} - {e.id for e in has_c}
    assert set(listed["not in `[effects]`, not added"]) == without
    unsimulated = {name for name, kind in HIDDEN.items() if not kind.loops}
    assert set(listed["not simulated"]) == unsimulated


@with_cases("name", "q1", "qdd1", "M1", "ZZ1", "Fv1", "pi", "tanh", "double", "lambda")
def test_reserved_names_are_refused(name):
    text = read_builtin_robot("two-link").replace("[symbols]", f"[symbols]\n{name} = 1.0")
    with pytest.raises(RobotError, match=re.escape(f'"{name}"')):
        parse_robot_text(text, "reserved.toml")


def test_every_environment_variable_is_described():
    """All that the program reads of the environment, and nothing else."""
    sources = [path.read_text(encoding="utf-8") for path in (ROOT / "modeler").rglob("*.py")]
    read = {name for text in sources for name in re.findall(r'environ\W[^"\n]*"([A-Z]\w+)"', text)}
    text = text_of("docs/reference/emitted-c.md")
    section = text.split("## Environment variables\n")[1].split("\n#")[0]
    assert read == set(re.findall(r"^\| `(\w+)` \|", section, re.MULTILINE))


def test_every_choice_of_the_processing_is_described():
    for field in dataclasses.fields(Processing):
        assert f"`{field.name}`" in text_of("docs/explanation/processing.md"), field.name


def test_commands_stand_on_their_page_by_family():
    """In the order of `modeler --help`."""
    table = text_of("docs/reference/commands.md").split("| command | does |")[1].split("\n\n")[0]
    listed: dict[str, list[str]] = {}
    for title, names in re.findall(r"^\| (?:\*\*(\w+)\*\*|([^|]+)) \|", table, re.MULTILINE):
        if title:
            listed[title] = []
        elif "modeler" in names:
            listed[list(listed)[-1]] += re.findall(r"modeler ([\w-]+)", names)
    assert listed == read_families()


def test_every_file_and_function_of_the_c_is_described():
    text = text_of("docs/reference/emitted-c.md")
    manifest = json.loads((ROOT / "generated/wrist/manifest.json").read_text(encoding="utf-8"))
    roles = [f["name"].removeprefix("wrist_") for f in manifest["functions"]]
    for role in (*roles, "observation", "signature"):
        assert re.search(rf"`two_link_{role}[(`]", text), role
    for path in (ROOT / "generated/wrist").iterdir():
        assert f"`{path.name.replace('wrist', 'two_link')}`" in text, path.name
