"""What a controller calls beside Pinocchio's C++ by gcc, interleaved in both orders, in cache.

Ours has rotor inertia and friction at every joint, Pinocchio rotor inertia; friction is 0 where the
outputs are compared, which comes first: a peer that computes something else is none.
"""

import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from benchmarks.line import Key, Line, Missing, ratio
from benchmarks.peers import pinocchio
from benchmarks.robots import lossy
from modeler.codegen import derive, generate
from modeler.runtime import find_toolchain

HERE = Path(__file__).resolve().parent
ROBOTS = ("puma560", "panda", "ur10e")
_ROUNDS, _FEW = 400, 40
_AGREES = 1e-8
_TWICE = (2.0, None)
_MUST: Mapping[str, tuple[float | None, float | None]] = {
    "inverse_dynamics": _TWICE,
    "inertia_matrix": _TWICE,
    "gravity": (None, None),
    "coriolis_matrix": _TWICE,
    "coriolis_transpose": _TWICE,
    "momentum": (None, None),
    "pose": (None, None),
    "jacobian": _TWICE,
    "jacobian_dot_qd": _TWICE,
    "twist": (None, None),
    "derivatives": (1.2, 2.0),
    "forward_dynamics": (1.2, 2.0),
    "forward_derivatives": (1.2, 2.0),
    "operational_inertia": (None, None),
    "slotine_li_regressor": (None, None),
}
_PEERS: Mapping[str, str] = {
    "inverse_dynamics": "`rnea`",
    "inertia_matrix": "`crba`",
    "gravity": "`computeGeneralizedGravity`",
    "coriolis_matrix": "`computeCoriolisMatrix`",
    "coriolis_transpose": "`computeCoriolisMatrix` and a product",
    "pose": "`updateFramePlacement`",
    "jacobian": "`computeFrameJacobian`",
    "jacobian_dot_qd": "`getFrameClassicalAcceleration`",
    "twist": "`getFrameVelocity`",
    "derivatives": "`computeRNEADerivatives`",
    "forward_dynamics": "`aba`",
    "forward_derivatives": "`computeABADerivatives`",
    "operational_inertia": "`crba`, Cholesky, LLT",
}
"""Pinocchio's functions; it has none of the momentum and of Slotine and Li's regressor."""


def _measure(quick: bool) -> Mapping[str, float | Missing]:
    table: dict[str, float | Missing] = {}
    for name in ROBOTS:
        times = nanoseconds(name, _FEW if quick else _ROUNDS)
        for function, (ours, theirs, apart) in times.items():
            table[f"control_ns.{function}.{name}"] = ours
            if theirs:
                key = f"control_vs_pinocchio.{function}.{name}"
                table[key] = theirs / ours
                if not apart <= _AGREES:
                    table[key] = Missing(f"the outputs are {apart:.1e} apart")
    return table


def nanoseconds(name: str, rounds: int) -> dict[str, tuple[float, float, float]]:
    """{function: our ns, Pinocchio's or 0, how far the outputs are apart}."""
    robot = lossy(name)
    random = np.random.default_rng(5)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        module = generate(derive(robot), folder / "module")
        bodies, chi = {}, dict[str, float]()
        for joint in robot.moving_joints:
            mass, centre, rotor = random.uniform(1, 5), random.uniform(-0.2, 0.2, 3), 0.1
            half = random.uniform(-0.1, 0.1, (3, 3))
            inertia = half @ half.T + 0.05 * np.eye(3)
            about = inertia + mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
            bodies[joint.name] = [mass, *centre, *inertia[np.tril_indices(3)], rotor]
            values = [*about[np.triu_indices(3)], *(mass * centre), mass, rotor]
            letters = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M", "Ia")
            chi |= {f"{a}{joint.name}": x for a, x in zip(letters, values, strict=True)}
        pinocchio.write_model(robot, folder / "model.txt", bodies)
        standard = [chi.get(p.name, 0.0) for p in module.spec.standard]
        (folder / "chi.txt").write_text("\n".join(map(repr, map(float, standard))))
        said = subprocess.run(
            [
                _compiled(module.spec, folder),
                str(rounds),
                str(folder / "chi.txt"),
                str(folder / "model.txt"),
                str(pinocchio.library("gcc")),
            ],
            capture_output=True,
            text=True,
            check=True,
        )
    lines = [line.split() for line in said.stdout.splitlines()]
    return {name: (float(a), float(b), float(c)) for name, a, b, c in lines}


def _compiled(spec, folder: Path) -> Path:
    tools, program = find_toolchain(), folder / "control"
    names = [
        f'-DHEADER="{spec.prefix}_control.h"',
        f"-DPREFIX={spec.prefix}",
        f"-DMACRO={spec.prefix.upper()}",
    ]
    units = [str(folder / "module" / unit) for unit in spec.sources if unit.endswith(".c")]
    made = subprocess.run(
        [
            *tools.command,
            *tools.flags,
            *names,
            "-I",
            str(folder / "module"),
            "-o",
            str(program),
            str(HERE / "control.c"),
            *units,
            "-lm",
            "-ldl",
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    if made.returncode:
        raise Missing(f"the C does not compile: {made.stderr.partition(chr(10))[0]}")
    return program


def _keys() -> list[Key]:
    keys = []
    for name in ROBOTS:
        for function, goals in _MUST.items():
            keys.append(Key(f"control_ns.{function}.{name}", "ns", "One call."))
            if function in _PEERS:
                keys.append(
                    ratio(
                        f"control_vs_pinocchio.{function}.{name}",
                        f"{_PEERS[function]} over it.",
                        *goals,
                    )
                )
    return keys


LINES = (Line(tuple(_keys()), _measure, 90),)
