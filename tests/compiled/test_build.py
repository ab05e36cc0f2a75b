"""Compiling and keeping: the cache, its accidents, and complaints that say what to do."""

import dataclasses
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import modeler.runtime.build as build
import modeler.runtime.model as compiled_model
from modeler.codegen.package import write_emitted
from modeler.core.errors import BuildError, ManifestError
from modeler.runtime.build import find_toolchain
from modeler.runtime.model import load_folder, load_module
from tests.modules import compiler, module, states
from tests.rotation import with_cases


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    folder = tmp_path / "cache"
    monkeypatch.setenv("MODELER_CACHE", str(folder))
    monkeypatch.setenv("CFLAGS", "-O0")  # where a test does not say other flags
    return folder


@pytest.fixture
def emps():
    return module("emps").emitted


def libraries(cache: Path) -> list[Path]:
    return sorted(cache.glob("*.so"))


def works(model) -> None:
    q, qd, qdd = states(1, 3)
    W = model.observation(q, qd, qdd)
    beta = np.arange(1.0, W.shape[1] + 1)
    np.testing.assert_allclose(model.inverse_dynamics(q, qd, qdd, beta)[:, 0], W @ beta)


def test_a_second_load_does_not_compile_and_other_text_is_another_library(cache, emps, monkeypatch):
    works(load_module(emps.spec, emps.files))
    with monkeypatch.context() as patch:
        patch.setattr(build, "compile_library", lambda *_: pytest.fail("compiled again"))
        works(load_module(emps.spec, emps.files))
    assert len(libraries(cache)) == 1
    assert not list(cache.glob(".build-*")), "the scratch folder is left"
    load_module(emps.spec, {**emps.files, "emps.c": emps.files["emps.c"] + "\n"})
    monkeypatch.setenv("CC", compiler("clang"))
    works(load_module(emps.spec, emps.files))
    assert len(libraries(cache)) == 3


