"""What all tests share: the cache of compiled models, and kept generated files."""

import difflib
import gc
import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from hypothesis.internal.conjecture import providers

from modeler.core.json import convert_to_plain
from tests.derived_once import derived_once
from tests.further_robots import FurtherRobots
from tests.robots import KINDS, OTHERS
from tests.rotation import Rotation, number_of_runs, today

pytest_plugins = ["pytester"]

# Hypothesis mixes the constants of whatever modules happen to be imported into its examples, and
# which are depends on the tests that ran before in the process: examples shall be the same always.
providers._get_local_constants = lambda: providers._local_constants

ROOT = Path(__file__).resolve().parents[1]

LONGEST = ("test_wheel.py", "test_typed.py")
"""Begun first: at the end, one process would work on them while the others have nothing to do."""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--regenerate", action="store_true", help="rewrite generated/ instead of comparing with it"
    )
    parser.addoption(
        "--every",
        type=number_of_runs,
        default=1,
        metavar="RUNS",
        help="run each case that repeats what others show once in so many runs",
    )
    parser.addoption("--day", type=int, default=today(), help="without a record; default: today")


def pytest_configure(config: pytest.Config) -> None:
    gc.disable()  # until all is collected: what collection makes stays
    config.pluginmanager.register(Rotation(config, KINDS, OTHERS), "rotation")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """With --regenerate, only what compares kept files: everything else would be run in vain."""
    if config.getoption("--regenerate"):
        keepers = {"compare_with_generated", "regenerate"}
        gone = {item for item in items if not keepers & set(getattr(item, "fixturenames", ()))}
        config.hook.pytest_deselected(items=[*gone])
        items[:] = [item for item in items if item not in gone]
    items.sort(key=lambda item: not item.nodeid.partition("::")[0].endswith(LONGEST))


def pytest_collection_finish() -> None:
    """What is collected stays: to look for garbage among it, so often, costs a sixth of a run."""
    gc.freeze()
    gc.set_threshold(20_000, 20, 10)
    gc.enable()


@pytest.fixture
def regenerate(request: pytest.FixtureRequest) -> bool:
    """Whether kept files are to be written anew instead of compared."""
    return bool(request.config.getoption("--regenerate"))


@pytest.fixture(scope="session")
def measured_folder() -> Path:
    """The folder of measured logs beside the checkout; they are not part of the project."""
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip(f"NOT CHECKED: no measured logs, there is no {folder}")
    return folder


@pytest.fixture(scope="session")
def loop_robots_folder() -> FurtherRobots:
    """The folder of robots with loops beside the checkout; they are not part of the project."""
    robots = FurtherRobots()
    if not any(robots.all()):
        pytest.skip(f"NOT CHECKED: no further robots with loops, there are none in {robots.folder}")
    return robots


@pytest.fixture(scope="session", autouse=True)
def compiled_models_beside_pytest(request: pytest.FixtureRequest) -> Iterator[None]:
    """Compiled models go into pytest's cache: kept between runs, never in the user's own."""
    before = os.environ.get("MODELER_CACHE")
    if before is None:
        cache = request.config.cache
        assert cache is not None
        os.environ["MODELER_CACHE"] = str(cache.mkdir("modeler"))
    yield
    if before is None:
        del os.environ["MODELER_CACHE"]


@pytest.fixture(scope="session", autouse=True)
def robots_derived_once() -> Iterator[None]:
    with derived_once():
        yield


@pytest.fixture(scope="session", autouse=True)
def results_are_as_the_schemas_say() -> Iterator[None]:
    """Whatever a command returns in any test is held against its schema."""
    from modeler.cli import console

    run_command = console.run_command

    def checked(args: Any, run: Callable[[Any], Any]) -> None:
        def held(args: Any) -> Any:
            content = run(args)
            from tests.json_schemas import check_schema  # only where a command runs

            check_schema(args.command, console.add_schema(args.command, convert_to_plain(content)))
            return content

        run_command(args, held)

    console.run_command = checked
    yield
    console.run_command = run_command


IN_FULL = ("wrist", "five-bar")
"""Robots whose emitted files are kept as they are; of the others `SHA256SUMS`."""


@pytest.fixture
def compare_with_generated(regenerate: bool) -> Callable[[str, Mapping[str, str]], None]:
    """Compare emitted files with generated/<name>/, both ways; or rewrite them."""

    def compare(name: str, emitted: Mapping[str, str]) -> None:
        folder = ROOT / "generated" / name
        wanted = emitted if name in IN_FULL else {"SHA256SUMS": list_digests(emitted)}
        files = [path for path in folder.rglob("*") if path.is_file()]
        rest = {path.relative_to(folder).as_posix(): path for path in files}
        if regenerate:
            for stale in rest.keys() - wanted.keys():
                rest[stale].unlink()
            for file, text in wanted.items():
                (folder / file).parent.mkdir(parents=True, exist_ok=True)
                (folder / file).write_bytes(text.encode())
            return
        assert sorted(rest) == sorted(wanted)
        for file, text in wanted.items():
            before = rest[file].read_bytes().decode().splitlines(True)
            now = (f"generated/{name}/{file}", "emitted now")
            difference = "".join(difflib.unified_diff(before, text.splitlines(True), *now, n=0))
            assert not difference, (
                f"\n{difference}\nmake regenerate DIFF={name} shows what changed since the last "
                "commit; if it is meant: make regenerate"
            )

    return compare


def list_digests(files: Mapping[str, str]) -> str:
    """As `sha256sum` writes them, sorted by path."""
    return "".join(
        f"{hashlib.sha256(text.encode()).hexdigest()}  {name}\n"
        for name, text in sorted(files.items())
    )
