"""Whether a change of a model is for the better: by joint, in units of its error, in blocks."""

import math
from dataclasses import replace

import numpy as np

from modeler.core.table import format_error_pair
from modeler.diagnosis.scoring import (
    ErrorChange,
    Residuals,
    Score,
    explain_no_improvement,
    format_error_changes,
    score_change,
)

RATE, SPAN = 20.0, 30.0


def coloured(seed: int, joint: int) -> np.ndarray:
    """(rows,) residual of rms 1 that lasts for a quarter of a second."""
    white = np.random.default_rng([seed, joint]).normal(size=int(RATE * SPAN) + 4)
    smooth = np.convolve(white, np.ones(5) / 5.0, mode="valid")
    return smooth / np.sqrt(np.mean(smooth**2))


def unseen(*residuals: np.ndarray, torque: float = 10.0) -> Residuals:
    count = len(residuals)
    time = np.arange(len(residuals[0])) / RATE
    return Residuals(
        tuple(str(j + 1) for j in range(count)),
        residuals,
        (np.full(len(time), torque),) * count,
        (time,) * count,
        (np.zeros(len(time), dtype=int),) * count,
    )


def changed(*factors: float, share: float = 0.0, seed: int = 0) -> Score:
    """Every joint's residual by a factor, and with a share of something else in it."""
    old = [coloured(seed, j) for j in range(len(factors))]
    other = [coloured(seed + 100, j) for j in range(len(factors))]
    new = [
        f * (math.sqrt(1.0 - share**2) * e + share * o)
        for f, e, o in zip(factors, old, other, strict=True)
    ]
    return score_change(unseen(*old), unseen(*new))


def test_one_joint_that_falls_is_not_drowned_by_others_that_are_larger() -> None:
    old = [coloured(0, 0), 5.0 * coloured(0, 1)]
    seen = score_change(unseen(*old), unseen(0.6 * old[0], (1.0 + 1e-5) * old[1]))
    assert seen.is_better and seen.changed_joints == ("1",)
    text = format_error_changes(seen.errors, seen.changed_joints)
    assert text == "joint 1 10 % -> 6 %; other joints unchanged"


def test_what_is_printed_falls_or_the_step_is_not_kept() -> None:
    """The total is the root mean square over joints: what one gains another may lose."""
    old = [coloured(0, 0), 5.0 * coloured(0, 1)]
    seen = score_change(unseen(*old), unseen(0.6 * old[0], 1.02 * old[1]))
    assert seen.whole.after > seen.whole.before and not seen.is_better
    total = math.sqrt((0.1**2 + 0.5**2) / 2.0)
    assert math.isclose(seen.whole.before, total, rel_tol=1e-9)
    alike = score_change(unseen(*old), unseen(old[0], (1.0 - 1e-6) * old[1])).whole
    assert alike.after < alike.before and alike.t_ratio > 2.0, "significantly less"
    assert len(set(format_error_pair(alike.before, alike.after))) == 1 and not alike.is_reduced, (
        "but as printed"
    )


def test_blocks_are_paired() -> None:
    """What falls by a twentieth in all blocks is sure, what one block makes is not."""
    noise = coloured(6, 0)
    assert score_change(unseen(noise), unseen(0.95 * noise)).is_better
    once = noise * np.where(np.arange(len(noise)) < RATE / 2.0, 30.0, 1.0)
    assert not score_change(unseen(once), unseen(noise)).is_better


def test_joints_may_have_weights_and_what_nobody_measured_counts_nothing() -> None:
    old, new = unseen(coloured(0, 0), coloured(0, 1)), unseen(0.5 * coloured(0, 0), coloured(0, 1))
    assert math.isclose(score_change(old, new, {"1": 2.0}).whole.after, 0.05, rel_tol=1e-9)
    silent = replace(old, torque=(0.0 * old.torque[0], old.torque[1]))
    score = score_change(silent, replace(new, torque=silent.torque), {"1": 1.0})
    assert math.isnan(score.whole.after) and not score.is_better and "1" not in score.errors
    assert format_error_pair(score.whole.before, score.whole.after) == ("-", "-")


