"""`modeler fleet` as a user types it, on logs of the simulator, which has dynamics of its own."""

import json
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import fleet, load, simulate, write_report
from modeler.cli import main
from modeler.robot.edit import replace_parameters
from modeler.robot.read import parse_robot_text
from tests.rotation import with_cases

MOTION = {"duration": 4.0, "rate": 200.0, "parameter_seed": 4}


@pytest.fixture(scope="module")
def two_days(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A machine on two days."""
    folder = tmp_path_factory.mktemp("two-days")
    (folder / "r1").mkdir()
    for day in (1, 2):
        simulate(load("two-link"), folder / "r1" / f"2026-03-0{day}.parquet", **MOTION, seed=day)
    return folder


@pytest.fixture(scope="module")
def plant(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two machines on five days; from the third on, joint 2 of r2 rubs by half as much again."""
    folder, robot = tmp_path_factory.mktemp("plant"), load("two-link")
    rubs = simulate(robot, **MOTION, seed=1).truth.parameters["Fs2"]
    worn = parse_robot_text(replace_parameters(robot.text, {"Fs2": 1.5 * rubs}), "worn")
    for m, machine in enumerate(("r1", "r2")):
        (folder / machine).mkdir()
        for day in range(1, 6):
            actual = worn if machine == "r2" and day >= 3 else robot
            place = folder / machine / f"2026-03-{day:02d}.parquet"
            simulate(actual, place, **MOTION, seed=10 * m + day)
    return folder


def run(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["fleet", "two-link", *words]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return out


def refusal(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["fleet", "two-link", *words]) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("modeler: ") and err.count("\n") == 1
    return err


@pytest.mark.slow
def test_processes_and_lists_give_the_same(capsys, plant: Path, tmp_path: Path) -> None:
    places = sorted(plant.glob("*/*.parquet"))
    whole, table = run(capsys, *map(str, places)), tmp_path / "logs.csv"
    assert run(capsys, str(plant), "--workers", "2") == whole
    rows = (f"{place.parent.name},{place.stem},{place}\n" for place in places)
    table.write_text("machine,period,log\n" + "".join(rows))
    assert run(capsys, "--list", str(table)) == whole


@with_cases(
    "words, text",
    ("", "fleet: got no logs; name files or folders of logs, or --list FILE"),
    ("@/r1/2026-03-01.parquet --workers 0", "--workers: got 0; expected 1 or more"),
    ("@/r1/2026-03-01.parquet", "fleet: got one log each of r1; expected two periods of a mac"),
    ("@/r1/2026-03-01.parquet @/r1/2026-03-01.parquet", "is too; expected one log each; renam"),
    ("@ --name no{period}", "does not fit --name no{period}; expected a path that ends so"),
    ("nowhere", "modeler: nowhere: no such file or folder; expected logs, or folders of logs"),
    ("@ --list @/logs.csv", "LOG: got it with --list; leave one of them out"),
    ("@/empty", "/empty: a folder without logs; expected .csv, .parquet, "),
    ("@ --cutoff -1", "position_cutoff is -1.0; expected a number that is not negative"),
    ("@ --effects none", "--effects: got none; expected some of"),
)
def test_bad_input_is_one_line(capsys, two_days: Path, words: str, text: str) -> None:
    (two_days / "empty").mkdir(exist_ok=True)
    where = str(two_days)
    assert text.replace("@", where) in refusal(capsys, *words.replace("@", where).split())


def test_rows_given_twice_are_refused(capsys, two_days: Path, tmp_path: Path) -> None:
    first, copy = two_days / "r1" / "2026-03-01.parquet", tmp_path / "r3" / "b.parquet"
    copy.parent.mkdir()
    copy.write_bytes(first.read_bytes())
    out = refusal(capsys, str(two_days / "r1"), str(copy))
    assert f"{copy}: got rows of {first} again" in out


@pytest.mark.rotating("long tests of fleet")
def test_the_command_and_python_say_the_same(capsys, plant: Path, tmp_path: Path) -> None:
    """A log that cannot be used is left out; in Python machines and periods have names."""
    bad = tmp_path / "r1" / "2026-02-01.parquet"
    bad.parent.mkdir()
    pq.write_table(pa.table({"time": [0.0, 1.0], "q1": [0.0, 0.0]}), bad)  # no rows, no joint 2
    out = run(capsys, str(bad), str(plant), "--json", str(tmp_path / "fleet.json"))
    assert f"left out: {bad}: 2 rows; expected at least 10" in out and "leaps up by" in out
    data = json.loads((tmp_path / "fleet.json").read_text())
    assert data["verdict"] == "drift" and data["time_unit"] == "days" and data["logs"] == 10
    [one] = data["findings"]
    assert (one["machine"], one["joint"], one["effect"], one["shape"], one["begin"]) == (
        *"r2 2 coulomb jump 2026-03-03".split(),
    )
    assert one["change_percent"] == pytest.approx(50.0, abs=8.0) and one["temperature"] is None
    followed = {each["parameter"]: each for each in data["quantities"]}
    assert set(followed) == {"Fv1", "Fs1", "Fv2", "Fs2", "gain 1", "gain 2", "load"}
    actual = followed["Fs2"]["machines"]["r2"]
    assert actual["times"] == [0.0, 1.0, 2.0, 3.0, 4.0] and len(actual["values"]) == 5

    result = fleet(
        load("two-link"),
        {
            machine: {path.stem: path for path in sorted((plant / machine).glob("*.parquet"))}
            for machine in ("r1", "r2")
        },
    )
    assert result.findings[0].change == pytest.approx(one["change"])
    assert len(result.table("findings").rows) == 1 and len(result.table("values").rows) == 70
    assert result.plot("quantity 4") is not None and "Fs2" in result.summary()
    page = write_report(result, tmp_path / "f.html", ["of a test"]).read_text()
    for words in ("of a test", "two-link: what drifts where", "leaps up", "All machines"):
        assert words in page
