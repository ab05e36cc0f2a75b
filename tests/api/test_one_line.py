"""The story of docs/reference/python.md on measured logs, which are not part of the project."""

from pathlib import Path

import numpy as np
import pytest

import modeler as md


@pytest.mark.rotating("long tests of api")
@pytest.mark.measured
def test_the_story_on_measured_logs(measured_folder: Path, tmp_path: Path) -> None:
    """EMPS, of which its authors print values by the same equations.

    Janot, Gautier, Brunot, "Data set and reference models of EMPS" (2019): M1 95.109 kg, Fv1
    203.50 N s/m, Fs1 20.394 N, offset -3.165 N, relative error 4.08 %; with friction by direction
    Fv+ 166.71, Fv- 240.42 N s/m and 3.11 %.
    """
    data = measured_folder / "emps"
    log, held_out = data / "train.parquet", data / "pulses.parquet"
    model = md.identify("emps", [log])
    for name, printed, unit in (
        ("M1", 95.109, "kg"),
        ("Fv1", 203.50, "N s/m"),
        ("Fs1", 20.394, "N"),
        ("Off1", -3.165, "N"),
    ):
        result = model[name]
        low, high = result.conf_int(0.95)
        assert result.value == pytest.approx(printed, rel=0.02) and result.unit == unit
        assert low < printed < high
    assert 0.02 < model.error(log) < 0.0408  # behind a narrower filter than theirs
    predicted, measured = model.predict(log), md.inspect_log(log)
    assert list(predicted.columns) == ["tau1"] and len(predicted) == measured.rows
    assert np.isfinite(predicted["tau1"]).mean() > 0.99
    result = model.missing(held_out)
    assert ("asymmetric_viscous", "1") in [(e.effect, e.joint) for e in result.effects]
    better = model.add("asymmetric_viscous", joint=1, held_out=held_out)
    assert better["Fv1+"].value == pytest.approx(166.71, rel=0.03)
    assert better["Fv1-"].value == pytest.approx(240.42, rel=0.03)
    assert better.error(log) < 0.75 * model.error(log)  # theirs: 3.11 % of 4.08 %
    assert better.error() < 0.95 * model.error(held_out)
    assert better.to_c(tmp_path / "out").spec.robot == "emps"
