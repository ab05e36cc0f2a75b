"""The cache of compiled libraries stays small, and no process trips over what another removes."""

import hashlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import modeler.runtime.build as kept
from modeler.runtime.build import build_library
from modeler.runtime.model import load
from tests.modules import module

OLD = kept.RECENT + 60.0


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    folder = tmp_path / "cache"
    monkeypatch.setenv("MODELER_CACHE", str(folder))
    return folder


def entry(cache: Path, number: int, age: float, size: int = 10) -> Path:
    """A folder as a build leaves it, last used that many seconds ago."""
    folder = cache / hashlib.sha256(bytes([number])).hexdigest()
    folder.mkdir(parents=True)
    content = bytes([number]) * size
    library = folder / f"{hashlib.sha256(content).hexdigest()}.so"
    library.write_bytes(content)
    for path in (library, folder):
        os.utime(path, (time.time() - age,) * 2)
    return folder


@pytest.mark.parametrize(("bound", "value"), [("MOST", 2), ("LARGEST", 250)])
def test_the_oldest_go_beyond_the_number_and_the_size(cache, monkeypatch, bound, value) -> None:
    monkeypatch.setattr(kept, bound, value)
    made = [entry(cache, k, OLD + 100.0 * k, size=100) for k in range(4)]
    kept.tidy(cache)
    assert [folder.exists() for folder in made] == [True, True, False, False]
    assert len([*cache.iterdir()]) == 2


def test_what_was_used_of_late_or_is_not_ours_stays_and_what_a_killed_build_left_goes(
    cache, monkeypatch
) -> None:
    monkeypatch.setattr(kept, "MOST", 0)
    late, used, old = entry(cache, 1, 60.0), entry(cache, 2, OLD), entry(cache, 3, OLD)
    for name, age in ((".build-left", OLD), (".build-now", 1.0), ("letters", OLD)):
        (cache / name).mkdir()
        os.utime(cache / name, (time.time() - age,) * 2)
    kept.in_use(kept.libraries(used)[0])
    kept.tidy(cache)
    assert {path.name for path in cache.iterdir()} == {
        late.name,
        used.name,
        ".build-now",
        "letters",
    }
    assert not old.exists()


def test_a_hit_counts_as_use_and_a_build_tidies(cache, monkeypatch) -> None:
    emitted = module("emps").emitted
    sources = {n: emitted.files[n] for n in emitted.spec.sources}
    library = build_library(sources)
    for path in (library, library.parent):
        os.utime(path, (time.time() - OLD,) * 2)
    assert build_library(sources) == library
    assert time.time() - library.stat().st_mtime < 60.0
    old = entry(cache, 1, OLD)
    monkeypatch.setattr(kept, "MOST", 0)
    load(emitted.spec, {**emitted.files, "emps.c": emitted.files["emps.c"] + "\n"})
    assert library.exists() and not old.exists()


def test_a_loaded_library_may_go(cache) -> None:
    model = load(module("emps").emitted.spec, module("emps").emitted.files)
    shutil.rmtree(cache)
    assert model.gravity([[0.1]], [1.0] * len(model.spec.base)).shape == (1, 1)


_REMOVER = """
import shutil, sys, time
from pathlib import Path
until = time.time() + 0.6
while time.time() < until:
    for folder in Path(sys.argv[1]).glob("[0-9a-f]*"):
        shutil.rmtree(folder, ignore_errors=True)
"""


def test_no_process_trips_over_what_another_removes(cache, monkeypatch) -> None:
    """One removes whatever it finds while another looks, tidies and puts libraries into place."""
    monkeypatch.setattr(kept, "MOST", 2)
    monkeypatch.setattr(kept, "RECENT", -60.0)
    cache.mkdir()
    other = subprocess.Popen([sys.executable, "-c", _REMOVER, str(cache)])
    rounds = 0
    while other.poll() is None:
        for k in range(5):
            made = cache / f".build-{k}"
            made.write_bytes(bytes([k]) * 1000)
            final = cache / hashlib.sha256(bytes([k])).hexdigest() / "x.so"
            kept.placed(made, final)
            for library in kept.libraries(final.parent):
                kept.in_use(library)
                kept.whole(library)
        kept.tidy(cache)
        rounds += 1
    assert rounds > 3 and other.returncode == 0
