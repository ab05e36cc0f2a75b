"""Effects that a robot file defines itself: what is read, every mistake, editing the file."""

import random
import re

import pytest

from modeler.api import load, own_effect
from modeler.codegen.workflow import derive
from modeler.core.errors import DerivationError, RobotError
from modeler.effects.catalogue import CATALOGUE, effect_named
from modeler.effects.effect import Acts
from modeler.robot.edit import with_effect, with_effects
from modeler.robot.read import robot_from_text

GOOD = """\
name = "arm"
gravity = [0, 0, 0]
priority = ["Keb*"]

[mdh]
columns = ["j", "theta"]
rows = [["1", "q1"], ["2", "q2"]]

[own_effects.eddy_brake]
title = "drag of a magnet"
columns = {Keb = "v*exp(-((q - c)/w)**2)"}
shapes = {c = [1, -1, 0], w = [0.1, 0.3]}
unit = "N*m*s/rad"
nonnegative = true

[own_effects.wave]
columns = {Wc = "cos(k*q)", Ws = "sin(k*q)"}
shapes = {k = 2}
unit = {Ws = "rad"}
acts = "position"

[own_effects.hook]
columns = {Kh = "z*cos(q)"}
shapes = {d = [0.01, 0.1]}

[effects]
eddy_brake = [{joint = "2", c = 0.7, w = 0.2}]
hook = [{joint = "1", d = 0.05}]

[parameters]
Keb2 = 3.0
Kh1 = 1.0
M1 = 2.0
"""
EDDY = 'columns = {Keb = "v*exp(-((q - c)/w)**2)"}'
HOOK = 'columns = {Kh = "z*cos(q)"}'
FIRST = "[own_effects.eddy_brake]"
WAVE = 'columns = {Wc = "cos(k*q)", Ws = "sin(k*q)"}'

