"""Triangles without W: against numpy's QR, the law R^T R = W^T W, and rows that are left out."""

import numpy as np
import pytest

from modeler.core.errors import ShapeError
from modeler.numerics.filters import build_row_filter
from modeler.runtime import build, fused
from modeler.runtime.bind import load_fused_library
from tests.modules import plain, states

EPS = np.finfo(float).eps


def levels() -> list[int]:
    """Every set of instructions that this processor has."""
    return list(range(1, load_fused_library().resolve_level() + 1))


def stacked(model, q, qd, qdd, tau) -> np.ndarray:
    """(joints, samples, c + 1) [W_j tau_j]."""
    phi = model.base_regressor(q, qd, qdd)
    return np.concatenate([phi, tau[:, :, None]], axis=2).transpose(1, 0, 2)


def drawn(samples: int, seed: int):
    """The wrist with random q, qd, qdd and torques."""
    q, qd, qdd = states(3, samples)
    return plain("wrist"), q, qd, qdd, np.random.default_rng(seed).normal(size=q.shape)


def check(triangles: np.ndarray, rows: np.ndarray) -> None:
    """R of every joint is upper and has the products of the rows, to rounding."""
    for item, joint in zip(triangles, rows, strict=True):
        assert not np.tril(item, -1).any()
        size = np.linalg.norm(joint) ** 2
        assert np.abs(item.T @ item - joint.T @ joint).max() <= 50 * EPS * max(size, 1e-300)


@pytest.mark.digits
@pytest.mark.parametrize(
    ("name", "samples"),
    [*(("wrist", n) for n in (0, 1, 7, 8, 9, 255, 1000)), ("five-bar", 300), ("emps", 300)],
)
def test_triangles_are_those_of_the_rows(name, samples):
    model = plain(name)
    q, qd, qdd = states(len(model.spec.joints), samples)
    if model.spec.closure is not None:
        q = 0.05 * q + home(model)
    tau = np.random.default_rng(1).normal(size=q.shape)
    result = model.triangles(q, qd, qdd, tau)
    assert result.rows.tolist() == [samples] * q.shape[1] and not result.left_out.any()
    check(result.triangles, stacked(model, q, qd, qdd, tau))


def home(model) -> np.ndarray:
    return np.array([model.spec.closure.home[i] for i in model.spec.closure.actuated])


def test_samples_whose_loops_do_not_close_are_left_out():
    model = plain("five-bar")
    q, qd, qdd = states(2, 40)
    q = 0.05 * q + home(model)
    tau = np.ones_like(q)
    far = q.copy()
    far[5] = [0.0, np.pi]
    assert model.closing_status(far).nonzero()[0].tolist() == [5]
    result = model.triangles(far, qd, qdd, tau)
    assert result.left_out.nonzero()[0].tolist() == [5] and result.rows.tolist() == [39, 39]
    mask = np.arange(40) != 5
    expected = stacked(model, q[mask], qd[mask], qdd[mask], tau[mask])
    check(result.triangles, expected)


def ill_conditioned(spread: float, rows: int = 700, columns: int = 11) -> np.ndarray:
    """Singular values from 1 down to `spread`, one place each."""
    rng = np.random.default_rng(3)
    left, _ = np.linalg.qr(rng.standard_normal((rows, columns)))
    right, _ = np.linalg.qr(rng.standard_normal((columns, columns)))
    return np.ascontiguousarray(left * np.geomspace(1.0, spread, columns) @ right.T)


@pytest.mark.digits
def test_small_singular_values_survive():
    """Those of R are within roundings of the largest; W^T W would end at its square root."""
    A = ill_conditioned(1e-14)
    exact = np.linalg.svd(A, compute_uv=False)
    pattern = fused.build_pattern([(0, c) for c in range(10)], 1, 10)
    for level in levels():
        result = fused.reduce_rows(pattern, A[:, None, :10].copy(), A[:, 10:], None, level=level)
        values = np.linalg.svd(result.triangles[0], compute_uv=False)
        assert np.abs(values - exact).max() < 30 * EPS
    lost = np.sqrt(np.abs(np.linalg.eigvalsh(A.T @ A)[::-1]))
    assert np.abs(lost - exact).max() > 1e5 * 30 * EPS


