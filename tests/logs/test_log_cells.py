"""Lists in cells, names of joints in columns, what is commanded, episodes, joined files."""

from itertools import pairwise

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import read_logs
from modeler.core.errors import DataError
from modeler.logs.blocks import open_blocks
from modeler.logs.columns import ColumnRequest
from modeler.logs.guess import guess_role
from modeler.logs.mapping import parse_map_options
from modeler.logs.readers import read_columns
from modeler.regression.read import open_source
from tests.logs.test_log_clocks import csv
from tests.logs.writers import JOINTS, ORDERS, joined
from tests.rotation import rotating, with_cases
from tests.texts import read_pairs

NAMES = "names=1:waist,2:shoulder,3:elbow"


def listed(table, show):
    q, tau = joined(table, "q"), joined(table, "tau")
    rows = zip(table["time"].tolist(), q, tau, strict=True)
    return "timestamp,joint_positions,joint_torques\n" + "".join(
        f"{t!r},{show(a)},{show(b)}\n" for t, a, b in rows
    )


SHOWN = {
    "python": lambda row: f'"{row.tolist()}"',
    "json": lambda row: '"' + str(row.tolist()).replace(" ", "") + '"',
    "numpy": lambda row: np.array2string(row, precision=17, max_line_width=1000),
    "numpy over lines": lambda row: f'"{np.array2string(row, precision=17, max_line_width=30)}"',
    "tuple": lambda row: f'"{tuple(row.tolist())}"',
    "array": lambda row: f'"array({row.tolist()})"',
}