# (what is wrong, old text, new text, pieces of the message in this order)
MISTAKES = [
    ("no table", "[own_effects.wave]", "[own_effects]\nwave = 3\n[terms]", ["wave]: got 3"]),
    ("an array", "[own_effects.wave]", "[[own_effects.wave]]", ["wave]: got [{", "a table"]),
    ("id of the catalogue", FIRST, "[own_effects.spring]", ["spring]:", "of the catalogue"]),
    ("alias there", FIRST, "[own_effects.stiction]", ['"stiction" is stribeck', "another name"]),
    ("capital id", FIRST, "[own_effects.Eddy]", ['got the name "Eddy"', "small letters"]),
    ("id with space", FIRST, '[own_effects."a b"]', ['got the name "a b"', "small letters"]),
    ("id of a word", FIRST, "[own_effects.undo]", ['got the name "undo"', "not all, auto, undo"]),
    ("unknown key", "nonnegative =", "positive =", ['unknown key "positive"', "expected title"]),
    ("misspelt key", "nonnegative =", "nonnegativ =", ['did you mean "nonnegative"?']),
    ("no columns", EDDY, "", ["eddy_brake], columns: is missing", "as in [own_effects."]),
    ("empty columns", EDDY, "columns = {}", ["columns: is missing"]),
    ("columns no table", EDDY, 'columns = "v"', ['columns: got "v"; expected a table']),
    ("equation a list", EDDY, "columns = {Keb = [1]}", ["columns, Keb: got [1]", "expression"]),
    ("equation unreadable", "w)**2)", "w)**2", ["columns, Keb:", "cannot be read"]),
    ("caret", "**2)", "^2)", ["columns, Keb:", "powers as x**2"]),
    ("unknown function", "v*exp", "v*ln", ["columns, Keb:", "no function ln", "sin, cos"]),
    ("unknown variable", "v*exp", "u*exp", ["Keb: got", "u is unknown", "names among q, v, a"]),
    ("misspelt shape", "- c)", "- cc)", ["cc is unknown", 'did you mean "c"?', "under shapes"]),
    ("rate", "v*exp", "rate*exp", ["rate is unknown", "expected names among"]),
    ("speed of a position", "cos(k*q)", "v*cos(k*q)", ["v is unknown", "names among q, k"]),
    ("kink of a position", "cos(k*q)", "abs(k*q)", ["wave], columns, Wc:", "without abs and sign"]),
    ("no joint", "v*exp", "v3*exp", ["v3 is unknown", "the name of a joint (1, 2); list"]),
    ("own joint", "v*exp", "v2*exp", ['joint "2" is the one whose v2', "write v for its own"]),
    ("of a position", "cos(k*q)", "cos(k*q1)", ["q1 is unknown", "names among q, k; list"]),
    ("shape a motion", "{c = [1,", "{v1 = [1,", ['"v1", which is the speed of joint 1']),
    ("prefix of the catalogue", "{Keb", "{Ks", ['the parameter "Ks" is that of spring already']),
    ("prefix of a link", "{Keb", "{MX", ['the parameter "MX" is that of the links already']),
    ("prefix of a log", "{Keb", "{qd", ['the parameter "qd" is that of the logs already']),
    ("prefix of the other", "{Wc", "{Keb", ["wave], columns:", '"Keb" is that of eddy_brake']),
    ("prefix with digit", "{Keb", "{K1", ['the parameter "K1"', "a letter first and last"]),
    ("shapes no table", "{k = 2}", "[2]", ["shapes: got [2]; expected a table"]),
    ("shape a variable", "{k = 2}", "{k = 2, v = 1}", ['the name "v"', "neither a variable (q,"]),
    ("shape reserved", "{k = 2}", "{k = 2, t0 = 1}", ['the name "t0"', "nor joint, t0"]),
    ("shape with dash", "{k = 2}", '{k = 2, "a-b" = 1}', ['the name "a-b"', "expected letters"]),
    ("empty grid", "[0.1, 0.3]", "[]", ["shapes, w: got an empty list", "[0.1, 0.3]"]),
    ("value twice", "[0.1, 0.3]", "[0.3, 0.3]", ["shapes, w:", "stands there twice"]),
    ("value no number", "[0.1, 0.3]", '["x"]', ['shapes, w: got "x"; expected a number']),
    ("value infinite", "[0.1, 0.3]", "[inf]", ["shapes, w: got inf", "finite"]),
    ("unused shape", "{k = 2}", "{k = 2, m = 1}", ["shapes: no equation uses m", "take it out"]),
    ("too many", "[0.1, 0.3]", str([*range(1, 40)]), ["117 combinations of c, w"]),
    ("division by 0", "v*exp", "1/v + exp", ["columns: Keb =", "no finite value at q = 0, v = 0"]),
    ("root of negative", "v*exp", "sqrt(q) + exp", ["columns: Keb =", "no finite value at q = -"]),
    ("complex", "v*exp", "v**0.5 + exp", ["columns: Keb =", "no finite value at"]),
    ("shape 0", "[0.1, 0.3]", "[0, 0.3]", ["no finite value at", "w = 0;", "at rest too"]),
    ("lag unknown", HOOK, f'{HOOK}\nlag = "abs(u)"', ["lag: got", "u is unknown", "among q, v, a"]),
    ("lag of itself", HOOK, f'{HOOK}\nlag = "abs(z)"', ["lag: got", "z is unknown"]),
    ("lag no text", HOOK, f"{HOOK}\nlag = [1]", ["hook], lag: got [1]", "expression"]),
    ("lag without tau", HOOK, f'{HOOK}\nlag = "v*d"', ["shapes: z lags by a time", "{tau ="]),
    ("lag of no time", HOOK + "\nshapes = {d = [0.01, 0.1]}",
     f'{HOOK}\nlag = "v"\nshapes = {{tau = [0, 1]}}', ["shapes: z lags", "no positive values"]),
    ("lag unused", EDDY, f'{EDDY}\nlag = "v"', ["lag: no equation uses z, which lags"]),
    ("lag infinite", HOOK + "\nshapes = {d = [0.01, 0.1]}",
     f'{HOOK}\nlag = "1/v"\nshapes = {{tau = [0.1, 1]}}', ["lag = ", "no finite value at v = 0"]),
    ("lag of a position", WAVE, f'{WAVE}\nlag = "q"', ["wave], lag: no equation uses z"]),
    ("unit no text", '"N*m*s/rad"', "3", ["unit: got 3; expected text"]),
    ("unit ends comment", '"N*m*s/rad"', '"N */ x"', ["unit: got", "expected text such as"]),
    ("unit of another", "{Ws =", "{Wx =", ['unit: got "Wx"', "no parameter of this", "Wc, Ws"]),
    ("nonnegative no word", "= true", "= 1", ["nonnegative: got 1; expected true or false"]),
    ("acts unknown", '"position"', '"motor"', ['acts: got "motor"; expected "joint"']),
    ("acts a list", '"position"', '["joint"]', ["acts: got ['joint']", 'expected "joint"']),
    ("empty title", '"drag of a magnet"', '""', ['title: got ""; expected text']),
    ("z without travel", "{d = [0.01, 0.1]}", "{}", ["shapes: z turns over a travel", "{d ="]),
    ("z with travel 0", "[0.01, 0.1]", "[0, 0.1]", ["shapes: z turns over", "no positive values"]),
    # their use
    ("not defined", "eddy_brake = ", "eddy = ", ['no effect "eddy"', "[own_effects.eddy]"]),
    ("no shapes", '[{joint = "2", c = 0.7, w = 0.2}]', '"all"', ['got "all"; expected its shapes']),
    ("one missing", ", w = 0.2", "", ["eddy_brake: got the shapes c; expected eddy_brake = [{"]),
    ("shape 0 there", "w = 0.2", "w = 0", ['joint "2": Keb =', "no finite value"]),
    ("no pattern", '["Keb*"]', '["Keq*"]', ['"Keq*" matches no parameter']),
]  # fmt: skip