def test_masked_rows_may_hold_anything_and_weights_multiply():
    wrist, q, qd, qdd, tau = drawn(501, 5)
    rng = np.random.default_rng(5)
    weight, use = rng.uniform(0.1, 10.0, q.shape), rng.random(q.shape) < 0.7
    dirty = np.where(use, tau, np.nan)
    result = wrist.triangles(q, qd, qdd, dirty, use=use, weight=np.where(use, weight, np.inf))
    assert result.rows.tolist() == use.sum(axis=0).tolist() and not result.left_out.any()
    rows = stacked(wrist, q, qd, qdd, tau) * weight.T[:, :, None]
    check(result.triangles, rows * use.T[:, :, None])
    q[~use.any(axis=1)] = np.nan  # no row of these samples is in use
    assert not wrist.triangles(q, qd, qdd, dirty, use=use).left_out.any()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e200])
def test_a_sample_that_is_not_finite_is_told_and_spoils_no_other(value):
    wrist, q, qd, qdd, tau = drawn(43, 6)
    clean = stacked(wrist, q, qd, qdd, tau)
    for sample, array in ((0, q), (11, qd), (30, qdd), (42, tau)):
        mask = np.arange(43) != sample
        before, array[sample, 2] = array[sample, 2], value
        if not (array is q and value == 1e200):  # its sine is that of some angle
            result = wrist.triangles(q, qd, qdd, tau)
            assert result.left_out.nonzero()[0].tolist() == [sample]
            assert result.rows.tolist() == [42, 42, 42]
            check(result.triangles, clean[:, mask])
        array[sample, 2] = before


