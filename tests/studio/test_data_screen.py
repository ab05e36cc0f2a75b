"""The data screen as a person uses it: logs come in, are mapped, cut, doubted and played."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest
import scipy.io

from modeler.cli import main
from modeler.core.builtin import builtin_text
from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import Stretch
from tests.rotation import rotating_with
from tests.studio.window import Served, Window, served

JOINTS = (1, 2, 3)


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """A run of the arm: time, positions and torques, SI."""
    place = tmp_path_factory.mktemp("run") / "run.parquet"
    words = ["simulate", "demo-arm", "--duration", "8", "--seed", "11", "--out", str(place)]
    assert main([*words, "--quiet"]) == 0
    read = pa.parquet.read_table(place).to_pydict()
    return {name: np.array(values) for name, values in read.items()}


def as_logged(run: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """As a German logger might write it: its own names, degrees."""
    found = {"Zeit": run["time"]}
    found |= {f"Winkel_{j}": np.rad2deg(run[f"q{j}"]) for j in JOINTS}
    return found | {f"Drehmoment_{j}": run[f"tau{j}"] for j in JOINTS}


def german(place: Path, columns: dict[str, np.ndarray]) -> Path:
    rows = np.column_stack(list(columns.values())).tolist()
    lines = [";".join(columns), *(";".join(repr(x).replace(".", ",") for x in row) for row in rows)]
    place.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return place


def parquet(place: Path, columns: dict[str, np.ndarray]) -> Path:
    pa.parquet.write_table(pa.table(columns), place)
    return place


def mat(place: Path, columns: dict[str, np.ndarray]) -> Path:
    scipy.io.savemat(place, columns)
    return place


def project(folder: Path, robot: str = "demo-arm") -> Path:
    """A folder in which the robot is described already."""
    folder.mkdir(exist_ok=True)
    if robot:
        (folder / "robot.toml").write_text(builtin_text(robot), encoding="utf-8")
        Workspace(folder).save(Project("robot.toml"))
    return folder


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Served]:
    with served(project(tmp_path / "arm")) as running:
        yield running


def drop(w: Window, files: list[Path]) -> None:
    """On the page; the files are chosen as the browser's dialog does, which is the same request."""
    w.page.set_input_files(".data-drop input[type=file]", [str(file) for file in files])
    w.page.wait_for_function(
        f"document.querySelectorAll('.data-log .data-name').length >= {len(files)}"
    )


def pictured(w: Window) -> None:
    w.page.wait_for_selector(".data-pictures .main-svg .scatterlayer .trace")


def curves(w: Window) -> dict[str, Any]:
    """What the picture draws: name and panel -> x and y."""
    return w.page.evaluate(
        """() => Object.fromEntries(document.querySelector('.data-pictures .js-plotly-plot').data
             .map((d) => [d.name + d.yaxis, {x: [...d.x], y: [...d.y]}]))"""
    )


def field(w: Window, label: str) -> Any:
    return w.page.get_by_role("combobox", name=label, exact=True)


def until(w: Window, served_: Served, holds: Callable[[Any], bool]) -> Any:
    """The project, as soon as its file says so."""
    for _ in range(1200):
        if holds(served_.project):
            return served_.project
        w.page.wait_for_timeout(50)
    raise AssertionError(served_.project)


