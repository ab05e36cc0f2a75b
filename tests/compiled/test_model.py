"""The compiled model at its interface: shapes, memory, threads."""

import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from modeler.core.errors import ShapeError
from tests.modules import plain, states
from tests.rotation import with_cases


@pytest.fixture(scope="module")
def wrist():
    return plain("wrist")


def test_results_have_the_shapes_that_are_promised(wrist):
    c, p = len(wrist.spec.base), len(wrist.spec.standard)
    beta = np.ones(c)
    for n in (7, 0):
        q, qd, qdd = states(3, n)
        assert wrist.base_regressor(q, qd, qdd).shape == (n, 3, c)
        assert wrist.regressor(q, qd, qdd).shape == (n, 3, p)
        assert wrist.observation(q, qd, qdd).shape == (3 * n, c)
        assert wrist.inertia_matrix(q, beta).shape == (n, 3, 3)
        for torque in (
            wrist.inverse_dynamics(q, qd, qdd, beta),
            wrist.gravity(q, beta),
            wrist.coriolis(q, qd, beta),
            wrist.friction(qd, beta),
        ):
            assert torque.shape == (n, 3)
        assert wrist.forward_kinematics(q).shape == (n, 3, 3, 4)
    assert wrist.base_parameters(np.ones(p)).shape == (c,)


def test_rows_of_one_sample_stand_together_in_w_and_out_is_filled_whatever_it_held(wrist):
    q, qd, qdd = states(3, 4)
    W = wrist.observation(q, qd, qdd)
    for sample in range(4):
        one = wrist.base_regressor(q[[sample]], qd[[sample]], qdd[[sample]])
        np.testing.assert_array_equal(W[3 * sample : 3 * sample + 3], one[0])
    out = np.full(W.shape, np.nan)
    assert wrist.observation(q, qd, qdd, out=out) is out
    np.testing.assert_array_equal(out, W)


def test_layout_and_type_of_inputs_do_not_matter_and_none_is_changed(wrist):
    q, qd, qdd = (np.round(x, 1) for x in states(3, 6))
    expected, before = wrist.base_regressor(q, qd, qdd), q.copy()
    q.flags.writeable = False
    for same in (np.asfortranarray(q), np.repeat(q, 2, axis=1)[:, ::2], q.tolist(), q):
        np.testing.assert_array_equal(wrist.base_regressor(same, qd, qdd), expected)
    np.testing.assert_array_equal(q, before)


@with_cases(
    "change, says",
    (lambda q: q.T, "q: got shape (3, 8), expected (samples, 3); did you mean q.T?"),
    (lambda q: q[0], "q: got shape (3,), expected (samples, 3); for one sample write q[None"),
    (lambda q: q[:, :2], "q: got shape (8, 2), expected (samples, 3); one row per sample"),
    (lambda q: q[:, 0], "q: got shape (8,), expected (samples, 3)"),
    (lambda q: 1.0, "q: got shape (), expected (samples, 3)"),
    (lambda q: q + 1j, "q: got no array of real numbers"),
    (lambda q: [["a", "b", "c"]], "q: got no array of real numbers"),
    (lambda q: [[1.0, 2.0, 3.0], [1.0]], "q: got no array of real numbers"),
    (lambda q: np.where(np.arange(8)[:, None] == 5, np.nan, q), "q: got nan in row 5, column"),
    (lambda q: np.where(q == q[7, 2], np.inf, q), "q: got inf in row 7, column 2"),
    (lambda q: q[:4], "different numbers of samples (q 4, qd 8, qdd 8)"),
)
def test_a_wrong_array_is_refused_by_name(wrist, change, says):
    q, qd, qdd = states(3, 8)
    wrong = change(q)
    with pytest.raises(ShapeError, match=re.escape(says)):
        wrist.base_regressor(wrong, qd, qdd)


def test_one_joint_as_a_vector_is_told_how_to_write_it():
    with pytest.raises(ShapeError, match=re.escape("write qd[:, None]")):
        plain("emps").friction(np.zeros(9), np.ones(len(plain("emps").spec.base)))


def test_wrong_parameters_and_outputs_are_refused(wrist):
    c, (q, qd, qdd) = len(wrist.spec.base), states(3, 2)
    bad = np.where(np.arange(c) == 4, np.inf, 0.0)
    for call, says in (
        (lambda: wrist.gravity(q, np.zeros(c + 1)), f"beta: got shape ({c + 1},), expected ({c},)"),
        (lambda: wrist.gravity(q, bad), "beta: got inf in entry 4"),
        (lambda: wrist.gravity(q, None), "beta: got no array of real numbers"),
        (lambda: wrist.inverse_dynamics(q, q, q, None), "beta: got no array of real numbers"),
        (lambda: wrist.base_parameters(np.zeros(3)), "chi: got shape"),
    ):
        with pytest.raises(ShapeError, match=re.escape(says)):
            call()
    contiguous = "a writeable C-contiguous (or Fortran-con"
    for out, says in (
        (np.empty((5, c)), f"out: got (5, {c}), expected an array (6, {c})"),
        ([], "out: got list"),
        (np.empty((6, c), dtype=np.float32), contiguous),
        (np.empty((6, 2 * c))[:, ::2], contiguous),
    ):
        with pytest.raises(ShapeError, match=re.escape(says)):
            wrist.observation(q, qd, qdd, out=out)


def test_threads_may_share_a_model(wrist):
    """Functions hold no state: each thread gets its own robot's motion right."""
    jobs = [states(3, 4000, seed) for seed in range(4)]
    expected = [wrist.observation(*job) for job in jobs]

    def right(number: int) -> bool:
        values = (wrist.observation(*jobs[number]) for _ in range(20))
        return all(np.array_equal(W, expected[number]) for W in values)

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(right, range(4)))


@pytest.mark.parametrize("name", ["wrist", "five-bar"])
def test_signals_that_no_effect_reads_are_refused(name):
    """They would change nothing; whoever gives them thinks of another robot."""
    model = plain(name)
    spec = model.spec
    home = [spec.closure.home[i] for i in spec.closure.actuated] if spec.closure else [0.0] * 3
    q, qd, qdd = np.tile(home, (4, 1)), *np.zeros((2, 4, len(home)))
    beta, s = np.ones(len(spec.base)), np.zeros((4, 1))
    motion = dict.fromkeys(["base_regressor", "regressor", "observation"], (q, qd, qdd))
    motion |= {"nonzeros": (q, qd, qdd)} if spec.closure is None else {}
    calls = motion | {
        "inverse_dynamics": (q, qd, qdd, beta),
        "friction": (qd, beta, q, qdd),
        "triangles": (q, qd, qdd, q),
    }
    for function, entry in calls.items():
        getattr(model, function)(*entry, s=np.zeros((4, 0)))  # none at all
        with pytest.raises(ShapeError, match="got s, but its effects read no signals; leave s out"):
            getattr(model, function)(*entry, s=s)
