"""What is emitted: every function of every built-in robot against the model and against laws."""

import dataclasses
import platform
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
import sympy

import modeler
from modeler.codegen.emit import emit
from modeler.codegen.functions import format_comment, make_prefix, name_macros
from modeler.codegen.workflow import derive, generate
from modeler.core.errors import EmitError
from modeler.core.manifest import parse_manifest
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import build_grouping_matrix
from modeler.robot import parse_robot_text, read_robot, replace_effects
from tests.modules import compiled, module, plain, states
from tests.repository import ROOT
from tests.robots import TREES
from tests.rotation import ROTATING, with_cases

SAMPLES = 40
CLOSE = {"rtol": 0, "atol": 1e-12}


def evaluated(name: str, entries, shape) -> np.ndarray:
    """Graph expressions in numpy, (samples, *shape), for `states`; {index: expression}."""
    model = module(name).model
    values: dict = dict(model.geometry.values) | {"pi": np.pi}
    motions = states(model.geometry.joint_count, SAMPLES)
    for kind, array in zip(("q", "qd", "qdd"), motions, strict=True):
        values |= {f"{kind}[{i}]": array[:, i] for i in range(array.shape[1])}
    result = np.zeros((SAMPLES, *shape))
    columns = model.graph.evaluate_outputs(list(entries.values()), values)
    for index, value in zip(entries, columns, strict=True):
        result[(slice(None), *np.atleast_1d(index))] = value
    return result


def relative(got: np.ndarray, expected: np.ndarray) -> None:
    scale = max(float(np.abs(expected).max(initial=0.0)), 1.0)
    np.testing.assert_allclose(got / scale, expected / scale, **CLOSE)


@pytest.mark.parametrize("name", TREES)
def test_regressors_are_those_of_the_model(name):
    made, library = module(name), plain(name)
    q, qd, qdd = states(made.model.geometry.joint_count, SAMPLES)
    shape = (q.shape[1], len(made.model.columns))
    standard = evaluated(name, made.model.regressor, shape)
    relative(library.regressor(q, qd, qdd), standard)
    columns = [parameter.column for parameter in made.base.parameters]
    relative(library.base_regressor(q, qd, qdd), standard[:, :, columns])
    W = library.observation(q, qd, qdd)
    relative(W, standard[:, :, columns].reshape(-1, len(columns)))
    rows, places = np.array(made.emitted.spec.nonzeros).T
    relative(library.nonzeros(q, qd, qdd), standard[:, :, columns][:, rows, places])


@pytest.mark.parametrize("name", TREES)
def test_torques_and_their_parts_are_the_regressor_of_standard_parameters_times_these(name):
    """Recursion with base parameters = product with standard ones: two ways to the same torque."""
    made, library = module(name), plain(name)
    chi = np.random.default_rng(8).normal(size=len(made.model.columns))
    beta = build_grouping_matrix(made.model, made.base.parameters) @ chi  # by the exact relations
    q, qd, qdd = states(made.model.geometry.joint_count, SAMPLES)
    still = np.zeros_like(q)

    def torque(qd, qdd):
        return library.regressor(q, qd, qdd) @ chi

    relative(library.base_parameters(chi), beta)
    relative(library.inverse_dynamics(q, qd, qdd, beta), torque(qd, qdd))
    M, gravity = library.inertia_matrix(q, beta), library.gravity(q, beta)
    coriolis, friction = library.coriolis(q, qd, beta), library.friction(qd, beta)
    np.testing.assert_array_equal(M, M.transpose(0, 2, 1))
    relative(np.einsum("nij,nj->ni", M, qdd), torque(qd, qdd) - torque(qd, still))
    rest = library.friction(still, beta)  # offsets act at standstill
    relative(gravity + rest, torque(still, still))
    relative(coriolis + gravity + friction, torque(qd, still))
    # Velocity products: even in the speeds, quadratic in their size.
    relative(library.coriolis(q, -2 * qd, beta), 4 * coriolis)