@with_cases("how", "python", "numpy over lines", *rotating("json", "numpy", "tuple", "array"))
def test_lists_in_cells_are_columns(how, short, tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(listed(short.table, SHOWN[how]))
    mapping = ["time=timestamp", "q<j>=joint_positions[{n}]", "tau<j>=joint_torques[{n}]"]
    short.check(path, mapping, 1e-7)
    assert open_blocks(path) is None  # a cell may go over several lines
    short.check(path, ["auto"], 1e-7)


def test_names_and_units_in_brackets_are_no_lists(tmp_path):
    text = "t [s],q[1],q[2]\n[s],[deg],[deg]\n" + "".join(f"{k},{k}.5,2\n" for k in range(20))
    (tmp_path / "a.csv").write_text(text)
    result = read_columns(tmp_path / "a.csv", ColumnRequest())
    assert [name for name, _ in result.columns] == ["t [s]", "q[1]", "q[2]"]


def test_structs_are_columns(short, tmp_path):
    q, tau = joined(short.table, "q").tolist(), joined(short.table, "tau").tolist()
    rows = [{"q": a, "effort": {"tau": b}} for a, b in zip(q, tau, strict=True)]
    path = tmp_path / "run.parquet"
    pq.write_table(pa.table({"t": short.table["time"], "state": rows}), path)
    short.check(path, ["time=t", "q<j>=state.q[{n}]", "tau<j>=state.effort.tau[{n}]"])
    short.check(path, ["auto"])


def test_names_in_columns_say_which_joint_is_which(short, tmp_path):
    """Their order changes from row to row: as `rostopic echo -p` writes them, and as lists."""
    order = np.array([ORDERS[k % 2] for k in range(len(short.table["time"]))])
    names = np.array(JOINTS)[order]
    q, tau = (np.take_along_axis(joined(short.table, items), order, 1) for items in ("q", "tau"))
    columns = {"%time": (short.table["time"] * 1e9).round().astype(int) + 10**18 + 10**17}
    for field, values in (("name", names), ("position", q), ("effort", tau)):
        columns |= {f"field.{field}{k}": values[:, k] for k in range(3)}
    short.check(csv(tmp_path / "run.csv", columns, show=str), ["auto", NAMES])
    table = {
        "time": short.table["time"],
        "name": names.tolist(),
        "position": q.tolist(),
        "effort": tau.tolist(),
    }
    other = tmp_path / "run.parquet"
    pq.write_table(pa.table(table), other, row_group_size=81)  # blocks begin with either order
    mapping = ["q<j>=position[{name}]", "tau<j>=effort[{name}]", NAMES]
    short.check(other, mapping)
    source = open_source(other, short.compiled.spec, parse_map_options(mapping))
    whole = np.concatenate([log.q for log in source.read_blocks(81)])
    assert whole == pytest.approx(joined(short.table, "q"))


COMMANDED = """
    AccCmptd qdd_des ddq_d tau_J_d VelocityCmptd torque_ref target_moment cmd.effort TorqueSetpoint
    acc_goal planned_velocity tau_computed taucmd reference.velocities vel_soll
""".split()
POSITIONS = """
    PositionCmptd q_d q_ref target_q qdes state.desired.positions cmd/pos points.positions
""".split()
MEASURED = read_pairs("""
    actual_q q pos_feedback q tau_J tau cmd_controller/actual.position q
    reference_robot.measured_torque tau target_current_actual current
""")


def test_what_is_commanded_is_not_measured():
    assert {name: guess_role(f"{name}[1]") for name in COMMANDED} == dict.fromkeys(COMMANDED, "")
    assert {name: guess_role(f"{name}[1]") for name in POSITIONS} == dict.fromkeys(POSITIONS, "qc")
    assert {name: guess_role(f"{name}[1]") for name in MEASURED} == MEASURED
    assert guess_role("state.error.positions[1]") == ""


def test_commanded_columns_beside_measured_ones(short, tmp_path):
    """As drives of an arm call them; units in names do not make them measured."""
    run, table = short.table, {"Time": short.table["time"]}
    for k in (1, 2, 3):
        table |= {
            f"Position{k}": run[f"q{k}"],
            f"TorqueCur{k}": run[f"tau{k}"] * 7.0,
            f"Torque{k}": run[f"tau{k}"],
            f"Cur{k}": run[f"tau{k}"] * 0.1,
            f"PositionCmptd{k}": run[f"q{k}"] + 0.1,
            f"AccCmptd{k}": 0.0 * run["time"],
            f"vel_cmd_{k} [deg/s]": run[f"q{k}"],
            f"error_{k} [deg]": run[f"q{k}"],
        }
    path = csv(tmp_path / "run.csv", table)
    log = short.check(path, ["auto"])
    assert log.qdd is None and log.qd is None
    assert log.commanded == pytest.approx(log.q + 0.1)
    assert log.extra["current1"] == pytest.approx(0.1 * run["tau1"])


def episodes(path, table, lengths, head="data/demo_{}/obs/", times=False):
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    ends = np.cumsum([0, *lengths])
    with h5py.File(path, "w") as file:
        for k, (a, b) in enumerate(pairwise(ends)):
            group = head.format(k + 8)  # 8, 9, 10: sorted as numbers
            file[f"{group}joint_pos"] = np.rad2deg(joined(table, "q")[a:b])
            file[f"{group}joint_pos"].attrs["units"] = "deg"
            file[f"{group}joint_effort"] = joined(table, "tau")[a:b]
            if times:
                file[f"{group}time"] = table["time"][a:b] - table["time"][a]
    return path


@pytest.mark.parametrize("times", [False, True])
def test_episodes_are_segments(times, short, tmp_path):
    path = episodes(tmp_path / "run.hdf5", short.table, (130, 100, 170), times=times)
    rate = [] if times else ["rate=1000"]
    log = short.check(path, ["auto", *rate])
    assert np.flatnonzero(np.diff(log.segment)).tolist() == [129, 229]
    said = "3 episodes, data/demo_8 to 10, one after the other as segments"
    assert any(said in note for note in log.reading_notes)
    (log,) = read_logs(short.compiled, [path], ["auto", *rate, "topic=data/demo_9"])
    assert log.q == pytest.approx(joined(short.table, "q")[130:230])
    if not times:
        with pytest.raises(DataError, match=r"no column time; .*--map rate=HZ"):
            read_logs(short.compiled, [path], ["auto"])
        path = episodes(tmp_path / "a.hdf5", short.table, (200, 200), "joint_{}/")
        names = [
            name for name, _ in read_columns(path, ColumnRequest()).columns
        ]  # which are no episodes
        assert "joint_8/joint_pos[1]" in names and "joint_9/joint_pos[1]" in names


def test_files_of_other_rates_join_by_time(case, tmp_path):
    """Positions in one file, torques in another that is faster and begins later."""
    time = case.table["time"]
    q = {"time": time[50:], **{f"q{j}": case.table[f"q{j}"][50:] for j in (1, 2, 3)}}
    fast = np.arange(0.3, time[-1] - 0.2, 0.5 * float(time[1] - time[0]))
    tau = {
        "t": fast,
        **{f"tau{j}": np.interp(fast, time, case.table[f"tau{j}"]) for j in (1, 2, 3)},
    }
    (tmp_path / "run").mkdir()
    csv(tmp_path / "run" / "positions.csv", q)
    csv(tmp_path / "run" / "torques.csv", tau)
    (log,) = read_logs(case.compiled, [tmp_path / "run"])
    inside = (time >= 0.3) & (time <= fast[-1])
    assert log.time == pytest.approx(time[inside])
    assert log.q == pytest.approx(joined(case.table, "q")[inside])
    assert log.tau == pytest.approx(joined(case.table, "tau")[inside], abs=1e-9)
    assert any("joined by time" in line and "torques.csv" in line for line in log.reading_notes)


def test_a_gap_of_one_file_is_not_filled(tmp_path):
    rows = np.arange(100) * 0.01
    csv(tmp_path / "q.csv", {"time": rows, "a": rows})
    there = (rows < 0.3) | (rows > 0.6)
    csv(tmp_path / "tau.csv", {"time": rows[there] + 0.002, "b": rows[there]})
    tau = dict(read_columns(tmp_path, ColumnRequest()).columns)["tau"].read_numbers()
    assert np.isnan(tau[35:58]).all()
    assert np.isfinite(np.r_[tau[1:28], tau[65:98]]).all()
