"""SYMORO's `.par` files are robot files: the same robot, exact; what is lost is reported."""

import math
import re
import tomllib
from fractions import Fraction

import numpy as np
import pytest

from modeler.codegen.workflow import derive
from modeler.core.errors import RobotError
from modeler.derivation.relations import serialise_base_parameters
from modeler.formats import read_robot
from modeler.formats.par_convert import convert_par_file
from modeler.formats.par_text import KEYS
from modeler.robot.cells import recognise_angle
from modeler.robot.read import parse_robot_text
from tests.elementary_motions import frames
from tests.robot.par_files import BOOM, INERTIA, par_of, par_text
from tests.rotation import with_cases
from tests.texts import read_pairs


def convert(text: str, where: str = "arm.par"):
    data = text if isinstance(text, bytes) else text.encode()
    converted = convert_par_file(data, where)
    return parse_robot_text(converted.text, where), converted


TWINS = ("rx90", "puma560", "scara", "sr400-tree", "tx40")


@with_cases(
    "name, letters",
    ("sr400", True),
    ("sr400", False),
    *(pytest.param(n, x, marks=pytest.mark.rotating) for n in TWINS for x in (True, False)),
)
def test_the_frames_of_a_twin_are_the_same(name, letters):
    robot = read_robot(name)
    twin, converted = convert(par_of(robot, letters=letters))
    if letters:  # the stand-ins are not the values
        values = {n: f"{n} = {v.evaluate()!r}" for n, v in robot.symbols.items()}
        none = re.compile(r"^(\w+) = .*# .*no value in the file$", re.M)
        text = none.sub(lambda stated: values[stated[1]], converted.text)
        twin = parse_robot_text(text, "twin")
    rng = np.random.default_rng(4)
    for _ in range(5):
        positions = {joint.name: rng.uniform(-3, 3) for joint in robot.moving_joints}
        ours, theirs = frames(robot, positions), frames(twin, positions)
        assert ours.keys() == theirs.keys()
        for frame, pose in ours.items():
            assert np.allclose(theirs[frame], pose, atol=1e-9), frame
    assert [j.actuated for j in twin.joints] == [j.actuated for j in robot.joints]
    assert np.allclose(
        *([e.evaluate(r.evaluate_symbols()) for e in r.gravity] for r in (robot, twin))
    )


def test_numbers_keep_the_structure_of_a_loop():
    """Equal lengths of the parallelogram stay one letter: SR400 from numbers alone."""
    robot = read_robot("sr400")
    twin, converted = convert(par_of(robot, letters=False))
    for column in ("gamma", "b", "alpha", "d", "theta"):
        texts = ([getattr(joint, column).text for joint in r.joints] for r in (twin, robot))
        assert next(texts) == next(texts)
    assert any(note.startswith("lengths of one loop that are equal") for note in converted.notes)
    assert len(twin.symbols) == 6  # g, D2, D3, D4, R4, D8: RL4 is on no loop, and no length of it


ROUNDED = """
    1.5708 pi/2; -1.571 -pi/2; 1.57 pi/2; 1.57080 pi/2; 3.1415 pi; 0.2618 pi/12; -4.7124 -3*pi/2;
    6.2832 2*pi; 1.5707963267948966 pi/2; 15.708e-1 pi/2; 0.785398163 pi/4; 2.880 11*pi/12
"""
NOT_ROUNDED = "0 0.0001 2.88 0.260000 1.58 0.79 2 1.57090 0.785398173".split()


@with_cases("digits, angle", *map(str.split, ROUNDED.split(";")), *((x, None) for x in NOT_ROUNDED))
def test_rounded_angles(digits, angle):
    assert recognise_angle(digits) == angle


