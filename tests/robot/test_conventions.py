"""Tables of Craig and of Denavit and Hartenberg are the robots that their books mean."""

import math
import re

import numpy as np
import pytest

from modeler.core.errors import DataError, RobotError
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import evaluate_regressor
from modeler.robot.read import parse_robot_text, read_robot
from tests.elementary_motions import frames, shift, turn
from tests.robot.texts import check_mistake
from tests.rotation import with_cases

pin = pytest.importorskip("pinocchio", reason="Pinocchio (PyPI: pin) is not installed")


def file(convention, columns, rows, more="", gravity='[0.7, -1.1, "-9.81"]'):
    cells = "\n".join(f"  [{', '.join(map(cell, row))}]," for row in rows)
    names = ", ".join(f'"{column}"' for column in columns)
    return (
        f'name = "arm"\ngravity = {gravity}\n[mdh]\nconvention = "{convention}"\n'
        f"columns = [{names}]\nrows = [\n{cells}\n]\n{more}"
    )


def cell(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


# Random serial robots: classical tables against Pinocchio, and back from Khalil's.


def random_angle(rng):
    if rng.random() < 0.6:
        return f"{rng.integers(-11, 12)}*pi/12"
    value = rng.uniform(-3, 3)
    while abs(value / (math.pi / 12) - round(value / (math.pi / 12))) < 0.02:  # would be rounded
        value = rng.uniform(-3, 3)
    return float(f"{value:.3f}") if rng.random() < 0.5 else f"{math.degrees(value):.2f} deg"


def random_length(rng):
    return 0 if rng.random() < 0.4 else float(f"{rng.uniform(-0.8, 0.8):.3f}")


def random_table(rng, count):
    """[sigma, theta, d, a, alpha] of each joint, its variable in theta or d."""
    table = []
    for j in range(1, count + 1):
        theta, d, sigma = random_angle(rng), random_length(rng), int(rng.random() < 0.3)
        sign = "-" if rng.random() < 0.3 else ""
        if sigma:
            d = f"{sign}q{j} + {d}"
        else:
            theta = f"{sign}q{j} + {theta}"
        table.append([sigma, theta, d, random_length(rng), random_angle(rng)])
    return table


def number(written, values=None):
    """A cell without anything of ours: degrees, pi and q<j>."""
    text = re.sub(r"([\d.]+) deg", r"(\1*pi/180)", str(written))
    return float(eval(text, {"pi": math.pi, **(values or {})}))


def classical_steps(table, q):
    """Frame j of the book in frame j - 1, and the part of it behind the axis of joint j."""
    values = {f"q{j}": x for j, x in enumerate(q, 1)}
    for _, theta, d, a, alpha in table:
        behind = shift(0, number(a)) @ turn(0, number(alpha))
        yield turn(2, number(theta, values)) @ shift(2, number(d, values)) @ behind, behind


def pinocchio_of(table, bodies, gravity):
    """The robot of a classical table, bodies given at the frames of the book."""
    model, parent, before = pin.Model(), 0, np.eye(4)
    model.gravity.linear = np.array(gravity)
    steps = classical_steps(table, np.zeros(len(table)))
    for j, ((sigma, theta, d, *_), (step, _), body) in enumerate(
        zip(table, steps, bodies, strict=True), 1
    ):
        sign = -1.0 if str(d if sigma else theta).startswith("-q") else 1.0
        kind = pin.JointModelPrismaticUnaligned if sigma else pin.JointModelRevoluteUnaligned
        parent = model.addJoint(parent, kind(np.array([0.0, 0.0, sign])), pin.SE3(before), f"{j}")
        model.appendBodyToJoint(parent, pin.Inertia(*body), pin.SE3(step))
        before = step
    return model, model.createData()


def random_body(rng):
    """Mass, centre, inertia about the centre."""
    half = rng.normal(size=(3, 3))
    return float(rng.uniform(0.5, 3)), rng.uniform(-0.3, 0.3, 3), half @ half.T * 0.02


def ten_at(pose, body):
    """The ten parameters at the origin and along the axes that see the body's frame at `pose`."""
    mass, centre, inertia = body
    c = pose[:3, :3] @ centre + pose[:3, 3]
    about = pose[:3, :3] @ inertia @ pose[:3, :3].T + mass * (c @ c * np.eye(3) - np.outer(c, c))
    return [*about[np.triu_indices(3)], *(mass * c), mass]


def torques(model, chi, q, qd, qdd):
    return (evaluate_regressor(model, (q, qd, qdd)) @ chi).reshape(q.shape)


def parts(count):
    """Share 0 always, the others in turn."""
    others = (pytest.param(k, marks=pytest.mark.rotating) for k in range(1, count))
    return pytest.mark.parametrize("part", [0, *others])


@parts(8)
def test_classical_tables_move_and_weigh_as_their_book_says(part):
    """Positions, torques, gravity and kinetic energy of 64 robots, by Pinocchio."""
    rng = np.random.default_rng([560, part])
    gravity = [0.7, -1.1, -9.81]
    for _ in range(8):
        table = random_table(rng, int(rng.integers(1, 5)))
        n = len(table)
        columns = ["j", "sigma", "theta", "d", "a", "alpha"]
        robot = parse_robot_text(
            file("classical", columns, [[f"{j}", *row] for j, row in enumerate(table, 1)]), "arm"
        )
        bodies = [random_body(rng) for _ in table]
        theirs, data = pinocchio_of(table, bodies, gravity)
        q, qd, qdd = rng.normal(size=(3, 3, n))
        for at in q:
            pose = np.eye(4)
            for step, _ in classical_steps(table, at):
                pose = pose @ step
            np.testing.assert_allclose(frames(robot, at)[robot.joints[-1].name], pose, atol=1e-12)
        model = derive_model(robot)
        behind = [part for _, part in classical_steps(table, np.zeros(n))]
        chi = np.concatenate([ten_at(*pair) for pair in zip(behind, bodies, strict=True)])
        still = np.zeros_like(q)
        ours = torques(model, chi, q, qd, qdd)
        weight = torques(model, chi, q, still, still)
        ways = [torques(model, chi, q, still, still + e) - weight for e in np.eye(n)]
        inertia = np.stack(ways, axis=2)
        for k in range(len(q)):
            tau = pin.rnea(theirs, data, q[k], qd[k], qdd[k])
            scale = np.abs(tau).max() + 1.0
            np.testing.assert_allclose(ours[k], tau, atol=1e-12 * scale)
            down = pin.computeGeneralizedGravity(theirs, data, q[k])
            np.testing.assert_allclose(weight[k], down, atol=1e-12 * scale)
            energy = pin.computeKineticEnergy(theirs, data, q[k], qd[k])
            assert qd[k] @ inertia[k] @ qd[k] / 2 == pytest.approx(energy, rel=1e-11)


@parts(6)
def test_tables_of_khalil_come_back_from_craig_and_classical(part):
    """Written in the other notations by the test, 60 robots are the same joint by joint."""
    rng = np.random.default_rng([2002, part])
    for _ in range(10):
        table = random_table(rng, int(rng.integers(1, 6)))
        rows = [[f"{j}", s, al, a, th, d] for j, (s, th, d, a, al) in enumerate(table, 1)]
        names = ["j", "sigma", "alpha", "d", "theta", "r"]
        khalil = parse_robot_text(file("khalil", names, rows), "khalil")
        names, order = ["j", "sigma", "alpha", "a", "theta", "d"], rng.permutation(6)
        columns, rows = [names[i] for i in order], [[row[i] for i in order] for row in rows]
        assert parse_robot_text(file("craig", columns, rows), "craig").joints == khalil.joints
        # Classical: what stands before the first joint is a fixed row of its own.
        steps = [["base", 2, 0, 0, *table[0][3:]]]
        for j, (sigma, theta, d, *_) in enumerate(table, 1):
            after = table[j][3:] if j < len(table) else [0, 0]
            steps.append([f"{j}", sigma, theta, d, *after])
        names = ["j", "sigma", "theta", "d", "a", "alpha"]
        classical = parse_robot_text(file("classical", names, steps), "classical")
        q = rng.normal(size=len(table))
        ours, theirs = frames(classical, q), frames(khalil, q)
        for joint, other in zip(classical.moving_joints, khalil.moving_joints, strict=True):
            assert (joint.name, joint.kind) == (other.name, other.kind)
            np.testing.assert_allclose(ours[joint.name], theirs[joint.name], atol=1e-12)


# PUMA 560 from four books.


A2, A3, D3, D4, RIGHT = 0.4318, 0.0203, 0.1501, 0.4331, math.pi / 2

# Convention; the positions at which each stands as Craig's at 0, the axes the same way, found on
# paper; alpha, a, d of every row, or d, a, alpha of a classical one.
BOOKS = {
    "khalil": ("khalil", [0, 0, math.pi, 0, 0, math.pi],
               [[0, 0, 0], ["-pi/2", 0, 0], [0, A2, D3], ["pi/2", -A3, D4], ["-pi/2", 0, 0],
                ["pi/2", 0, 0]]),
    # Craig, Introduction to Robotics, 2nd ed., figure 3.21, in degrees as there
    "craig": ("craig", [0] * 6,
              [[0, 0, 0], ["-90 deg", 0, 0], [0, A2, D3], ["-90 deg", A3, D4], ["90 deg", 0, 0],
               ["-90 deg", 0, 0]]),
    # Corke, Robotics toolbox, puma560; the floor is 0.672 m below
    "corke": ("classical", [math.pi, math.pi, 0, 0, 0, 0],
              [[0.672, 0, "pi/2"], [0, A2, 0], [D3, A3, "-pi/2"], [D4, 0, "pi/2"],
               [0, 0, "-pi/2"], [0, 0, 0]]),
    # Fu, Gonzalez, Lee, Robotics, 1987, figure 2.11; 1.5708 as lecture notes have it
    "lee": ("classical", [0, 0, math.pi, 0, 0, 0],
            [[0, 0, -1.5708], [D3, A2, 0], [0, -A3, 1.5708], [D4, 0, -1.5708], [0, 0, 1.5708],
             [0.05625, 0, 0]]),
}  # fmt: skip


def robot_of(book):
    convention, _, rows = BOOKS[book]
    if convention == "khalil":
        robot = read_robot("puma560")
        values = {"g": 9.81, "D3": A2, "R3": D3, "D4": -A3, "R4": D4}
        assert robot.evaluate_symbols() | {"D4": -A3} == pytest.approx(values)
        return robot
    names = ["j", "alpha", "a", "d", "theta"]
    ways = [[*row, f"q{k}"] for k, row in enumerate(rows, 1)]
    if convention == "classical":
        names, ways = ["j", "theta", "d", "a", "alpha"], [[x, *row] for *row, x in ways]
    table = [[f"{k}", *way] for k, way in enumerate(ways, 1)]
    return parse_robot_text(file(convention, names, table, gravity="[0, 0, -9.81]"), book)


def link_frames(book, q):
    """Where the inertial parameters of each link stand: behind Rz(theta) Tz(d) of its joint."""
    convention, _, rows = BOOKS[book]
    pose, poses = shift(2, -0.672) if book == "corke" else np.eye(4), []
    for row, x in zip(rows, q, strict=True):
        first, a, last = map(number, row)
        if convention != "classical":
            pose = pose @ turn(0, first) @ shift(0, a) @ turn(2, x) @ shift(2, last)
            poses.append(pose)
        else:
            pose = pose @ turn(2, x) @ shift(2, first)
            poses.append(pose)
            pose = pose @ shift(0, a) @ turn(0, round(last / RIGHT) * RIGHT)
    return poses


def test_puma_of_four_books_has_the_same_torques():
    rng = np.random.default_rng(1986)
    bodies = [random_body(rng) for _ in range(6)]  # in the shoulder's frame, all at Craig's 0
    q, qd, qdd = rng.normal(size=(3, 10, 6))
    taus = {}
    for book, (_, zero, _) in BOOKS.items():
        frames_and_bodies = zip(link_frames(book, zero), bodies, strict=True)
        chi = np.concatenate([ten_at(np.linalg.inv(one), body) for one, body in frames_and_bodies])
        taus[book] = torques(derive_model(robot_of(book)), chi, q + zero, qd, qdd)
    for book, tau in taus.items():
        np.testing.assert_allclose(tau, taus["craig"], atol=1e-11 * np.abs(tau).max(), err_msg=book)
    # A sign or offset forgotten would be seen.
    shifted = link_frames("corke", [0, math.pi, 0, 0, 0, 0])
    assert not np.allclose(shifted[2], link_frames("craig", [0] * 6)[2])


# What is not as it must be said is reported, with the line to write.

HEAD = 'name = "arm"\ngravity = [0, 0, -9.81]\n[symbols]\nA2 = 0.4\nAL = 1.57\n'
FLAT = 'columns = ["j", "theta", "d"]\nrows = [["1", "q1", 0.1], ["2", "q2", 0]]\n'


def read(mdh, more="", head=""):
    return parse_robot_text(f"{head}{HEAD}[mdh]\n{mdh}\n{more}", "arm.toml")


@pytest.mark.parametrize(
    ("mdh", "text"),
    [
        # Craig's table in the place of Khalil's: lengths where antecedents stand
        ('columns = ["j","a","alpha","d","theta"]\nrows = [["1",0,0,0,"q1"], ["2",0.43,0,0,"q2"]]',
         'row "2", column a: got 0.43 .. write convention = "craig" .. or convention = "clas'),
        ('columns = ["j","a","d","theta"]\nrows = [["1","0",0,"q1"], ["2","A2",0,"q2"]]',
         'row "2", column a: got "A2" .. write convention = "craig"'),
        ('columns = ["j","parent","theta"]\nrows = [["1","0","q1"]]',
         '"parent" .. Write convention = "craig"'),
        # a wrist, whose lengths are 0: not three joints on the base
        ('columns = ["j","a","alpha","d","theta"]\n'
         'rows = [["1",0,0,0,"q1"], ["2",0,"pi/2",0,"q2"]]',
         'columns: got a, alpha, d, theta .. reads like another notation .. "craig"'),
        # a classical one
        ('columns = ["j","theta","d","a","alpha"]\n'
         'rows = [["1","q1",0,0,"pi/2"], ["2","q2",0,"A2",0]]',
         'columns: got theta, d, a, alpha .. a is a length .. convention = "classical" .. "craig"'),
        ('columns = ["j","theta","d","alpha"]\nrows = [["1","q1",0.1,"pi/2"], ["2","q2",0.2,0]]',
         'd is along z .. write convention = "classical"'),
        ('columns = ["j","a","alpha","d","theta"]\nrows = [["1",0.2,0,0,"q1"], ["2",0,0,0,"q2"]]',
         'row "1", column a: got 0.2 .. write convention = "classical"'),
        ('columns = ["j","sigma","theta","d"]\nrows = [["1",0,"q1",0], ["2",1,0,"q2"]]',
         'belongs into column r .. convention = "craig"'),
        # Khalil's under another name
        ('convention = "craig"\ncolumns = ["j","a","d","theta"]\n'
         'rows = [["1","0",0,"q1"], ["2","1",0,"q2"]]',
         'column a: got 0, 1 .. write convention = "khalil"'),
        ('convention = "craig"\ncolumns = ["j","theta","r"]\nrows = [["1","q1",0]]',
         '"r" .. r of Khalil is d in this table'),
        ('convention = "classical"\ncolumns = ["j","parent","theta"]\nrows = [["1","0","q1"]]',
         '"parent" .. serial robot .. "khalil" or "craig"'),
        ('convention = "classic"\n' + FLAT, 'got "classic" .. did you mean "classical"'),
        # places in the letters of the table
        ('convention = "craig"\ncolumns = ["j","sigma","theta","d","a"]\n'
         'rows = [["1",0,"q1",0,0], ["2",1,0,0,"q2"]]',
         'row "2", column a .. belongs into column d'),
        ('convention = "craig"\ncolumns = ["j","parent","theta"]\n'
         'rows = [["1","0","q1"], ["2","7","q2"]]', 'row "2", column parent .. got "7"'),
    ],
)  # fmt: skip
def test_a_table_of_another_convention_is_told_with_the_line_to_write(mdh, text):
    check_mistake(HEAD + "[mdh]\n", "[mdh]\n", f"[mdh]\n{mdh}\n", f"[mdh] .. {text}")


@with_cases(
    "key, more, head",
    ("loops", "[loops]\nrows = []", ""),
    ("platform", '[platform]\nname = "P"\nmotion = "planar"', ""),
    ("legs", "", 'legs = ["1"]\n'),
)
def test_a_classical_table_is_of_a_serial_robot(key, more, head):
    assert read('convention = "classical"\n' + FLAT).convention == "classical"
    with pytest.raises(RobotError, match=rf'"classical", and the file has \W?{key}.*serial'):
        read('convention = "classical"\n' + FLAT, more, head)


def test_khalil_where_it_is_said_has_any_order():
    mdh = 'columns = ["j", "theta", "d", "alpha"]\nrows = [["1", "q1", 0.1, "pi/2"]]'
    assert read('convention = "khalil"\n' + mdh).joints[0].d.text == "0.1"
    named = '["j", "alpha", "a", "d", "theta"]\nrows = [["1", 0, "0", 0, "q1"], ["2", 0, "1", 0, '
    assert read(f'columns = {named}"q2"]]').joints[1].antecedent == "1"


def test_greek_letters_of_a_book_are_columns():
    rows = '[["1", 0, "pi/2", "q1"], ["2", 2, 0.4, 0]]'
    robot = read(f'columns = ["j", "σ", "α", "θ"]\nrows = {rows}')
    assert robot.joints == read(f'columns = ["j", "sigma", "alpha", "theta"]\nrows = {rows}').joints


def test_branches_of_craig_name_their_parents():
    robot = read(
        'convention = "craig"\ncolumns = ["j", "parent", "a", "theta"]\n'
        'rows = [["1", "0", 0, "q1"], ["2", "1", "A2", "q2"], ["3", "1", "-A2", "q3"]]'
    )
    assert [joint.antecedent for joint in robot.joints] == ["0", "1", "1"]
    assert robot.joints[2].d.text == "-A2"


@pytest.mark.parametrize("convention", ["khalil", "craig", "classical"])
def test_the_table_is_shown_and_kept_in_its_letters(convention, tmp_path):
    """What is printed, typed in again, is the same robot; edited files stay in their convention."""
    from modeler.robot.edit import replace_effects, replace_parameters
    from modeler.views.derivation import _tabulate_dh_rows
    from modeler.views.robot_page import build_table_head, build_table_rows

    lengths = ("d", "r") if convention == "khalil" else ("a", "d")
    columns = ["j", "sigma", "alpha", lengths[0], "theta", lengths[1]]
    rows = [
        ["1", 0, "pi/2", 0, "q1", 0.5],
        ["2", 1, 0.4, 0.31, 0, "q2 - 0.1"],
        ["3", 0, 0, 0.25, "-q3 + pi/4", 0],
    ]
    robot = parse_robot_text(file(convention, columns, rows), "arm")
    result = _tabulate_dh_rows(robot)
    head = [name for name, _ in result.columns]
    again = file(convention, head, [list(row) for row in result.rows])
    assert parse_robot_text(again, "again").joints[:3] == robot.joints[:3]
    assert ("parent" in head) == (convention == "craig")
    assert build_table_head(robot)[-1] == "q"
    assert len(build_table_rows(robot)[0].entries) == len(head) - (
        3 if convention == "classical" else 4
    )
    text = replace_parameters(replace_effects(robot.text, {"viscous": "all"}), {"Fv1": 2.0})
    edited = parse_robot_text(text, "edited")
    assert edited.joints == robot.joints
    assert edited.convention == convention


# Angles.


@with_cases(
    "written, radians",
    ("90 deg", math.pi / 2),
    ("-90deg", -math.pi / 2),
    ("37.5°", math.radians(37.5)),
    ("pi/2 - 30 deg", math.pi / 3),
    ("(10 + 20) deg", math.pi / 6),
    ("1e1 deg", math.pi / 18),
    ("\u221230\u00b0", -math.pi / 6),
    ("2\u00b7\u03c0/3", 2 * math.pi / 3),
    ("2*A2 deg", math.radians(0.8)),
    (".5 deg", math.radians(0.5)),
)
def test_degrees_stand_wherever_angles_do(written, radians):
    rows = f'rows = [["1", "{written}", "q1 - ({written})"]]'
    more = (
        f'[limits]\n1 = ["-170 deg", "{written} + 180 deg", "90 deg", 8]\n'
        f'[home]\nq1 = "{written}"\n'
    )
    robot = read(f'columns = ["j", "alpha", "theta"]\n{rows}', more)
    values = robot.evaluate_symbols()
    assert robot.joints[0].alpha.evaluate(values) == pytest.approx(radians, abs=1e-15)
    assert robot.joints[0].theta.evaluate({**values, "q1": 0.0}) == pytest.approx(-radians)
    assert robot.limits["1"].upper == pytest.approx(radians + math.pi)
    assert robot.limits["1"].speed == pytest.approx(math.pi / 2)
    assert robot.home["1"] == pytest.approx(radians)
    assert not robot.readings


@pytest.mark.parametrize("written", ["deg", "90 degrees", "1 + deg", "90 de"])
def test_what_is_no_degree_is_told(written):
    with pytest.raises(RobotError, match=r"cannot be read|not declared"):
        read(f'columns = ["j", "alpha", "theta"]\nrows = [["1", "{written}", "q1"]]')


@with_cases(
    "written, text, message",
    ("1.5708", "pi/2", "1.5708 is pi/2"),
    ("-1.57", "-pi/2", "-1.57 is -pi/2"),
    ('"q1 - 1.5708"', "q1 - pi/2", "1.5708 is pi/2"),
    ('"3.1416/2"', "pi/2", "3.1416 is pi"),
    ('"4.7124 - q1"', "3*pi/2 - q1", "4.7124 is 3*pi/2"),
    ('"AL"', "AL", ""),
    ('"A2 + 3.1416"', "A2 + pi", "3.1416 is pi"),
    ("1.5608", "1.5608", ""),
    ("1.5", "1.5", ""),
    ("1.5707963265", "pi/2", ""),
    ('"2*0.7853981633974483"', "pi/2", ""),
    ("1e-17", "0", ""),
    ('"0.25*pi"', "0.25*pi", ""),
    ('"q1 + 1.5707963267948966"', "q1 + pi/2", ""),
    ('"1.5707963267948966 - q1"', "-q1 + pi/2", ""),
    ('"q1 + 1e-12"', "q1", ""),
    ('"-q1 - 3.141592653589793"', "-q1 - pi", ""),
)
def test_a_rounded_angle_is_exact_and_told(written, text, message):
    """But for one that is declared, as a measured one is; what is exact already needs no word."""
    moves = "q1" in written
    cells = f"0, {written}" if moves else f'{written}, "q1"'
    robot = read(f'columns = ["j", "alpha", "theta"]\nrows = [["1", {cells}]]')
    joint = robot.joints[0]
    assert (joint.theta if moves else joint.alpha).text == text
    assert message in "".join(robot.readings) and bool(message) == bool(robot.readings)


def test_a_rounded_angle_of_a_relation_is_exact_too():
    mdh = 'columns = ["j", "theta"]\nrows = [["1", "q1"], ["2", "1.5708 - q1"]]'
    robot = read(mdh)
    assert robot.relations["2"].text == "pi/2 - q1"
    assert "1.5708 is pi/2" in robot.readings[0]


def test_degrees_of_effects_and_of_words_on_the_command_line():
    from modeler.api.motion_bounds import parse_assignments

    robot = read(
        'columns = ["j", "theta"]\nrows = [["1", "q1"]]',
        '[effects]\nspring = [{joint = "1", q0 = "30 deg", h = 0}]',
    )
    assert robot.effects[0].stated_instances[0].nonlinear_parameters["q0"] == pytest.approx(
        math.pi / 6
    )
    values = parse_assignments("limits", ["1=-90 deg,pi/2,2,8"], ["1"], (4, 5), "LOWER,...")
    assert values == {"1": [-math.pi / 2, math.pi / 2, 2.0, 8.0]}
    with pytest.raises(DataError, match="numbers in SI units"):
        parse_assignments("limits", ["1=-90 degrees,q1,2,8"], ["1"], (4, 5), "LOWER,...")
