"""Every format gives the numbers of the run, whatever its names and units are."""

import json

import numpy as np
import pytest

from modeler.api import read_logs
from modeler.core.errors import DataError
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import build_map
from tests.logs import writers
from tests.logs.writers import MAPPING, ROS, under

FORMATS = {
    "mat": (writers.mat, "run.mat", under("data.", MAPPING)),
    "mat 7.3": (writers.mat73, "run.mat", under("data.", MAPPING)),
    "hdf5": (writers.hdf5, "run.h5", under("arm/", MAPPING)),
    "npz": (writers.npz, "run.npz", MAPPING),
    "mcap": (writers.mcap, "run.mcap", ROS),
    "bag": (writers.bag, "run", ROS),
    "bag, mcap": (lambda path, table: writers.bag(path, table, "MCAP"), "run", ROS),
    "bag 1": (writers.bag1, "run.bag", ROS),
}


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_gives_the_numbers_of_the_run_and_the_rows_of_a_window(name, short, tmp_path):
    write, file, mapping = FORMATS[name]
    path = write(tmp_path / file, short.table)
    short.check(path, mapping, 1e-14)
    (log,) = read_logs(short.compiled, [f"{path}@0.0995:0.3005"], mapping)
    rows = (short.table["time"] > 0.0999) & (short.table["time"] < 0.3001)
    assert log.q[:, 2] == pytest.approx(short.table["q3"][rows], rel=1e-14)


def test_an_array_may_be_chosen_by_its_group_and_what_is_no_column_is_told(short, tmp_path):
    path = writers.mat(tmp_path / "run.mat", short.table)
    short.check(path, {**MAPPING, "topic": "data"})
    with pytest.raises(DataError, match="topic other: no group of that name; the groups are data"):
        read_logs(short.compiled, [path], {**MAPPING, "topic": "other"})
    log = short.check(path, under("data.", MAPPING))
    assert "pose (4 x 4) left out: no columns of" in " ".join(log.reading_notes)


def test_units_that_a_file_states_are_used_and_told(short, tmp_path):
    path = writers.hdf5(tmp_path / "run.h5", short.table)
    log = short.check(path, under("arm/", MAPPING) | {"q<j>": "arm/pos[{n}]"}, 1e-14)
    assert "by the units that the file states: q1 in deg, q3 in deg" in log.reading_notes


def test_other_topics_hold_their_last_message(short, tmp_path):
    path = writers.mcap(tmp_path / "run.mcap", short.table)
    mapping = ROS | {"temperature1": "motor/heat.temperature"}
    table = LogTable(path, build_map(mapping, "mapping"), short.compiled.spec.joints)
    heat = table.read_measured("temperature1")
    assert np.isnan(heat[:50]).all()
    assert heat[50:150] == pytest.approx(np.full(100, 70.0))  # row 50 has its stamp
    log = short.check(path, mapping)
    joined = [
        line for line in log.reading_notes if line.startswith("/motor/heat joined to that clock")
    ]
    assert len(joined) == 1 and "at most 0.099 s old" in joined[0]
    assert any(n.startswith("rows are the messages of /joint_states") for n in log.reading_notes)
    assert log.notes == ()


def test_of_several_topics_one_is_chosen(short, tmp_path, run):
    path = writers.bag(tmp_path / "run", short.table, extra_topic="/other/joint_states")
    with pytest.raises(DataError, match=r"2 topics may hold the motion: .*--map topic=/"):
        read_logs(short.compiled, [path], ROS)
    short.check(path, {**ROS, "topic": "/joint_states"}, 1e-14)
    with pytest.raises(DataError, match="topic /x: no messages of it; the topics are /"):
        read_logs(short.compiled, [path], {**ROS, "topic": "/x"})
    status, out, _ = run("log", path, "--json", tmp_path / "log.json")  # which chooses none
    raw = json.loads((tmp_path / "log.json").read_text())
    assert status == 0
    assert [s["name"] for s in raw["streams"]] == ["/joint_states", "/other/joint_states"]
    assert [s["is_clock"] for s in raw["streams"]] == [True, False]
    assert "/joint_states  sensor_msgs/msg/JointState, 400 messages, the clock" in out
    assert '"q<j>" = "joint_states.position[{name}]"' in out
    assert 'names = {1 = "waist", 2 = "shoulder", 3 = "elbow"}' in out


def test_messages_of_some_joints_do_not_break_the_others(short, tmp_path):
    """A gripper often speaks on the topic of its arm."""
    log = short.check(writers.bag(tmp_path / "run", short.table, gripper=True), ROS, 1e-14)
    assert not log.missing and "joint_states.position[finger]" in log.extra
    assert np.isfinite(log.extra["joint_states.position[finger]"][20:]).all()


def test_objects_of_matlab_are_told(tmp_path, monkeypatch):
    """A timeseries comes as an opaque object."""
    import scipy.io
    from scipy.io.matlab import MatlabOpaque

    opaque = MatlabOpaque(np.zeros(1, dtype=[("s0", "O")]))
    content = {"ts": opaque, "q": np.zeros((30, 2)), "who": "me"}
    monkeypatch.setattr(scipy.io, "loadmat", lambda *a, **k: content)
    (tmp_path / "run.mat").write_bytes(b"MATLAB 5.0")
    table = LogTable(tmp_path / "run.mat")
    assert table.names == ("q[1]", "q[2]")
    assert table.notes[0].startswith("ts left out: an object that only MATLAB reads; of a times")


def test_structure_with_time_of_simulink(short, tmp_path):
    import scipy.io

    signals = {"values": short.table.other["pos"], "dimensions": 3.0, "label": "q"}
    scipy.io.savemat(
        tmp_path / "run.mat", {"out": {"time": short.table["time"], "signals": signals}}
    )
    table = LogTable(tmp_path / "run.mat")
    assert table.read_numbers("out.signals.values[2]") == pytest.approx(
        short.table.other["pos"][:, 1]
    )
    assert table.read_numbers("out.time") == pytest.approx(short.table["time"])


def test_units_that_are_not_understood_are_told(tmp_path):
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    with h5py.File(tmp_path / "run.h5", "w") as file:
        file["q1"] = np.ones(20)
        file["q1"].attrs["units"] = "degrees"
        file["p"] = np.ones(20)
        file["p"].attrs["units"] = "furlong"
    table = LogTable(tmp_path / "run.h5")
    assert table.read_numbers("q1") == pytest.approx(np.full(20, np.pi / 180))
    text = 'the file states units that are not understood, taken as SI: p "furlong"'
    assert text in table.notes
