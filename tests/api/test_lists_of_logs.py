"""One log alone stands for a list of it, in every function that takes logs."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import modeler.api as api
from modeler.core.errors import ModelerError


def test_one_log_alone_is_a_list_of_it(tmp_path: Path) -> None:
    """A text was once taken for a list of letters."""
    robot = api.load("two-link")
    place = tmp_path / "run.parquet"
    run = api.simulate(robot, place, duration=2.0, seed=1)
    compiled = api.compile_model(api.generate(api.derive(robot)))
    columns = {"time": run.time, "q1": run.q[:, 0], "q2": run.q[:, 1]}
    columns |= {"tau1": run.tau[:, 0], "tau2": run.tau[:, 1]}
    (read,) = api.read_logs(compiled, [place])
    for alone in (str(place), place, run, columns, pd.DataFrame(columns), read):
        (log,) = api.read_logs(compiled, alone)
        np.testing.assert_array_equal(log.q, run.q)
    (log,) = api.read_logs(compiled, iter([place]))  # type: ignore[arg-type]
    assert log.content == read.content
    assert api.Load(str(place), 2.0).logs == [str(place)]
    model = api.identify(robot, place)
    assert api.compare(model, place).prediction.logs == ("run.parquet",)
    assert api.compare_models([model, model], str(place)).names == ("A", "B")
    assert api.observe(compiled, place).names == tuple(p.name for p in model.fit.parameters)
    assert not api.diagnose(model, place).effects


def test_a_path_that_does_not_exist_is_named() -> None:
    compiled = api.compile_model(api.generate(api.derive(api.load("two-link"))))
    for act in (
        lambda: api.read_logs(compiled, "none.parquet"),
        lambda: api.identify("two-link", "none.parquet"),
        lambda: api.identify("none.toml", "none.parquet"),
        lambda: api.open_model("none.json"),
        lambda: api.open_robot("none.toml"),
        lambda: api.fleet(api.load("two-link"), "none.parquet"),
    ):
        with pytest.raises(ModelerError, match=r"none\.\w+"):
            act()
