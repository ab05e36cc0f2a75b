"""Relations that loops imply, and the rank of the torques over all that is reached.

The law on every robot with loops: relations hold at closed postures found by other means, and the
number of base parameters is the rank of the torques there.
"""

import re

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import LoopError
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import evaluate_regressor
from modeler.derivation.relations import SampledRank, format_proof, serialise_base_parameters
from modeler.derivation.walks import compute_closed_motion
from modeler.robot.read import parse_robot_text, read_robot
from tests.base.test_printed_relations import wrong
from tests.loops.derived import of_file
from tests.modules import module
from tests.oracles.closed_ways import closed_near, open_at, reached
from tests.oracles.complex_step import Oracle
from tests.robot_texts import FOUR_BAR, OFFSET, PANTOGRAPH
from tests.robots import one_always
from tests.rotation import ROTATING, rotating, with_cases

# file -> inertial base parameters and all, by an independent program; kind of proof
FILES = {
    "offset_parallelogram": (3, 5, "exact"),
    "rccc": (16, 16, "exact"),
    "rccc_wide": (16, 16, "exact"),
    "twoloops": (22, 22, "exact at the given values"),
    "twoloops_poorhome": (22, 22, "exact at the given values"),
    "twoloops_mixed": (22, 22, "exact at the given values"),
    "excavator": (40, 49, "exact"),
    "excavator_bucket": (60, 60, "exact"),
    "3rpr_sim": (19, 28, "exact"),
}
TURNS = ("offset_parallelogram", "twoloops_poorhome", "3rpr_sim")
FURTHER = ["rccc_wide", *rotating(*TURNS)]
FURTHER += [pytest.param(n, marks=ROTATING) for n in FILES if n not in (*TURNS, "rccc_wide")]


def check_laws(robot, model, base):
    """Relations and rank at closed postures of a kinematics that shares nothing with the model."""
    oracle = Oracle(robot)
    home = np.array([[robot.home.get(joint.name, 0.0) for joint in robot.free_joints]])
    u = reached(oracle, closed_near(oracle, home, 12)[0], 40, seed=3, reach=0.8, steps=20)
    assert len(u) > 12
    assert np.max(np.abs(open_at(oracle, u))) < 1e-10
    known = oracle.variables(u)
    of_model = np.stack([known[joint.name] for joint in model.robot.free_joints], axis=1)
    for name, value in Oracle(model.robot).variables(of_model).items():
        assert np.max(np.abs(known[name] - value)) < 1e-9, name
    singular = spectrum(model, of_model)
    dropped = singular[base.rank] if base.rank < len(singular) else 1e-16
    assert singular[base.rank - 1] > 1e3 * max(dropped, 1e-15)


