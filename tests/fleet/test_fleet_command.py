"""`modeler fleet` as a user types it, on logs of the simulator, which has dynamics of its own."""

import contextlib
import io
import json
import re
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import fleet, load, simulate, write_report
from modeler.cli import main
from modeler.core.errors import DataError
from modeler.robot.edit import with_parameters
from modeler.robot.read import robot_from_text

MOTION = {"duration": 4.0, "rate": 200.0, "parameter_seed": 4}


@pytest.fixture(scope="module")
def plant(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two machines on five days; from the third on, joint 2 of r2 rubs by half as much again."""
    folder = tmp_path_factory.mktemp("plant")
    robot = load("two-link")
    truth = simulate(robot, **MOTION, seed=1).truth.parameters
    worn = robot_from_text(
        with_parameters(robot.text, {**truth, "Fs2": 1.5 * truth["Fs2"]}), "worn"
    )
    for m, machine in enumerate(("r1", "r2")):
        (folder / machine).mkdir()
        for day in range(1, 6):
            own = worn if machine == "r2" and day >= 3 else robot
            place = folder / machine / f"2026-03-{day:02d}.parquet"
            simulate(own, place, **MOTION, seed=10 * m + day)
    return folder


@pytest.fixture(scope="module")
def written(plant: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the page and the JSON of the command, and `told.txt`, what it printed."""
    folder, out = tmp_path_factory.mktemp("written"), io.StringIO()
    files = ["--report", str(folder / "fleet.html"), "--json", str(folder / "fleet.json")]
    with contextlib.redirect_stdout(out):
        assert main(["fleet", "two-link", str(plant), *files]) == 0
    (folder / "told.txt").write_text(out.getvalue())
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


@pytest.mark.rotating("long tests of fleet")
def test_text_json_and_page(written: Path) -> None:
    out = (written / "told.txt").read_text()
    assert out.startswith("two-link: 1 of 2 machines drift or are apart from the others, beyond d")
    told = r"machine r2, joint 2: Coulomb friction \(Fs2\) leaps up by \d\d(\.\d)? % at 2026-03-03"
    assert re.search(told, out)
    found = json.loads((written / "fleet.json").read_text())
    assert found["verdict"] == "drift" and found["time"] == "days" and found["logs"] == 10
    [one] = found["findings"]
    assert (one["machine"], one["joint"], one["effect"], one["shape"], one["from"]) == (
        "r2", "2", "coulomb", "jump", "2026-03-03",
    )  # fmt: skip
    assert one["change_percent"] == pytest.approx(50.0, abs=8.0) and one["temperature"] is None
    followed = {each["parameter"]: each for each in found["quantities"]}
    assert set(followed) == {"Fv1", "Fs1", "Fv2", "Fs2", "gain 1", "gain 2", "load"}
    own = followed["Fs2"]["machines"]["r2"]
    assert own["at"] == [0.0, 1.0, 2.0, 3.0, 4.0] and len(own["values"]) == 5
    text = (written / "fleet.html").read_text()
    assert "two-link: what drifts where" in text and "Coulomb friction (Fs2) leaps up" in text
    assert "All machines" in text and "What was looked at" in text


@pytest.mark.slow
def test_processes_and_lists_give_the_same(capsys, plant: Path, tmp_path: Path) -> None:
    places = [str(path) for path in sorted(plant.glob("*/*.parquet"))]
    whole = run(capsys, *places)
    assert run(capsys, str(plant), "--workers", "2") == whole
    table = plant / "logs.csv"
    rows = (f"{Path(p).parent.name},{Path(p).stem},{Path(p).relative_to(plant)}" for p in places)
    table.write_text("machine,period,log\n" + "\n".join(rows) + "\n")
    try:
        assert run(capsys, "--list", str(table)) == whole
        told = refusal(capsys, places[0], "--list", str(table))
        assert f"--list {table}: got {places[0]} besides; expected all logs in the list" in told
    finally:
        table.unlink()


@pytest.mark.rotating("long tests of fleet")
def test_a_log_that_cannot_be_used_is_left_out(capsys, plant: Path, tmp_path: Path) -> None:
    bad = tmp_path / "r1" / "2026-02-01.parquet"
    bad.parent.mkdir()
    pq.write_table(pa.table({"time": [0.0, 1.0], "q1": [0.0, 0.0]}), bad)  # no rows, no joint 2
    out = run(capsys, str(bad), str(plant))
    assert f"left out: {bad}: 2 rows; expected at least 10" in out and "leaps up by" in out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("", "fleet: got no logs; name files or folders of logs, or a --list of them"),
        ("@/r1/2026-03-01.parquet --workers 0", "--workers: got 0; expected 1 or more"),
        ("@/r1/2026-03-01.parquet", "fleet: got one log each of r1; expected two periods of a mac"),
        ("@/r1/2026-03-01.parquet @/r1/2026-03-01.parquet", "is too; expected one log each; renam"),
        ("@ --name no{period}", "does not fit --name no{period}; expected a path that ends so"),
        ("@/r1/gone.parquet", "/r1/gone.parquet: no such file or folder; expected logs, or folde"),
        ("nowhere", "modeler: nowhere: no such file or folder; expected logs, or folders of logs"),
        ("--list @/gone.csv", "cannot be read (No such file or directory); expected a list of lo"),
        ("@/empty", "/empty: a folder without logs; expected .csv, .parquet, "),
        ("@ --cutoff -1", "position_cutoff is -1.0; expected a number that is not negative"),
        ("@ --effects none", "--effects: got none; expected some of"),
    ],
)
def test_bad_input_is_one_line(capsys, plant: Path, words: str, told: str) -> None:
    (plant / "empty").mkdir(exist_ok=True)
    assert told in refusal(capsys, *words.replace("@", str(plant)).split())


def test_rows_given_twice_are_refused(capsys, plant: Path, tmp_path: Path) -> None:
    copy = tmp_path / "r3" / "b.parquet"
    copy.parent.mkdir()
    copy.write_bytes((plant / "r1" / "2026-03-01.parquet").read_bytes())
    assert f"{copy}: got rows of {plant}/r1/2026-03-01.parquet again" in refusal(
        capsys, str(plant / "r1"), str(copy)
    )


@pytest.mark.rotating("long tests of fleet")
def test_from_python(plant: Path, written: Path, tmp_path: Path) -> None:
    """By names of machines and periods it is what the command finds by folders."""
    found = fleet(load("two-link"), {
        machine: {path.stem: path for path in sorted((plant / machine).glob("*.parquet"))}
        for machine in ("r1", "r2")
    })  # fmt: skip
    told = json.loads((written / "fleet.json").read_text())
    [one] = found.findings
    assert (one.machine, one.change) == ("r2", pytest.approx(told["findings"][0]["change"]))
    assert len(found.table("findings").rows) == 1 and len(found.table("values").rows) == 70
    assert found.plot("quantity 4") is not None and "Fs2" in found.summary()
    place = write_report(found, tmp_path / "f.html", ["of a test"])
    assert "of a test" in place.read_text()
    with pytest.raises(DataError, match="fleet: got the text"):
        fleet("two-link", [plant])  # type: ignore[arg-type]
