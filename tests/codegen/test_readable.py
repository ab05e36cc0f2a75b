"""Names of temporaries: they say what is true, and hang on nothing else."""

import numpy as np
import pytest

from modeler.api.workflow import load
from modeler.codegen.block import Naming
from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.codegen.workflow import derive
from modeler.derivation import Label
from modeler.derivation.derive import derive_model
from modeler.robot import parse_robot_text
from tests.codegen.fitted_library import SLOW, fitted_of
from tests.modules import module
from tests.rotation import rotating


def test_the_text_does_not_depend_on_what_was_asked_of_the_model_before() -> None:
    first = derive(load("scara"))
    before = dict(emit(first.model, first.base).files)
    assert dict(emit(first.model, first.base, fitted_of(module("scara").emitted.spec)).files)
    first.closed_form()
    first.model.derive_forward_kinematics()
    assert dict(emit(first.model, first.base).files) == before
    second = derive(load("scara"))
    second.closed_form()
    second.regressor()
    assert dict(emit(second.model, second.base).files) == before


@pytest.mark.parametrize("name", ["scara", *rotating("five-bar")])
def test_the_names_of_a_robot_do_not_depend_on_its_other_units(name: str) -> None:
    """Its signature neither: a model fitted without them belongs to a folder with them."""
    made = module(name)
    fitted = fitted_of(made.emitted.spec)
    more = emit(made.model, made.base, fitted, control=Control())
    for file, text in made.emitted.code.items():
        if "tile" not in file and "/" not in file and file.endswith(".c"):
            assert more.files[file] == text, file
    unit = f"{made.emitted.spec.prefix}_fitted.c"
    assert emit(made.model, made.base, fitted).files[unit] == more.files[unit]


def values_at(model, refs, q, qd, qdd) -> np.ndarray:
    known = dict(model.geometry.values)
    for kind, row in (("q", q), ("qd", qd), ("qdd", qdd)):
        known |= {f"{kind}[{i}]": x for i, x in enumerate(row)}
    return np.array(model.graph.evaluate_outputs(refs, known), dtype=float)


@pytest.mark.parametrize("robot", [*rotating("ur10e"), "scara", "slow-arm"])
def test_labels_tell_the_truth(robot: str) -> None:
    """w, wd, vd, e and m against differences of the forward kinematics along a motion."""
    model = derive_model(parse_robot_text(SLOW, robot)) if robot == "slow-arm" else None
    model = model or derive_model(load(robot))
    with model.restore_labels():
        labels = model.graph.labels.copy()
    random = np.random.default_rng()
    n = model.geometry.coordinate_count
    q, qd, qdd = random.uniform(-1, 1, (3, n))
    poses = np.array(model.derive_forward_kinematics(), dtype=object)
    names = [row.joint.name for row in model.geometry.rows if row.index is not None]

    def pose(at, way) -> np.ndarray:
        flat = values_at(model, list(poses.ravel()), at, 0 * at, 0 * at)
        return flat.reshape(poses.shape)[names.index(way)]

    h = 1e-4
    g = [model.algebra.static(x) for x in model.geometry.gravity]
    down = values_at(model, g, q, qd, qdd)

    def along(link, t) -> np.ndarray:
        return pose(q + t * qd + t * t / 2 * qdd, link)

    def spin(link, t, path=along) -> np.ndarray:
        ahead, behind, now = path(link, t + h), path(link, t - h), path(link, t)
        turning = now[:, :3].T @ (ahead - behind)[:, :3] / (2 * h)
        return np.array([turning[2, 1], turning[0, 2], turning[1, 0]])

    checked = set()
    for node, label in labels.items():
        if label.step or label.quantity not in ("w", "wd", "vd", "e", "m"):
            continue
        link, now = label.link, along(label.link, 0)
        if label.quantity in ("e", "m"):
            j = [joint.name for joint in model.robot.free_joints].index(label.of)
            unit = np.eye(n)[j]
            path = lambda link, t, unit=unit: pose(q + t * unit, link)  # noqa: E731
            moved = (path(link, h) - path(link, -h))[:, 3] / (2 * h)
            expected = spin(link, 0, path) if label.quantity == "e" else now[:, :3].T @ moved
        elif label.quantity == "w":
            expected = spin(link, 0)
        elif label.quantity == "wd":
            expected = (spin(link, h) - spin(link, -h)) / (2 * h)
        else:
            second = (along(link, h) - 2 * now + along(link, -h))[:, 3] / h**2
            expected = now[:, :3].T @ (second - down)
        (got,) = values_at(model, [type(poses.flat[0])(model.graph, node)], q, qd, qdd)
        sign = -1.0 if label.minus else 1.0
        assert sign * got == pytest.approx(expected["xyz".index(label.component)], abs=2e-5), label
        checked.add(label.quantity)
    assert checked >= {"w", "wd", "vd"} and len(labels) > 20


def test_names_are_c_names_and_differ_where_letters_fall_together() -> None:
    label = Label("w", "leg a", "x", "", "", True)
    graph = module("wrist").model.graph
    graph.links["leg a"] = next(iter(graph.links.values()))
    labels = {2: label, 3: label, 4: label._replace(link="3", component="")}
    made = Naming(graph, labels, {"t1": 2, "t2": 3, "t3": 4}, ["W3 = 1;"])
    lines = made.write_names([f"const double t{k} = {k}.0;" for k in (1, 2, 3)], "/* {} */")
    names = [line.split()[-3] for line in lines]
    assert names == ["minus_w_lega_x", "minus_w_lega_x_2", "minus_w3"]
    del graph.links["leg a"]
