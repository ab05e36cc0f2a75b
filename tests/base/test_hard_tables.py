"""Tables on which a careless grouping is wrong and says that it is exact."""

import pytest

from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.relations import format_relation
from modeler.robot.read import parse_robot_text
from tests.base.ranks import seen

SYMBOLS = "g = 9.81\nL = 0.4\nal = 0.3\nL1 = 0.1\nL2 = 0.2\nL3 = 0.3\n"


def model_of(rows, gravity='[0, 0, "-g"]', more="", symbols=SYMBOLS):
    columns = ("j", "a", "sigma", "gamma", "b", "alpha", "d", "theta", "r")
    lines = []
    for row in rows:
        cells = dict.fromkeys(columns, 0) | row
        quoted = (f'"{cells[c]}"' if isinstance(cells[c], str) else repr(cells[c]) for c in columns)
        lines.append(f"[{', '.join(quoted)}]")
    return derive_model(
        parse_robot_text(
            f'name = "t"\ngravity = {gravity}\n[symbols]\n{symbols}[mdh]\n'
            f"columns = {list(columns)}\nrows = [{', '.join(lines)}]\n{more}".replace("'", '"'),
            "t.toml",
        )
    )


def R(j: int, a: object, **cells) -> dict:
    return {"j": str(j), "a": str(a), "theta": f"q{j}"} | cells


def P(j: int, a: object, **cells) -> dict:
    return {"j": str(j), "a": str(a), "sigma": 1, "r": f"q{j}"} | cells


def F(j: str, a: object, **cells) -> dict:
    return {"j": j, "a": str(a), "sigma": 2} | cells


ALL = '[effects]\nrotor_inertia = "all"\nviscous = "all"\ncoulomb = "all"\noffset = "all"\n'

CASES = {
    "angles of fixed frames add to zero": (
        [F("F", 0, alpha="pi/3"), F("G", "F", alpha="pi/3"), R(1, "G", alpha="-2*pi/3"),
         R(2, 1, d="L")], '[0, 0, "-g"]', "", 4, "exact"),
    "symbolic angles add to zero": (
        [R(1, 0), F("F", 1, alpha="2*al"), F("G", "F", alpha="-al"), R(2, "G", alpha="-al", d="L")],
        '[0, 0, "-g"]', "", 4, "exact"),
    "sum of a symbol and pi/4": (
        [R(1, 0), F("F", 1, alpha="al + pi/4"), F("G", "F", alpha="-al"),
         R(2, "G", alpha="-pi/4", d="L")], '[0, 0, "-g"]', "", 4, "exact"),
    "tilted base, same symbol": (
        [R(1, 0, alpha="al"), R(2, 1, d="L")], '[0, "g*sin(al)", "-g*cos(al)"]', "", 4, "exact"),
    "tilted base, twice the symbol": (
        [R(1, 0, alpha="2*al"), R(2, 1, d="L")], '[0, "g*sin(2*al)", "-g*cos(2*al)"]', "", 4,
        "exact"),
    "tilted base, radicals": (
        [R(1, 0, alpha="pi/3"), R(2, 1, d="L")], '[0, "g*sqrt(3)/2", "-g/2"]', "", 4, "numeric"),
    "decimal angles add to zero": (
        [P(1, 0), P(2, 1, alpha=0.3), P(3, 2, alpha=0.4), R(4, 3, alpha=-0.7, d="L")],
        '[0, 0, "-g"]', "", 6, None),
    "given lengths cancel": (
        [R(1, 0), R(2, 1, d="L1 + L2 - L3"), R(3, 2, d="L")], '[0, 0, "-g"]', "", 5,
        "exact at the given values"),
    "backward slide with offset": (
        [P(1, 0, r="-q1")], '[0, 0, "-g"]', ALL, 4, "exact"),
    "one symbol, angle and length": (
        [R(1, 0), R(2, 1, alpha="al"), R(3, 2, alpha="pi/2", d="al")], '[0, 0, "-g"]', "", None,
        "exact"),
    "angle times length": (
        [R(1, 0), R(2, 1, alpha="al", d="L*al"), R(3, 2, d="L")], '[0, 0, "-g"]', "", 15, "exact"),
    "rotor that links hide": (
        [R(1, 0), R(2, 1, d="L")], "[0, 0, 0]",
        '[coupling]\n2 = "q1 + q2"\n[effects]\ncoupled_inertia = ["2"]\n', 4, "numeric"),
    "four shafts of two joints": (
        [R(1, 0), R(2, 1, d="L")], '[0, 0, "-g"]', '[coupling]\n1 = "q1 - q2"\n2 = "q1 + q2"\n'
        '[effects]\nviscous = "all"\ncoulomb = "all"\ncoupled_friction = ["1", "2"]\n', 11,
        "exact"),
    "shafts whose speeds are in proportion": (
        [R(1, 0), R(2, 1, d="L"), R(3, 2, d="L")], '[0, 0, "-g"]',
        '[relations]\nq3 = "-5*q1/2"\n[effects]\nviscous = "all"\ncoulomb = "all"\n', None,
        "exact"),
    "twelve joints without gravity": (
        [R(j, j - 1, alpha="pi/2", d="L") for j in range(1, 13)], "[0, 0, 0]", "", None, "exact"),
    "multiples of the primes": (
        [R(1, 0), R(2, 1, alpha="pi/2", d="2305843009213693951/10**18"),
         R(3, 2, alpha="pi/2", d="1/2147483647")], '[0, 0, "-g"]', "", None, None),
    "functions of lengths": (
        [R(1, 0), R(2, 1, d="sqrt(L)**3 + exp(1)*L*tan(al)"), R(3, 2, d="abs(L)")],
        '[0, 0, "-g"]', "", 7, "exact"),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_rank_is_what_the_torques_show(name):
    rows, gravity, more, rank, kind = CASES[name]
    model = model_of(rows, gravity, more)
    base = derive_base_parameters(model)
    assert base.rank == seen(model)
    assert rank is None or base.rank == rank
    assert kind is None or base.proof.kind == kind
    assert base.proof.agreement < 1e-9


def test_numbers_stand_for_what_symbols_cannot_say():
    rows, gravity, more, *_ = CASES["rotor that links hide"]
    base = derive_base_parameters(model_of(rows, gravity, more))
    (first,) = [p for p in base.parameters if p.name == "ZZ1R"]
    assert format_relation(first).startswith("ZZ1R = ZZ1 + 0.16")
    assert "No exact proof" in base.proof.statement and "error" not in base.proof.kind


def test_general_twists_of_many_joints_end():
    """Coefficients that would fill pages are given as numbers."""
    symbols = SYMBOLS + "".join(f"a{i} = {0.3 + 0.1 * i}\n" for i in range(1, 7))
    rows = [R(j, j - 1, alpha=f"a{j}", d="L", r="L1") for j in range(1, 7)]
    model = model_of(rows, symbols=symbols)
    base = derive_base_parameters(model)
    assert base.proof.kind == "numeric" and "more than" in base.proof.statement
    assert base.rank == seen(model)
    assert base.proof.agreement < 1e-9
