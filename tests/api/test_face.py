"""What a user of Python sees: a fit that is not usable, units, messages, tables, pictures."""

import warnings
from pathlib import Path

import numpy as np
import pytest

import modeler
from modeler.core.errors import FitWarning


@pytest.fixture(scope="module")
def run() -> dict[str, np.ndarray]:
    made = modeler.simulate(modeler.open_robot("two-link"), duration=6.0, seed=1)
    return {"time": made.time, "q": made.q, "tau": made.tau}


@pytest.fixture(scope="module")
def model(run) -> modeler.Model:
    with warnings.catch_warnings():
        warnings.simplefilter("error", FitWarning)  # a good fit says nothing
        return modeler.identify("two-link", run)


def test_a_fit_that_is_not_usable_says_so_wherever_it_is_seen(run, model) -> None:
    noise = np.random.default_rng().normal(size=run["tau"].shape)
    with pytest.warns(FitWarning) as seen:
        spoilt = modeler.identify("two-link", run | {"tau": 20.0 * noise})
    assert spoilt.fit.verdict is not None and not spoilt.fit.verdict.valid
    (warning,) = [each for each in seen if each.category is FitWarning]
    assert Path(warning.filename) == Path(__file__)  # the line that called
    line = spoilt.fit.verdict.line.partition(";")[0]
    assert line.removeprefix("Not valid: ") in str(warning.message) and line in repr(spoilt)
    assert line.partition(":")[0] in spoilt._repr_html_()
    assert line.partition(":")[0] not in repr(model) + model._repr_html_()


def test_every_relative_error_is_a_fraction(run, model) -> None:
    result = model.compare(run)
    assert 0.0 < model.error(run) == result.relative_error < 0.01
    by_joint = {item.joint.name: item.relative_error for item in result.joints}
    frame = result.to_frame("errors")
    assert dict(zip(frame["joint"], frame["relative error"], strict=True)) == by_joint
    assert frame.attrs["units"]["relative error"] == ""
    fitted = model.to_frame("errors")
    assert list(fitted["relative error"]) == [j.relative_error for j in model.fit.joints]
    assert model.to_dict()["relative_error"] == model.fit.relative_error
    local = model.to_frame()
    expected = 100.0 * local["sigma"] / local["value"].abs()
    assert np.allclose(local["relative_sigma_percent"], expected)
    names = {"a": model, "b": model}
    errors = modeler.compare_models(names, [run]).to_frame("errors")
    assert np.allclose(errors[["a", "b"]].to_numpy().T, list(by_joint.values()))


def test_a_diagnosis_is_a_sequence_of_its_effects() -> None:
    result = object.__new__(modeler.Diagnosis)
    object.__setattr__(result, "effects", ("first", "second"))
    assert len(result) == 2 and result[0] == "first" and [*result] == ["first", "second"]


def test_no_panel_of_a_comparison_is_empty(run, model) -> None:
    """Too few samples to split the variance: those panels are not drawn."""
    drawn = model.compare(run).plot()
    assert drawn.axes and all(axis.has_data() for axis in drawn.axes)
    for legend in drawn.legends:
        colours = [handle.get_facecolor() for handle in legend.legend_handles]
        assert len(set(map(tuple, colours))) == len(colours)