def test_three_formats_from_the_drop_to_the_fit(
    window: Callable[..., Window], studio: Served, measured: dict[str, np.ndarray], tmp_path: Path
) -> None:
    w = window().open(studio)
    page = w.page
    w.go("Data")
    clean = as_logged(measured)
    spoilt = {**clean, "Drehmoment_2": clean["Drehmoment_2"].copy()}
    spoilt["Drehmoment_2"][3000] += 300.0
    files = [german(tmp_path / "a.csv", spoilt), parquet(tmp_path / "b.parquet", clean)]
    drop(w, [*files, mat(tmp_path / "c.mat", clean)])
    pictured(w)
    found = studio.project
    assert found.mapping == ("time=Zeit", "q<j>=Winkel_{j}:deg", "tau<j>=Drehmoment_{j}")
    assert [log.file for log in found.logs] == ["logs/a.csv", "logs/b.parquet", "logs/c.mat"]
    assert found.words("train") == ["logs/a.csv", "logs/b.parquet"]
    assert found.words("test") == ["logs/c.mat"]
    w.sees("A guess by names")
    drawn = curves(w)["joint 1y"]
    at = np.interp(drawn["x"], measured["time"], measured["q1"])
    np.testing.assert_allclose(drawn["y"], at, atol=1e-5)
    assert len(drawn["x"]) <= 1500

    # Another unit, by the menu: the picture follows, and the words.
    field(w, "unit of q1").click()
    page.get_by_role("option", name="rad", exact=True).click()
    plot = "document.querySelector('.data-pictures .js-plotly-plot')"
    page.wait_for_function(f"Math.max(...({plot}?.data?.[0]?.y ?? [])) > 10")
    np.testing.assert_allclose(curves(w)["joint 1y"]["y"], np.rad2deg(at), atol=1e-3)
    words = until(w, studio, lambda p: "q1=Winkel_1" in " ".join(p.mapping)).mapping
    assert "q2=Winkel_2:deg" in words
    page.get_by_role("button", name="sign of q1").click()
    until(w, studio, lambda p: any(word.startswith("q1=-Winkel_1") for word in p.mapping))
    w.page.locator("[aria-label='sign of q1']", has_text="\u2212").wait_for()
    # A unit that cannot be is refused in one line, and nothing is lost.
    before = studio.project.mapping
    unit = field(w, "unit of q1")
    unit.fill("kg")
    unit.press("Enter")
    w.sees('got unit "kg"')
    assert studio.project.mapping == before
    # Back, by dragging the column onto its name, and the unit of all joints.
    page.get_by_role("button", name="sign of q1").click()
    page.locator("[aria-label='sign of q1']", has_text="+").wait_for()
    page.locator(".mapping-chip", has_text="Winkel_1").drag_to(page.locator("[data-own=q2]"))
    until(w, studio, lambda p: "q2=Winkel_1:deg" in p.mapping)
    page.locator(".mapping-chip", has_text="Winkel_2").drag_to(page.locator("[data-own=q2]"))
    until(w, studio, lambda p: "q2=Winkel_2:deg" in p.mapping)
    page.locator(".mapping-all").first.click()
    page.get_by_role("option", name="deg", exact=True).click()
    until(w, studio, lambda p: p.mapping == found.mapping)

    # The spike is a mark on the line: why, and leave it out.
    mark = page.locator(".timeline-active .timeline-mark")
    mark.first.click()
    w.sees("No machine does that")
    page.get_by_role("dialog").get_by_role("button", name="Leave out").click()
    log = until(w, studio, lambda p: p.logs[0].out).logs[0]
    assert len(log.out) == 1 and log.out[0].start < 3.0 < log.out[0].end < 3.1
    # Half of what comes before is held out, by brushing.
    page.get_by_role("dialog").wait_for(state="detached")
    page.locator(".timeline-active").scroll_into_view_if_needed()
    box = page.locator(".timeline-active").bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.1 * box["width"], y)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.3 * box["width"], y, steps=4)
    page.mouse.up()
    page.get_by_role("button", name="held out", exact=True).click()
    log = until(w, studio, lambda p: p.logs[0].test).logs[0]
    assert log.test[0].start == pytest.approx(0.8, abs=0.03)
    assert log.test[0].end == pytest.approx(2.4, abs=0.03)
    # By the keyboard: numbers, and a key on the line.
    page.get_by_label("from s").fill("5")
    page.get_by_label("to s").fill("6.5")
    page.locator(".timeline-active").press("o")
    log = until(w, studio, lambda p: len(p.logs[0].out) == 2).logs[0]
    assert log.out[1] == Stretch(5.0, 6.5)

    plays(w, measured)
    fits(w, studio, tmp_path)
    assert w.complaints == []


