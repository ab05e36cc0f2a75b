"""Effects that a robot file defines itself: what is read, every mistake, editing the file."""

import time

import numpy as np
import pytest

from modeler.api import define_effect, load
from modeler.codegen.workflow import derive
from modeler.core.errors import DerivationError, RobotError
from modeler.core.expression import MOST
from modeler.effects.catalogue import CATALOGUE, find_effect
from modeler.effects.effect import EffectTarget
from modeler.robot.edit import insert_effect, replace_effects
from modeler.robot.read import parse_robot_text
from tests.learned import drawn, text_with
from tests.robot.texts import LAW, OWN_EFFECTS


def test_the_good_file_is_read():
    robot = parse_robot_text(OWN_EFFECTS, "arm.toml")
    eddy, wave, hook = robot.own_effects
    assert robot.catalogue == (*CATALOGUE, eddy, wave, hook)
    assert find_effect("eddy_brake") is None
    assert find_effect("eddy_brake", robot.catalogue) is eddy
    assert (eddy.title, eddy.acts) == ("drag of a magnet", EffectTarget.JOINT)
    grids = [shape.grid for shape in eddy.forms[0].nonlinear_parameters]
    assert grids == [(-1.0, 0.0, 1.0), (0.1, 0.3)]
    assert eddy.columns[0].nonnegative and not wave.columns[0].nonnegative
    assert [c.unit_revolute for c in (*eddy.columns, *wave.columns)] == ["N*m*s/rad", "SI", "rad"]
    assert wave.acts is EffectTarget.POSITION and not wave.forms[0].free_parameters
    assert hook.forms[0].internal_state is not None
    assert hook.forms[0].internal_state.parameter == "d"
    assert all(effect.can_be_stated for effect in robot.own_effects)
    assert robot.parameters == {"Keb2": 3.0, "Kh1": 1.0, "M1": 2.0}


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
        parse_robot_text(text, "two.toml")


def test_a_load_has_its_reference():
    text = OWN_EFFECTS.replace("z*cos(q)", "z*load")
    assert parse_robot_text(text + "[reference]\nM1 = 2.0\n", "arm.toml").reference == {"M1": 2.0}


def test_a_position_without_derivative_is_told_when_it_is_derived():
    text = OWN_EFFECTS.replace("cos(k*q)", "(1 + q**2)**1.5 + k")
    text = text.replace("[effects]", '[effects]\nwave = ["2"]') + "\n[reference]\nM1 = 2.0\n"
    with pytest.raises(DerivationError, match=r"Wc2: .* differentiated twice, but pow has no"):
        derive(parse_robot_text(text, "arm.toml"))


def test_the_definition_stays_when_its_use_goes():
    bare = parse_robot_text(replace_effects(OWN_EFFECTS, {"viscous": "all"}), "arm")
    assert [effect.id for effect in bare.own_effects] == ["eddy_brake", "wave", "hook"]
    assert [use.effect for use in bare.effects] == ["viscous"]
    assert bare.parameters == {"M1": 2.0}  # values of parameters that are gone go with them
    stored = replace_effects(OWN_EFFECTS, {"eddy_brake": [{"joint": "2", "c": 0.5, "w": 0.1}]})
    assert parse_robot_text(stored, "arm").parameters == {"Keb2": 3.0, "M1": 2.0}


def test_an_effect_is_put_on_one_joint_more():
    text = insert_effect(OWN_EFFECTS, "eddy_brake", "1", {"c": -0.25, "w": 0.125})
    use = next(u for u in parse_robot_text(text, "arm").effects if u.effect == "eddy_brake")
    assert {i.joint: dict(i.nonlinear_parameters) for i in use.instances} == {
        "2": {"c": 0.7, "w": 0.2},
        "1": {"c": -0.25, "w": 0.125},
    }


def test_names_become_tables_where_one_has_values():
    """Time counts from the start of the logs, on every joint."""
    text = OWN_EFFECTS + '\n[own_effects.fade]\ncolumns = {Kf = "exp(-t/5)"}\n'
    once = replace_effects(text, {"fade": ["1"]})
    twice = parse_robot_text(insert_effect(once, "fade", "2", {"t0": 3.0}), "arm").effects[0]
    stated = [(i.joint, dict(i.nonlinear_parameters)) for i in twice.instances]
    assert stated == [("1", {}), ("2", {"t0": 3.0})]


def test_from_python_without_a_file():
    robot = define_effect(
        load("emps"),
        "fan",
        title='a "fan"',
        columns={"Kf": "v*abs(v)"},
        nonnegative=True,
        shapes={},
        unit="N*s^2/m^2",
    )
    (fan,) = robot.own_effects
    assert (fan.id, fan.title, fan.columns[0].nonnegative) == ("fan", 'a "fan"', True)
    assert parse_robot_text(robot.text, "again").own_effects == (fan,)
    with pytest.raises(RobotError, match=r"own_effects.fan\]: the robot has it already"):
        define_effect(robot, "fan", columns={"Kg": "v"})
    with pytest.raises(RobotError, match="columns: is missing"):
        define_effect(robot, "fan2")
    with pytest.raises(RobotError, match='got the name "a b"'):
        define_effect(robot, "a b", columns={"Kg": "v"})


# The key `law`.

TABLE = "{low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}"


def test_a_message_never_shows_a_whole_table() -> None:
    cells = [float(x) for x in np.linspace(0, 1, 3000)]
    for wrong in (f"{{low = {cells}}}", f"{cells}", TABLE.replace("[2]", str(cells))):
        with pytest.raises(RobotError) as result:
            parse_robot_text(LAW.replace(TABLE, wrong), "arm")
        assert len(str(result.value)) < 500


def test_the_largest_table_is_read() -> None:
    law = drawn(np.random.default_rng(1), 2, (97, 97))
    assert len(law.values) == MOST
    text = text_with("two-link", {"1": ("law(q, v)", law)})
    begin = time.process_time()
    robot = parse_robot_text(text, "arm")
    assert time.process_time() - begin < 10
    (effect,) = robot.own_effects
    assert effect.columns[0].equation.law == law