@pytest.mark.parametrize("decimals", [3, 6, 12])
def test_every_multiple_is_found_in_its_rounding_and_hardly_ever_elsewhere(decimals):
    for k in range(-24, 25):
        if k:
            text = recognise_angle(f"{k * math.pi / 12:.{decimals}f}")
            assert text is not None
            assert eval(text, {"pi": math.pi}) == pytest.approx(k * math.pi / 12, abs=1e-12)
            assert Fraction(k, 12) == Fraction(eval(text, {"pi": 1})).limit_denominator(12)
    rng = np.random.default_rng(1)
    wrong = sum(
        recognise_angle(f"{angle:.{decimals}f}") is not None for angle in rng.uniform(0.1, 6, 2000)
    )
    # Two units of the last digit around a multiple, of the pi/12 between two.
    assert wrong <= 3 + 2000 * 3 * 10.0**-decimals / (math.pi / 12)


def test_letters_and_numbers():
    lists = {
        "Ant": "0,1,2,3",
        "Sigma": "0,0,1,2",
        "d": "0,0.25,L*2,-0.25",
        "R": "RL1,0,r3,0.1",
        "gamma": "0,0,0,0.3",
        "Alpha": "0,Pi/2,-1.5708,0",
        "Theta": "th1,th2 - 1.571,0,0",
        "Mu": "1,0,1,0",
    }
    robot, converted = convert(par_text(lists, "my arm"))
    rows = tomllib.loads(converted.text)["mdh"]["rows"]
    assert rows == [
        ["1", "0", 1, 0, 0, 0, 0, "q1", "RL1"],
        ["2", "1", 0, 0, 0, "pi/2", "D2", "q2 - pi/2", 0],
        ["3", "2", 1, 1, 0, "-pi/2", "L*2", 0, "q3"],
        ["4", "3", 0, 2, "gam4", 0, "-D4", 0, "R4"],
    ]
    values = {name: value.evaluate() for name, value in robot.symbols.items()}
    assert values["D2"] == 0.25 and values["D4"] == 0.25  # no loops: letters of their own
    assert values["R4"] == 0.1 and values["gam4"] == 0.3
    assert values["L"] != values["RL1"]
    assert robot.name == "my-arm" and robot.title == "my arm"
    text = "\n".join(converted.notes)
    assert "no values in the file: RL1, L" in text
    assert "-1.5708 is -pi/2" in text and "1.571 is pi/2" in text
    assert "th1, th2, r3" in text
    assert "# no value in the file" in converted.text
    assert all(note in robot.notes for note in converted.notes)


def test_lists_may_be_short_of_what_is_the_default():
    robot, _ = convert("Ant = {0,1}\nSigma = {0,0}\nd = {0,0.3}\nTheta = {t1,t2}\n", "my_own.par")
    assert robot.name == "my_own"
    assert [joint.actuated for joint in robot.joints] == [True, True]
    assert [entry.text for entry in robot.gravity] == ["0", "0", "-g"]


def test_joint_variables():
    """Conventional letters, other letters, none, constants, and a joint that follows."""
    lists = {"Ant": "0,1,2,3,4", "Theta": "0,phi,0.4,q4 + Pi, phi - q4", "Mu": "1,1,1,1,0"}
    robot, converted = convert(par_text(lists))
    assert [joint.theta.text for joint in robot.joints][:4] == ["q1", "q2", "q3 + off3", "q4 + pi"]
    assert robot.relations["5"].text == "q2 - q4"
    assert any("q1, q3" in note for note in converted.notes)


def test_names_that_mean_something_else_are_changed():
    lists = {"Ant": "0,1,2,3,4,5", "d": "0,lambda,M2,double,qd1,β", "Theta": "t1,t2,t3,t4,t5,t6"}
    robot, converted = convert(par_text(lists))
    assert [joint.d.text for joint in robot.joints] == "0 lambda_ M2_ double_ qd1_ s1".split()
    text = "\n".join(converted.notes)
    for was in ("lambda", "M2", "double", "qd1", "β"):
        assert f"{was} is called" in text


