"""Small odd robots: one axis, slides, no gravity, a short log, a joint that rests."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from tests.diagnose.conftest import Run, columns_of, written
from tests.rotation import rotating

ROWS = {
    "turn": '["1", "0", 0, 0, 0, "q1", 0]',
    "slide": '["1", "0", 1, 0, 0, 0, "q1"]',
    "second slide": '["2", "1", 1, "pi/2", 0, 0, "q2"]',
}
LEVEL, UPRIGHT, NONE = '[0, "-g", 0]', '[0, 0, "-g"]', "[0, 0, 0]"
ROBOTS = {
    "slide_along_gravity": (UPRIGHT, ["slide"]),
    "slide_across_gravity": (LEVEL, ["slide"]),
    "pendulum_with_prior": (LEVEL, ["turn"]),
    "turn_without_gravity": (NONE, ["turn"]),
    "gantry": (UPRIGHT, ["slide", "second slide"]),
    "turn_and_slide": (LEVEL, ["turn", "second slide"]),
}
PRIOR = "[parameters]\nM1 = 3.0\nMX1 = 0.4\nZZ1 = 0.3\n[parameters.uncertainty]\ninertial = 0.1\n"


def write_robot(folder: Path, name: str) -> Path:
    """Its file."""
    gravity, rows = ROBOTS[name]
    place = folder / "r.toml"
    place.write_text(
        f'name = "{name}"\ngravity = {gravity}\n[symbols]\ng = 9.81\n[mdh]\n'
        'columns = ["j", "a", "sigma", "alpha", "d", "theta", "r"]\n'
        f"rows = [{', '.join(ROWS[row] for row in rows)}]\n"
        '[effects]\nviscous = "all"\ncoulomb = "all"\n' + PRIOR * name.endswith("prior")
    )
    return place


def changed(columns: dict[str, np.ndarray], how: str) -> dict[str, np.ndarray]:
    """A log that is short, of one segment; a log whose last joint rests."""
    if how == "short":
        return {name: values[:150] for name, values in columns.items()}
    last = max(name[1:] for name in columns if name[0] == "q" and name[1:].isdigit())
    still = {
        name: 0 * columns[name] + columns[name][0] * (name[1] != "d")
        for name in (f"q{last}", f"qd{last}", f"qc{last}")
        if name in columns
    }
    return columns | still


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize(
    "name", ["pendulum_with_prior", *rotating(*(n for n in ROBOTS if n != "pendulum_with_prior"))]
)
def test_a_diagnosis_ends_in_sentences(name: str, tmp_path: Path, run: Run) -> None:
    robot, a, b = write_robot(tmp_path, name), tmp_path / "a.parquet", tmp_path / "b.parquet"
    for seed, log, words in ((1, a, ("--hide", "stribeck")), (2, b, ())):
        words = (*words, "--duration", 6, "--rate", 100, "--seed", seed, "--out", log)
        assert run("simulate", robot, *words)[0] == 0
    assert run("fit", robot, a, "--out", tmp_path / "m.json")[0] == 0
    short, resting = tmp_path / "short.parquet", tmp_path / "resting.parquet"
    for place, to in ((a, short), (b, resting)):
        written(to, changed(columns_of(place), to.stem))
    asked = [(a, "--holdout", b), (a, "--holdout", resting), (short,)]
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        for words in asked:
            status, out, err = run("diagnose", tmp_path / "m.json", *words)
            assert (status, err) == (0, "") or (status == 1 and err.count("\n") == 1), err
            assert status or "cross-validated error" in out or "held-out error" in out
