"""Metadata, pins, version and changelog agree, and nothing names one particular machine."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path, PureWindowsPath

import pytest
import yaml
from packaging.markers import Marker
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

import modeler
from modeler.logs.columns import READERS
from tests.repository import ROOT, kept_files
from tests.rotation import with_cases

_PIN = re.compile(r"([a-z0-9]+(?:-[a-z0-9]+)*)==([0-9]+(?:\.[0-9]+)*(?:\.post[0-9]+)?)(?: ; (.+))?")


@pytest.fixture(scope="module")
def settings() -> dict:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def pins() -> dict[str, str]:
    versions = {}
    for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            match = _PIN.fullmatch(line)
            assert match, f"constraints.txt: got {line!r}, expected name==version, maybe a marker"
            name, version, marker = match.groups()
            assert name not in versions, f"constraints.txt: {name} stands there twice"
            if marker:
                Marker(marker)
            versions[name] = version
    return versions


def requirements(settings: dict) -> list[Requirement]:
    project = settings["project"]
    lines = [*project["dependencies"], *settings["build-system"]["requires"]]
    lines += [line for group in project["optional-dependencies"].values() for line in group]
    return [Requirement(line) for line in lines]


def test_metadata(settings: dict) -> None:
    project = settings["project"]
    assert project["name"] == "modeler-robotics"
    assert project["requires-python"] == ">=3.11"
    assert project["license"] == "MIT"
    readme = settings["tool"]["hatch"]["metadata"]["hooks"]["fancy-pypi-readme"]
    for file in [
        *(f["path"] for f in readme["fragments"] if "path" in f),
        *project["license-files"],
        settings["tool"]["hatch"]["version"]["path"],
    ]:
        assert (ROOT / file).is_file(), file
    assert project["scripts"] == {"modeler": "modeler.cli:main"}
    assert (ROOT / "modeler" / "py.typed").is_file()


def test_what_messages_tell_to_install_there_is(settings: dict) -> None:
    """Every extra that is named in the program or in the documentation, and every reader."""
    extras = set(settings["project"]["optional-dependencies"])
    sources = [p.read_text(encoding="utf-8") for p in (ROOT / "modeler").rglob("*.py")]
    pages = [
        p.read_text(encoding="utf-8") for p in (*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.[mi]*"))
    ]
    named = {name for text in [*sources, *pages] for name in _EXTRA.findall(text)}
    named |= {name for text in sources for name in re.findall(r"suggest_install\(['\"](\w+)", text)}
    assert {"gpu", "dask", "notebook"} <= named <= extras
    readers = {n for t in sources for n in re.findall(r'make_package_error\([^)]*"([\w-]+)"\)', t)}
    assert readers == set(READERS) and set(READERS.values()) <= extras
    for package, extra in READERS.items():
        wanted = settings["project"]["optional-dependencies"][extra]
        assert package in {canonicalize_name(Requirement(line).name) for line in wanted}


_EXTRA = re.compile(r"modeler-robotics\[(\w+)\]")


def test_the_version_stands_in_one_place(settings: dict) -> None:
    Version(modeler.__version__)
    assert "version" in settings["project"]["dynamic"] and "version" not in settings["project"]
    places = [
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "modeler").rglob("*.py")
        if re.search(r"^__version__\s*=", path.read_text(encoding="utf-8"), re.M)
    ]
    assert places == ["modeler/__init__.py"]


def test_the_changelog_begins_with_this_version() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    first, *_ = re.findall(r"^## (\S+) - (\d{4}-\d{2}-\d{2}|unreleased)$", text, re.M)
    assert first[0] == modeler.__version__
    newest = text.split("\n## ")[1]
    assert len(newest.split()) < 1600, "CHANGELOG.md: what a user can read, not the history"
    assert newest.count("\n### ") == len(set(re.findall(r"^### (.+)$", newest, re.M)))


def test_the_citation_is_of_this_version() -> None:
    """The entries that Citation File Format 1.2.0 requires, and the numbers of the changelog."""
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert cited["cff-version"] == "1.2.0" and cited["type"] == "software"
    assert {"message", "title", "authors"} <= cited.keys() and cited["authors"]
    assert all("name" in one or "family-names" in one for one in cited["authors"])
    assert cited["version"] == modeler.__version__ and cited["license"] == "MIT"
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    (date,) = re.findall(rf"^## {re.escape(modeler.__version__)} - (\S+)$", changes, re.M)
    assert str(cited.get("date-released", "unreleased")) == date


def test_every_dependency_is_pinned_to_a_version_it_allows(settings, pins):
    for requirement in requirements(settings):
        name = canonicalize_name(requirement.name)
        assert name in pins, f"constraints.txt has no line for {name}"
        assert requirement.specifier.contains(pins[name]), f"{requirement} excludes {pins[name]}"


NEVER_INSTALLED = ("cupy-cuda12x",)
"""Pinned, but not installed where tests run, nor what it brings: it needs a graphics processor."""


def test_what_dependencies_need_is_pinned(settings: dict, pins: dict[str, str]) -> None:
    """Every package that suggest_install brings has its line, and every line brings a package."""
    waiting = [_wanted(requirement) for requirement in requirements(settings)]
    waiting.append((canonicalize_name("editables"), frozenset()))  # what hatchling asks for
    met: set[tuple[str, frozenset[str]]] = set()
    while waiting:
        name, extras = waiting.pop()
        if (name, extras) in met:
            continue
        met.add((name, extras))
        if name in NEVER_INSTALLED:
            continue
        try:
            lines = metadata.requires(name) or []
        except metadata.PackageNotFoundError:
            pytest.skip(f"NOT CHECKED: {name} is not installed, so what it needs is not known")
        for requirement in map(Requirement, lines):
            marker = requirement.marker
            if marker is None or any(marker.evaluate({"extra": each}) for each in ("", *extras)):
                waiting.append(_wanted(requirement))
    assert {name for name, _ in met} == pins.keys()


def _wanted(requirement: Requirement) -> tuple[str, frozenset[str]]:
    return canonicalize_name(requirement.name), frozenset(requirement.extras)


# Written in pieces, so that this file does not name what it looks for.
_FORBIDDEN = {
    "a registry's host": r"py" + r"pi\.org|python" + r"hosted|ana" + r"conda\.org",
    "a place to install from": r"--(?:extra-)?index"
    + r"-url|--find"
    + r"-links|trusted"
    + r"-host",
    "another project, which the public index has by this name": r"install\s+(?:-\S+\s+)*['\"]?mod"
    + r"eler\b(?!-robotics)|['\"]mod"
    + r"eler\[",
    "a path of one machine": r"(?<![\w./~}])/(?:work|tmp|root|home|opt)" + r"/\w",
}


def test_nothing_names_a_registry_or_a_machine() -> None:
    places = []
    for name in kept_files():
        text = (ROOT / name).read_bytes().decode("utf-8", errors="ignore")
        for number, line in enumerate(text.splitlines(), start=1):
            places += [
                f"{name}:{number}: {what}: {line.strip()[:80]}"
                for what, pattern in _FORBIDDEN.items()
                if re.search(pattern, line)
            ]
    assert not places, "\n".join(["", *places])


@with_cases(
    "line",
    "see https://py" + "pi.org/x",
    "pip install --index" + "-url x",
    'open("' + "/tmp" + '/x")',
    "pip install mod" + "eler",
    "pip install -U 'mod" + "eler[gpu]'",
    "'mod" + "eler[dask]'",
    "in " + "/work" + "/main",
)
def test_what_must_not_be_named_would_be_found(line: str) -> None:
    assert any(re.search(pattern, line) for pattern in _FORBIDDEN.values())


CONDA = {"matplotlib": "matplotlib-base"}
"""What is called otherwise there: parts that need no window and no commercial solver."""


def test_the_recipe_for_conda_says_what_the_project_says(settings: dict) -> None:
    """Read and rendered by the program that builds from it; every bound of every dependency."""
    rattler = pytest.importorskip("rattler_build", reason="NOT CHECKED: no py-rattler-build")
    recipe = rattler.Stage0Recipe.from_file(str(ROOT / "conda" / "recipe.yaml"))
    (made,) = recipe.render(rattler.VariantConfig())
    assert "modeler-robotics" in repr(made) and f"'{modeler.__version__}'" in repr(made)
    recipe_dict, project = recipe.to_dict(), settings["project"]
    names = [Requirement(line) for line in project["dependencies"]]
    bounds = {CONDA.get(r.name, r.name): str(r.specifier) for r in names}
    needs = recipe_dict["requirements"]
    assert _bounds(needs["run"]) == {"python": project["requires-python"], **bounds}
    building = [Requirement(line) for line in settings["build-system"]["requires"]]
    made_with = {r.name: str(r.specifier) for r in building}
    assert _bounds(needs["host"]) == {"python": project["requires-python"], "pip": "", **made_with}
    groups = project["optional-dependencies"].items()
    extras = {
        r.name: str(r.specifier)
        for name, group in groups
        if name not in ("test", "docs")
        for r in map(Requirement, group)
    }
    elsewhere = {"cupy-cuda12x", "mujoco-core"}
    assert _bounds(needs["run_constraints"]) == {
        name: bound for name, bound in extras.items() if name not in elsewhere
    }
    about, build = recipe_dict["about"], recipe_dict["build"]
    assert about["license"] == project["license"] and about["summary"] == project["description"]
    assert about["license_file"] == project["license-files"]
    (script,) = build["python"]["entry_points"]
    assert dict([script.split(" = ")]) == project["scripts"]


def _bounds(lines: list[str]) -> dict[str, str]:
    return {name: bound for name, _, bound in (line.partition(" ") for line in lines)}


def test_the_dockerfile_is_as_hadolint_wants_it() -> None:
    folders = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    program = shutil.which("hadolint", path=folders)
    if program is None:
        pytest.skip("NOT CHECKED: hadolint is not installed")
    result = subprocess.run(
        [program, "--no-color", str(ROOT / "Dockerfile")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (result.returncode, result.stdout) == (0, ""), result.stdout


_RESERVED = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\..*)?|.*[<>:\"|?*\\\x00-\x1f].*|.*[. ]")
"""Names that Windows has for devices, letters that it has for other things, ends that it drops."""


def test_windows_and_macos_can_hold_every_file() -> None:
    names = kept_files()
    parts = {part for name in names for part in PureWindowsPath(name).parts}
    assert not [part for part in parts if _RESERVED.fullmatch(part)]
    folders = {parent.as_posix() for name in names for parent in PureWindowsPath(name).parents}
    assert len({name.lower() for name in names}) == len(names)  # they know no large letters
    assert len({folder.lower() for folder in folders}) == len(folders)
    assert max(map(len, names)) < 120  # of the 260 that a path may have


@pytest.mark.parametrize("name", ["aux.c", "COM1", "a:b", "x.", "what?.md"])
def test_what_windows_cannot_hold_would_be_found(name: str) -> None:
    assert _RESERVED.fullmatch(name) and not _RESERVED.fullmatch("console.py")


def test_the_hook_before_commits_has_the_ruff_of_the_tests(pins) -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))
    (ruff,) = (repo for repo in hooks["repos"] if repo["repo"].endswith("/ruff-pre-commit"))
    assert ruff["rev"] == f"v{pins['ruff']}"


def test_there_is_no_lock_file() -> None:
    names = {Path(name).name.lower() for name in kept_files()}
    assert not {name for name in names if name.endswith(".lock") or name == "pylock.toml"}


@pytest.fixture
def make(tmp_path: Path):
    """`make` with our Makefile in an empty folder whose path has a space."""
    if shutil.which("make") is None:
        pytest.skip("NOT CHECKED: make is not installed")
    folder = tmp_path / "a folder"
    folder.mkdir()
    for name in ("Makefile", "pyproject.toml", "constraints.txt"):
        shutil.copy(ROOT / name, folder)

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(["make", *arguments], cwd=folder, capture_output=True, text=True)

    return run


def test_make_alone_says_what_there_is(make) -> None:
    help_text = make().stdout
    assert all(f"make {target}" in help_text for target in ("demo", "test", "lint", "regenerate"))


def test_make_without_a_fitting_python_says_so_in_one_line(make, tmp_path: Path) -> None:
    old = tmp_path / "old-python"
    old.write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
    old.chmod(0o755)
    result = make("demo", f"PYTHON={old}")
    assert result.returncode != 0
    first = result.stderr.splitlines()[0]
    assert first.startswith("modeler: Python 3.11 or later not found; install it")


def test_make_without_the_venv_module_says_so_in_one_line(make, tmp_path: Path) -> None:
    bare = tmp_path / "bare-python"
    bare.write_text('#!/bin/sh\ncase "$2" in *venv*) exit 1;; esac\n', encoding="utf-8")
    bare.chmod(0o755)
    result = make("test", f"PYTHON={bare}")
    assert result.returncode != 0
    assert "has no venv module; install it" in result.stderr.splitlines()[0]


def test_make_without_a_compiler_says_so_in_one_line(make, tmp_path: Path) -> None:
    empty = tmp_path / "bin"
    empty.mkdir()
    shell = shutil.which("sh")
    assert shell is not None
    result = make("demo", f"PATH={empty}", f"SHELL={shell}", "CC=")
    assert result.returncode != 0
    assert result.stderr.splitlines()[0].startswith("modeler: no C compiler")
