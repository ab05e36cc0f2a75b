"""Base parameters against the literature, and the laws that any grouping obeys."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import DerivationError
from modeler.core.expression import parse_expression
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.relations import format_relation
from modeler.robot.read import parse_robot_text, read_robot
from modeler.robot.robot import EffectUse
from tests.base.ranks import seen
from tests.base.test_hard_tables import model_of
from tests.modules import module
from tests.rotation import with_cases


def derive(robot):
    return derive_base_parameters(derive_model(robot))


def relations(robot):
    return [format_relation(parameter) for parameter in derive(robot).parameters]


def with_effects(robot, *effects):
    names = tuple(joint.name for joint in robot.moving_joints)
    return dataclasses.replace(robot, effects=tuple(EffectUse(e, names) for e in effects))


def with_gravity(robot, *entries):
    return dataclasses.replace(robot, gravity=tuple(parse_expression(e) for e in entries))


COLUMNS = '["j", "alpha", "d", "theta", "r"]'


def table(rows, gravity='[0, 0, "-g"]', symbols="", columns=COLUMNS):
    return parse_robot_text(
        f'name = "t"\ngravity = {gravity}\n[symbols]\ng = 9.81\n{symbols}\n'
        f"[mdh]\ncolumns = {columns}\nrows = {rows}\n",
        "t.toml",
    )


WRIST = """
ZZ1R = ZZ1 + YY2
MX1 = MX1
MY1R = MY1 - MZ2
XX2R = XX2 - YY2 + YY3 + 2*bl1*MZ3 + bl1**2*M3
XY2 = XY2
XZ2 = XZ2
YZ2 = YZ2
ZZ2R = ZZ2 + YY3 + 2*bl1*MZ3 + bl1**2*M3
MX2 = MX2
MY2R = MY2 + MZ3 + bl1*M3
XX3R = XX3 - YY3
XY3 = XY3
XZ3 = XZ3
YZ3 = YZ3
ZZ3 = ZZ3
MX3 = MX3
MY3 = MY3
"""


def test_wrist_groups_as_the_rule_of_khalil_says():
    """Khalil and Dombre 2002, section 9.4.2, applied by hand to the wrist."""
    base = module("wrist").base
    assert [format_relation(p) for p in base.parameters] == WRIST.split("\n")[1:-1]
    assert base.unidentifiable == ("XX1", "XY1", "XZ1", "YY1", "YZ1", "MZ1", "M1", "M2")


@pytest.mark.parametrize(
    ("gravity", "rank"),
    [((0, "-g", 0), 17), (("g", "g", "g"), 17), ((0, 0, "g"), 15), ((0, 0, 0), 11)],
)
def test_gravity_direction_decides(gravity, rank):
    assert derive(with_gravity(read_robot("wrist"), *gravity)).rank == rank


@with_cases(
    "name, effects, rank",
    ("rx90", (), 36),
    # Khalil and Dombre 2002, example 9.6: 40 with the rotor inertias of joints 3 to 6.
    ("rx90", ("rotor_inertia",), 40),
    ("tx40", ("rotor_inertia",), 40),
    ("ur10e", (), 36),
    ("sr400-tree", (), 50),
    ("panda", ("rotor_inertia", "viscous", "coulomb", "offset"), 43 + 5 + 14 + 7),
)
def test_known_numbers(name, effects, rank):
    assert derive(with_effects(read_robot(name), *effects)).rank == rank


def test_planar_arm_with_vertical_axes_feels_no_gravity():
    rows = '[["1", 0, 0, "q1", 0], ["2", 0, "L1", "q2", 0]]'
    wanted = "ZZ1R = ZZ1 + L1**2*M2; ZZ2 = ZZ2; MX2 = MX2; MY2 = MY2"
    assert relations(table(rows, symbols="L1 = 0.4")) == wanted.split("; ")
    wanted = "ZZ1R = ZZ1 + L1**2*M2; MX1R = MX1 + L1*M2; MY1 = MY1; ZZ2 = ZZ2; MX2 = MX2; MY2 = MY2"
    assert relations(table(rows, '["g", 0, 0]', "L1 = 0.4")) == wanted.split("; ")


def test_general_twist_of_a_planar_pair():
    """An axis tilted by al against the first: YY2 reaches ZZ1 with sin(al)**2, and so on."""
    pair = table('[["1", 0, 0, "q1", 0], ["2", "al", 0, "q2", 0]]', "[0, 0, 0]", "al = 0.7")
    wanted = (
        "ZZ1R = ZZ1 + sin(al)**2*YY2; XX2R = XX2 - YY2; XY2 = XY2; XZ2 = XZ2; YZ2 = YZ2; ZZ2 = ZZ2"
    )
    assert relations(pair) == wanted.split("; ")


def test_lift_axis_tells_mass_from_rotor_only_by_gravity():
    rows = '[["1", 0, 1, 0, 0, "q1"]]'
    columns = '["j", "alpha", "sigma", "d", "theta", "r"]'
    lift = with_effects(table(rows, columns=columns), "rotor_inertia", "offset")
    assert relations(lift) == ["M1R = M1 + Off1/g", "Ia1R = Ia1 - Off1/g"]
    assert relations(with_gravity(lift, "g", 0, 0)) == ["M1R = M1 + Ia1", "Off1 = Off1"]


def test_priority_is_the_users():
    robot = dataclasses.replace(read_robot("wrist"), priority=("YY*", "M3"))
    base = derive(robot)
    rest = {base.columns[p.column].name for p in base.parameters}
    assert {"YY2", "YY3", "M3"} <= rest
    assert not {"XX2", "XX3", "MZ3"} & rest
    assert base.rank == 17 and base.proof.agreement < 1e-12
    with pytest.raises(DerivationError, match=r'priority: "Q\*" matches no parameter; expected'):
        derive(dataclasses.replace(robot, priority=("Q*",)))


def test_value_zero_and_right_angles_are_exact():
    """A symbol worth 0 is 0; an angle symbol worth pi/2 is a right angle, also as a decimal."""
    rows = '[["1", 0, 0, "q1", 0], ["2", "al", "d", "q2", 0]]'
    expected = relations(table('[["1", 0, 0, "q1", 0], ["2", "pi/2", 0, "q2", 0]]'))
    for value in ('"pi/2"', "1.5707963267948966"):
        assert relations(table(rows, symbols=f"al = {value}\nd = 0.0")) == expected


def random_tree(rng: np.random.Generator) -> dict[str, str | list[dict]]:
    """A random tree of 2 to 5 rows with the entries where grouping changes its form."""
    rows, symbols = [], "g = 9.81\n"
    for j in range(1, int(rng.integers(2, 6)) + 1):
        alphas = ["0", "pi/2", "-pi/2", "pi", "pi/3", f"al{j}"]
        alpha = rng.choice(alphas, p=[0.25, 0.2, 0.2, 0.1, 0.1, 0.15])
        gamma = rng.choice(["0", "pi/2", f"ga{j}"], p=[0.8, 0.1, 0.1])
        d, b, r = (rng.choice(["0", f"{x}{j}", "0.3"], p=[0.5, 0.35, 0.15]) for x in "dbr")
        first = int(rng.integers(0, 2))
        sigma = int(rng.choice([0, 1, 2], p=[0.65, 0.25, 0.1])) if j > 1 else first
        theta = {
            0: rng.choice([f"q{j}", f"q{j} + pi/2", f"-q{j} + 0.4"]),
            1: rng.choice(["0", "pi/2", "0.4"]),
            2: "0.4",
        }[sigma]
        r = f"q{j} + {r}" if sigma == 1 else r
        a = j - 1 if rng.random() < 0.75 else int(rng.integers(0, j))
        cells = {"gamma": gamma, "b": b, "alpha": alpha, "d": d, "theta": theta, "r": r}
        rows.append(
            {"j": str(j), "a": str(a), "sigma": sigma} | {k: str(x) for k, x in cells.items()}
        )
        for name, value in zip(("al", "ga", "d", "b", "r"), rng.uniform(0.2, 0.7, 5), strict=True):
            symbols += f"{name}{j} = {value:.3f}\n"
    gravity = rng.choice(['[0, 0, "-g"]', '["g", 0, 0]', '["g", "0.5*g", "-g"]', "[0, 0, 0]"])
    every = ("rotor_inertia", "viscous", "coulomb", "offset")
    effects = "".join(f'{e} = "all"\n' for e in every if rng.random() < 0.4)
    return {"rows": rows, "gravity": gravity, "more": f"[effects]\n{effects}", "symbols": symbols}


@pytest.mark.parametrize(
    "seed", [*range(5), *(pytest.param(k, marks=pytest.mark.rotating) for k in range(5, 20))]
)
def test_random_trees(seed):
    """The exact relations against the rank in floating point, on tables nobody thought of."""
    tree = random_tree(np.random.default_rng(seed))
    model = model_of(**tree)
    base = derive_base_parameters(model)
    assert base.rank == seen(model), tree
    assert base.proof.kind.startswith("exact"), tree
    assert base.proof.agreement < 1e-12, tree
