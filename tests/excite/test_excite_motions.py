"""Motions that are found: limits, worth, and what a fit gains by them."""

import dataclasses

import numpy as np
import pytest

from modeler.api.motion import build_subject
from modeler.api.motion_bounds import build_bounds
from modeler.core.errors import DataError
from modeler.excitation import MotionRequest, build_task, design_motion, draw_random_motion
from modeler.excitation.series import MotionColumns, build_series, compute_condition
from modeler.robot.edit import replace_gravity
from modeler.robot.read import parse_robot_text, read_builtin_robot
from modeler.simulation import closing
from tests.excite.robots_to_excite import limits_of, plausible, robot
from tests.rotation import ROTATING, rotating


def finely(motion):
    """Sampled ten times as densely as limits were looked at in the search, and at other places."""
    count = 320 * motion.series.harmonics + 1
    times = np.linspace(0.0, motion.series.duration, count)
    return build_series(motion.series.duration, motion.series.harmonics, times).evaluate_motion(
        motion.x
    )


def assert_within(motion, bounds):
    q, qd, qdd = finely(motion)
    assert np.all(q <= bounds.upper) and np.all(q >= bounds.lower)
    assert np.all(np.abs(qd) <= bounds.speed) and np.all(np.abs(qdd) <= bounds.acceleration)
    # They are used, too: some joint comes near each kind of limit, or the motion is a timid one.
    assert (
        max((np.abs(qd) / bounds.speed).max(), (np.ptp(q, axis=0) / 2 / bounds.half_range).max())
        > 0.8
    )


@pytest.mark.parametrize("name", ["scara", pytest.param("rx90", marks=pytest.mark.rotating)])
def test_serial_robots_keep_to_their_limits_and_beat_random_motions(name):
    compiled, bounds = limits_of(name)
    motion = design_motion(compiled, bounds, MotionRequest(8.0, 5, starts=1))
    assert_within(motion, bounds)
    assert motion.quality.condition < motion.random[0]
    # Sigmas are a tenth larger at most than on the motion that is best for them among 50.
    worse = (motion.random_log_det - motion.quality.log_det) / 2 / len(compiled.spec.base)
    assert worse < np.log(1.1)
    value = compiled.observation(*motion.series.evaluate_motion(motion.x))
    assert motion.quality.condition == pytest.approx(compute_condition(value))


def test_torques_and_boxes_hold_between_the_samples():
    compiled, bounds = limits_of(
        "demo-arm", ("2=-0.6,2.4,2,8,40", "3=-2.4,2.4,3,12,9"), ("3=-1,0.2,-1,1,0.1,1",)
    )
    beta = plausible(compiled)
    free = dataclasses.replace(bounds, torque=np.full(3, np.inf), boxes=())
    wish = MotionRequest(6.0, 4, starts=1)
    loose = design_motion(compiled, free, wish, beta=beta)
    tight = design_motion(compiled, bounds, wish, beta=beta)
    loads, poses = [], []
    for motion in (loose, tight):
        q, qd, qdd = finely(motion)
        loads.append(np.abs(compiled.inverse_dynamics(q, qd, qdd, beta)).max(axis=0))
        poses.append(compiled.forward_kinematics(q)[:, 2, :, 3])
    assert np.any(loads[0] > bounds.torque) and np.all(loads[1] <= bounds.torque)
    box = bounds.boxes[0]
    assert np.any(poses[0] > box.upper) or np.any(poses[0] < box.lower)
    assert np.all(poses[1] <= box.upper) and np.all(poses[1] >= box.lower)
    assert np.allclose(tight.usage.torque, loads[1], rtol=1e-2)


def assert_not_faster(found, constraints, q, bounds):
    """Joints that follow, by the simulator's closure: at most twice as fast as at home."""
    angular = np.array([joint.is_revolute for joint in found.moving_joints])
    follow = np.isin(np.arange(len(angular)), constraints.passive_rows)
    units = [angular & follow, ~angular & follow]
    sizes = []
    for places in (bounds.home[None, :], q[::40]):
        v = closing.compute_closed_postures(found, constraints, places)
        speeds = []
        for j, half in enumerate(bounds.half_range):
            qd = np.zeros_like(places)
            qd[:, j] = half
            speeds.append(closing.compute_rates(constraints, v, qd, np.zeros_like(qd))[0])
        squares = np.sum(np.array(speeds) ** 2, axis=0)
        sizes.append([np.sqrt(squares[:, unit].sum(axis=1)).max() for unit in units])
    assert np.all(np.array(sizes[1]) <= 2.0 * np.array(sizes[0]) + 1e-9)