def test_rows_are_means_over_the_samples_that_they_may_use():
    """Each joint its samples and columns; a row that does not count is a mean over whole ones."""
    random = np.random.default_rng(4)
    rows = build_row_filter(np.arange(2, 400, 7), 400, 0.01, 5.0)
    values, usable = random.normal(size=(400, 3, 21)), random.random((400, 3)) > 0.7
    used, whole = random.random((len(rows.centres), 3)) > 0.2, random.random(400) > 0.1
    usable[:60, 1] = False  # rows without any
    spans = [slice(3, 20), slice(0), slice(2, 3)]
    expected = np.zeros((*used.shape, 21))
    for j, span in enumerate(spans):
        means = (rows.average_samples(values[:, j], flags) for flags in (usable[:, j], whole))
        expected[:, j, span] = np.where(used[:, j, None], *means)[:, span]
    values[~whole & ~usable.any(axis=1)] = np.nan  # what no row may use may hold anything
    weights = rows.weights.data, rows.weights.indices, rows.weights.indptr
    for level in levels():
        means = fused.average_rows(weights, values, usable, used, whole, spans, level)
        np.testing.assert_allclose(means, expected, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("spacing", [1, 7, 90])
def test_rows_that_are_means_are_added_without_the_regressor(spacing):
    """Also where rows have no sample in common, so that some samples are never evaluated."""
    model, q, qd, qdd, _ = drawn(1200, 5)
    random, joints = np.random.default_rng(6), q.shape[1]
    rows = build_row_filter(np.arange(40, 1200, spacing), 1200, 0.01, 3.0)
    weights = rows.weights.data, rows.weights.indices, rows.weights.indptr
    usable = random.random(q.shape) > 0.4
    used = random.random((len(rows.centres), joints)) > 0.3
    torque = random.normal(size=used.shape)
    torque[3, 1] = np.nan
    used[3, 1] = True
    before = model.triangles(q[:50], qd[:50], qdd[:50], qdd[:50])
    after = model.mean_triangles((q, qd, qdd), None, torque, weights, usable, used, before)
    phi, whole = model.base_regressor(q, qd, qdd), np.zeros(1200, dtype=bool)
    means = fused.average_rows(weights, phi, usable, used, whole)
    used[3, 1] = False
    assert (after.rows == 50 + used.sum(axis=0)).all()
    added = np.concatenate([means, torque[:, :, None]], axis=2)
    first = stacked(model, q[:50], qd[:50], qdd[:50], qdd[:50])
    parts = [np.concatenate([first[j], added[used[:, j], j]]) for j in range(joints)]
    check(after.triangles, parts)


def test_threads_and_blocks_give_the_same_bits(monkeypatch):
    wrist, q, qd, qdd, tau = drawn(5 * 64 + 3, 7)
    monkeypatch.setattr(fused, "BLOCK", 64)
    values = []
    for count in (1, 2, 7):
        monkeypatch.setattr(build, "count_processors", lambda count=count: count)
        values.append(wrist.triangles(q, qd, qdd, tau))
    for item in values[1:]:
        np.testing.assert_array_equal(item.packed, values[0].packed)
    check(values[0].triangles, stacked(wrist, q, qd, qdd, tau))


def test_later_samples_are_added_to_a_state():
    wrist, q, qd, qdd, tau = drawn(333, 8)
    state, before = None, None
    for part in np.split(np.arange(333), [1, 8, 8, 200]):
        before = None if state is None else (state, state.packed.copy())
        state = wrist.triangles(q[part], qd[part], qdd[part], tau[part], state=state)
        assert len(state.left_out) == len(part)
        if before is not None:
            np.testing.assert_array_equal(before[0].packed, before[1])
    assert state.rows.tolist() == [333] * 3
    check(state.triangles, stacked(wrist, q, qd, qdd, tau))


@pytest.mark.digits
def test_least_squares_of_a_triangle_is_that_of_the_rows():
    model, q, qd, qdd, noise = drawn(4000, 10)
    beta = np.random.default_rng(9).normal(size=len(model.spec.base))
    tau = model.inverse_dynamics(q, qd, qdd, beta) + 0.1 * noise
    R = model.triangles(q, qd, qdd, tau).triangles.reshape(-1, len(beta) + 1)
    W = model.observation(q, qd, qdd)
    expected = np.linalg.lstsq(W, tau.reshape(-1), rcond=None)[0]
    solved = np.linalg.lstsq(R[:, :-1], R[:, -1], rcond=None)[0]
    scale = np.abs(expected).max() * np.linalg.cond(W)
    assert np.abs(solved - expected).max() < 100 * EPS * scale


def test_wrong_arrays_are_refused_by_name():
    wrist, (q, qd, qdd) = plain("wrist"), states(3, 5)
    state = plain("two-link").triangles(*states(2, 5), states(2, 5)[0])
    for more, says in (
        (
            {"use": np.ones((5, 2), bool)},
            r"use: got shape \(5, 2\) of type bool, expected \(5, 3\)",
        ),
        ({"use": np.ones((5, 3), np.int64)}, r"use: got shape \(5, 3\) of type int64"),
        ({"tau": np.ones((4, 3))}, "different numbers of samples"),
        ({"state": state}, r"state: got triangles of another robot \(2 joints"),
        ({"state": "x"}, "state: got str, expected what `triangles` gave"),
        *(({name: None}, f"^{name}: got no array of real") for name in ("q", "qd", "qdd", "tau")),
    ):
        with pytest.raises(ShapeError, match=says):
            wrist.triangles(**({"q": q, "qd": qd, "qdd": qdd, "tau": q} | more))


@pytest.mark.parametrize("value", [np.nan, np.inf, -0.5])
def test_weights_in_use_are_finite_and_not_negative(value):
    q, qd, qdd = states(3, 5)
    weight, use = np.zeros((5, 3)), np.ones((5, 3), dtype=bool)
    weight[4, 1] = value
    for name, n in (("wrist", 3), ("five-bar", 2)):
        with pytest.raises(ShapeError, match=f"weight: got {value} in row 4, column 1"):
            motion = [x[:, :n] for x in (q, qd, qdd, q)]
            plain(name).triangles(*motion, weight=weight[:, :n])
    use[4, 1] = False
    assert plain("wrist").triangles(q, qd, qdd, q, use=use, weight=weight).rows[1] == 4
