"""Pinocchio's C++, compiled from the headers of the `pin` wheel."""

import ctypes
import hashlib
import importlib.util
import os
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from benchmarks.line import Missing
from benchmarks.robots import compiled, lossy
from modeler.robot import Robot
from modeler.runtime import find_cache_folder

SOURCE = Path(__file__).with_suffix(".cpp")
FLAGS = (
    "-std=c++17",
    "-O3",
    "-march=native",
    "-DNDEBUG",
    "-w",
    "-fPIC",
    "-shared",
    "-fvisibility=hidden",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
)
COMPILERS = {"gcc": "g++", "clang": "clang++"}
_AGREES = 1e-9
_ORDER = [4, 5, 7, 6, 8, 9, 1, 2, 3, 0]  # of [m, mc, Ixx, Ixy, Iyy, Ixz, Iyz, Izz], as ours


def library(kind: str) -> Path:
    """The peer as a shared library; about a minute the first time, then kept.

    Raises:
        Missing: no such compiler, no headers.
    """
    compiler = shutil.which(COMPILERS[kind])
    if compiler is None:
        raise Missing(f"no {COMPILERS[kind]} on this machine")
    includes = [f"-I{folder}" for folder in _headers()]
    version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True)
    words = [SOURCE.read_text(encoding="utf-8"), version.stdout, *FLAGS, *includes]
    digest = hashlib.sha256("\0".join(words).encode()).hexdigest()[:16]
    made = find_cache_folder() / "benchmarks" / f"pinocchio-{kind}-{digest}.so"
    if not made.exists():
        made.parent.mkdir(parents=True, exist_ok=True)
        scratch = made.with_suffix(f".{os.getpid()}")
        command = [compiler, *FLAGS, *includes, "-o", str(scratch), str(SOURCE)]
        said = subprocess.run(command, capture_output=True, text=True, check=False)
        if said.returncode:
            lines = [line for line in said.stderr.splitlines() if "error" in line]
            raise Missing(f"{COMPILERS[kind]} refuses Pinocchio's headers: {lines[:1]}")
        scratch.replace(made)
    return made


def _headers() -> list[Path]:
    """Of Pinocchio, and of Eigen, which CasADi's wheel carries."""
    values = []
    for package, inside, probe in (
        ("cmeel", "../cmeel.prefix/include", "pinocchio/algorithm/regressor.hpp"),
        ("casadi", "include/eigen3", "Eigen/Core"),
    ):
        spec = importlib.util.find_spec(package)
        if spec is None or spec.origin is None:
            raise Missing(f"the Python package {package} is not installed (pip install pin casadi)")
        folder = (Path(spec.origin).parent / inside).resolve()
        if not (folder / probe).exists():
            raise Missing(f"{folder / probe} is missing: another version of its package?")
        values.append(folder)
    return values


def write_model(robot: Robot, place: Path, bodies: Mapping[str, Sequence[float]] = {}) -> None:
    """The robot as the peer reads it.

    Args:
        robot: without loops.
        place: file to write.
        bodies: {joint: mass, centre, inertia there as xx xy yy xz yz zz, rotor inertia}.
    """
    values = robot.evaluate_symbols()
    lines = [" ".join(repr(float(e.evaluate(values))) for e in robot.gravity)]
    places: dict[str, tuple[int, np.ndarray]] = {"0": (0, np.eye(4))}
    count = 0
    for joint in robot.joints:
        parent, before = places[joint.antecedent]
        numbers = values | {joint.variable: 0.0}
        placement = before @ _placement(joint, numbers)
        if not joint.is_moving:
            places[joint.name] = (parent, placement)
            continue
        count += 1
        cells = [*placement[:3, :3].ravel(), *placement[:3, 3]]
        cells += bodies.get(joint.name, [0.0] * 11)
        turns = int(joint.is_revolute)
        lines.append(f"{parent} {turns} " + " ".join(repr(float(cell)) for cell in cells))
        places[joint.name] = (count, np.eye(4))
    place.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _placement(joint, numbers) -> np.ndarray:
    """Rot(z, gamma) Trans(z, b) Rot(x, alpha) Trans(x, d) Rot(z, theta) Trans(z, r)."""
    value = {
        name: float(getattr(joint, name).number(numbers))
        for name in ("gamma", "b", "alpha", "d", "theta", "r")
    }
    about = (
        _about_z(value["gamma"], value["b"]),
        _about_x(value["alpha"], value["d"]),
        _about_z(value["theta"], value["r"]),
    )
    return about[0] @ about[1] @ about[2]


def _about_z(angle: float, along: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, along], [0, 0, 0, 1]])


def _about_x(angle: float, along: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0, along], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def check(kind: str, name: str, model: Path) -> None:
    """The peer computes the same regressor as we do, or there is nothing to compare.

    Raises:
        Missing: it does not.
    """
    peer = ctypes.CDLL(str(library(kind)))
    peer.peer_model.restype = ctypes.c_void_p
    peer.peer_regressor.restype = ctypes.c_double
    handle = ctypes.c_void_p(peer.peer_model(os.fsencode(model)))
    n = len(lossy(name).moving_joints)
    q, qd, qdd = np.random.default_rng(3).uniform(-2, 2, (3, n))
    theirs = np.empty((n, 10 * n))
    pointers = [ctypes.c_void_p(x.ctypes.data) for x in (q, qd, qdd, theirs)]
    peer.peer_regressor(handle, *pointers)
    peer.peer_free(handle)
    names = [p.name for p in compiled(name).spec.standard]
    ours = compiled(name).regressor(q[None], qd[None], qdd[None])[0]
    for link in range(n):
        block = theirs[:, 10 * link : 10 * link + 10][:, _ORDER]
        letters = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
        actual = ours[:, [names.index(f"{letter}{link + 1}") for letter in letters]]
        if np.abs(block - actual).max() > _AGREES * np.abs(ours).max():
            raise Missing(f"Pinocchio and modeler disagree on link {link + 1} of {name}")