@pytest.mark.parametrize("name", ["five-bar", pytest.param("orthoglide-2012", marks=ROTATING)])
def test_loops_close_all_along_away_from_singular_postures(name):
    (values, compiled), limits = robot(name), ()
    if name == "five-bar":
        home = np.array(compiled.spec.closure.home)[list(compiled.spec.closure.actuated)]
        limits = tuple(
            f"{joint.name}={at - 2.5},{at + 2.5},3,12"
            for joint, at in zip(compiled.spec.joints, home, strict=True)
        )
    compiled, box = limits_of(name, limits)
    motion = design_motion(compiled, box, MotionRequest(6.0, 4, starts=1))
    q, *_ = finely(motion)
    constraints = closing.build_constraints(values)
    away = closing.compute_singularity_distances(
        constraints, closing.compute_closed_postures(values, constraints, q)
    )
    home = closing.compute_singularity_distances(
        constraints, closing.compute_closed_postures(values, constraints, box.home[None, :])
    )[0]
    assert away.min() > 0.05 * home
    assert_not_faster(values, constraints, q, box)
    assert motion.usage.loops < 1.0 and motion.quality.condition < motion.random[0]
    assert np.all(q <= box.upper) and np.all(q >= box.lower)
    if name == "five-bar":  # its limits alone would lead it through a singular posture
        rng = np.random.default_rng(0)
        corners = box.mid_range + box.half_range * rng.uniform(-0.95, 0.95, (200, len(box.lower)))
        assert np.count_nonzero(compiled.closing_status(corners))


def test_the_same_seed_gives_the_same_motion_and_another_one_another():
    compiled, bounds = limits_of("two-link")
    wishes = [MotionRequest(4.0, 3, starts=1, seed=seed) for seed in (3, 3, 4)]
    one, again, other = (design_motion(compiled, bounds, wish) for wish in wishes)
    assert np.array_equal(one.x, again.x) and one.to_json() == again.to_json()
    assert not np.allclose(one.x, other.x, atol=1e-3)


def test_the_objectives_do_what_they_are_called():
    compiled, bounds = limits_of("scara")
    table = {
        name: design_motion(compiled, bounds, MotionRequest(6.0, 4, name, 1)).quality
        for name in ("both", "condition", "information")
    }
    assert table["condition"].condition <= table["both"].condition < table["information"].condition
    assert table["information"].log_det >= table["both"].log_det > table["condition"].log_det


def test_a_noisy_joint_counts_less():
    """Weighted rows: of a joint with tenfold noise the information is a hundredth."""
    emitted, bounds = limits_of("two-link")
    sigma = np.array([1.0, 10.0])
    task = build_task(emitted, bounds, MotionRequest(4.0, 3), sigma, None, None)
    x = draw_random_motion(task, np.random.default_rng(0))
    W = emitted.observation(*task.series.evaluate_motion(x)).reshape(-1, 2, len(emitted.spec.base))
    weighted = (W / sigma[:, None]).reshape(-1, W.shape[2])
    assert np.allclose(task.compute_rows(task.series.evaluate_motion(x)), weighted)


def heavy_arm(first, second):
    """An arm that hangs, whose weight and friction come near these limits of torque."""
    hanging = replace_gravity(read_builtin_robot("two-link"), [-9.81, 0.0, 0.0])
    subject = build_subject(parse_robot_text(hanging, "arm"))
    limits = {"1": (-2.5, 2.5, 4, 20, first), "2": (-2.5, 2.5, 5, 30, second)}
    return subject, build_bounds(subject.robot, subject.compiled, limits, {})


@pytest.mark.parametrize(("first", "second"), [(1.67, 0.86), *rotating((16, 4))])
def test_wider_torques_are_never_refused_and_the_narrowest_hold_at_all_times(first, second):
    subject, bounds = heavy_arm(first, second)
    wish = MotionRequest(6.0, 4, starts=1, seed=1, time_limit=0.4)
    motion = subject.search_motion(bounds, wish)
    compiled, (q, qd, qdd) = subject.compiled, finely(motion)
    loads = np.abs(compiled.inverse_dynamics(q, qd, qdd, subject.beta)).max(axis=0)
    assert np.all(loads <= bounds.torque) and np.isfinite(motion.quality.condition)
    assert np.all(np.abs(qd) <= bounds.speed) and np.all(np.abs(qdd) <= bounds.acceleration)


def test_torques_below_dry_friction_are_refused_in_a_line():
    subject, bounds = heavy_arm(5.0, 0.79)
    with pytest.raises(DataError, match=r"no posture was found .*; q1 = .* times what they allow"):
        subject.search_motion(bounds, MotionRequest(6.0, 4))


@pytest.mark.parametrize("steps", [900, *rotating(1)])
def test_every_loop_asks_for_the_time(monkeypatch, steps):
    """A clock that a look at the columns moves on: what comes after the limit is bounded."""
    subject, bounds = heavy_arm(4.0, 1.0)
    clock = [0.0]
    for name in ("evaluate_exact", "evaluate_smooth"):
        whole = getattr(MotionColumns, name)

        def counted(self, *args, whole=whole):
            clock[0] += 1.0
            return whole(self, *args)

        monkeypatch.setattr(MotionColumns, name, counted)
    monkeypatch.setattr("modeler.excitation.search.time.monotonic", lambda: clock[0])
    before = clock[0]
    motion = subject.search_motion(bounds, MotionRequest(6.0, 4, seed=1, time_limit=before + steps))
    assert motion.has_ended_early and clock[0] < before + steps + 700
    assert (motion.random_count == 1) == (steps == 1)
