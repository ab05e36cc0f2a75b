"""Robots of the controller's functions, physical parameters, and the same in Pinocchio."""

from functools import cache

import numpy as np

from modeler.codegen import derive, generate, load
from modeler.codegen.control import Control
from modeler.core.builtin import builtin_names
from modeler.robot.read import robot_from_text
from tests.modules import loaded

SERIAL = (
    "puma560", "panda", "ur10e", "wrist", "rx90", "scara", "lwr", "kinova_gen3", "tx40", "so101",
    "vx300s", "two-link",
)  # fmt: skip
TREE = ("sr400-tree", "orthoglide-leg-tree", "tree-1", "tree-2", "tree-3", "tree-4")


def tree_text(seed: int) -> str:
    """A drawn tree of turning and sliding joints.

    Rows of even seeds go through one branch after another, as some of Pinocchio's algorithms want
    it; those of odd seeds do not.
    """
    random = np.random.default_rng(seed)
    rows, way = [], [0]
    for j in range(1, 7 + seed % 3):
        before = int(random.choice(way) if seed % 2 == 0 else random.integers(max(0, j - 3), j))
        way = [*way[: way.index(before) + 1], j] if seed % 2 == 0 else way
        slides = random.random() < 0.25
        cells = [f"{x:.2f}" for x in random.normal(0, 0.8, 5)]
        gamma, b, alpha, d, still = (f'"{cell}"' for cell in cells)
        theta, r = (still, f'"q{j}"') if slides else (f'"q{j}"', still)
        rows.append(f'["{j}", "{before}", {int(slides)}, {gamma}, {b}, {alpha}, {d}, {theta}, {r}]')
    columns = '["j", "a", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]'
    return (
        f'name = "tree-{seed}"\ngravity = [1.0, -2.0, -9.5]\n\n[mdh]\ncolumns = {columns}\n'
        f"rows = [\n{''.join(f'  {row},{chr(10)}' for row in rows)}]\n\n[effects]\n"
        'viscous = "all"\ncoulomb = "all"\nrotor_inertia = ["1", "2"]\noffset = "all"\n'
    )


def robot_of(name: str):
    if name not in builtin_names() and name.startswith("tree-"):
        return robot_from_text(tree_text(int(name[5:])), name)
    return load(name)


@cache
def controlled(name: str, precision: str = "double"):
    """The compiled module of a robot, with the controller's unit."""
    emitted = generate(derive(robot_of(name)), precision=precision, control=Control())
    return loaded(emitted)


def physical(spec, random) -> dict[str, float]:
    """Standard parameters: bodies of five mass points, rotors, friction; 0 of other effects."""
    values = {}
    for joint in spec.joints:
        m, p = random.uniform(0.1, 1.5, 5), random.normal(0, 0.15, (5, 3))
        J = np.einsum("k,kij->ij", m, [x @ x * np.eye(3) - np.outer(x, x) for x in p])
        numbers = [J[0, 0], J[0, 1], J[0, 2], J[1, 1], J[1, 2], J[2, 2], *(m @ p), m.sum()]
        names = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
        values |= {f"{x}{joint.name}": v for x, v in zip(names, numbers, strict=True)}
        own = {"Ia": 0.3, "Fv": 0.5, "Fs": 0.8, "Off": 0.2}
        values |= {f"{x}{joint.name}": v * random.uniform(0.5, 1) for x, v in own.items()}
    return {parameter.name: values.get(parameter.name, 0.0) for parameter in spec.standard}


def in_pinocchio(robot, chi):
    """(model, places of our joints in its vectors) with bodies, and rotors as armature."""
    from tests.symbolic.oracles import pin, pinocchio_model

    model, ids = pinocchio_model(robot)
    for joint, index in zip(robot.moving, ids, strict=True):

        def of(prefix, name=joint.name):
            return chi.get(f"{prefix}{name}", 0.0)

        J = np.array(
            [[of("XX"), of("XY"), of("XZ")], [of("XY"), of("YY"), of("YZ")],
             [of("XZ"), of("YZ"), of("ZZ")]]
        )  # fmt: skip
        mass = of("M")
        if mass > 0:
            c = np.array([of("MX"), of("MY"), of("MZ")]) / mass
            model.inertias[index] = pin.Inertia(
                mass, c, J - mass * (c @ c * np.eye(3) - np.outer(c, c))
            )
        model.armature[model.idx_vs[index]] = of("Ia")
    return model, [model.idx_vs[i] for i in ids]


def frictions(spec, chi, qd):
    """Of viscous and dry friction and offsets, (n, joints)."""
    of = {
        p: np.array([chi.get(f"{p}{j.name}", 0.0) for j in spec.joints])
        for p in ("Fv", "Fs", "Off")
    }
    return of["Fv"] * qd + of["Fs"] * np.sign(qd) + of["Off"]