def test_bodies_with_and_without_parameters():
    lists = read_pairs("""
        Ant 0,1,2 Theta t1,t2,t3 Mu 1,1,0 XX XX1,0.5,0 XY 0,0,0 XZ 0,0,0 YY 0,0.25,0 YZ 0,0,0
        ZZ J,1e-2,0 MX MX1,0,0 MY 0,0,0 MZ 0,0,0 M M1,3,0 IA IA1,0,IA3 FV FV1,FV2,FV3 FS 0,1.5,0
    """)
    robot, converted = convert(par_text(lists))
    assert robot.get_inertial_prefixes("1") == ("XX", "ZZ", "MX", "M")
    assert set(robot.get_inertial_prefixes("2")) == set(INERTIA)  # numbers: 0 is a value
    assert robot.get_inertial_prefixes("3") == ()
    assert robot.parameters["ZZ2"] == 0.01 and robot.parameters["XY2"] == 0
    assert robot.parameters["Fs2"] == 1.5
    uses = {use.effect: use.joints for use in robot.effects}
    assert uses.pop("offset") == ("1", "2")  # of the joints with a motor and friction
    assert uses == {"rotor_inertia": ("1",), "viscous": ("1", "2", "3"), "coulomb": ("2",)}
    text = "\n".join(converted.notes)
    assert "ZZ1 (there J)" in text and "IA3: left out" in text
    assert "added to the joints with friction: offset (1, 2)" in text


@with_cases(
    "lists, line, message",
    ({"FX": "0,FX2"}, "", "FX are left out"),
    ({"W0": "0,0,w"}, "", "W0 are left out"),
    ({"VP0": "0,0,1"}, "", "VP0 are left out"),
    ({"eta": "0,1"}, "", "eta are left out"),
    ({"Z": "1,0,0,0,0,1,0,0,0,0,1,0.5,0,0,0,1"}, "", "Z is left out"),
    ({"Mu": "0,0"}, "", "all are taken as actuated"),
    ({}, "Type = 2", "Type is"),
    ({"M": "M0,M1,M2"}, "is_floating = True", "stands still here"),
)
def test_what_is_not_carried_over_is_told(lists, line, message):
    basis = {"Ant": "0,1", "Theta": "t1,t2", "QDP": "QDP1,QDP2", "WP0": "0,0.0,0"}
    text = par_text(basis | lists).replace("Type = 0", line or "Type = 0")
    assert sum(message in note for note in convert(text)[1].notes) == 1
    for kind in "01":
        _, plain = convert(par_text(basis).replace("Type = 0", f"Type = {kind}"))
        assert not any("left out" in note or "Type is" in note for note in plain.notes)


def test_fixed_frames_carry_nothing():
    lists = {"Ant": "0,1", "Sigma": "0,2", "Theta": "t1,0", "d": "0,0.3", "M": "3,2", "XX": "1,0"}
    robot, converted = convert(par_text(lists))
    assert [joint.name for joint in robot.moving_joints] == ["1"]
    assert not robot.parameters.keys() & {"M2"}
    assert any("parameters of frame 2 are left out" in note for note in converted.notes)


@pytest.mark.parametrize("theta", ["q0,q1,q2", "q1,q3,q2", "q2,q3,q4 + Pi"])
def test_variables_are_those_of_the_rows(theta):
    robot, _ = convert(par_text({"Ant": "0,1,2", "Theta": theta}))
    assert [min(joint.theta.names) for joint in robot.joints] == ["q1", "q2", "q3"]
    assert not robot.symbols.keys() - {"g"}