def test_the_good_file_is_read():
    robot = robot_from_text(GOOD, "arm.toml")
    eddy, wave, hook = robot.own_effects
    assert robot.catalogue == (*CATALOGUE, eddy, wave, hook)
    assert effect_named("eddy_brake") is None
    assert effect_named("eddy_brake", robot.catalogue) is eddy
    assert (eddy.title, eddy.acts) == ("drag of a magnet", Acts.JOINT)
    assert [shape.grid for shape in eddy.forms[0].shapes] == [(-1.0, 0.0, 1.0), (0.1, 0.3)]
    assert eddy.columns[0].nonnegative and not wave.columns[0].nonnegative
    assert [c.unit_revolute for c in (*eddy.columns, *wave.columns)] == ["N*m*s/rad", "SI", "rad"]
    assert wave.acts is Acts.POSITION and not wave.forms[0].free
    assert hook.forms[0].memory is not None and hook.forms[0].memory.shape == "d"
    assert all(effect.written for effect in robot.own_effects)
    assert robot.parameters == {"Keb2": 3.0, "Kh1": 1.0, "M1": 2.0}


@pytest.mark.parametrize(
    ("old", "new", "pieces"), [pytest.param(*mistake[1:], id=mistake[0]) for mistake in MISTAKES]
)
def test_a_mistake_is_told(old, new, pieces):
    assert GOOD.count(old) >= 1
    pattern = ".*".join(re.escape(piece) for piece in pieces)
    with pytest.raises(RobotError, match=pattern) as caught:
        robot_from_text(GOOD.replace(old, new, 1), "arm.toml")
    message = str(caught.value)
    assert message.startswith("arm.toml: ")
    assert "\n" not in message
    assert len(message) < 700


def test_two_parameters_of_one_name_are_refused():
    """Kf on joint b1, and Kfb on joint 1."""
    text = """
        name = "two"
        gravity = [0, 0, 0]
        mdh = {columns = ["j", "theta"], rows = [["1", "q1"], ["b1", "qb1"]]}
        own_effects.one.columns = {Kf = "v**2"}
        own_effects.two.columns = {Kfb = "v**3"}
        effects = {one = ["b1"], two = ["1"]}
    """
    with pytest.raises(RobotError, match='row "b1": the name makes Kfb1 mean two parameters'):
        robot_from_text(text, "two.toml")


