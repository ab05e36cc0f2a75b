"""The example programs of a fitted folder, compiled as they are, against the simulated machine."""

import dataclasses
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.core.choices import read_builtin_robot
from modeler.core.figure import BLUE, GREEN, VERMILLION, Curve, Panel, Picture, Style
from modeler.robot.edit import replace_effects
from modeler.robot.read import parse_robot_text, read_robot
from modeler.runtime import load_folder
from modeler.simulation import HiddenEffect, SimulationSettings
from tests.codegen.fitted_library import fitted_of, robot_module
from tests.csrc.emitted_folders import built, make
from tests.csrc.simulated_machine import Machine, fitted_folder, observed, replies, rms, true_folder
from tests.modules import loaded, module, unoptimised
from tests.when_used import WhenUsed

figure_matplotlib = WhenUsed("modeler.views.figure_matplotlib")

FROM = 1.5  # s, when the push begins
TOOL = """
[tool]
x = 0.03
z = 0.12
pitch = 0.4
"""
PROGRAMS = ("example_computed_torque", "example_residual_observer")
BRISTLE = HiddenEffect("presliding", "2", {"distance": 0.01, "damping": 1.0})


def driven(folder: Path, machine: Machine, size: float) -> tuple[np.ndarray, np.ndarray]:
    """(n, joints) tracking errors and r, with a push of joint 2 from FROM on."""
    seen = []

    def line(k: int, *state: np.ndarray) -> np.ndarray:
        seen.append(np.concatenate(state))
        return machine.tracking(k, *state)

    def push(t: float) -> np.ndarray:
        return np.where(np.arange(machine.joints) == 1, size if t >= FROM else 0.0, 0.0)

    tick = machine.reference.time[1]
    run = machine.drive([folder / "example_computed_torque", 3.0, tick], line, push)
    return run.error, observed([folder / "example_residual_observer", 30.0, tick], np.array(seen))


@pytest.mark.rotating("long tests of csrc")
@pytest.mark.parametrize("name", ["demo-arm", "five-bar"])
def test_the_examples_follow_the_motion_and_see_a_push(name, tmp_path):
    """A chain and a loop, values of a fit. Measured: errors of 0.1 % of the motion, a push that is
    0.2 % too small."""
    robot, folder = read_robot(name), tmp_path / "c"
    fitted_folder(robot, folder)
    make(folder, "examples")
    settings = SimulationSettings(duration=2.5, rate=500.0, seed=5, controller=bool(robot.loops))
    plant = Machine(robot, settings)
    time, size = plant.reference.time, 0.2 * plant.torque
    error, pushed = driven(folder, plant, size)
    assert np.all(rms(error[time <= FROM]) < 0.003 * rms(plant.moved))
    assert np.all(np.abs(pushed[time <= FROM].mean(axis=0)) < 0.05 * size)
    seen = pushed[time > FROM + 0.3].mean(axis=0)
    assert abs(seen[1] - size) < 0.02 * size
    assert np.all(np.abs(np.delete(seen, 1)) < 0.05 * size)


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_line_that_is_no_sample_is_told(name, tmp_path):
    """Too short, too long, no number: status 1; the end of the input after a line: status 0."""
    folder = built(values_of("two-link"), tmp_path, *PROGRAMS)
    width = 2 * (5 if name == "example_computed_torque" else 3)
    good = " ".join(["0.1"] * width)
    short = " ".join(["0.1"] * (width - 1))

    def ran(text: str) -> tuple[int, int, str]:
        done = subprocess.run([folder / name], input=text, capture_output=True, text=True)
        return done.returncode, len(done.stdout.splitlines()), done.stderr

    for text in ("", "\n", good, f"{good}\n", f"{good}\r\n\n"):
        assert ran(text) == (0, int("0.1" in text), "")
    for bad, count in ((short, width - 1), (f"{good} 1", width), (f"{short} x", width - 1)):
        for text in (f"{good}\n{bad}", f"{good}\n{bad}\n{good}\n"):
            status, answers, said = ran(text)
            assert (status, answers) == (1, 1)
            assert f"a line has {count}" in said and f"expected {width}: q, qd, " in said


