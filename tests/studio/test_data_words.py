"""What the data screen makes of menus and brushes: words of commands that say just that."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.api import load, simulate
from modeler.cli import main
from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs import build_map, parse_map_options
from modeler.studio.log_mapping import (
    ColumnChoice,
    apply_choice,
    build_choices,
    build_map_words,
    select_units,
)
from modeler.studio.project import Project, ProjectLog
from modeler.studio.tasks import TimeRange
from modeler.studio.viewing import log_film, log_guess, log_window


def joints(*names: str) -> tuple[JointSpec, ...]:
    return tuple(JointSpec(name, "revolute", "rad", "N m", True, None) for name in names)


@pytest.fixture(scope="module")
def timeline() -> Any:
    """The module, which imports NiceGUI."""
    from modeler.studio import timeline

    return timeline


FIVE = joints("1", "2", "3", "4", "5")
NAMES = joints("waist", "11", "7")


def drawn_choices(rng, robot):
    """A mapping as a person might click it together."""
    signs = [1, -1]
    alike = rng.random() < 0.5
    stem = rng.choice(["pos{}", "data.pos[{}]", "arm/q[{}]", "Joint {} [x]", "{}_pos", "w 1 {}"])
    table = {"time": ColumnChoice("zeit: s", str(rng.choice(["", "ms", "us"])))}
    unit, sign = str(rng.choice(["", "deg", "0.01 rev/8192"])), int(rng.choice(signs))
    for k, joint in enumerate(robot):
        label = str(rng.choice([joint.name, str(k + 1)])) if not alike else str(k + 1)
        actual = (unit, sign) if alike else (str(rng.choice(["", "deg"])), int(rng.choice(signs)))
        column = f"{stem.format(label)}{'' if alike else f' ({k})'}"
        table[f"q{joint.name}"] = ColumnChoice(column, *actual)
        if rng.random() < 0.7:
            table[f"tau{joint.name}"] = ColumnChoice(f"t={k}:N", str(rng.choice(["N m", "mN m"])))
    return table


@pytest.mark.parametrize("robot", [FIVE, NAMES, joints("1")], ids=["digits", "names", "one"])
@pytest.mark.parametrize("seed", range(12))
def test_words_say_what_was_chosen(robot: tuple[JointSpec, ...], seed: int) -> None:
    wanted = drawn_choices(np.random.default_rng(seed), robot)
    words = build_map_words(wanted, {}, robot)
    columns = {one.column for one in wanted.values()}
    result = build_choices(parse_map_options(words), robot, columns)
    if wanted["time"].unit == "":  # "zeit: s" looks like a column with its unit
        wanted["time"] = ColumnChoice("zeit: s", "s")
    assert result == wanted


def test_patterns_are_found_and_what_is_so_is_not_said() -> None:
    plain = {f"q{j.name}": ColumnChoice(f"pos_{k}", "deg", -1) for k, j in enumerate(FIVE)}
    assert build_map_words(plain, {}, FIVE) == ("q<j>=-pos_{n-1}:deg",)
    late = {f"q{j.name}": ColumnChoice(f"c{k + 12}") for k, j in enumerate(FIVE)}
    assert build_map_words(late, {}, FIVE) == ("q<j>=c{n+11}",)
    local = {f"q{j.name}": ColumnChoice(f"q{j.name}") for j in FIVE}
    assert build_map_words(local, local, FIVE) == ()
    assert build_map_words(local | {"q2": ColumnChoice("q2", "deg")}, local, FIVE) == ("q2=q2:deg",)
    table = {"q<j>": {"column": "enc{n}", "unit": "deg", "scale": 0.01, "offset": 3.0}}
    stated = build_choices(build_map(table, "[log]"), FIVE, [f"enc{k}" for k in range(1, 6)])
    assert stated["q2"] == ColumnChoice("enc2", "0.01 deg", 1, 3.0)
    assert build_map_words(stated, stated, FIVE) == ()


@pytest.mark.parametrize("column", ["-enc", "a -b:deg ", " x"])
def test_names_that_no_word_can_say_are_refused(column: str) -> None:
    with pytest.raises(DataError, match="cannot be named with --map; rename it"):
        build_map_words({"q1": ColumnChoice(column)}, {}, FIVE)


def test_units_that_cannot_be_are_refused() -> None:
    for unit, expected in (("N m", ""), ("furlong", "; expected one such as rad")):
        with pytest.raises(DataError, match=f'q1: got unit "{unit}"{expected}'):
            apply_choice(np.ones(2), "", ColumnChoice("x", unit), "q1", FIVE)


def test_pictures_have_the_numbers_that_commands_read(tmp_path: Path) -> None:
    """The window as the picture maps it is the one that the words of `--map` read."""
    rng = np.random.default_rng(7)
    rows = np.column_stack([np.arange(300) * 2.0, *rng.normal(size=(4, 300)) * 90.0])
    file = tmp_path / "log.csv"
    lines = "\n".join(",".join(map(repr, row)) for row in rows.tolist())
    file.write_text(f"t,a,b,c,d\nms,deg,,kg cm,degC\n{lines}\n", encoding="utf-8")
    one = joints("1", "2")
    for wanted in (
        {
            "q1": ColumnChoice("a"),
            "q2": ColumnChoice("b", "deg", -1),
            "tau1": ColumnChoice("c", "", -1),
            "temperature1": ColumnChoice("d"),
        },
        {
            "q1": ColumnChoice("a", "0.5 rev"),
            "q2": ColumnChoice("b"),
            "tau1": ColumnChoice("c", "mN m"),
            "temperature1": ColumnChoice("d", "K"),
        },
    ):
        clock = ("time=t:ms",)
        raw = log_window(str(file), [c.column for c in wanted.values()], -np.inf, np.inf, clock)
        words = (*clock, *build_map_words(wanted, {}, one))
        robot = tmp_path / "two.toml"
        robot.write_text(
            'name = "two"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j", "a", "theta", "d"]\n'
            'rows = [["1", "0", "q1", 0], ["2", "1", "q2", 1]]\n',
            encoding="utf-8",
        )
        read = log_window(str(file), list(wanted), -np.inf, np.inf, words, str(robot))
        for item, choice in wanted.items():
            stated = {"a": "deg", "c": "kg cm", "d": "degC"}.get(choice.column, "")
            time, values = raw[choice.column]
            np.testing.assert_allclose(time, read[item][0], atol=1e-12)
            shown = apply_choice(values, stated, choice, item, one)
            np.testing.assert_allclose(shown, read[item][1], rtol=1e-12)


def test_a_film_passes_through_the_rows(tmp_path: Path) -> None:
    time = np.arange(0.0, 3.0, 0.01)
    file = tmp_path / "log.csv"
    table = np.column_stack([time, np.sin(time), np.cos(3.0 * time)])
    text = "\n".join(f"{a!r},{b!r},{c!r}" for a, b, c in table.tolist())
    file.write_text(f"time,q1,q2\n{text}\n", encoding="utf-8")
    film = log_film(str(file), ["q1", "q2", "q9"], rate=25.0)
    assert set(film) == {"time", "q1", "q2"} and np.ptp(np.diff(film["time"])) < 1e-9
    np.testing.assert_allclose(film["q1"], np.sin(film["time"]), atol=2e-5)
    assert log_guess(str(file)).joints == 2


# Segments: an algebra of sets, with instants as its elements.


def drawn_log(timeline: Any, rng: np.random.Generator) -> ProjectLog:
    log = ProjectLog("a.csv", train=(TimeRange(),))
    for _ in range(int(rng.integers(1, 9))):
        start, end = np.sort(rng.uniform(0.0, 10.0, 2)).round(2)
        role = str(rng.choice(["train", "test", "out", "in"]))
        log = timeline.assign_role(log, TimeRange(float(start), float(end)), role)
    return log


def inside(parts: tuple[TimeRange, ...], times: np.ndarray) -> np.ndarray:
    none = np.zeros(times.size, dtype=bool)
    return np.any([none, *((times >= p.start) & (times < p.end) for p in parts)], axis=0)


@pytest.mark.parametrize("seed", range(20))
def test_every_instant_has_one_role(timeline: Any, seed: int) -> None:
    rng = np.random.default_rng(seed)
    log, times = drawn_log(timeline, rng), np.arange(-1.0, 12.0, 0.005) + 0.0017
    train, test, out = (inside(getattr(log, role), times) for role in timeline.ROLES)
    assert not (train & test).any() and (train | test).all()
    start, end = np.sort(rng.uniform(0.0, 10.0, 2)).round(2)
    held = TimeRange(float(start), float(end))
    local = inside((held,), times)
    for role in ("train", "test"):
        now = timeline.assign_role(log, held, role)
        assert inside(getattr(now, role), times)[local].all()
        assert not inside(now.out, times)[local].any()
        np.testing.assert_array_equal(inside(now.train, times)[~local], train[~local])
        np.testing.assert_array_equal(inside(now.out, times)[~local], out[~local])
    left = timeline.assign_role(log, held, "out")
    np.testing.assert_array_equal(inside(left.out, times), out | local)
    assert left.train == log.train
    assigned = timeline.assign_role(left, held, "in")
    np.testing.assert_array_equal(inside(assigned.out, times), out & ~local)


def test_first_roles(timeline: Any) -> None:
    a, b, c = (ProjectLog(name) for name in ("a", "b", "c"))
    ends = {"a": (0.0, 10.0), "b": (5.0, 6.0)}
    for logs, train, test in (((a,), "a@:7", "a@7:"), ((a, b, c), "a", "b")):
        project = Project(logs=timeline.assign_default_roles(logs, ends))
        assert (project.collect_words("train"), project.collect_words("test")) == ([train], [test])


# Where warnings lie.


def test_marks_of_a_log_lie_where_it_was_spoilt(tmp_path, capsys):
    rng = np.random.default_rng(3)
    measured, run = simulate(load("emps"), duration=6.0, rate=1000.0, seed=3), tmp_path / "run.csv"
    columns = (measured.time, measured.q[:, 0], measured.tau[:, 0])
    cells = [[repr(float(x)) for x in row] for row in zip(*columns, strict=True)]
    spike, hole, gap = rng.integers([500, 2000, 4000], [1500, 3000, 5000])
    cells[spike][2] = "4000"
    for row in cells[hole : hole + 3]:
        row[1] = ""
    left = cells[:gap] + cells[gap + 150 :]
    run.write_text("\n".join(["time,q1,tau1", *map(",".join, left)]) + "\n", encoding="utf-8")
    said = tmp_path / "said.json"
    assert main(["log", str(run), "--robot", "emps", "--json", str(said)]) == 0
    capsys.readouterr()
    marks = json.loads(said.read_text(encoding="utf-8"))["marks"]
    places = {(mark["kind"], mark["channel"]): mark for mark in marks}
    for kind, channel, first, last in (
        ("spike", "tau1", spike, spike + 1),
        ("missing", "q1", hole, hole + 2),
        ("gap", "time", gap - 1, gap + 150),
    ):
        mark = places[kind, channel]
        assert mark["start"] == pytest.approx(first * 1e-3, abs=1.5e-3)
        assert mark["end"] == pytest.approx(last * 1e-3, abs=1.5e-3)
    assert [mark["start"] for mark in marks] == sorted(mark["start"] for mark in marks)


def test_units_begin_with_what_is_taken_without_one() -> None:
    for items in ("time", "q1", "qd1", "qdd1", "tau1", "qc1", "temperature1"):
        first = select_units(items, FIVE)[0]
        np.testing.assert_allclose(
            apply_choice(np.array([2.0]), "", ColumnChoice("x", first), items, FIVE),
            apply_choice(np.array([2.0]), "", ColumnChoice("x"), items, FIVE),
        )