@with_cases(
    "lists, gravity",
    ({"G": "0,0,9.81"}, [0, 0, 9.81]),
    ({"G": "0,-9.8,0"}, [0, -9.8, 0]),
    ({"G": "0,0,G3"}, [0, 0, -9.81]),
    ({"G": "0,0,2*g"}, [0, 0, -9.81]),
    ({"G": "GX,GY,GZ"}, [0, 0, -9.81]),
    ({"G": "GX,0,-9.81"}, [0, 0, -9.81]),
    ({"G": "g,0,0"}, [9.81, 0, 0]),
    ({"G": "0,g*sin(a),-g*cos(a)"}, [0, 0, -9.81]),
    ({"G": "0,0,0", "VP0": "0,0,g"}, [0, 0, -9.81]),
    ({"G": "0,0,0"}, [0, 0, 0]),
    ({"G": "0,0,0", "VP0": "0,0,9.81"}, [0, 0, -9.81]),
    ({"G": "0,1.5,-3"}, [0, 1.5, -3]),
)
def test_gravity(lists, gravity):
    """Letters stay, with stand-ins by which gravity points where the note says."""
    robot, converted = convert(par_text({"Ant": "0", "Theta": "t1"} | lists))
    values = {name: value.evaluate() for name, value in robot.symbols.items()}
    assert [entry.evaluate(values) for entry in robot.gravity] == pytest.approx(gravity)
    letters = set("gGka") & set("".join(lists.values()))
    (note,) = [n for n in converted.notes if "gravity is taken" in n] or [""]
    assert bool(note) == bool(letters)
    if letters:
        (k,) = np.flatnonzero(gravity)
        assert f"along {'-' * (gravity[k] < 0)}{'xyz'[k]}0, 9.81 m/s2" in note
        names = {name for entry in robot.gravity for name in entry.names} - ({"g"} - letters)
        assert all(f"{name} = " in note for name in names)


def test_every_key_of_a_par_file_is_read_told_or_refused():
    """A list of numbers or letters in place of each: another robot file, or a note."""
    basis = {"Ant": "0,1", "Theta": "t1,t2", "d": "0,0.3", "M": "M1,M2", "Mu": "1,1"}
    plain = convert(par_text(basis))[1]
    drawn, refused = np.random.default_rng(), list[str]()
    for key in KEYS:
        if key in ("NF", "NL", "NJ", "Type", "Ant", "Sigma", "theta"):  # they say how many
            continue
        for entries in (drawn.uniform(0.1, 1, 16).round(3).tolist(), [f"z{k}" for k in range(16)]):
            count = {"Z": 16, "G": 3} | dict.fromkeys(("W0", "WP0", "V0", "VP0"), 3)
            text = ",".join(map(str, entries[: count.get(key, 2)]))
            key = {"b": "B", "r": "R", "alpha": "Alpha"}.get(key, key)
            lists = dict(basis)
            if key in ("QP", "QDP", "GAM") and "z0" in entries:
                continue  # letters of a state, as SYMORO writes them itself
            if key in ("is_mobile", "is_floating"):
                lists, text = {**lists, "M": "1,2,3"}, ""
            try:
                state = par_text({**lists, **({key: text} if text else {})})
                state += "" if text else f"{key} = 1\n"
                _, converted = convert(state)
            except RobotError:
                refused.append(key)
                continue
            assert converted.text != plain.text or converted.notes != plain.notes, (key, text)
    assert set(refused) <= {"Mu"}  # which is 0 or 1


HAND_BOOM = """
name = "boom"
gravity = [0, 0, "-g"]
symbols = {{g = 9.81, a = {a}, c = {c}, gam5 = {gam5}}}
[mdh]
columns = ["j",   "a", "mu", "sigma", "gamma", "alpha", "d", "theta", "r"]
rows = [
          ["1",   "0",  0,    0,       0,     "pi/2",   0,   "q1",     0],
          ["2",   "0",  0,    0,       0,     "pi/2",  "a",  "q2",     0],
          ["3",   "2",  1,    1,       0,     "-pi/2",  0,   0,      "q3"],
          ["rod", "3",  0,    2,       0,     "pi/2",   0,   0,        0],
          ["eye", "1",  0,    2,     "gam5",   0,      "c",  0,        0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["eye", "rod", "eye", "revolute"]]
[home]
"""