@pytest.mark.slow
def test_the_controller_carries_what_friction_remembers(tmp_path):
    """A bristle on joint 2 of the machine: the error there falls from 2.5 to 0.07 mrad rms.

    And the observer, which carries it too, takes it for no push any more: 0.06 N m for 3.7.
    """
    settings = SimulationSettings(duration=3.0, rate=1000.0, seed=5, hidden=(BRISTLE,))
    plant = Machine(read_robot("demo-arm"), settings)
    (bristle,) = plant.hidden
    level, distance = bristle.values["level"], bristle.values["distance"]
    usual = dict.fromkeys(("rotor_inertia", "viscous", "coulomb", "offset"), "all")
    bristles = {"presliding": [{"joint": "2", "d": distance}]}
    errors = []
    for name, effects in (("forgets", usual), ("remembers", {**usual, **bristles})):
        text = replace_effects(read_builtin_robot("demo-arm"), effects)
        true = {**plant.standard, "Fs2": level, "Fz2": level}
        true["Fzd2"] = bristle.values["damping"]
        true_folder(parse_robot_text(text, "demo-arm"), true, tmp_path / name)
        make(tmp_path / name, "examples")
        errors.append([rms(values)[1] for values in driven(tmp_path / name, plant, 0.0)])
    forgetting, remembering = np.array(errors)
    assert np.all(remembering < 0.1 * forgetting)


def test_torques_are_held_where_the_loops_do_not_close_and_the_program_gives_up(tmp_path):
    emitted = values_of("five-bar")
    built(emitted, tmp_path, *PROGRAMS)
    home = np.array([emitted.spec.closure.home[k] for k in emitted.spec.closure.actuated])
    good = np.concatenate([home, np.zeros(2), home, np.zeros(4)])
    bad = np.concatenate([home + 100.0, good[2:]])
    bad[0] = np.nan
    torque = tmp_path / "example_computed_torque"
    answers, code, said = replies([torque], [good, bad, bad, good])
    assert code == 0 and said.count("torques held") == 2
    for answer in answers[1:]:
        np.testing.assert_array_equal(answer, answers[0])
    answers, code, said = replies([torque], [good, *[bad] * 8, good])
    assert code == 1 and len(answers) == 4 and said.count("torques held") == 4
    rows = [np.concatenate([row[:4], np.ones(2)]) for row in (good, good, bad, good, good)]
    answers, code, said = replies([tmp_path / "example_residual_observer"], rows)
    assert code == 0 and said.count("r is held") == 1
    assert np.all(np.isfinite(answers))
    np.testing.assert_array_equal(answers[2], answers[1])
    np.testing.assert_allclose(answers[3], answers[2], rtol=1e-9)


def values_of(name: str):
    made = robot_module(name)
    return emit(made.model, made.base, fitted_of(made.emitted.spec), control=Control())


def test_a_robot_with_a_joint_that_nothing_drives_has_no_example_loop():
    from modeler.codegen.package import EXAMPLES, select_examples

    spec = values_of("demo-arm").spec
    passive = dataclasses.replace(spec.joints[1], actuated=False)
    rigid = tuple(name for name in EXAMPLES if name != "example_elastic")
    assert select_examples(spec) == rigid
    joints = (spec.joints[0], passive, *spec.joints[2:])
    assert select_examples(dataclasses.replace(spec, joints=joints)) == ()
    assert select_examples(module("demo-arm").emitted.spec) == ()


def draw_learning(time: np.ndarray, off: np.ndarray, error: np.ndarray) -> None:
    """The picture of docs/how-to/controller.md."""
    learnt = Curve("torques of the learnt parameters", time, 100 * off, Style(BLUE))
    joints = [
        Curve(f"joint {k + 1}", time, error[:, k], Style(color))
        for k, color in enumerate((BLUE, VERMILLION, GREEN))
    ]
    learned = Panel("", "time [s]", "off by [%]", (learnt,))
    tracking = Panel("", "time [s]", "tracking error [mrad]", tuple(joints))
    picture = Picture(
        "adaptive",
        "A controller that learns its parameters from nothing",
        "",
        ((learned, tracking),),
        320,
    )
    place = Path(__file__).parents[2] / "docs" / "how-to" / "adaptive.svg"
    place.write_bytes(figure_matplotlib.render_images(picture)["svg"])


