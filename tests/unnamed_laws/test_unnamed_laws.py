"""Every law acts in the simulated arm as its column says; the true form explains what is left."""

import numpy as np
import pytest

from tests.hidden_effects.conftest import plant_compiler as plant_compiler
from tests.hidden_effects.plant import TICK
from tests.hidden_effects.test_generator import arm, moved
from tests.rotation import rotating
from tests.unnamed_laws.found import what_is_learned, what_is_proposed
from tests.unnamed_laws.judge import errors
from tests.unnamed_laws.laws import LAWS, Motion
from tests.unnamed_laws.machines import CLEAN, LEAST, MOST, machine, with_law

pytestmark = pytest.mark.usefixtures("plant_compiler")


@pytest.mark.parametrize("name", LAWS)
def test_the_simulated_torque_is_the_column(name):
    plant, path, scales = arm(seconds=3.0)
    form = with_law(name, plant, scales, path, np.random.default_rng(4))
    x, j = moved(plant, path), form.joint
    expected, scale = np.zeros_like(x.q), x.torque.std(0)
    column = form.column(Motion(x.q, x.v, x.a, x.load, np.arange(len(x.q)) * TICK))
    expected[:, j] = form.size * column
    jumps = np.abs(np.diff(expected, axis=0, prepend=0)).max(1) > 0.01 * scale[j]
    steady = x.steady & ~(np.convolve(jumps, np.ones(9), "same") > 0)
    assert steady.mean() > 0.3
    error = ((x.extra - expected)[steady].std(0) / scale).max()
    assert error < 5e-3
    share = np.sqrt((expected[:, j] ** 2).mean()) / scales.motors[j]
    assert max(0.6 * LEAST, 5 * error) < share < 1.6 * MOST


@pytest.mark.rotating("long tests of unnamed_laws")
@pytest.mark.parametrize(
    ("name", "encoder"), [("load_speed", "fine"), *rotating(("dither", "4096"))]
)
def test_the_true_form_explains_what_is_left(name, encoder, tmp_path):
    plant = machine(name, 1, encoder, tmp_path)
    result, j = errors(plant), plant.truth.joint
    assert result.taken[j] > 0.5
    assert result.without[j] > 2 * np.delete(result.without, j).max()
    assert np.allclose(np.delete(result.taken, j), 0, atol=0.1)
    written = plant.train[0].stat().st_mtime_ns
    assert machine(name, 1, encoder, tmp_path) == plant  # and it is not made again
    assert plant.train[0].stat().st_mtime_ns == written


@pytest.mark.slow
@pytest.mark.parametrize("name", ["two_dips", "neighbour_drag", "maxwell_hose"])
def test_a_law_is_learned_and_an_equation_proposed(name, tmp_path):
    plant = machine(name, 5, "fine", tmp_path)
    learned = what_is_learned(plant)
    assert float(learned.rsplit(": ", 1)[1].split()[0]) > 0.8, learned
    proposed = what_is_proposed(plant)
    assert "found)" in proposed, proposed


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3])
def test_nothing_is_learned_of_a_machine_that_lacks_nothing(seed, tmp_path):
    lines = what_is_learned(machine(CLEAN, seed, "4096", tmp_path)).splitlines()
    assert all(line.endswith("nothing is learned") for line in lines), lines
