"""Parameters that change at run time: seal, check, a store without tears, payload by addition."""

import shutil
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest

from modeler.api.workflow import load
from modeler.codegen import derive, generate
from modeler.codegen.control import Control
from modeler.robot import INERTIAL
from modeler.robot.read import read_robot
from tests.bodies import buildable
from tests.control.draw import emitted
from tests.modules import STRICT, compiler, loaded, plain

NAME = "two-link"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    where = tmp_path_factory.mktemp("set")
    generate(derive(load(NAME)), where, control=Control())
    shutil.copy(Path(__file__).parent / "sets.c", where)
    return where


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("cc", "flags"),
    [("gcc", ["-fsanitize=thread"]), ("gcc", ["-fsanitize=address,undefined"]), ("clang", [])],
)
def test_sets_are_checked_and_never_torn(folder, cc, flags):
    sources = ["sets.c", "two_link.c", "two_link_base_regressor.c", "two_link_control.c"]
    strict = [flag for flag in STRICT if flag != "-Wpedantic"]
    made = folder / f"sets-{cc}{len(flags)}"
    command = [compiler(cc), *strict, "-O1", "-g", *flags, "-o", made, *sources]
    subprocess.run([*command, "-lm", "-lpthread"], cwd=folder, check=True)
    done = subprocess.run([made], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    checksum, widths = map(int, done.stdout.split())
    spec = emitted(NAME)[1].spec
    numbers = [0.5 + i for i in range(len(spec.base))] + [0.01] * widths
    words = [int(spec.compute_signature()[i : i + 8], 16) for i in (0, 8)]
    stated = np.array(words, np.uint32).tobytes() + np.array(numbers).tobytes()
    assert checksum == zlib.crc32(stated)


def test_widths_at_run_time():
    model, random = loaded(emitted(NAME)[1]), np.random.default_rng(4)
    values = buildable(model.spec, random)
    chi = dict(zip([p.name for p in model.spec.standard], values, strict=True))
    beta, n = model.base_parameters(values), len(model.spec.joints)
    q, qd, qdd = random.normal(size=(3, 20, n))
    specs = {f.name.removeprefix(f"{model.spec.prefix}_"): f for f in model.spec.control.functions}
    count = specs["smooth_friction"].inputs[-1].size
    assert count == n
    width = random.uniform(0.01, 1, n)
    sharp = model.inverse_dynamics(q, qd, qdd, beta)
    state = {"q": q, "qd": qd, "qdd": qdd}
    none = model.evaluate("smooth_inverse_dynamics", **state, beta=beta, widths=np.zeros(n))
    np.testing.assert_array_equal(none, sharp)
    smooth = model.evaluate("smooth_friction", qd=qd, beta=beta, widths=width)
    Fs = np.array([chi[f"Fs{j.name}"] for j in model.spec.joints])
    expected = model.friction(qd, beta) + Fs * (np.tanh(qd / width) - np.sign(qd))
    np.testing.assert_allclose(smooth, expected, atol=1e-12)
    whole = model.evaluate("smooth_inverse_dynamics", q=q, qd=qd, qdd=qdd, beta=beta, widths=width)
    np.testing.assert_allclose(whole - sharp, smooth - model.friction(qd, beta), atol=1e-9)


def test_a_payload_is_added_to_the_parameters():
    """beta += K chi_load, against Pinocchio's robot with that body on its last link."""
    from tests.oracles.pinocchio_dynamics import pin, places_of

    model, random = plain("puma560"), np.random.default_rng(5)
    chi, load = (buildable(model.spec, random) for _ in range(2))
    felt = {f"{prefix}{model.spec.joints[-1].name}" for prefix in INERTIAL}
    load[[p.name not in felt for p in model.spec.standard]] = 0.0
    beta = model.base_parameters(chi) + model.base_parameters(load)
    q, qd, qdd = random.normal(size=(3, 10, len(model.spec.joints)))
    tau = model.inverse_dynamics(q, qd, qdd, beta) - model.friction(qd, beta)
    both = dict(zip([p.name for p in model.spec.standard], chi + load, strict=True))
    other, rows = places_of(read_robot("puma560"), both)
    data = other.createData()
    theirs = np.array([pin.rnea(other, data, *state) for state in zip(q, qd, qdd, strict=True)])
    assert rows == list(range(6))
    assert np.abs(tau - theirs).max() <= 1e-10 * np.abs(theirs).max()