@pytest.mark.rotating("long tests of csrc")
def test_the_adaptive_example_learns_the_parameters(tmp_path, capsys, regenerate):
    """From nothing: beta's error, weighed by what the motion determines, falls; so does tracking's.

    Measured: 29 % after 1 s, 2 % after 6 s.
    """
    settings = SimulationSettings(duration=6.0, rate=1000.0, seed=8)
    robot = read_robot("demo-arm")
    plant = Machine(robot, settings)
    true_folder(robot, plant.standard, tmp_path)
    make(tmp_path, "example_adaptive")
    ref = plant.reference

    run = plant.drive([tmp_path / "example_adaptive", 10.0, 10.0, 0.001], plant.tracking)
    beta = run.answers[:, plant.joints :]
    model = module("demo-arm")
    c, standard = loaded(model.emitted), model.emitted.spec.standard
    true = c.base_parameters([plant.standard[p.name] for p in standard])
    W = c.observation(ref.q[::20], ref.qd[::20], ref.qdd[::20])
    off = np.linalg.norm((beta - true) @ W.T, axis=1) / np.linalg.norm(W @ true)
    with capsys.disabled():
        for second in range(7):
            now = off[min(1000 * second, len(off) - 1)]
            print(f"{second} s: torques of beta {100 * now:.2f} % off")
    if regenerate:
        shown = np.linspace(0, len(off) - 1, 150, dtype=int)
        draw_learning(ref.time[shown], off[shown], 1e3 * run.error[shown])
    assert off[-1] < 0.05
    assert np.linalg.norm(run.error[-1000:]) < 0.5 * np.linalg.norm(run.error[:1000])


def circle(time: np.ndarray, radius: float) -> list[np.ndarray]:
    """Position, speed, acceleration, (n, 3), of one turn that begins and ends at rest."""
    x = time / time[-1]
    turn = 2 * np.pi * (10 * x**3 - 15 * x**4 + 6 * x**5)
    rate = 2 * np.pi * 30 * x**2 * (1 - x) ** 2 / time[-1]
    more = 2 * np.pi * 60 * x * (1 - x) * (1 - 2 * x) / time[-1] ** 2
    c, s, none = np.cos(turn), np.sin(turn), 0 * turn
    along = [
        [c - 1, s, none],
        [-s * rate, c * rate, none],
        [-c * rate**2 - s * more, c * more - s * rate**2, none],
    ]
    return [radius * np.array(each).T for each in along]


@pytest.mark.rotating("long tests of csrc")
def test_the_tool_follows_a_path_in_space_and_feels_a_push_of_5_newton(tmp_path):
    """A circle of 5 cm in 2.5 s, the wrist held still; then a push."""
    robot = parse_robot_text(read_builtin_robot("puma560") + TOOL, "puma560")
    plant = Machine(robot, SimulationSettings(duration=2.5, rate=500.0, seed=5))
    true_folder(robot, plant.standard, tmp_path)
    make(tmp_path, "example_cartesian", "example_residual_observer")
    with unoptimised():
        model, time = load_folder(tmp_path), plant.reference.time
    start = model.evaluate("pose", q=plant.reference.q[:1])[0]
    path, force = circle(time, 0.05), np.array([3.0, 0.0, -4.0])

    seen = []

    def line(k: int, q: np.ndarray, qd: np.ndarray, tau: np.ndarray) -> np.ndarray:
        seen.append(np.concatenate([q, qd, tau]))
        T = start.copy()
        T[:, 3] += path[0][k]
        rest = np.zeros(3)
        return np.concatenate([q, qd, T.ravel(), path[1][k], rest, path[2][k], rest])

    def outside(t: float) -> np.ndarray:
        if t < FROM:
            return np.zeros(6)
        return force @ model.evaluate("jacobian", q=seen[-1][:6])[0, :3]

    plant.drive([tmp_path / "example_cartesian", 3.0, time[1]], line, outside)
    rows = np.array(seen)
    q = rows[:, :6]
    r = observed([tmp_path / "example_residual_observer", 30.0, time[1]], rows)
    J = model.evaluate("jacobian", q=q)
    felt = np.array([np.linalg.lstsq(j.T, x)[0][:3] for j, x in zip(J, r, strict=True)])
    before, late = (time > 0.3) & (time < FROM), time > FROM + 0.3
    T = model.evaluate("pose", q=q)[time < FROM]
    turned = np.einsum("kij,il->kjl", T[:, :, :3], start[:, :3])
    away = np.linalg.norm(rms(T[:, :, 3] - start[:, 3] - path[0][time < FROM]))
    assert away < 2e-5 and np.abs(turned - np.eye(3)).max() < 1e-3
    assert np.linalg.norm(felt[late].mean(axis=0) - force) < 0.2
    assert np.linalg.norm(felt[before].mean(axis=0)) < 0.05