@with_cases(
    "name",
    *("wrist", "five-bar"),
    *(pytest.param(n, marks=ROTATING) for n in ("puma560", "sr400", "orthoglide-2003")),
)
def test_an_optimising_compiler_changes_roundings_only(name):
    """As users compile it; all other tests here take the C unoptimised."""
    model = module(name).model
    q, qd, qdd = states(len(model.robot.coordinates), SAMPLES)
    if model.closure is not None:
        q = 0.02 * q + np.array(model.closure.home)[list(model.closure.actuated)]
    beta = np.random.default_rng(9).normal(size=module(name).base.rank)
    for call in (
        lambda c: c.base_regressor(q, qd, qdd),
        lambda c: c.inverse_dynamics(q, qd, qdd, beta),
        lambda c: c.inertia_matrix(q, beta),
    ):
        fast, slow = call(compiled(name)), call(plain(name))
        scale = np.abs(slow).max()
        np.testing.assert_allclose(fast / scale, slow / scale, rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", TREES)
def test_the_manifest_survives_its_file_and_describes_the_module(name):
    made = module(name)
    spec = made.emitted.spec
    read = parse_manifest(made.emitted.files["manifest.json"], "here")
    assert read == spec and read.compute_signature() == spec.compute_signature()
    assert spec.compute_signature() in made.emitted.files[f"{spec.prefix}.c"]
    model = made.model
    columns = {p.column: i for i, p in enumerate(made.base.parameters)}
    assert set(spec.nonzeros) == {(j, columns[k]) for j, k in model.regressor if k in columns}
    for base in spec.base:
        assert base.terms[0].parameter == base.column_of


@pytest.mark.parametrize("name", [*TREES, "five-bar"])
def test_the_text_is_the_same_each_time_and_names_no_place_of_this_machine(name):
    emitted = module(name).emitted
    here = [str(ROOT), str(Path.home()), tempfile.gettempdir(), platform.node()]
    versions = [modeler.__version__, platform.python_version(), sympy.__version__, np.__version__]
    items = (f"{emitted.spec.prefix}_generator.h", "manifest.json")  # these say what wrote them
    for file, text in emitted.files.items():
        for word in (*here, *(versions[1:] if file in items else versions)):
            assert not re.search(rf"(?<![\w.]){re.escape(word)}(?![\w.])", text), (file, word)
        assert not re.search(r"\b(19|20)\d\d-\d\d?-\d\d?\b|\b\d\d:\d\d\b", text), file
        assert "\r" not in text and text.endswith("\n"), file
        if file.endswith((".c", ".h")):
            text.encode("ascii")
            if name != "five-bar" or "/" in file:  # of loops, programs alone are held to it
                assert max(len(line) for line in text.splitlines()) <= 100, file
    if name == "emps":
        model = derive_model(read_robot(name))
        assert emit(model, derive_base_parameters(model)).files == emitted.files


def test_operation_counts_are_those_that_were_measured_as_reachable():
    """Base regressors without friction: as few operations as any tool's (SymEngine 498+688)."""
    spec = module("panda").emitted.spec
    if any(p.kind != "inertial" for p in spec.standard):
        pytest.skip("the built-in panda has friction now; count changes")
    counts = {f.name: (f.additions, f.multiplications) for f in spec.functions}
    additions, multiplications = counts["panda_base_regressor"]
    assert additions <= 498 and multiplications <= 685


def test_a_title_cannot_break_out_of_its_comment():
    made = module("wrist")
    robot = dataclasses.replace(made.model.robot, title='*/ int evil; /* "naïve"\nrobot')
    model = dataclasses.replace(made.model, robot=robot)
    text = emit(model, made.base).files["wrist.h"]
    assert "*/ int evil" not in text.split("#ifndef")[0]
    assert text.isascii()


def test_robot_names_become_c_names_and_those_that_would_clash_are_refused():
    assert [*map(make_prefix, ("sr400-tree", "3rrr", "UR10e", "ö"))] == [
        *"sr400_tree robot_3rrr ur10e robot".split()
    ]
    with pytest.raises(EmitError, match="start with modeler_ are taken"):
        make_prefix("modeler-batch")
    with pytest.raises(EmitError, match="symbol é has letters"):
        name_macros("arm", ["é"])
    with pytest.raises(EmitError, match=r"math\.h is a header of C; choose another"):
        make_prefix("Math")


def test_a_robot_without_base_parameters_is_refused():
    made = module("wrist")
    with pytest.raises(EmitError, match="wrist has no base parameters"):
        emit(made.model, dataclasses.replace(made.base, parameters=()))


def test_the_header_says_which_effects_friction_holds_that_act_at_rest():
    text = read_robot("two-link").text
    springs = {"viscous": "all", "spring": [{"joint": "2", "q0": 0.5, "h": 0.0}]}
    emitted = generate(derive(parse_robot_text(replace_effects(text, springs), "springs")))
    header = " ".join(emitted.files["two_link.h"].replace("\n *", " ").split())
    apart = "offsets and the spring of joint 2, which the friction function holds."
    assert f"hold the robot still, without friction, {apart}" in header
    assert "friction, offsets, the spring of joint 2." in header
    friction = next(f for f in emitted.spec.functions if f.name.endswith("_friction"))
    assert friction.equation == "f(q, qd) with the spring of joint 2"


def test_letters_of_comments_are_written_in_ascii():
    text = "Prüfstand é Größe u\u0308 – 5° 工"
    assert format_comment(text) == "Pruefstand e Groesse ue - 5 deg ?"
