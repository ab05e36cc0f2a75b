"""Base parameters of robots with relations and loops: numbers, names, exactness."""

import re
from pathlib import Path

import pytest
import sympy

from modeler.core.choices import read_builtin_robot
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.read import parse_robot_text
from tests.base.ranks import seen
from tests.modules import module
from tests.robots import TIED, one_always
from tests.rotation import ROTATING, rotating, with_cases

# facts of the papers, each computed there by two independent methods:
# base parameters, standard parameters, without effect
KNOWN = {
    "orthoglide-leg": (14, 53, 21),
    "orthoglide-2003": (43, 163, 63),
    "orthoglide-2003-similar-legs": (23, None, None),
    "orthoglide-2012": (53, 196, 90),
    "evra": (90, 210, 54),
    "sr400": (39, 80, None),
    "stewart": (88, None, None),
}
ALWAYS = ("five-bar", "wrist-coupled", "orthoglide-leg", "orthoglide-2003")


@pytest.mark.parametrize("name", one_always(TIED, *ALWAYS))
def test_the_rank_is_that_of_the_torques_and_of_the_papers(name):
    model, base, _ = module(name)
    assert base.rank == seen(model)
    stated = KNOWN.get(name, (None, None, None))
    values = (base.rank, len(base.columns), len(base.unidentifiable))
    assert all(known in (None, item) for known, item in zip(stated, values, strict=True))


def variant(name, *changes):
    text = read_builtin_robot(name)
    for old, new in changes:
        assert re.search(old, text, re.M), old
        text = re.sub(old, new, text, flags=re.M)
    return derive_base_parameters(derive_model(parse_robot_text(text, name)))


NO_PASSIVE = (r"^(viscous|coulomb) = .*$", r'\1 = ["1{i}"]')
OFFSETS = (r"^\[effects\]$", '[effects]\noffset = ["1{i}"]')
LEGS = (r"^priority", 'shared = ["*2{i}", "*3{i}", "*4{i}", "*5{i}"]\npriority')
ALL = (r"^priority", 'shared = ["*1{i}", "*2{i}", "*3{i}", "*4{i}", "*5{i}"]\npriority')
ORDER = (r"^priority = .*$", 'priority = ["*6"]')


@with_cases(
    "changes, rank",
    ([NO_PASSIVE, LEGS, OFFSETS, ORDER], 23),
    *rotating(([NO_PASSIVE], 41), ([ALL, ORDER], 19)),
    *(
        pytest.param(*variant, marks=ROTATING)
        for variant in (
            ([NO_PASSIVE, OFFSETS], 43),
            ([OFFSETS], 55),
            ([NO_PASSIVE, LEGS, ORDER], 21),
            ([LEGS, ORDER], 25),
            ([LEGS, OFFSETS, ORDER], 27),
            ([NO_PASSIVE, ALL, ORDER], 15),
        )
    ),
)
def test_the_orthoglide_of_2012_in_all_its_variants(changes, rank):
    base = variant("orthoglide-2012", *changes)
    assert base.rank == rank
    assert base.proof.agreement < 1e-12


@pytest.mark.rotating("long tests of loops")
def test_sr400_with_rotors():
    base = variant("sr400", (r"^\[links\]$", '[effects]\nrotor_inertia = "all"\n\n[links]'))
    assert base.rank == 42 and base.proof.kind == "exact"


LOCKED = [
    (r'^ *\["s1", .*$', '["s1", "0", 0, 2, "pi/2", "pi/2", 0, 0, 0],'),
    (r'^ *\["s2", .*$', '["s2", "s1", 0, 2, "pi/2", "pi/2", 0, 0, 0],'),
    (r"^(s1|s2) = .*$", ""),
    (r"^(Ms1|Ms2) = .*$", ""),
]
UPRIGHT = [
    (r'^ *\["1\{i\}".*$', '["1{i}", "B{i}", 0, 0, 0, 0, 0, "q1{i}", 0],'),
    (r"^q1([135]) = .*$", r"q1\1 = -0.5957"),
    (r"^q1([246]) = .*$", r"q1\1 = 0.5957"),
    (r"^q2(\d) = .*$", r"q2\1 = -4.1922"),
]


@pytest.mark.slow
def test_evra_locked():
    """Sliders locked: 88; first axes of the universal joints vertical besides: 76."""
    assert variant("evra", *LOCKED).rank == 88
    upright = variant("evra", *LOCKED, *UPRIGHT)
    assert upright.rank == 76 and upright.proof.kind == "exact"


def test_the_anti_parallelogram_is_another_robot():
    """Home says which assembly mode is meant: crossed bars turn differently, and group less."""
    crossed = re.sub(r"q3 = .*", "q3 = 0.6", read_builtin_robot("sr400"))
    crossed = re.sub(r"q8 = .*", "q8 = 2.4", crossed)
    crossed = re.sub(r"q9 = .*", "q9 = 0.3", crossed)
    model = derive_model(parse_robot_text(crossed, "sr400"))
    assert model.closure is not None and "3" not in model.robot.relations
    assert derive_base_parameters(model).rank == 47


def test_coefficients_may_be_sums_and_quotients():
    """Link 4 turned and shifted on a leg: sin, cos and a sum of squares in the coefficients."""
    text = read_builtin_robot("orthoglide-leg")
    text = text.replace('"b3", "-pi/2",   0,   "q3",     0]', '"b3", "al",   0,   "q3",     "r3"]')
    text = text.replace("b3 = -0.04 ", "al = -1.2\nr3 = 0.05\nb3 = -0.04 ")
    base = derive_base_parameters(derive_model(parse_robot_text(text, "leg")))
    assert base.proof.kind == "exact"
    row = {t.parameter: t.coefficient for p in base.parameters for t in p.terms if p.name == "ZZ2R"}
    al, r3, D4 = (sympy.Symbol(n, real=True) for n in ("al", "r3", "D4"))
    expected = sympy.sin(al) ** 2 * (r3**2 + D4**2)
    assert sympy.simplify(row["M4"] - expected) == 0


def test_what_cancels_over_the_legs_is_not_written():
    """Three equal legs of a planar platform: their first moments add up to nothing."""
    text = (Path(__file__).parent / "star.toml").read_text(encoding="utf-8")
    base = derive_base_parameters(derive_model(parse_robot_text(text, "star.toml")))
    terms = {p.name: {t.parameter: t.coefficient for t in p.terms} for p in base.parameters}
    assert terms["MPR"]["M2"] == 3
    assert "MXP" in terms and "MYP" in terms
    assert all(value != 0 for item in terms.values() for value in item.values())