def test_what_rises_is_told_apart() -> None:
    errors = {"1": (0.03, 0.032), "2": (0.05, 0.02), "3": (0.1, 0.1)}
    line = format_error_changes(errors, ("1", "2"))
    assert line == "joint 2 5 % -> 2 %; joint 1 rises, 3 % -> 3.2 %; other joints unchanged"
    assert format_error_changes(errors, ()) == "no joint changes"


def test_a_rise_is_weighed_against_the_falls_and_may_spoil_them() -> None:
    assert changed(0.5, 1.2, 0.5).is_better and changed(0.5, 1.1).is_better
    assert not changed(0.9, 1.3).is_better
    refused = changed(0.2, 1.5, 0.2, 0.2, 0.2)
    assert refused.whole.is_reduced and refused.has_spoilt_joint and not refused.is_better


def test_another_model_that_is_as_good_is_seldom_better() -> None:
    """Half of the residual is another one: differences as large as chance makes them."""
    same = [changed(1.0, 1.0, 1.0, share=0.5, seed=1000 * k) for k in range(200)]
    assert sum(score.is_better for score in same) < 15


def test_what_falls_in_a_few_moments_only_is_seen() -> None:
    """Friction at reversals: nine tenths of the residual lie in a sixth of the time."""
    noise = coloured(3, 0)
    burst = np.where(np.arange(len(noise)) % 120 < 20, 8.0 * coloured(4, 0), 0.0)
    assert score_change(unseen(noise + burst), unseen(noise + 0.5 * burst)).is_better


def test_errors_that_are_as_good_as_none_neither_count_nor_spoil() -> None:
    old = [coloured(0, 0), 1e-6 * coloured(0, 1)]
    assert score_change(unseen(*old), unseen(0.7 * old[0], 10.0 * old[1])).is_better
    assert not score_change(unseen(*old), unseen(old[0], 0.1 * old[1])).is_better


def test_rows_of_another_grid_or_of_two_logs_with_one_clock_are_compared_in_blocks() -> None:
    """A delay moves the rows: they are no longer the same moments."""
    old, new = unseen(coloured(0, 0)), unseen(0.6 * coloured(5, 0))
    moved = replace(new, time=(new.time[0] + 0.013,))
    names = ("residual", "torque", "time", "run")
    thinned = replace(moved, **{name: (getattr(moved, name)[0][::2],) for name in names})
    assert score_change(old, moved).is_better and score_change(old, thinned).is_better
    half = len(old.time[0]) // 2
    time = np.tile(old.time[0][:half], 2)
    both = replace(old, run=(np.repeat([0, 2], half),), time=(time,))
    assert score_change(both, replace(both, residual=(0.6 * both.residual[0],))).is_better


def test_a_joint_that_is_mended_counts_beside_one_that_says_nothing() -> None:
    """Of joint 2 nearly all is explained; joint 1 leaves so much that the sum says nothing."""
    calm, loud = ErrorChange("2", 0.02, 0.002, 9.0), ErrorChange("1", 0.14, 0.14, 0.1)
    whole = ErrorChange("", 0.1, 0.099, 1.0)
    assert Score((loud, calm), whole).is_better
    assert not Score((loud, ErrorChange("2", 0.02, 0.019, 9.0)), whole).is_better
    assert not Score((ErrorChange("1", 0.14, 0.141, -5.0), calm), whole).is_better
    line = explain_no_improvement({"1": (0.14, 0.14), "2": (0.02, 0.019)}, ["2"])
    assert line.startswith("the error does not fall by more than chance: ")
    assert "joint 2 2 % -> 1.9 %" in line
    assert explain_no_improvement({"1": (0.01, 0.02)}, ["1"]).startswith("the error rises: ")