@pytest.mark.parametrize("damage", [b"\x7fELF nonsense", None])
def test_a_damaged_library_is_built_again(cache, emps, damage):
    load_module(emps.spec, emps.files)
    (library,) = libraries(cache)
    whole = library.read_bytes()
    library.unlink()  # not in place: this process has it mapped
    library.write_bytes(whole[: len(whole) // 2] if damage is None else damage)
    works(load_module(emps.spec, emps.files))
    (again,) = libraries(cache)
    assert again.read_bytes() != damage


def test_threads_and_processes_may_build_at_once(cache, emps, tmp_path):
    write_emitted(emps, tmp_path)
    script = f"from modeler.runtime import load_folder; load_folder({str(tmp_path)!r})"
    processes = [subprocess.Popen([sys.executable, "-c", script]) for _ in range(2)]
    with ThreadPoolExecutor(2) as pool:
        loads = [pool.submit(load_module, emps.spec, emps.files) for _ in range(2)]
    assert [process.wait() for process in processes] == [0, 0]
    for each in loads:
        works(each.result())


def test_own_flags_take_the_place_of_ours(cache, emps, monkeypatch):
    monkeypatch.setenv("CFLAGS", "-O1 -ffp-contract=off")
    assert find_toolchain().flags == ("-std=c99", "-fPIC", "-O1", "-ffp-contract=off")
    works(load_module(emps.spec, emps.files))
    monkeypatch.setenv("CFLAGS", "")
    assert "-O3" in find_toolchain().flags


@with_cases(
    "words, stays, goes",
    ("-march=x86-64", "-O3", "-march=native"),
    ("-mcpu=native", "-O3", "-march=native"),
    ("-O1 -ffp-contract=off", "-fno-math-errno", "-ffp-contract=fast"),
    ("-Os", "-fno-math-errno", "-O3"),
    ("-ftree-slp-vectorize", "-ffp-contract=fast", "-fno-tree-slp-vectorize"),
)
def test_flags_of_the_command_win(cache, emps, monkeypatch, words, stays, goes, tmp_path):
    real = compiler("gcc")
    wrapped = tmp_path / "any-cc"  # which takes flags of every processor
    wrapped.write_text(
        f'#!/bin/sh\nfor w; do shift; case $w in -mcpu=*) ;; *) set -- "$@" "$w";; '
        f'esac; done\nexec {real} "$@"\n'
    )
    wrapped.chmod(0o755)
    monkeypatch.delenv("CFLAGS", raising=False)
    monkeypatch.setenv("CC", f"{wrapped} {words}")
    flags = find_toolchain().flags
    assert stays in flags and goes not in flags
    if words == "-mcpu=native":
        works(load_module(emps.spec, emps.files))


@with_cases(
    "variables, says",
    (
        {"PATH": "{tmp}"},
        "none of cc, gcc, clang is found; install one: Debian, Ubuntu `apt install gcc`, Fedora",
    ),
    ({"CFLAGS": "-O2 --no-such-flag"}, 'refuses CFLAGS="-O2 --no-such-flag" ('),
    ({"CFLAGS": "-O2 'open"}, 'got CFLAGS="-O2 \'open" (No closing quotation)'),
    ({"CC": "no-such-compiler -m64"}, 'got CC="no-such-compiler -m64", which is not found'),
    ({"CC": "{tmp}/broken-cc"}, "broken-cc does not start"),
    ({"MODELER_CACHE": "{tmp}/broken-cc"}, "; set MODELER_CACHE"),
)
def test_what_does_not_compile_is_named(cache, emps, monkeypatch, tmp_path, variables, says):
    broken = tmp_path / "broken-cc"
    broken.write_bytes(b"\x7fELF")
    broken.chmod(0o755)
    monkeypatch.delenv("CC", raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value.format(tmp=tmp_path))
    with pytest.raises(BuildError, match=re.escape(says)):
        load_module(emps.spec, emps.files)
    assert not libraries(cache)


def test_the_compilers_own_words_are_quoted(cache, emps):
    files = {**emps.files, "emps.c": emps.files["emps.c"] + "\nthis is not C;\n"}
    with pytest.raises(BuildError, match=r"refused the emitted code:\n(.|\n)*error"):
        load_module(emps.spec, files)
    assert not libraries(cache)


def test_the_cache_is_where_the_environment_says(monkeypatch, tmp_path):
    for name, below in (
        ("HOME", ".cache/modeler"),
        ("XDG_CACHE_HOME", "modeler"),
        ("MODELER_CACHE", ""),
    ):
        monkeypatch.delenv("MODELER_CACHE", raising=False)
        if name == "HOME":
            monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
        monkeypatch.setenv(name, str(tmp_path / name))
        assert build.find_cache_folder() == tmp_path / name / below


def test_code_and_manifest_that_do_not_fit_are_refused(cache, emps):
    spec, files, functions = emps.spec, emps.files, emps.spec.functions
    lacking = {**files, "emps.c": files["emps.c"].replace("emps_gravity", "emps_gravitas")}
    no_name = dataclasses.replace(functions[0], name="f(void); int x")
    for manifest, code, says in (
        (
            dataclasses.replace(spec, title="another robot"),
            files,
            "code answers .*one of them is older, generate both",
        ),
        (spec, lacking, "lacks what its manifest names"),
        (
            dataclasses.replace(spec, functions=functions[1:]),
            files,
            "code answers .*one of them is older, generate both",
        ),
        (dataclasses.replace(spec, functions=(no_name, *functions)), files, "expected a C name"),
    ):
        with pytest.raises(ManifestError, match=says):
            load_module(manifest, code)


@pytest.mark.parametrize("prefix", ["../emps", "emps/../../emps", ""])
def test_a_prefix_that_leads_elsewhere_is_refused_before_anything_is_touched(
    cache, emps, tmp_path, prefix, monkeypatch
):
    spec = dataclasses.replace(emps.spec, prefix=prefix)
    files = {name.replace("emps", prefix): text for name, text in emps.files.items()}
    monkeypatch.setattr(compiled_model, "build_library", lambda _: pytest.fail("built"))
    with pytest.raises(ManifestError, match="expected a C name"):
        load_module(spec, files)
    folder = tmp_path / "module"
    folder.mkdir()
    (folder / "manifest.json").write_text(spec.to_json())
    (tmp_path / "emps.c").mkdir()
    with pytest.raises(ManifestError, match="expected a C name"):
        load_folder(folder)
    assert not cache.exists()


def test_a_folder_with_other_files_is_loaded_and_one_without_a_manifest_named(
    cache, emps, tmp_path
):
    write_emitted(emps, tmp_path)
    (tmp_path / "controller.c").write_text("not C at all")
    works(load_folder(tmp_path))
    (tmp_path / "manifest.json").unlink()
    with pytest.raises(ManifestError, match=r"no manifest\.json; expected a folder that"):
        load_folder(tmp_path)


def test_loading_needs_no_symbols(emps, tmp_path):
    """A robot identified today can be loaded tomorrow without sympy, casadi or jinja2."""
    write_emitted(emps, tmp_path)
    script = (
        "import sys\nfor name in ('sympy', 'casadi', 'jinja2'): sys.modules[name] = None\n"
        f"from modeler.runtime import load_folder\nload_folder({str(tmp_path)!r})\n"
        "north = tuple(f'modeler.{n}' for n in ('derivation', 'robot', 'effects', 'codegen'))\n"
        "assert not [m for m in sys.modules if m.startswith(north)]\n"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
