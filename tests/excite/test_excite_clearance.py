"""Links that must not meet: distances beside coal's, motions that keep them at all times."""

import dataclasses
import json

import coal
import numpy as np
import pytest

from modeler import excitation
from modeler.api import check_motion
from modeler.api.motion_bounds import build_bounds
from modeler.cli import main
from modeler.core.errors import DataError, RobotError
from modeler.excitation.limits import build_posture_limits
from modeler.robot import parse_robot_text, read_robot
from modeler.views.robot_skeleton import build_skeleton, compute_poses
from tests.chain import chain_of
from tests.excite.robots_to_excite import robot as built_in
from tests.rotation import with_cases

CAPSULES = {
    "0": (0.1, (0, 0, -0.5), (0, 0, -0.05)),
    "1": (0.09, (0, 0, -0.05), (0, 0, 0.05)),
    "2": (0.05, (0, 0, 0), (0.4, 0, 0)),
    "3": (0.06, (0.1, 0, 0), (0.42, 0, 0)),
}
FLOOR = (0.0, 0.0, 2.0, -1.0)


def arm_text() -> str:
    """The demonstration arm over a floor."""
    rows = [[row, radius, *one, *other] for row, (radius, one, other) in CAPSULES.items()]
    head = '"row", "radius", "x0", "y0", "z0", "x1", "y1", "z1"'
    return read_robot("demo-arm").text + (
        f"\n[capsules]\ncolumns = [{head}]\nrows = {json.dumps(rows)}\n"
        f"planes = {{floor = {list(FLOOR)}}}\n"
    )


@pytest.fixture(scope="module")
def arm():
    robot = parse_robot_text(arm_text(), "arm.toml")
    compiled = chain_of(robot).compiled
    return robot, compiled, build_bounds(robot, compiled, {}, {})


def coal_distance(one, other, a, b) -> float:
    """Of two capsules: (2, 3) ends each, a and b their radii."""

    def shape(ends, radius):
        way = ends[1] - ends[0]
        z = way / np.linalg.norm(way)
        x = np.linalg.svd(z[None, :])[2][1]
        R = np.column_stack([x, np.cross(z, x), z])
        made = coal.Capsule(radius, float(np.linalg.norm(way)))
        return made, coal.Transform3s(R, ends.mean(axis=0))

    result = coal.DistanceResult()
    return coal.distance(*shape(one, a), *shape(other, b), coal.DistanceRequest(), result)


def oracle(robot, q) -> dict[tuple[str, str], float]:
    """By pair, at one posture: the table's numbers for the frames, coal for the distances."""
    frames = compute_poses(build_skeleton(robot), q)
    placed = {}
    for row, (radius, *ends) in CAPSULES.items():
        T = np.eye(4) if row == "0" else frames[int(row) - 1]
        placed["base" if row == "0" else row] = (np.array(ends) @ T[:3, :3].T + T[:3, 3], radius)
    table = {}
    for i, (a, (one, r)) in enumerate(placed.items()):
        for b, (other, s) in list(placed.items())[i + 1 :]:
            table[a, b] = coal_distance(one, other, r, s)
        table[a, "floor"] = one[:, 2].min() - FLOOR[3] / FLOOR[2] - r
    return table


def test_distances_are_coals_for_capsules_that_cross_touch_and_are_parallel():
    rng = np.random.default_rng()
    ends = rng.normal(size=(60, 2, 2, 3))
    ends[:10, 1] = ends[:10, 0] + [0.0, 0.0, 1.3]  # parallel
    ends[10:20, 1, 0] = ends[10:20, 0].mean(axis=1)  # they touch
    radius = np.array([0.05, 0.08])
    solids = excitation.CollisionGeometry(
        ("1", "2"),
        np.zeros(2, dtype=int),
        ends[0],
        radius,
        np.zeros((0, 3)),
        np.zeros(0),
        np.array([[0, 1]]),
    )
    value, points = solids.compute_distances(ends)
    lines = [coal_distance(a, b, *radius) for a, b in ends]
    apart = value[:, 0] > 0  # coal shows the depth of a penetration by other rules
    assert apart.sum() > 30 and np.allclose(value[apart, 0], np.array(lines)[apart], atol=1e-6)
    assert np.all(np.array(lines)[~apart] < 1e-6)
    between = np.linalg.norm(points[:, 0, 0] - points[:, 0, 1], axis=1)
    assert np.allclose(between - radius.sum(), value[:, 0])


