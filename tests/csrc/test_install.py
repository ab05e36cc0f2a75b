"""An emitted folder is installed by make and CMake, found by name or by signature, and linked."""

import shutil
from functools import partial
from pathlib import Path

import pytest

from modeler.codegen.package import format_package_version
from tests.csrc import emitted_folders
from tests.csrc.emitted_folders import built
from tests.modules import compiler, module

CONSUMER = """cmake_minimum_required(VERSION 3.13)
project(consumer LANGUAGES CXX)
find_package(emps {wanted})
message(STATUS "found <${{emps_FOUND}}> <${{emps_SIGNATURE}}>")
add_executable(consumer consumer.cpp)
target_link_libraries(consumer emps::emps)
add_executable(many many.cpp)
target_link_libraries(many emps::batch)
"""

run = partial(emitted_folders.run, CFLAGS="-O0")


def signature() -> str:
    return module("emps").emitted.spec.compute_signature()


def write_other(folder: Path) -> None:
    """The folder of a robot of the same name, with another signature."""
    new = signature()[::-1]
    versions = format_package_version(signature()), format_package_version(new)
    for name, text in module("emps").emitted.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text.replace(signature(), new).replace(*versions))


@pytest.fixture
def folder(tmp_path) -> Path:
    compiler("make"), compiler("g++"), compiler("ldd")
    programs = Path(__file__).with_name("programs")
    (tmp_path / "consumer").mkdir()
    for name in ("consumer.cpp", "many.cpp"):
        shutil.copy(programs / name, tmp_path / "consumer")
    return built(module("emps").emitted, tmp_path / "emps_c", "all", "batch", "shared", flags="-O0")


def install_by_make(folder: Path, prefix: Path) -> None:
    run("make", "install", f"PREFIX={prefix}", where=folder)


def install_by_cmake(folder: Path, prefix: Path, shared: bool) -> None:
    build = folder / f"build-{shared}"
    run("cmake", "-S", ".", "-B", build, f"-DBUILD_SHARED_LIBS={int(shared)}", where=folder)
    run("cmake", "--build", build, where=folder)
    run("ctest", "--test-dir", build, where=folder)
    run("cmake", "--install", build, "--prefix", prefix, where=folder)


def files(prefix: Path) -> set[str]:
    return {p.relative_to(prefix).as_posix() for p in prefix.rglob("*") if not p.is_dir()}


def configure(place: Path, prefix: object, wanted: str, *more: str, fails: bool = False) -> str:
    """What CMake says of a project that needs the package."""
    (place / "CMakeLists.txt").write_text(CONSUMER.format(wanted=wanted))
    shutil.rmtree(place / "build", ignore_errors=True)
    words = ["cmake", "-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={prefix}", *more]
    return run(*words, where=place, fails=fails)


def consume(place: Path, prefix: object, shared: bool, wanted: str = "REQUIRED") -> None:
    """A C++ program that finds the package by CMake, and runs."""
    said = configure(place, prefix, wanted, f"-DBUILD_SHARED_LIBS={int(shared)}")
    assert f"found <1> <{signature()}>" in said
    run("cmake", "--build", "build", where=place)
    assert run("build/consumer", where=place) == f"{signature()} 100"
    assert run("build/many", where=place) == "2"
    needed = run("ldd", "build/consumer", where=place)
    assert (f"libemps_model.so.{signature()}" in needed) == shared


@pytest.mark.rotating("long tests of csrc")
def test_make_installs_what_cmake_and_pkg_config_find_and_takes_it_away_again(folder, tmp_path):
    compiler("cmake"), compiler("pkg-config")
    prefix, place = tmp_path / "a prefix", tmp_path / "consumer"
    prefix.mkdir()
    (prefix / "mine").write_text("")
    install_by_make(folder, prefix)
    assert files(prefix) >= {
        "include/emps/emps.h",
        "lib/libemps_model.a",
        "lib/libemps_model.so",
        f"lib/libemps_model.so.{signature()}",
    }
    consume(place, prefix, shared=False)
    moved = tmp_path / "moved"
    prefix.rename(moved)  # nothing in it says where it was
    consume(place, moved, shared=True, wanted="REQUIRED COMPONENTS shared")
    check_pkg_config(place, moved)
    run("make", "uninstall", f"PREFIX={moved}", where=folder)
    assert files(moved) == {"mine"}


def check_pkg_config(place: Path, prefix: Path) -> None:
    path, rpath = prefix / "lib" / "pkgconfig", f"-Wl,-rpath,{prefix / 'lib'}"

    def ask(*words: str, fails: bool = False) -> str:
        said = run("pkg-config", *words, where=place, PKG_CONFIG_PATH=str(path), fails=fails)
        return said.strip()

    one = ("emps", "consumer", f"{signature()} 100")
    for package, program, says in (one, ("emps_batch", "many", "2")):
        flags = ask("--cflags", "--libs", package).split()
        words = ["-Wall", "-Werror", f"{program}.cpp", *flags, rpath, "-o", program]
        run("g++", *words, where=place)
        assert run(f"./{program}", where=place) == says
    version = format_package_version(signature())
    assert ask("--modversion", "emps") == version
    assert ask("--variable=signature", "emps") == signature()
    ask("--exists", f"emps = {version}")
    ask("--exists", "emps = 1.1.2.3", fails=True)


