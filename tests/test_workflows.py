"""The workflow files, which nothing here runs: they parse, are pinned, and call what there is."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from packaging.specifiers import SpecifierSet

from modeler.cli.parser import read_commands
from tests.repository import ROOT

FILES = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
DIST = ("dist", "demo_c")
"""Folders that earlier steps write."""


def steps(path: Path) -> Iterator[dict[str, Any]]:
    """Every step of every job."""
    for job in yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"].values():
        yield from job["steps"]


def lines(path: Path) -> list[str]:
    """Every command line."""
    return [line for step in steps(path) for line in step.get("run", "").splitlines()]


def targets() -> set[str]:
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z-]+):", text, re.MULTILINE))


def test_there_are_wheels_tests_and_docs() -> None:
    assert [path.stem for path in FILES] == ["docs", "tests", "wheels"]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_workflow_is_pinned_and_may_only_read(path: Path) -> None:
    result = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert result["permissions"] == {"contents": "read"}
    assert {"name", True, "jobs"} <= result.keys()  # YAML 1.1 reads `on` as true
    for job in result["jobs"].values():
        systems = job.get("strategy", {}).get("matrix", {}).get("system", [job["runs-on"]])
        assert not any("latest" in system for system in systems) and job["timeout-minutes"]
    for step in steps(path):
        assert ("run" in step) != ("uses" in step), step
        if "uses" in step:
            assert re.fullmatch(r"[\w-]+/[\w-]+@v\d+\.\d+\.\d+", step["uses"]), step["uses"]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_workflow_calls_what_there_is(path: Path) -> None:
    for line in lines(path):
        words = line.split()
        if words[0] == "make" and words[1] != "-C":
            assert words[1] in targets(), line
        elif words[0] == "make":
            assert words[2] in DIST, line
        elif words[0] == "modeler":
            assert words[1] in read_commands(), line
        elif words[0] == ".ci/run":
            assert (ROOT / words[0]).is_file()
        else:
            assert words[:2] == ["python", "-m"] and words[2] in ("pip", "build", "pytest"), line


def test_the_pythons_are_those_that_it_asks_for() -> None:
    asked = re.search(r'requires-python = "(.+)"', (ROOT / "pyproject.toml").read_text("utf-8"))
    assert asked is not None
    text = (ROOT / ".github" / "workflows" / "tests.yml").read_text(encoding="utf-8")
    pythons = re.findall(r'"(3\.\d+)"', text)
    assert pythons and all(version in SpecifierSet(asked[1]) for version in pythons)