def test_pairs_that_share_a_joint_or_always_touch_are_left_out_and_told(arm):
    _, _, bounds = arm
    pairs = [
        set(bounds.clearance.solids.get_pair_names(k))
        for k in range(len(bounds.clearance.solids.pairs))
    ]
    lines = [{"base", "3"}, {"1", "3"}, {"1", "floor"}, {"2", "floor"}, {"3", "floor"}]
    assert sorted(map(sorted, pairs)) == sorted(map(sorted, lines))
    out = {frozenset(pair[:2]): pair[2] for pair in bounds.clearance.excluded_pairs}
    assert out[frozenset({"base", "2"})] == "in 100 % of postures"


def test_the_slope_of_distances_is_their_derivative(arm):
    _, compiled, bounds = arm
    limits, rng = build_posture_limits(compiled, bounds), np.random.default_rng()
    q = bounds.mid_range + bounds.half_range * rng.uniform(-0.8, 0.8, (40, 3))
    q = q[limits.compute_shares(q).max(axis=1) < 1.0]
    pull = rng.normal(size=limits.compute_shares(q).shape)
    values, h = limits.pull_back_gradient(q, pull), 1e-6
    for j, way in enumerate(h * np.eye(3)):
        text = ((limits.compute_shares(q + way) - limits.compute_shares(q - way)) * pull).sum(
            axis=1
        ) / (2 * h)
        assert np.allclose(values[:, j], text, rtol=1e-3, atol=1e-5)


@pytest.mark.rotating("long tests of excite")
@pytest.mark.parametrize(
    "family",
    ["fourier", *(pytest.param(f, marks=pytest.mark.rotating) for f in ("bspline", "trapezoid"))],
)
def test_a_motion_keeps_links_apart_at_all_times_and_costs_little(arm, family, tmp_path):
    robot, compiled, bounds = arm
    path = excitation.design_motion(
        compiled, bounds, excitation.MotionRequest(6.0, 3, "condition", 1, family=family)
    )
    fine = path.series.resample_at(np.linspace(0.0, 6.0, 201)).evaluate_motion(path.x)[0]
    seen = [oracle(robot, q) for q in fine]
    rest = {
        bounds.clearance.solids.get_pair_names(k) for k in range(len(bounds.clearance.solids.pairs))
    }
    least = min(each[pair] for each in seen for pair in rest)
    assert 0.01 <= path.closest_approach.bound <= least + 1e-9
    assert path.closest_approach.bound > path.closest_approach.distance - 2e-4
    assert path.closest_approach.distance - 2e-4 < least < path.closest_approach.distance + 0.01
    at = oracle(robot, np.array(list(path.closest_approach.posture.values())))
    assert at[path.closest_approach.pair] == pytest.approx(path.closest_approach.distance, abs=1e-6)
    assert path.quality.condition < path.random[0]
    place = tmp_path / "m.csv"
    place.write_text(excitation.format_csv(path.sample_motion(200.0)))
    result = check_motion(robot, place)
    assert result.pair == path.closest_approach.pair
    assert result.distance == pytest.approx(path.closest_approach.distance, abs=2e-5)