@pytest.mark.rotating("long tests of csrc")
@pytest.mark.parametrize("shared", [pytest.param(False, marks=pytest.mark.rotating), True])
def test_cmake_installs_either_kind(folder, tmp_path, shared):
    compiler("cmake"), compiler("pkg-config")
    prefix, place = tmp_path / "prefix", tmp_path / "consumer"
    install_by_cmake(folder, prefix, shared)
    consume(place, prefix, shared, f"{format_package_version(signature())} EXACT REQUIRED")
    kinds = ("static", "shared")
    text = configure(place, prefix, f"REQUIRED COMPONENTS {kinds[not shared]}", fails=True)
    assert f"no library of signature {signature()} here that is {kinds[not shared]}" in text
    (pc,) = prefix.rglob("emps.pc")
    path = {"PKG_CONFIG_PATH": str(pc.parent)}
    includes = run("pkg-config", "--cflags", "emps", where=place, **path).strip()
    assert (Path(includes.removeprefix("-I")) / "emps.h").is_file()


@pytest.mark.rotating("another signature")
def test_the_library_beside_is_found_where_the_first_has_another_signature(folder, tmp_path):
    """By the number that stands for the signature; by the interface alone any will do."""
    compiler("cmake")
    another, prefix, place = tmp_path / "other", tmp_path / "prefix", tmp_path / "consumer"
    write_other(another)
    install_by_make(another, tmp_path / "first")
    install_by_make(folder, prefix)
    version = format_package_version(signature())
    both = f"{tmp_path / 'first'};{prefix}"
    consume(place, both, False, f"{version} REQUIRED")
    for wanted in (version, "1"):
        text = configure(place, tmp_path / "first", f"{wanted} REQUIRED", fails=True)
        assert format_package_version(signature()[::-1]) in text  # "considered but not accepted"


@pytest.mark.rotating("another signature")
def test_a_program_never_gets_the_library_of_another_signature(folder, tmp_path):
    """The newer one is installed over the older: its file has another name, and both stay."""
    prefix, place = tmp_path / "prefix", tmp_path / "consumer"
    install_by_make(folder, prefix)
    lib = prefix / "lib"
    link = ["-I", prefix / "include" / "emps", "-L", lib, f"-Wl,-rpath,{lib}", "-lemps_model"]
    run("g++", "consumer.cpp", *link, "-o", "old", where=place)
    write_other(folder)
    run("make", "clean", where=folder)
    install_by_make(folder, prefix)
    run("g++", "consumer.cpp", *link, "-o", "new", where=place)
    assert run("./old", where=place) == f"{signature()} 100"
    assert run("./new", where=place) == f"{signature()[::-1]} 100"
    (lib / f"libemps_model.so.{signature()}").unlink()
    out = run("./old", where=place, fails=True)
    assert f"libemps_model.so.{signature()}" in out


@pytest.mark.slow
def test_a_kind_that_was_left_by_another_signature_is_not_taken(folder, tmp_path):
    """CMake installs one kind; the other, older one stays beside it."""
    compiler("cmake")
    prefix, place = tmp_path / "prefix", tmp_path / "consumer"
    install_by_cmake(folder, prefix, shared=False)
    write_other(folder)
    install_by_cmake(folder, prefix, shared=True)
    text = configure(place, prefix, "REQUIRED COMPONENTS static", fails=True)
    assert "that is static" in text


def test_a_destination_goes_before_the_prefix(folder, tmp_path):
    run("make", "install", "PREFIX=/srv/robots", f"DESTDIR={tmp_path / 'stage'}", where=folder)
    staged = tmp_path / "stage" / "srv" / "robots"
    assert (staged / "include" / "emps" / "emps.h").is_file()
    for text in (staged / "lib").rglob("emps*"):
        assert str(tmp_path) not in text.read_text() if text.is_file() else True
    run("make", "uninstall", "PREFIX=/srv/robots", f"DESTDIR={tmp_path / 'stage'}", where=folder)
    assert not files(staged)


def test_the_check_of_the_folder_notices_a_library_that_is_not_its_own(folder):
    assert f"emps {signature()}:\n11 functions agree with the stored states" in run(
        "make", "check", where=folder
    )
    header = (folder / "emps.h").read_text()
    (folder / "emps.h").write_text(header.replace(signature(), "0" * 16))
    out = run("make", "check", where=folder, fails=True)
    assert f"the library is {signature()},\nthe header {'0' * 16}" in out


def test_a_version_is_made_of_the_signature():
    assert format_package_version("12345678abcd0000") == "2.4660.22136.43981"
