"""The page of licences says what the packages say of themselves, and misses none."""

import re
import tomllib
from importlib import metadata

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.repository import ROOT, kept_files

PAGE = ROOT / "docs" / "reference" / "licences.md"
WORKING = ("test", "docs")
"""Extras of which nothing is shipped."""
FAMILIES = {
    "LGPL": r"LGPL|Lesser General",
    "GPL": r"(?<!L)GPL|(?<!Lesser )General Public",
    "MPL": r"MPL|Mozilla",
    "Apache": "Apache",
    "BSD": "BSD",
    "MIT": r"MIT\b",
    "PSF": "PSF|Python Software Foundation",
    "ISC": r"\bISC\b",
    "any": "any-OSI",
}
BOUND = {"LGPL", "GPL", "MPL"}
"""Families that ask for more than a notice."""


def families(text: str) -> set[str]:
    """Which licences a text names."""
    return {name for name, pattern in FAMILIES.items() if re.search(pattern, text)}


def stated(package: str) -> set[str]:
    """What the metadata of an installed package says."""
    about = metadata.metadata(package)
    classes = [line for line in about.get_all("Classifier") or () if line.startswith("License")]
    for text in (about.get("License-Expression"), " ".join(classes), about.get("License")):
        if text and families(text):
            return families(text)
    return set()


def rows() -> dict[str, tuple[str, str]]:
    """{package: (licence, extras)} of the page."""
    table = re.findall(r"^\| ([\w-]+) \| ([^|]+) \| ([^|]+) \|$", PAGE.read_text("utf-8"), re.M)
    return {name: (licence, extras) for name, licence, extras in table if name != "package"}


def wanted() -> dict[str, set[str]]:
    """{package: extras, "always"} that an installation asks for itself."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = {"always": project["dependencies"]} | {
        extra: lines
        for extra, lines in project["optional-dependencies"].items()
        if extra not in WORKING
    }
    extras: dict[str, set[str]] = {}
    for extra, lines in groups.items():
        for line in lines:
            extras.setdefault(canonicalize_name(Requirement(line).name), set()).add(extra)
    return extras


def brought() -> set[str]:
    """All that these need in turn, of what is installed here."""
    waiting, met = [(name, ("",)) for name in wanted()], set()
    while waiting:
        name, extras = waiting.pop()
        if name in met:
            continue
        try:
            lines = metadata.requires(name) or []
        except metadata.PackageNotFoundError:
            continue
        met.add(name)
        for need in map(Requirement, lines):
            if need.marker is None or any(need.marker.evaluate({"extra": e}) for e in extras):
                waiting.append((canonicalize_name(need.name), tuple(need.extras) or ("",)))
    return met


def test_every_dependency_has_its_row() -> None:
    for name, extras in wanted().items():
        assert name in rows(), f"docs/reference/licences.md has no row for {name}"
        assert {extra.strip("` ") for extra in rows()[name][1].split(",")} == extras, name


def test_the_rows_say_what_the_packages_say() -> None:
    checked = 0
    for name, (licence, _) in rows().items():
        try:
            said = stated(name)
        except metadata.PackageNotFoundError:
            continue
        assert not said or said & families(licence), f"{name}: {licence}, its metadata: {said}"
        assert said & BOUND <= families(licence), f"{name}: {licence}, its metadata: {said}"
        checked += 1
    assert checked > len(wanted()) - 6


def test_what_asks_for_more_than_a_notice_is_named() -> None:
    for name in brought():
        assert not stated(name) & BOUND or name in rows(), f"{name}: {stated(name)}"


def test_licences_of_what_is_kept_here_are_named() -> None:
    text = PAGE.read_text(encoding="utf-8")
    files = [name for name in kept_files() if name.endswith("/LICENSE")]
    assert files and all(f"`{name}`" in text for name in files)