def test_what_comes_near_between_samples_is_seen(arm):
    """A dip of the elbow that lasts a two hundredth of the motion, anywhere."""
    _, compiled, bounds = arm
    solids, rng = bounds.clearance.solids, np.random.default_rng()
    for _ in range(5):
        at, deep = rng.uniform(1.0, 9.0), rng.uniform(0.3, 0.6)

        def path(t, at=at, deep=deep):
            q = np.tile([0.0, 0.1, 0.4], (len(t), 1))
            q[:, 1] -= deep * np.exp(-(((t - at) / 0.03) ** 2)) + 0.1 * np.sin(t)
            return q

        near = excitation.find_closest_approach(compiled, solids, path, 10.0)
        close = at + np.linspace(-0.1, 0.1, 4001)
        ends = solids.place_capsules(compiled.forward_kinematics(path(close)))
        least = solids.compute_distances(ends)[0].min()
        assert near.bound <= least + 1e-9 and near.distance <= least + 1e-3


def test_the_command_checks_a_motion_and_draws_the_nearest_two(arm, tmp_path, capsys):
    (tmp_path / "arm.toml").write_text(arm_text())
    t = np.linspace(0.0, np.pi, 401)
    columns = {"time": t} | {f"q{j}": 0.0 * t for j in "123"}
    columns["q3"] = 1.5 + 0.9 * np.sin(t) ** 2  # the forearm folds back to the column
    columns["q2"] = 0.2 + 0.2 * np.sin(t) ** 2
    place, page = tmp_path / "fold.csv", tmp_path / "fold.html"
    place.write_text(excitation.format_csv(columns))
    words = ["excite", str(tmp_path / "arm.toml"), "--check", str(place)]
    assert main([*words, "--report", str(page), "--clearance", "0.3"]) == 1
    out, err = capsys.readouterr()
    assert "nearest are" in out and err.count("\n") == 1
    assert "expected 300 mm or more" in err and "fold.csv" in err
    text = page.read_text()
    assert text.count('"layer":"capsules"') + text.count('"layer": "capsules"') > 200
    assert "mm apart at" in text
    assert main([*words, "--clearance", "0", "--json", str(tmp_path / "c.json")]) == 0
    message = json.loads((tmp_path / "c.json").read_text())["clearance"]
    near = check_motion(arm[0], place, clearance=0.0)
    assert message["margin"] == 0
    assert message["closest_approach"]["distance"] == pytest.approx(near.distance)


@pytest.mark.rotating("long tests of excite")
def test_loops_are_kept_clear_too():
    result, compiled = built_in("five-bar")
    bounds = build_bounds(result, compiled, {}, {}, 0.02)
    motion = excitation.design_motion(
        compiled, bounds, excitation.MotionRequest(6.0, 3, starts=1, time_limit=0.3)
    )
    assert motion.closest_approach.bound >= 0.02
    assert len(motion.closest_approach.posture) > len(bounds.joints)


@with_cases(
    "text, message",
    ('columns = ["row"]\nrows = []', "row, radius and any of x0"),
    ('columns = ["row", "radius"]\nrows = [["9", 0.1]]', "the name of a row"),
    ('columns = ["row", "radius"]\nrows = [["1", 0]]', "a length above 0"),
    ('columns = ["row", "radius"]\nrows = [["1", 0.1, 2]]', "2"),
    ("planes = {floor = [0, 0, 0, 1]}", "the normal (0, 0, 0)"),
    ("planes = {floor = [0, 0, 1]}", "[x, y, z, offset]"),
    ("radius = 3", "radius"),
)
def test_one_line_for_capsules_that_cannot_be(text, message):
    with pytest.raises(RobotError) as caught:
        parse_robot_text(f"{read_robot('demo-arm').text}\n[capsules]\n{text}\n", "a.toml")
    assert message in str(caught.value) and "\n" not in str(caught.value)


def test_a_margin_that_leaves_no_room_is_refused(arm):
    _, compiled, bounds = arm
    far = dataclasses.replace(bounds, clearance=dataclasses.replace(bounds.clearance, margin=0.8))
    with pytest.raises(DataError, match="no posture was found"):
        excitation.design_motion(compiled, far, excitation.MotionRequest(4.0, 3, starts=1))
