"""The page of studies: its commands parse, and give what it shows where the logs are at hand."""

import dataclasses
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from modeler.cli.parser import build_parser
from tests.measured_sets.sets import DATA, PAGE
from tests.rotation import ROTATING
from tests.test_docs import Block, Reader, blocks

STUDIES = dict(
    re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
)
"""Title -> text of each study."""


def readable(text: str) -> Iterator[Block]:
    """The blocks of a study, its commands as a reader types them."""
    for block in blocks(text):
        if block.kind == "sh":
            lines = tuple(f"$ {line}" for line in block.lines)
            block = dataclasses.replace(block, kind="console", lines=lines)
        yield block


@pytest.mark.parametrize("title", STUDIES)
def test_a_study_names_its_source_and_its_commands_parse(title: str) -> None:
    text = STUDIES[title]
    assert "https://github.com/" in text or "From the same authors" in text
    (shell,) = (block for block in blocks(text) if block.kind == "sh")
    fit, diagnose = (build_parser().parse_args(shlex.split(line)[1:]) for line in shell.lines)
    assert (diagnose.model, diagnose.logs) == (fit.out, fit.logs)
    assert not set(diagnose.holdout) & set(fit.logs)


@pytest.mark.measured
@pytest.mark.parametrize("title", [pytest.param(title, marks=ROTATING) for title in STUDIES])
def test_a_study_prints_what_it_shows(title, tmp_path, monkeypatch, regenerate) -> None:
    folders = {name.split("/")[0] for name in re.findall(r"\w+/[\w.-]+\.parquet", STUDIES[title])}
    if absent := sorted(name for name in folders if not (DATA / name).is_dir()):
        pytest.skip(f"NOT CHECKED: {title}: no measured logs {', '.join(absent)} in {DATA}")
    for name in folders:
        Path(tmp_path / name).symlink_to(DATA / name)
    monkeypatch.chdir(tmp_path)
    reader = Reader(PAGE.name, regenerate)
    for block in readable(STUDIES[title]):
        reader.do(block)
    if reader.replaced:
        text = PAGE.read_text("utf-8")
        for shown, printed in reader.replaced.items():
            text = text.replace(f"\n{shown}\n", f"\n{printed}\n")
        PAGE.write_text(text, encoding="utf-8")
