"""Emitted folders: built once for each text, compiler and flags, kept between runs, and copied."""

import hashlib
import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from modeler.codegen.package import write_emitted
from modeler.core.manifest import EmittedModule
from tests.modules import STRICT, compiler
from tests.repository import ROOT

KEPT = ROOT / ".pytest_cache" / "d" / "folders"
MOST = 40
"""So many built folders are kept, those used last."""

FLAGS = " ".join(["-O0", *STRICT, "-Wundef", "-Wcast-align=strict"])
CPP = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
CLEAN = {k: v for k, v in os.environ.items() if k not in ("CFLAGS", "MAKEFLAGS", "DESTDIR")}


def run(*command: object, where: Path, fails: bool = False, **environment: str) -> str:
    """What a command prints."""
    words = [str(word) for word in command]
    env = {**CLEAN, **environment}
    done = subprocess.run(words, cwd=where, env=env, capture_output=True, text=True)
    assert (done.returncode != 0) == fails, f"{words}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def make(folder: Path, *targets: str, flags: str = FLAGS, fails: bool = False) -> str:
    return run(compiler("make"), "-s", *targets, f"CFLAGS={flags}", where=folder, fails=fails)


def built(emitted: EmittedModule, folder: Path, *targets: str, flags: str = FLAGS) -> Path:
    """The folder with the emitted files, and with what `make` makes of them."""
    key = _key(emitted.files, *targets, flags, _version())
    stored = KEPT / key
    if not stored.is_dir():
        KEPT.mkdir(parents=True, exist_ok=True)
        for old in sorted(KEPT.iterdir(), key=_used)[: 1 - MOST]:
            shutil.rmtree(old, ignore_errors=True)
        new = Path(tempfile.mkdtemp(prefix=".new-", dir=KEPT))
        write_emitted(emitted, new)
        make(new, *targets, flags=flags)
        try:
            new.rename(stored)
        except OSError:  # another process was first
            shutil.rmtree(new)
    os.utime(stored)
    shutil.copytree(stored, folder, symlinks=True, dirs_exist_ok=True)
    return folder


def _key(files: Mapping[str, str], *words: str) -> str:
    text = json.dumps([sorted(files.items()), words])
    return hashlib.sha256(text.encode()).hexdigest()


def _used(folder: Path) -> float:
    return folder.stat().st_mtime if folder.exists() else 0.0


@cache
def _version() -> str:
    return run(compiler("cc"), "--version", where=ROOT)
