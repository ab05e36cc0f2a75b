"""Gallery of the built-in robots: picture, table, base parameters, size of the C."""

import re
import tomllib
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from docsite.effects import Portrait
from docsite.markdown import block, cell, code, table
from modeler import formulas
from modeler.codegen import Derivation, derive, generate
from modeler.core.choices import list_builtin_robots, read_builtin_robot
from modeler.derivation import format_base_parameters
from modeler.robot import read_robot
from modeler.views import render_picture, show

WRITTEN = Path(__file__).resolve().parents[1] / "docs" / "robots"
"""Pages on single robots."""


@dataclass(frozen=True)
class Exhibit:
    """A robot as the gallery shows it.

    Attributes:
        name: of the built-in robot.
        title: as in its file.
        page: Markdown.
        picture: PNG.
        joints: number of coordinates.
        base: number of base parameters.
        lines: of C, headers and the runtime included.
    """

    name: str
    title: str
    page: str
    picture: bytes
    joints: int
    base: int
    lines: int


def exhibit(name: str) -> Exhibit:
    """All that the gallery says of a built-in robot; takes seconds for the largest."""
    robot = read_robot(name)
    derivation, shown = derive(robot), show(robot)
    sizes, functions = _emitted(derivation)
    text = read_builtin_robot(name)
    links = "".join(f"{line}\n" for line in _written_about(name))
    numbered = "".join(f"{line}\n" for line in coefficients(derivation))
    paragraphs = [
        f"# {name}\n\n**{cell(robot.title)}**\n\n{_notes(text)}",
        f"{links}![{name}]({name}.png){{ width=420 }}\n\n{_counts(derivation)}",
        f"## Table\n\n{_mdh(text)}\n\n## Base parameters",
        f"{format_base_parameters(derivation.base, 'markdown')}",
        f"{numbered}## C\n\n{_sum(sizes)}",
        table(("file", "lines", "bytes"), _rows(sizes)),
        table(("function", "additions", "multiplications"), functions),
        f"## File\n\n{block(text, 'toml')}",
    ]
    return Exhibit(
        name,
        robot.title,
        "\n\n".join(paragraphs),
        render_picture(shown.skeleton, shown.posture, ".png"),
        len(robot.coordinates),
        derivation.base.rank,
        sum(lines for lines, _ in sizes.values()),
    )


def coefficients(derivation: Derivation) -> list[str]:
    """The section of a robot whose paper numbers the coefficients of its closed form."""
    if not derivation.robot.terms:
        return []
    table = formulas.build_coefficient_table(derivation.model, derivation.base)
    return ["## Coefficients", "", formulas.coefficients.format_coefficients(table, "markdown"), ""]


def gallery_index(exhibits: Sequence[Exhibit]) -> str:
    """The page that shows all robots."""
    rows = [
        (
            f"[![{item.name}]({item.name}.png){{ width=120 }}]({item.name}.md)",
            f"[{item.name}]({item.name}.md)",
            cell(item.title),
            str(item.joints),
            str(item.base),
            str(item.lines),
        )
        for item in exhibits
    ]
    head = ("picture", "name", "robot", "coordinates", "base parameters", "lines of C")
    return (
        "# Robots\n\nThe built-in robots, as `modeler robots` lists them. Any command takes their "
        "names; their files are beginnings of files of your own. Pictures are those of `modeler "
        f"show --picture`, sizes those of `modeler generate`.\n\n{table(head, rows)}"
    )


def gallery_front(robots: Sequence[Exhibit], effects: Sequence[Portrait]) -> str:
    """The page before the galleries: robots, effects and studies, as pictures to click."""
    arms = [(entry.name, f"robots/{entry.name}.png", f"robots/{entry.name}.md") for entry in robots]
    seen = [
        (item.effect.id, f"effects/{item.effect.id}-small.png", f"effects/{item.effect.id}.md")
        for item in effects
        if item.thumbnail is not None
    ]
    return (
        "# Gallery\n\n## [Robots](robots/index.md)\n\n"
        f"The {len(robots)} built-in robots: table, base parameters, size of the C.\n\n"
        f"{_thumbnails(arms)}\n\n## [Effects](effects/index.md)\n\n"
        f"The {len(effects)} physical effects that a model may lack: equation, what each leaves in "
        "the residual, what it is mistaken for, the motion that shows it.\n\n"
        f"{_thumbnails(seen)}\n\n## [Studies](../studies/measured-sets.md)\n\n"
        "Measured logs of real machines that others have published: what one command says of "
        "each.\n"
    )


def _thumbnails(shown: Sequence[tuple[str, str, str]]) -> str:
    """Pictures beside each other, (name, picture, page) each."""
    links = [f"[![]({picture})<br>{cell(name)}]({page})" for name, picture, page in shown]
    return "\n".join(['<div class="thumbnails" markdown="1">', "", *links, "", "</div>"])


def _written_about(name: str) -> list[str]:
    """A line that leads to the pages of docs/robots/ that bear its name or run a command on it."""
    pages = []
    for path in sorted(WRITTEN.glob("*.md")):
        text = path.read_text(encoding="utf-8")
        run = re.search(rf"^\$ modeler .* {re.escape(name)}(?: |$)", text, re.MULTILINE)
        if run or name.startswith(path.stem):
            title = text.partition("\n")[0].removeprefix("# ")
            pages.append(f"[{cell(title)}](../../robots/{path.name})")
    return [f"Step by step: {', '.join(pages)}.", ""] if pages else []


def exhibits() -> list[Exhibit]:
    """All built-in robots, as many at a time as there are processors."""
    with ProcessPoolExecutor() as pool:
        return list(pool.map(exhibit, list_builtin_robots()))


def _notes(text: str) -> str:
    notes = tomllib.loads(text).get("notes", "")
    return cell(" ".join(str(notes).split()))


def _counts(derivation: Derivation) -> str:
    base = derivation.base
    kinds = ", ".join(f"{n} {cell(kind)}" for kind, n in base.count_by_kind().items() if n)
    return (
        f"{len(base.columns)} standard parameters, {base.rank} base parameters ({kinds}); proof: "
        f"{cell(base.proof.kind)}."
    )


def _mdh(text: str) -> str:
    """The table as its file writes it, in the notation of Khalil and Kleinfinger."""
    result = tomllib.loads(text)["mdh"]
    rows = [[code(str(entry)) for entry in row] for row in result["rows"]]
    return table(result["columns"], rows)


def _emitted(
    derivation: Derivation,
) -> tuple[dict[str, tuple[int, int]], list[tuple[str, str, str]]]:
    """{C file: (lines, bytes)}, and (function, additions, multiplications)."""
    emitted = generate(derivation)
    sizes = {
        name: (len(text.splitlines()), len(text.encode()))
        for name, text in emitted.files.items()
        if name.endswith((".c", ".h"))
    }
    functions = [
        (code(function.name), str(function.additions), str(function.multiplications))
        for function in emitted.spec.functions
    ]
    return sizes, functions


def _rows(sizes: dict[str, tuple[int, int]]) -> list[tuple[str, str, str]]:
    return [(code(name), str(lines), str(size)) for name, (lines, size) in sizes.items()]


def _sum(sizes: dict[str, tuple[int, int]]) -> str:
    lines, size = (sum(column) for column in zip(*sizes.values(), strict=True))
    return f"{lines} lines, {size} bytes, the parts that all robots share included."
