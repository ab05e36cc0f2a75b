"""The rank of robots with loops, proven in balls: all of them, and never what is not so."""

import json
from dataclasses import replace

import numpy as np
import pytest

from modeler.derivation import numeric_rank, numeric_rank as balls, relations
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.precise import enclose_symbols, load_flint
from modeler.derivation.walks import draw_closed_walk
from modeler.robot.read import parse_robot_text
from tests.base.test_hard_tables import CASES, model_of
from tests.modules import module
from tests.robot_texts import BENNETT, FOUR_BAR
from tests.robots import ROBOTS

SEED = 11


@pytest.mark.parametrize("name", ROBOTS)
def test_every_built_in_robot_is_certified(name):
    model, base, _ = module(name)
    rank = base.proof.certificate
    assert isinstance(rank, relations.ModularRank if model.closure is None else relations.BallRank)
    assert rank.rank == base.rank == base.proof.numeric_rank and base.proof.kind == "exact"
    assert base.proof.agreement < 1e-12  # base torque is standard torque
    last, first = base.proof.gap
    assert first < 1e-9 * last
    text = relations.serialise_base_parameters(name, base)["certificate"]
    assert text["exact_rank"] == base.rank
    assert (text["prime"] is None) == (model.closure is not None)


def test_dependent_columns_are_not_certified(name="five-bar"):
    """One column more than the base, which others make up; one without any effect."""
    model, base, _ = module(name)
    rest = [parameter.column for parameter in base.parameters]
    sample = numeric_rank.draw_sample(model, 60, SEED)
    assert isinstance(numeric_rank.prove_rank(model, rest, sample, SEED), relations.BallRank)
    grouped = {term.parameter for p in base.parameters for term in p.terms[1:]}
    one = next(i for i, name in enumerate(model.names) if name in grouped)
    result = numeric_rank.prove_rank(model, [*rest, one], sample, SEED)
    assert isinstance(result, relations.SampledRank) and "hold a singular matrix" in result.why
    nothing = model.names.index(base.unidentifiable[0])
    result = numeric_rank.prove_rank(model, [*rest, nothing], sample, SEED)
    assert isinstance(result, relations.SampledRank)


def test_postures_off_the_loops_are_not_enclosed():
    model = module("orthoglide-2003").model
    (u,) = draw_closed_walk(model, 1, np.random.default_rng(2)).postures
    with load_flint().ctx.workprec(128):
        enclosures = numeric_rank.Enclosures(model, enclose_symbols(model.robot))
        q = enclosures.enclose_posture(u)
        values = enclosures.equations({f"q[{k}]": x for k, x in enumerate(q)})
        assert all(x.contains(0) and float(x.rad()) < 1e-30 for x in values)
        off = u.copy()
        off[model.closure.solved[0]] += 1e-4
        with pytest.raises(numeric_rank.EnclosureError, match="do not close within"):
            enclosures.enclose_posture(off)
        far = u.copy()
        far[list(model.closure.actuated)] += 2.5  # out of reach
        with pytest.raises(numeric_rank.EnclosureError):
            enclosures.enclose_posture(far)


@pytest.mark.parametrize("name", ["five-bar", "orthoglide-2003"])
def test_anyone_can_run_the_certificate_again(name):
    """From the JSON alone, in floating point: the rows that it names have full rank."""
    model, base, _ = module(name)
    data = json.loads(
        json.dumps(relations.serialise_base_parameters(name, base)["certificate"]["independence"])
    )
    states = data["states"]
    free = [joint.name for joint in model.robot.free_joints]
    names = [joint.name for joint in model.robot.coordinates]
    kinds = (("positions", free), ("speeds", names), ("accelerations", names))
    u, qd, qdd = (np.array([[s[kind][k] for k in item] for s in states]) for kind, item in kinds)
    closed = model.closure.close_loops(u)
    assert np.max(np.abs(closed - u)) < 1e-4
    phi = numeric_rank.evaluate_regressor(model, numeric_rank.expand_states(model, closed, qd, qdd))
    rows = [phi[i, names.index(joint)] for i, joint in data["rows"]]
    W = np.array(rows)[:, [parameter.column for parameter in base.parameters]]
    assert data["kind"] == "balls" and W.shape == (base.rank, base.rank)
    assert np.linalg.matrix_rank(W / np.linalg.norm(W, axis=0), tol=1e-12) == base.rank


def test_more_bits_are_taken_where_few_do_not_do(monkeypatch):
    model, base, _ = module("five-bar")
    rest = [parameter.column for parameter in base.parameters]
    monkeypatch.setattr(balls, "THRESHOLDS", replace(balls.THRESHOLDS, ball_bits=(12, 128)))
    result = numeric_rank.prove_rank(model, rest, numeric_rank.draw_sample(model, 60, SEED), SEED)
    assert isinstance(result, relations.BallRank) and result.bits == 128


def test_what_is_sampled_only_says_so(monkeypatch):
    monkeypatch.setattr(balls, "THRESHOLDS", replace(balls.THRESHOLDS, ball_bits=(12,)))
    model = module("five-bar").model
    base = derive_base_parameters(model)
    assert base.rank == 11 and base.proof.kind == "relations exact, rank sampled"
    text = " ".join(relations.format_proof(base.proof).split())
    assert "Independence is not proven" in text and "rank 11 in floating point only" in text
    message = relations.serialise_base_parameters("five-bar", base)["certificate"]
    assert message["prime"] is message["exact_rank"] is message["points"] is None
    assert message["independence"]["kind"] == "sampled" and message["independence"]["why"]


def test_a_planar_loop_on_a_body_that_turns_has_no_equation_too_many():
    """The swinging four-bar closes in the two equations of its plane, in the axes of that body."""
    model = derive_model(parse_robot_text(FOUR_BAR, "four-bar"))
    assert len(model.closure.equations) == 2 and model.closure.redundant_count == 0
    assert isinstance(derive_base_parameters(model).proof.certificate, relations.BallRank)


def test_equations_that_follow_for_other_reasons_are_not_taken_for_implied():
    """The Bennett linkage: rank 7 as the torques have it at postures that close all equations."""
    model = derive_model(parse_robot_text(BENNETT, "bennett"))
    walk = draw_closed_walk(model, 60, np.random.default_rng(3))
    assert np.max(model.closure.compute_openness(walk.postures)) < 1e-12
    base = derive_base_parameters(model)
    result = base.proof.certificate
    assert base.rank == 7 and isinstance(result, relations.SampledRank)
    assert "3 closure equations seem to follow from the others" in result.why


def test_numbers_without_loops_have_a_proven_lower_bound():
    rows, gravity, more, rank, kind = CASES["tilted base, radicals"]
    base = derive_base_parameters(model_of(rows, gravity, more))
    result = base.proof.certificate
    assert (base.rank, base.proof.kind) == (rank, kind)
    assert isinstance(result, relations.BallRank) and result.rank == rank
    assert "states of few digits" in relations.format_proof(base.proof)