def plays(w: Window, run: dict[str, np.ndarray]) -> None:
    """The robot stands where the log says, at the cursor and while it plays."""
    page = w.page
    page.wait_for_function("document.querySelector('iframe.studio-robot')?.ready")
    page.evaluate(
        """() => {
          const frame = document.querySelector('iframe.studio-robot'), tell = window.toRobot;
          window.posed = [];
          window.toRobot = (id, m) => { posed.push([id === frame.id, m]); tell(id, m); };
        }"""
    )
    line = page.locator(".timeline-active")
    line.scroll_into_view_if_needed()
    box = line.bounding_box()
    for share in (0.15, 0.83):
        page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)
        page.wait_for_function("posed.length > 0")
        own, message = page.evaluate("posed.at(-1)")
        at = float(line.get_attribute("aria-valuenow"))
        assert own and at == pytest.approx(8.0 * share, abs=0.02)
        for j in JOINTS:
            expected = np.interp(at, run["time"], run[f"q{j}"])
            assert message["q"][str(j)] == pytest.approx(expected, abs=1e-3)
        stands = page.frames[-1].evaluate(
            "Object.fromEntries(robot.free.map((n, k) => [n, modelerShow.u[k]]))"
        )
        assert stands == pytest.approx(message["q"], abs=1e-9)
        page.evaluate("posed.length = 0")
    page.get_by_role("button", name="play", exact=True).click()
    page.wait_for_function("posed.length > 3")
    page.get_by_role("button", name="pause", exact=True).click()
    page.wait_for_timeout(200)
    count = page.evaluate("posed.length")
    assert float(line.get_attribute("aria-valuenow")) > 8.0 * 0.83
    page.wait_for_timeout(200)
    assert page.evaluate("posed.length") == count
    cursor = page.locator(".data-pictures .studio-cursor span").inner_text()
    assert cursor == f"{float(line.get_attribute('aria-valuenow')):.3f} s"


def fits(w: Window, studio: Served, tmp_path: Path) -> None:
    """What the project says, typed by hand, gives the numbers that the studio gives."""
    found = studio.project
    w.go("Fit")
    w.page.get_by_role("button", name="Fit", exact=True).last.click()
    done = until(w, studio, lambda p: p.current > 0)
    step = done.step(done.current)
    made = json.loads((studio.folder / step.result).read_text(encoding="utf-8"))
    logs = [word.replace("logs/", f"{studio.folder}/logs/") for word in found.words("train")]
    maps = [word for own in found.mapping for word in ("--map", own)]
    said = tmp_path / "typed.json"
    words = ["fit", "demo-arm", *logs, *maps, "--out", str(tmp_path / "typed.model.json")]
    assert main([*words, "--json", str(said), "--quiet"]) == 0
    typed = json.loads(said.read_text(encoding="utf-8"))
    assert len(logs) == 5  # before and after what is held out, and between what is left out
    for one, other in zip(made["parameters"], typed["parameters"], strict=True):
        assert one["name"] == other["name"]
        assert one["value"] == pytest.approx(other["value"], rel=1e-12)


def test_what_cannot_be_read_is_told_in_place(
    window: Callable[..., Window], studio: Served, measured: dict[str, np.ndarray], tmp_path: Path
) -> None:
    w = window().open(studio)
    w.go("Data")
    evil = "<img src=x onerror=document.title='taken'>_{}"
    columns = {"t": measured["time"]}
    columns |= {evil.format(j): measured[f"q{j}"] for j in JOINTS}
    columns |= {f"tau{j}": measured[f"tau{j}"] for j in JOINTS}
    broken = tmp_path / "broken.parquet"
    broken.write_bytes(b"PAR1 this is none")
    drop(w, [broken, parquet(tmp_path / "good.parquet", columns)])
    w.sees("cannot be read as PARQUET")
    pictured(w)
    # Names from files are text, wherever they stand.
    field(w, "column of q2").click()
    w.page.get_by_role("option", name=evil.format(3), exact=True).click()
    until(w, studio, lambda p: f"q2={evil.format(3)}" in p.mapping)
    w.sees(evil.format(1))
    assert w.page.title() != "taken" and w.page.locator("img").count() == 0
    # A file that goes away while it is looked at: told, and all is as it was when it is back.
    before = studio.project
    place = studio.folder / "logs" / "good.parquet"
    kept = place.read_bytes()
    place.unlink()
    w.click("whole log")
    w.sees("put the file back")
    w.page.reload()
    w.page.wait_for_selector(".studio-screen")
    w.go("Data")
    w.sees("good.parquet: cannot be read")
    assert studio.project.logs == before.logs and studio.project.mapping == before.mapping
    place.write_bytes(kept)
    w.page.reload()
    w.page.wait_for_selector(".studio-screen")
    w.go("Data")
    pictured(w)
    w.page.get_by_text("this window only reads").wait_for(state="hidden")  # the one before left
    w.click("take logs/broken.parquet off the list")
    until(w, studio, lambda p: [log.file for log in p.logs] == ["logs/good.parquet"])
    assert (studio.folder / "logs" / "broken.parquet").exists()
    assert [c for c in w.complaints if "400" not in c] == []