def spectrum(model, u, seed=4):
    """Singular values of the torque regressor at closed postures, columns of length 1."""
    rng = np.random.default_rng(seed)
    rows = len(u) * len(model.robot.coordinates)
    u = np.concatenate([u] * (1 + 3 * len(model.columns) // rows))
    if model.closure is None:
        ud, udd = rng.normal(size=(2, *u.shape))
    else:
        u = model.closure.close_loops(u)
        qd, qdd = rng.normal(size=(2, len(u), len(model.closure.actuated)))
        motion = compute_closed_motion(model, u, qd)
        ud = np.einsum("nij,nj->ni", motion.coupling, qd)
        udd = np.einsum("nij,nj->ni", motion.coupling, qdd) + motion.drift
    W = evaluate_regressor(model, (u, ud, udd)).reshape(-1, len(model.columns))
    lengths = np.linalg.norm(W, axis=0)
    W = W[:, lengths > 1e-12 * lengths.max()]
    return np.linalg.svd(W / np.linalg.norm(W, axis=0), compute_uv=False)


@pytest.mark.parametrize(
    "name",
    one_always(
        ("five-bar", "sr400", "delta", "orthoglide-2012", "3rrr", "evra", "stewart"), "five-bar"
    ),
)
def test_relations_and_rank_hold_over_wide_postures(name):
    check_laws(read_robot(name), module(name).model, module(name).base)


@pytest.mark.rotating("long tests of loops")
@pytest.mark.parametrize("name", FURTHER)
def test_further_robots(name, loop_robots_folder):
    """Counts, proof, all printed forms, and the laws."""
    path = loop_robots_folder / f"{name}.toml"
    robot, model, base = read_robot(path), of_file(path).model, of_file(path).base
    inertial, count, kind = FILES[name]
    assert (base.count_by_kind()["inertial"], base.rank, base.proof.kind) == (inertial, count, kind)
    certificate = base.proof.certificate
    assert certificate.rank == base.rank and not isinstance(certificate, SampledRank)
    assert wrong(name, base, emit(model, base), seed=15) == []
    if name == "rccc_wide":  # the proof says how far the postures went
        low, high = base.proof.sampling.ranges["1"]
        assert -3.0 <= low < -2.5 and 2.5 < high <= 3.0
        assert "on walks from [home]" in " ".join(format_proof(base.proof).split())
        text = serialise_base_parameters(robot.name, base)["certificate"]["sampling"]
        assert text["ranges"]["1"] == [low, high] and text["distance_to_singularity"] > 0.01
    if name == "twoloops_poorhome":  # from there Newton of the tests goes to another mode
        robot = read_robot(loop_robots_folder / "twoloops.toml")
    check_laws(robot, model, base)


def changed(text, rng):
    """The file with other lengths and angles."""

    def other(match):
        factor = 1.0 if match[1] == "g" else rng.uniform(0.96, 1.04)
        return f"{match[1]} = {float(match[2]) * factor:.6f}"

    head, symbols, tail = re.split(r"(?ms)(^\[symbols\].*?)(?=^\[)", text, maxsplit=1)
    return head + re.sub(r"(?m)^(\w+) = (-?[\d.]+)(?=\s*(#.*)?$)", other, symbols) + tail


IN_LETTERS = ["four-bar", *rotating("pantograph", "offset")]
WRITTEN = {"four-bar": (FOUR_BAR, 19), "pantograph": (PANTOGRAPH, 8), "offset": (OFFSET, 3)}


@pytest.mark.parametrize(
    "name", [*IN_LETTERS, *one_always(("five-bar", "sr400", "delta", "evra"), "five-bar")]
)
def test_relations_are_true_at_any_lengths(name):
    """In letters, not of the values of the file: products of inertia of a swinging four-bar, first
    moments of a pantograph on sliders. Values changed at random: what still closes has the same
    relations and base parameters, and obeys the laws.
    """
    text, rank = WRITTEN.get(name) or (read_builtin_robot(name), module(name).base.rank)
    before = derive_model(parse_robot_text(text, name))
    base = derive_base_parameters(before)
    assert (base.rank, base.proof.kind) == (rank, "exact") and not before.special
    rng = np.random.default_rng(8)
    for _ in range(6):
        robot = parse_robot_text(changed(text, rng), name)
        try:
            model = derive_model(robot)
        except LoopError:
            continue
        other = derive_base_parameters(model)
        assert written(model, other) == written(before, base)
        check_laws(robot, model, other)
        return
    pytest.fail(f"{name} closes at none of six choices of lengths")


def written(model, base):
    """Relations of joints and of parameters, in letters."""
    sums = [(p.name, [(t.parameter, str(t.coefficient)) for t in p.terms]) for p in base.parameters]
    return {n: e.text for n, e in model.robot.relations.items()}, sums


@with_cases(
    "change, relation, special",
    (("w = 0.4", "w = 0.4"), "q1 - w", False),
    (("w = 0.4", 'v = 0.1\nw = "pi/4 + 3*v/2"'), "q1 - 3*v/2 - pi/4", False),
    (("w = 0.4", 'v = 0.3\nw = "sqrt(v)"'), "q1 - w", False),
    (('"w"', "0.4123"), "q1 - 4123/10000", False),
    ((', "L", 0],\n  ["3e"', ', "K", 0],\n  ["3e"'), "q1 - w", True),
)
def test_constants_of_relations(change, relation, special):
    """Sums of symbols and pi, symbols that are no such sums, numbers; equal values by chance."""
    text = OFFSET.replace(*change).replace("D = 0.2", "D = 0.2\nK = 0.5")
    model = derive_model(parse_robot_text(text, "offset"))
    assert {n: e.text for n, e in model.robot.relations.items()} == {"3": "-q1", "2": relation}
    assert bool(model.special) == special and not model.unproven
    assert derive_base_parameters(model).proof.kind == (
        "exact at the given values" if special else "exact"
    )


def test_what_is_not_proven_is_not_used():
    """A table with a number of 16 digits: the relation has no short constant."""
    text = OFFSET.replace('"w"', "0.41234567891234567")
    model = derive_model(parse_robot_text(text, "offset"))
    assert not model.robot.relations and set(model.unproven) == {"2", "3"}
    base = derive_base_parameters(model)
    assert base.rank == 3
    assert "not provably, are solved for: 3, 2" in base.proof.statement