def test_cut_joints_are_loops():
    robot, converted = convert(par_text(BOOM, "boom", links=3, joints=4))
    assert [(loop.frame, loop.meets, loop.kind) for loop in robot.loops] == [("4", "5", "rigid")]
    assert robot.get_inertial_prefixes("4") == () and len(robot.get_inertial_prefixes("3")) == 10
    assert [joint.name for joint in robot.coordinates] == ["3"]
    values = {name: value.evaluate() for name, value in robot.symbols.items()}
    q1 = 0.5  # close by hand: the vector from the base eye to the boom eye
    x = values["c"] * math.cos(q1 + values["gam5"]) - values["a"]
    z = values["c"] * math.sin(q1 + values["gam5"])
    home = {"1": q1, "2": math.atan2(z, x) - math.pi / 2, "3": math.hypot(x, z)}
    home["4"] = q1 + values["gam5"] - home["2"]
    ends = frames(robot, home)
    assert np.allclose(ends["4"], ends["5"])
    lines = "\n".join(f"q{row} = {value!r}" for row, value in home.items())
    base = derive(parse_robot_text(f"{converted.text}\n[home]\n{lines}\n", "boom")).base
    # The same with the cut joint as a pin between two fixed frames.
    by_hand = HAND_BOOM.format(**values) + "\n".join(lines.splitlines()[:3])
    expected = serialise_base_parameters("boom", derive(parse_robot_text(by_hand, "by hand")).base)
    assert serialise_base_parameters("boom", base)["base"] == expected["base"]
    assert base.proof.certificate.rank == base.rank
    assert any("[home]" in note for note in converted.notes)


def test_atan2_of_two_letters_is_exact():
    lists = BOOM | {"d": "0,a,0,0,sqrt(e**2 + f**2)", "gamma": "0,0,0,0,Pi - atan2(e, f)"}
    lists["B"] = "0,f,0,0,0"
    robot, converted = convert(par_text(lists, "boom", links=3, joints=4))
    fifth = robot.joints[4]
    assert (fifth.d.text, fifth.gamma.text) == ("L1", "pi - A1")
    values = {}
    for name, value in robot.symbols.items():
        values[name] = value.evaluate(values)
    assert math.hypot(values["e"], values["f"]) == pytest.approx(values["L1"])
    assert math.atan2(values["e"], values["f"]) == pytest.approx(values["A1"])
    assert any("L1*sin(A1)" in note for note in converted.notes)


@with_cases(
    "gamma, value",
    ("ArcTan[f, e]", lambda e, f: math.atan2(e, f)),
    ("atan2(-e, f)", lambda e, f: math.atan2(-e, f)),
    ("atan2(e, -f)", lambda e, f: math.atan2(e, -f)),
    ("atan2(-e, -f)", lambda e, f: math.atan2(-e, -f)),
    ("atan2(2*e, f)", lambda e, f: math.atan2(2 * e, f)),
    ("ArcSin[e/(e + f)] + Pi/4", lambda e, f: math.asin(e / (e + f)) + math.pi / 4),
    ("acos(Cos[e])", lambda e, f: e),
    ("atan2(e, f) - atan2(f, e)", lambda e, f: math.atan2(e, f) - math.atan2(f, e)),
)
def test_inverse_functions_have_their_value(gamma, value):
    lists = BOOM | {"d": "0,e,0,0,f", "gamma": f"0,0,0,0,{gamma}"}
    robot, _ = convert(par_text(lists, "boom", links=3, joints=4))
    values = {}
    for name, worth in robot.symbols.items():
        values[name] = worth.evaluate(values)
    expected = value(values["e"], values["f"])
    turns = (robot.joints[4].gamma.evaluate(values) - expected) / (2 * math.pi)
    assert turns == pytest.approx(round(turns), abs=1e-9)


