"""A law that no catalogue has: learned, held, beside physics; nothing where there is nothing."""

from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.core.errors import DataError
from modeler.diagnosis import LawRequest
from modeler.diagnosis.learn import learn_law
from modeler.diagnosis.state import SearchData, analyse_logs, build_state
from modeler.estimation.model_file import load_model, save_model
from modeler.regression.log import Log
from modeler.robot.read import parse_robot_text
from tests.diagnose.conftest import Case, demonstration, motion, nothing, on_joint

SIZE, WHERE, WIDTH = 2.0, 0.6, 0.15  # N m, rad/s


def dip(v: np.ndarray) -> np.ndarray:
    """Friction that is more at one speed."""
    return SIZE * np.sign(v) * np.exp(-(((np.abs(v) - WHERE) / WIDTH) ** 2))


def hidden(log: Log) -> np.ndarray:
    """The same on joint 2."""
    return on_joint(log, 1, dip(motion(log)[1][:, 1]))


def test_the_error_falls_and_physics_stays(case: Case, tmp_path: Path) -> None:
    fitted, train, holdout = case.hidden(hidden)
    save_model(tmp_path / "m.json", api.add(fitted, "learned", [train], [holdout], joint="2"))
    better = load_model(tmp_path / "m.json")
    first, last = better.history
    assert last.error < 0.25 * first.error
    assert last.is_improvement and last.is_learned and not last.warning
    assert (last.effect, last.joint) == ("learned_2", "2")
    assert last.shifts_in_sigmas and max(last.shifts_in_sigmas.values()) < 2.0
    physics, law = better.error_reduction_shares or (0.0, 0.0)
    assert physics == 0.0 and law == pytest.approx(first.error - last.error)
    (item,) = parse_robot_text(better.robot_text, "better").own_effects
    assert item.is_learned and item.columns[0].equation.law is not None
    # The C has the law, and its even rest is viscous and Coulomb friction's.
    place, v = [p.name for p in better.fit.parameters].index("Lw2"), np.linspace(-1.0, 1.0, 41)
    qd = np.outer(v, [0.3, 1.0, -0.2])
    columns = api.compile(better).base_regressor(np.sin(qd), qd, np.cos(qd))[:, :, place]
    assert not columns[:, [0, 2]].any()
    left = better.fit.parameters[place].value * columns[:, 1] - dip(v)
    basis = np.column_stack([v, np.sign(v)])
    left -= basis @ np.linalg.lstsq(basis, left, rcond=None)[0]
    assert np.sqrt(np.mean(left**2)) < 0.15 * np.sqrt(np.mean(dip(v) ** 2))


@pytest.mark.rotating("effects are added to simulated runs")
def test_nothing_is_learned_of_nothing() -> None:
    fitted, train, holdout = demonstration(robot="two-link").hidden(nothing)
    with pytest.raises(DataError, match="learned: nothing is added: no law explains more than"):
        api.add(fitted, "learned", [train], [holdout])


def test_a_law_as_asked(case: Case) -> None:
    fitted, train, _ = case.hidden(hidden)
    compiled = api.compile(fitted)
    observation = analyse_logs(compiled, [train], fitted.processing)
    state = build_state(SearchData(compiled, observation), (), fitted.beta)
    for asked, equation in (
        (LawRequest(("z",)), "law(z)"),
        (LawRequest(("q", "v")), "law(q, v)"),
        (LawRequest(("v",), odd=True, rising=1), "sign(v)*law(abs(v))"),
    ):
        result = learn_law(state, 1, asked)
        assert result is not None and result.coordinates.equation == equation
    x = np.linspace(result.law.low[0], result.law.high[0], 500)
    assert np.all(np.diff(result.law(x)) >= -1e-5)  # rounded to six digits
    assert result.law(1e6) == result.law(result.law.high[0])
    assert abs(result.law(x[-1], along=0)) < 1e-9  # it comes to rest at its end


@pytest.mark.rotating("effects are added to simulated runs")
def test_auto_puts_laws_in_last() -> None:
    def both(log: Log) -> np.ndarray:
        q = motion(log)[0]
        return hidden(log) + on_joint(log, 0, 1.5 * np.sin(q[:, 0]) * np.abs(np.sin(q[:, 0])))

    fitted, train, holdout = demonstration(robot="two-link").hidden(both)
    better = api.add_all(fitted, [train], [holdout], learned=True)
    kinds = [step.is_learned for step in better.history[1:]]
    assert kinds == sorted(kinds) and any(kinds)
