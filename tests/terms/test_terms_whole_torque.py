"""Printed equations are the whole torque of the emitted C: every robot, every effect, term by term.

The text is run as it stands, and put together as the words above it say; the parameters are random.
"""

import ast
from collections import Counter

import numpy as np
import pytest

from modeler.formulas.function_sheet import sheet_lines
from modeler.formulas.regressor_form import equation_of
from tests.robots import ROBOTS, kinds_first
from tests.terms.printed_lines import compiled, derived, known, printed_coupling, run_lines, torque

SAMPLES = 3


def states(derivation):
    """Motors near home where loops close, anywhere else; random speeds and accelerations."""
    rng, closure = np.random.default_rng(17), derivation.model.closure
    for _ in range(SAMPLES):
        if closure is None:
            yield rng.uniform(-2, 2, (3, len(derivation.robot.coordinates)))
        else:
            home = np.array(closure.home)[list(closure.given)]
            q = home + rng.uniform(-0.03, 0.03, len(home))
            yield np.array([q, *rng.uniform(-1, 1, (2, len(home)))])


def monomials(node: ast.expr, sign: int = 1) -> list[tuple[int, tuple[str, ...]]]:
    """Terms of a printed sum, a product with one bracket multiplied out: (sign, factors)."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
        other = sign if isinstance(node.op, ast.Add) else -sign
        return monomials(node.left, sign) + monomials(node.right, other)
    if isinstance(node, ast.UnaryOp):
        return monomials(node.operand, -sign)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        left, right = monomials(node.left, sign), monomials(node.right)
        if len(left) == 1 or len(right) == 1:
            return [(a * b, tuple(sorted(f + g))) for a, f in left for b, g in right]
    return [(sign, (ast.unparse(node),))]


def check_sums(name) -> None:
    """Nothing cancels within a sum.

    S315 of a PUMA was ... + MX5c*(k34 + k51) - MX5c*(k34 - k51): 2*MX5c*k51.
    """
    for statement in ast.parse(derived(name).closed_form().text).body:
        terms = monomials(statement.value)
        gone = {f for sign, f in terms if sign > 0} & {f for sign, f in terms if sign < 0}
        assert not gone, ast.unparse(statement)


def check(name) -> None:
    """The torque of the printed lines is that of the C."""
    derivation, model = derived(name), compiled(name)
    text = derivation.closed_form().text
    lines, names = text.splitlines(), [j.name for j in derivation.model.robot.free]
    chain = "S_kij = -S_jik" in text
    rng = np.random.default_rng(5)
    for q, qd, qdd in states(derivation):
        beta, s = rng.normal(size=derivation.base.rank), rng.uniform(0.2, 0.8, 3)
        s = s[: len(derivation.model.signals)]
        signals = {f"{kind}{k + 1}": x for k, x in enumerate(s) for kind in "tTz"}
        expected = model.inverse_dynamics(*np.array([q, qd, qdd])[:, None], beta,
                                          s[None] if len(s) else None)[0]  # fmt: skip
        if derivation.model.closure is None:
            found = run_lines(lines, known(derivation, q, qd, qdd, beta) | signals)
            tau = torque(found, names, qd, qdd, chain)
        else:
            u, G = model.close(q[None])[0], model.coupling(q[None])[0]
            first = run_lines(lines, known(derivation, u, G @ qd, G @ qdd, beta) | signals)
            J, b = printed_coupling(derivation, first)
            ud, udd = J @ qd, J @ qdd + b
            found = run_lines(lines, known(derivation, u, ud, udd, beta) | signals)
            tau = J.T @ torque(found, names, ud, udd, chain)
        assert np.max(np.abs(tau - expected)) < 1e-12 * np.max(np.abs(expected))


@pytest.mark.parametrize("name", kinds_first(ROBOTS))
def test_printed_lines_are_the_whole_torque_of_the_c(name):
    check(name)
    check_sums(name)


@pytest.mark.parametrize("name", ["odd", "askew", "geared", "puma560"])
def test_printed_lines_of_awkward_robots(name):
    check(name)
    check_sums(name)


@pytest.mark.slow
@pytest.mark.parametrize("file", ["offset_parallelogram.toml", "twoloops.toml"])
def test_printed_lines_of_further_robots(loop_robots_folder, file):
    check(loop_robots_folder / file)


@pytest.mark.parametrize("name", ["puma560", "sr400", "orthoglide-2003"])
def test_a_document_of_both_has_one_thing_under_each_name(name):
    """The torque and the columns on one sheet: names are given once, and before they are read."""
    derivation = derived(name)
    found = equation_of(derivation.model, derivation.base, motion=True, columns=True)
    tree = ast.parse("\n".join(sheet_lines(found.sheet)))
    names = [node.targets[0].id for node in tree.body if isinstance(node, ast.Assign)]
    assert max(Counter(names).values()) == 1
    free = range(len(derivation.model.robot.free))
    values = known(derivation, *([0.5 + 0.1 * k for k in free],) * 3, [1.0] * derivation.base.rank)
    run_lines(sheet_lines(found.sheet), values)  # NameError otherwise
    read = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
    assert not set(names) & set(values)
    assert {d.name for d in found.sheet.definitions if not d.result} <= read