def test_a_load_needs_its_reference():
    text = GOOD.replace("z*cos(q)", "z*load")
    with pytest.raises(RobotError, match=r"\[reference\]: is missing; hook depends on the torques"):
        robot_from_text(text, "arm.toml")
    assert robot_from_text(text + "[reference]\nM1 = 2.0\n", "arm.toml").reference == {"M1": 2.0}


def test_a_position_without_derivative_is_told_when_it_is_derived():
    text = GOOD.replace("cos(k*q)", "(1 + q**2)**1.5 + k")
    text = text.replace("[effects]", '[effects]\nwave = ["2"]') + "\n[reference]\nM1 = 2.0\n"
    with pytest.raises(DerivationError, match=r"Wc2: .* differentiated twice, but pow has no"):
        derive(robot_from_text(text, "arm.toml"))


def test_the_definition_stays_when_its_use_goes():
    bare = robot_from_text(with_effects(GOOD, {"viscous": "all"}), "arm")
    assert [effect.id for effect in bare.own_effects] == ["eddy_brake", "wave", "hook"]
    assert [use.effect for use in bare.effects] == ["viscous"]
    assert bare.parameters == {"M1": 2.0}  # values of parameters that are gone go with them
    kept = with_effects(GOOD, {"eddy_brake": [{"joint": "2", "c": 0.5, "w": 0.1}]})
    assert robot_from_text(kept, "arm").parameters == {"Keb2": 3.0, "M1": 2.0}


def test_an_effect_is_put_on_one_joint_more():
    text = with_effect(GOOD, "eddy_brake", "1", {"c": -0.25, "w": 0.125})
    use = next(u for u in robot_from_text(text, "arm").effects if u.effect == "eddy_brake")
    assert {i.joint: dict(i.shapes) for i in use.instances} == {
        "2": {"c": 0.7, "w": 0.2}, "1": {"c": -0.25, "w": 0.125},
    }  # fmt: skip


def test_names_become_tables_where_one_has_values():
    """Time counts from the start of the logs, on every joint."""
    text = GOOD + '\n[own_effects.fade]\ncolumns = {Kf = "exp(-t/5)"}\n'
    once = with_effects(text, {"fade": ["1"]})
    twice = robot_from_text(with_effect(once, "fade", "2", {"t0": 3.0}), "arm").effects[0]
    assert [(i.joint, dict(i.shapes)) for i in twice.instances] == [("1", {}), ("2", {"t0": 3.0})]


def test_from_python_without_a_file():
    robot = own_effect(
        load("emps"), "fan", title='a "fan"', columns={"Kf": "v*abs(v)"}, nonnegative=True,
        shapes={}, unit="N*s^2/m^2",
    )  # fmt: skip
    (fan,) = robot.own_effects
    assert (fan.id, fan.title, fan.columns[0].nonnegative) == ("fan", 'a "fan"', True)
    assert robot_from_text(robot.text, "again").own_effects == (fan,)
    with pytest.raises(RobotError, match=r"own_effects.fan\]: the robot has it already"):
        own_effect(robot, "fan", columns={"Kg": "v"})
    with pytest.raises(RobotError, match="columns: is missing"):
        own_effect(robot, "fan2")
    with pytest.raises(RobotError, match='got the name "a b"'):
        own_effect(robot, "a b", columns={"Kg": "v"})


@pytest.mark.parametrize("seed", range(25))
def test_damaged_definitions_raise_nothing_but_robot_errors(seed):
    rng = random.Random(seed)
    start, end = GOOD.index(FIRST), GOOD.index("[effects]")
    place, length = rng.randrange(start, end), rng.randrange(8)
    shard = rng.choice(["", '"', "[", "{}", "0", "-", "=", "**", "v", "q", "w", "1e999", "9" * 400])
    try:
        robot_from_text(GOOD[:place] + shard + GOOD[place + length :], "arm.toml")
    except RobotError as error:
        assert "\n" not in str(error)