@rotating_with("screens of the studio")
def test_logs_of_other_names_chosen_where_they_lie_are_each_taken_by_their_own_guess(
    window: Callable[..., Window], measured: dict[str, np.ndarray], tmp_path: Path
) -> None:
    other = {"t": measured["time"]} | {"pos": np.column_stack([measured[f"q{j}"] for j in JOINTS])}
    other["torque"] = np.column_stack([measured[f"tau{j}"] for j in JOINTS])
    place = tmp_path / "elsewhere"
    (place / "deep").mkdir(parents=True)
    german(place / "deep" / "a.csv", as_logged(measured))
    far = mat(place / "deep" / "b.mat", other)
    with served(project(tmp_path / "arm"), "--allow", str(place)) as studio:
        w = window().open(studio)
        w.go("Data")
        w.click("Choose where it lies")
        dialog = w.page.get_by_role("dialog")
        dialog.get_by_role("button", name=str(place)).click()
        dialog.get_by_role("button", name="deep").click()
        for name in ("a.csv", "b.mat"):
            dialog.get_by_role("checkbox", name=name).click()
        dialog.get_by_role("button", name="Take", exact=True).click()
        pictured(w)
        w.sees("The logs name their columns differently")
        assert studio.project.mapping == ("auto",)
        assert [log.file for log in studio.project.logs] == [str(far.parent / "a.csv"), str(far)]
        first = curves(w)["joint 2y"]
        w.click("b.mat", exact=True)
        w.page.locator(".mapping-chip", has_text="torque[2]").wait_for()
        pictured(w)
        second = curves(w)["joint 2y"]
        between = np.interp(second["x"], first["x"], first["y"])
        np.testing.assert_allclose(between, second["y"], atol=2e-3)
        # A unit of one, said beside the guess, is no matter of the other.
        field(w, "unit of tau2").click()
        w.page.get_by_role("option", name="mN m", exact=True).click()
        until(w, studio, lambda p: p.mapping == ("auto", "tau2=torque[2]:mN m"))
        w.click("a.csv", exact=True)
        w.page.locator(".mapping-chip", has_text="Drehmoment_2").wait_for()
        assert field(w, "column of tau2").input_value() == "Drehmoment_2"
        assert w.complaints == []


@rotating_with("screens of the studio")
def test_many_files_at_once_and_a_robot_to_start_from(
    window: Callable[..., Window], measured: dict[str, np.ndarray], tmp_path: Path
) -> None:
    files = []
    for k in range(30):
        rows = slice(200 * k, 200 * k + 400)
        columns = {"time": measured["time"][rows]}
        columns |= {
            f"{kind}{j}": measured[f"{kind}{j}"][rows] for j in JOINTS for kind in ("q", "tau")
        }
        files.append(parquet(tmp_path / f"part{k:02}.parquet", columns))
    with served(project(tmp_path / "none", robot="")) as studio:
        w = window().open(studio)
        w.go("Data")
        drop(w, files)
        pictured(w)
        found = studio.project
        assert [log.file for log in found.logs] == [f"logs/part{k:02}.parquet" for k in range(30)]
        assert len(found.words("train")) == 29 and found.words("test") == ["logs/part29.parquet"]
        assert found.mapping == ()
        w.click("A robot with 3 joints to start from")
        made = until(w, studio, lambda p: p.robot)
        assert made.robot == "robot.toml"
        text = (studio.folder / "robot.toml").read_text(encoding="utf-8")
        assert '"q3"' in text and '"q4"' not in text
        w.page.wait_for_selector("iframe.studio-robot")
        assert w.complaints == []
