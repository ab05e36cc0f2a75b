"""Names and units of logs: what is understood, what is refused, and with which words."""

import numpy as np
import pytest
import scipy.constants as known

from modeler.api import read_currents, read_logs
from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import build_map, find_unit, parse_map_options, parse_unit
from modeler.regression.read import read_log
from tests.logs import writers

TURN = JointSpec("1", "revolute", "rad", "N m", True, 2.0)
SLIDE = JointSpec("2", "prismatic", "m", "N", True, None)
JOINTS = (TURN, SLIDE)

FACTORS = {
    **{"deg": known.degree, "°": known.degree, "rev": 2 * known.pi, "mrad": 1e-3, "rad/s": 1.0},
    **{"rpm": 2 * known.pi / known.minute, "rev/8192": 2 * known.pi / 8192, "%": 0.01},
    **{"deg/s": known.degree, "deg/s^2": known.degree, "deg/s²": known.degree},
    **{"0.1 deg": known.degree / 10, "m": 1.0, "mm": 1e-3, "um": known.micro, "in": known.inch},
    **{"ft/min": known.foot / 60, "s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9},
    **{"min": 60.0, "A": 1.0, "mA": 1e-3, "N m": 1.0, "Nm": 1.0, "N*m": 1.0, "N·m": 1.0},
    **{"N.m": 1.0, "mN m": 1e-3, "kN": 1e3, "lbf in": known.lbf * known.inch},
    **{"kgf cm": known.kgf * 0.01, "ozf in": known.lbf / 16 * known.inch},
}


@pytest.mark.parametrize("text", FACTORS)
def test_factors_are_those_of_another_table(text):
    assert parse_unit(text).factor == pytest.approx(FACTORS[text], rel=1e-14)


@pytest.mark.parametrize(
    "text", ["", "x", "deg//s", "/s", "0 deg", "1e400", "m^", "furlong", "[ms]"]
)
def test_what_is_no_unit(text):
    assert find_unit(text) is None
    with pytest.raises(DataError, match="expected a unit such as deg"):
        parse_unit(text)


def table_of(tmp_path, mapping, names=("t", "a", "b", "c", "d"), **columns):
    n = 40
    values = {"t": np.arange(n) * 2.0}
    values |= {name: np.linspace(k, k + 3.0, n) for k, name in enumerate(names[1:], start=1)}
    path = writers.parquet(tmp_path / "a.parquet", values | columns)
    read = parse_map_options(mapping) if isinstance(mapping, list) else build_map(mapping, "R")
    return LogTable(path, read, JOINTS), values


TURNED = {"column": "a", "unit": "rev/100", "sign": -1, "offset": 25}
SCALED = {"column": "a", "unit": "rpm", "scale": 0.01}
CONVERTED = [
    ({"q1": "a [deg]"}, "q1", lambda v: np.deg2rad(v["a"])),
    ({"q1": TURNED}, "q1", lambda v: (25.0 - v["a"]) * 2 * np.pi / 100),
    ({"qd1": SCALED}, "qd1", lambda v: v["a"] * 0.01 * 2 * np.pi / 60),
    ({"q2": "b [mm]"}, "q2", lambda v: v["b"] / 1000),
    ({"tau1": {"column": "a", "unit": "kg cm"}}, "tau1", lambda v: v["a"] * 9.80665 / 100),
    ({"tau1": {"column": "a", "unit": "lb in"}}, "tau1", lambda v: v["a"] * known.lbf * known.inch),
    ({"tau2": {"column": "a", "unit": "kg"}}, "tau2", lambda v: v["a"] * known.kgf),
    ({"current1": "c [mA]"}, "current1", lambda v: v["c"] / 1000),
    ({"current1": "c"}, "current1", lambda v: v["c"]),
    ({"temperature1": "d [K]"}, "temperature1", lambda v: v["d"] - 273.15),
    ({"temperature1": "d [°F]"}, "temperature1", lambda v: (v["d"] - 32) / 1.8),
    ({"pressure": "d [kN]"}, "pressure", lambda v: 1000 * v["d"]),
    ({"rate": 250}, "time", lambda v: np.arange(40) / 250),
    ({"time": "t [ms]"}, "time", lambda v: v["t"] / 1000),
    (["q1=-a:deg"], "q1", lambda v: -np.deg2rad(v["a"])),
    (["tau1=a:mN m"], "tau1", lambda v: v["a"] / 1000),
    (["names=1:a,2:b", "q<j>={name}"], "q2", lambda v: v["b"]),
    (["q<j>=a:deg", "q<j>=b:rev", "q2=c:mm"], "q1", lambda v: v["b"] * 2 * np.pi),
    (["rate=100"], "time", lambda v: np.arange(40) / 100),
]


@pytest.mark.parametrize(("mapping", "local", "expected"), CONVERTED)
def test_columns_are_converted(tmp_path, mapping, local, expected):
    table, values = table_of(tmp_path, mapping)
    assert table.read_numbers(local) == pytest.approx(expected(values), rel=1e-13, abs=1e-13)


def test_a_column_may_be_called_with_its_unit(tmp_path):
    """CSV files say it there; the whole name is the column then."""
    table, _ = table_of(tmp_path, {"time": "t [ms]"}, **{"t [ms]": np.arange(40) * 4.0})
    assert table.read_numbers("time")[1] == pytest.approx(0.004)
    assert table.format_name("time") == "t [ms] (time)"


def test_our_own_names_serve_where_log_names_a_column_that_is_not_there(tmp_path):
    table, _ = table_of(tmp_path, {"q<j>": "pos{j} [deg]"}, q1=np.full(40, 0.5), q2=np.ones(40))
    assert (table.read_numbers("q1") == 0.5).all()


def test_places_of_joints_are_counted_from_one_or_zero(tmp_path):
    columns = {"x0": np.zeros(40), "x1": np.ones(40), "y1": np.full(40, 2.0)}
    table, _ = table_of(tmp_path, {"q<j>": "x{n-1}", "tau<j>": "y{n}"}, **columns)
    assert (table.read_numbers("q2") == 1.0).all() and (table.read_numbers("tau1") == 2.0).all()
    assert "no column y2 for tau2" in table.notes


WRONG = [
    (
        {"q2": "b [deg]"},
        r'R, q2: got unit "deg", which is an angle; q2 is a position of joint 2, '
        r"which is prismatic: expected a unit such as mm, m, in",
    ),
    ({"q1": "a [mm]"}, r'R, q1: got unit "mm", which is a length; q1 is a position of joint 1'),
    ({"qd1": "a [deg]"}, r"qd1 is a speed of joint 1, .*such as deg/s, rad/s, rev/s, rpm"),
    ({"tau1": "a [mA]"}, r"is a current; tau1 is a torque .*; a current is called current<j>"),
    ({"tau2": "a [N m]"}, r"which is a torque; tau2 is a force of joint 2"),
    ({"time": "t [mm]"}, r"time is a time: expected a unit such as s, ms"),
    ({"q1": 3}, r"R, q1: got 3; expected the name of a column, or a table"),
    ({"q1": {"colum": "a"}}, r"R, q1: unknown key colum \(did you mean column\?\)"),
    ({"q1": {"column": "a", "unit": "grad"}}, r"R, q1: got unit 'grad'; expected a unit such as"),
    ({"q1": {"column": "a", "sign": 2}}, r"R, q1: sign is 2; expected 1 or -1; .* scale"),
    ({"q1": {"column": "a", "scale": 0}}, r"R, q1: scale is 0"),
    ({"q1": {"column": "a", "offset": "x"}}, r"R, q1: offset is 'x'; expected a number"),
    ({"q<j><j>": "a"}, r"expected a name such as q2, or a pattern such as q<j>"),
    ({"q1": {"column": ""}}, r"R, q1: column is ''"),
    ({"topic": 3}, r"R, topic: got 3"),
    ({"rate": 0}, r"R: rate is 0; expected the samples in a second"),
    ({"names": ["a"]}, r"R, names: got \['a'\]; expected a table such as"),
    (["q1=ab:deg"], r"mapping, q1: no column ab \(q1\) \(did you mean . or .\?\); the columns"),
    (["q<j>=pos{j}"], r"mapping, q<j>: no column pos1 \(q1\)"),
    (["q1"], r"mapping q1: expected NAME=COLUMN\[:UNIT\]"),
    (["rate=fast"], r"mapping rate=fast: got fast; expected a number"),
    (["names=1"], r"mapping names=1: got 1; expected JOINT:NAME"),
    (["none.toml"], r"mapping none.toml: cannot be read \(No such file or directory\)"),
]


@pytest.mark.parametrize(("mapping", "words"), WRONG)
def test_mistakes_are_told_in_one_line(tmp_path, mapping, words):
    with pytest.raises(DataError, match=words) as error:
        table_of(tmp_path, mapping)
    assert "\n" not in str(error.value)


def test_a_file_of_lines_or_a_robot_file_serves_as_well(tmp_path):
    (tmp_path / "lines.toml").write_text('q1 = "a [deg]"\n')
    (tmp_path / "robot.toml").write_text('name = "x"\n[log]\nq1 = "a [deg]"\n')
    for name in ("lines.toml", "robot.toml"):
        table, values = table_of(tmp_path, [str(tmp_path / name)])
        assert table.read_numbers("q1") == pytest.approx(np.deg2rad(values["a"]))
    (tmp_path / "bad.toml").write_text("q1 = \n")
    with pytest.raises(DataError, match=r"bad\.toml: not TOML"):
        table_of(tmp_path, [str(tmp_path / "bad.toml")])


def broken(case, tmp_path, **changes):
    table = {n: v.copy() for n, v in case.table.items()}
    named = {"time": "clock"} | {f"q{j}": f"pos_{j}" for j in "123"} | {"tau1": "load_1"}
    for name, change in changes.items():
        table[name] = change and change(table[name])
    table = {named.get(n, n): v for n, v in table.items() if v is not None}
    return writers.parquet(tmp_path / "broken.parquet", table)


MAPPED = {"time": "clock", "q<j>": "pos_{j}", "tau1": "load_1"}
SAID = [
    ({"q2": None}, r"no column pos_2 \(q2\) \(did you mean pos_"),
    ({"tau1": None}, r"mapping, tau1: no column load_1 \(tau1\)"),
    (
        {"time": lambda v: np.where(np.arange(len(v)) == 5, 0.0, v)},
        r"column clock \(time\), row 6: 0 s after 0\.004 s",
    ),
    ({"time": lambda v: v * 1e12}, r"column clock \(time\): median step of .*map it with its unit"),
    ({"q2": lambda v: v.astype(str)}, r"column pos_2 \(q2\) holds string|column pos_2 \(q2\), row"),
]


@pytest.mark.parametrize(("changes", "words"), SAID)
def test_errors_name_the_column_of_the_user(case, tmp_path, changes, words):
    with pytest.raises(DataError, match=words):
        read_logs(case.compiled, [broken(case, tmp_path, **changes)], MAPPED)


def test_log_of_the_robot_file_is_not_strict_but_says_whose_column_it_is(case, tmp_path):
    (log,) = read_logs(case.compiled, [broken(case, tmp_path)], MAPPED)
    assert log.torque_source[0] == "tau1 from load_1"
    path = broken(case, tmp_path, tau1=None)
    words = r"no column load_1 \(tau1\) or current1: joint 1 of demo-arm is actuated"
    with pytest.raises(DataError, match=words):
        read_log(path, case.compiled.spec, build_map(MAPPED, "[log]"))


def test_currents_may_be_mapped(case, tmp_path):
    table = {n.replace("tau", "i_"): v for n, v in case.table.items()}
    path = writers.parquet(tmp_path / "a.parquet", table)
    (log,) = read_currents(case.compiled, [path], {"current<j>": "i_{j} [mA]"})
    assert log.tau == pytest.approx(writers.joined(case.table, "tau") / 1000, rel=1e-14)