def test_encodings_and_line_ends():
    lists = {"Ant": "0,1", "Theta": "t1,t2"}
    plain = par_text(lists, "Nœud é").replace("a comment", "1 rue de la Noë")
    expected = convert(plain)[1].text
    assert convert(plain.encode() + b"\x1a")[1].text == expected
    for encoding in ("cp1252", "utf-8-sig", "utf-16"):
        assert convert(plain.encode(encoding))[1].text == expected
    for end in ("\r\n", "\r"):
        assert convert(plain.replace("\n", end).encode())[1].text == expected


GOOD = par_text({"Ant": "0,1,2", "Theta": "t1,t2,t3", "XX": "XX1,XX2,XX3"})

MISTAKES = [
    ("XX1,XX2,XX3", "XX1,XX2,XX3,XX4", "XX: got 4 entries, expected 3 (NL); remove 1"),
    ("0,1,2}", "0,1,5}", 'Ant, entry 3: got "5"; expected the base, 0, or a frame before it'),
    ("Sigma  = {\n        0,0,0}", "Sigma  = {\n        0,3,0}", 'Sigma, entry 2: got "3"'),
    ("NF = 3", "NF = 4", "NF: got 4, expected 3, which is 2 NJ - NL"),
    ("NL = 3", "NL = 4", "got NL = 4, NJ = 3; expected 1 <= NL <= NJ"),
    ("NL = 3", "NL = three", 'NL: got "three"; expected a count'),
    ("Type = 0", "is_mobile = maybe\nType = 0", 'is_mobile: got "maybe"; expected 0 or 1'),
    ("Alpha", "Alhpa", 'unknown keyword "Alhpa" (did you mean "alpha"'),
    ("Mu  =", "Alpha  =", "alpha stands twice, first on line"),
    ("t1,t2,t3}", "t1,t2,t3", "theta: the list is not closed"),
    ("t1,t2,t3}", "t1,t2,}", "theta, entry 3: is empty"),
    ("t1,t2,t3}", "t1,a+c,t3}", 'theta, entry 2: got "a+c"; expected the joint variable'),
    ("t1,t2,t3}", "t1,2 Pi,t3}", 'theta, entry 2: got "2 Pi"; expected a number, a letter'),
    ("t1,t2,t3}", "t1,atan2(3),t3}", "theta, entry 2: got"),
    ("gamma  = {\n        0,0,0}", "gamma  = {\n        0,90,0}", "entry 2: got 90, which is"),
    ("Type = 0", "Type = closed", 'Type: got "closed"; expected 0 (simple), 1 (tree) or 2'),
    ("NJ = 3", "NJ = {3}", "NJ: got a list; expected one number"),
    ("d  = {\n        0,0,0}", "d = 0", 'd: got "0"; expected a list in braces'),
    ("(* End", "nonsense (* End", 'got "nonsense"; expected KEY = {...} or KEY = number'),
    ("(* End of definition *)", "(* End", 'the comment "(*" is not closed'),
    ("t1,t2,t3}", "t1,t2 + atan(2*t1),t3}", "got atan(2*q1), which moves with q1; robot files"),
    ("t1,t2,t3}", "t1,t2 + acos(2),t3}", "got acos(2), which has no value at these lengths"),
    ("Ant  = {\n        0,1,2}", "", "is no SYMORO file: the list Ant is missing"),
]


@pytest.mark.parametrize(("old", "new", "text"), MISTAKES)
def test_mistakes_are_told_in_one_line(old, new, text):
    assert old in GOOD
    with pytest.raises(RobotError) as error:
        convert(GOOD.replace(old, new))
    message = str(error.value)
    assert message.startswith("arm.par") and text in message and "\n" not in message


@pytest.mark.parametrize("data", [b"", b"\x00\x01\x02", b"<robot/>"])
def test_what_is_no_such_file_is_told(data):
    with pytest.raises(RobotError, match=r"^arm\.par: "):
        convert(data)
