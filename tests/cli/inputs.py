"""Logs and models that several tests of commands read, made once a session."""

from pathlib import Path

import pytest

from modeler.cli import main


def folder_after(folder: Path, *lines: str) -> Path:
    """The folder after these commands; `{}` in them is its path."""
    for line in lines:
        assert main(line.format(folder).split()) == 0, line
    return folder


@pytest.fixture(scope="session")
def two_link(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Logs a, b and held of a two-link arm, and m.json, fitted to a and b."""
    simulate = "simulate two-link --duration 8 --rate 200"
    return folder_after(
        tmp_path_factory.mktemp("two_link"),
        f"{simulate} --seed 1 --out {{}}/a.parquet",
        f"{simulate} --seed 2 --out {{}}/b.parquet",
        f"{simulate} --seed 3 --out {{}}/held.parquet",
        "fit two-link {0}/a.parquet {0}/b.parquet --out {0}/m.json",
    )


@pytest.fixture(scope="session")
def axis(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Logs a.csv and b.csv of one axis with a spring that its file lacks; m.json, fitted to a."""
    simulate = "simulate emps --hide spring:stiffness=40,rest=0.1 --rate 250 --duration 8"
    return folder_after(
        tmp_path_factory.mktemp("axis"),
        f"{simulate} --seed 1 --out {{}}/a.csv",
        f"{simulate} --seed 2 --out {{}}/b.csv",
        "fit emps {0}/a.csv --out {0}/m.json",
    )
