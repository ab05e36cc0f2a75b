"""Names that are programs: of folder, files, columns, robot, steps. No screen runs one of them."""

import csv
from pathlib import Path

import pytest

from modeler.core.choices import read_builtin_robot
from modeler.studio import commands
from modeler.studio.project import Project, ProjectLog, Workspace
from modeler.studio.tasks import TimeRange
from tests.studio.hubs import hub_of, run_tasks
from tests.studio.window import served

RUN = "window.pwned=1"
TAG = f"<img src=x onerror={RUN}>"
TEMPLATE = f"{{{{constructor.constructor('{RUN}')()}}}}"
QUOTED = f'" :onmouseover="{RUN}" x="'
SINGLE = f"' :onmouseover='{RUN}' :style='{RUN}' x='"
HARM = f"{TAG} {TEMPLATE} {QUOTED} '+{RUN}+' `${{{RUN}}}` <!--"
FOLDER = f"{TAG} '+{RUN}+' {TEMPLATE}"
CLOSING = f"</title></script><script>{RUN}</script>"


pytestmark = [pytest.mark.slow, pytest.mark.rotating("screens of the studio")]


@pytest.fixture(scope="module")
def hostile(axis: Path, tmp_path_factory) -> Path:
    """A project with a fit, a comparison and a diagnosis, in which every free name is harmful."""
    folder = tmp_path_factory.mktemp("names") / FOLDER
    (folder / "logs").mkdir(parents=True)
    message = (HARM + CLOSING).replace("\\", "").replace('"', "'")
    text = read_builtin_robot("emps").replace("EMPS, one", f"{message} one")
    (folder / "robot.toml").write_text(text)
    plain = axis / "logs/a.csv"
    with plain.open(newline="") as file:
        head, *rows = csv.reader(file)
    name = f"logs/{TAG} {TEMPLATE} {QUOTED}.csv"
    with (folder / name).open("w", newline="") as file:
        item = csv.writer(file)
        item.writerow([*head, HARM, f"q9 {TAG}", f"temp{CLOSING.replace('/', '|')}"])
        item.writerows([*row, row[0], row[1], "20"] for row in rows)
    log = ProjectLog(name, (TimeRange(0.0, 3.0),), (TimeRange(3.5, 6.0),), (TimeRange(1.0, 1.1),))
    project = Project("robot.toml", logs=(log,), without=(TAG, QUOTED, SINGLE), mapping=())

    Workspace(folder).save(project)
    with hub_of(folder) as hub:
        run_tasks(hub, commands.fit, commands.compare)
    return folder


def test_no_screen_runs_a_name(hostile: Path, window) -> None:
    from modeler.studio.app import JOBS

    with served(hostile) as studio:
        page = window()
        page.open(studio)
        assert page.page.title().startswith(FOLDER)
        for screen, (title, _) in JOBS.items():
            page.go(title)
            page.page.wait_for_timeout(600)
            for place in page.page.locator("[title], .mapping-chip, td").all()[:12]:
                if place.is_visible():
                    place.hover(force=True, timeout=2000)
            assert page.page.evaluate("() => window.pwned") is None, screen
            assert page.page.locator("img[src=x]").count() == 0, screen
        seen = page.page.content()
        assert "pwned" in seen  # the names are there, as names


REACHING = """<script>
window.told = [];
const told = (name) => (got) => window.told.push(`${name} ${got.status ?? got.name ?? got.type}`);
fetch("/").then(told("GET"), told("GET"));
fetch("/drop/logs", { method: "POST", body: "x" }).then(told("POST"), told("POST"));
const socket = new WebSocket(`ws://${location.host}/_nicegui_ws/socket.io/?EIO=4&transport=websocket`);
socket.onopen = socket.onerror = told("socket");
try { told("cookie")(document.cookie) } catch (error) { told("cookie")(error) }
</script>"""


def test_a_report_that_somebody_wrote_reaches_nothing(hostile: Path, window) -> None:
    """Its scripts draw, as those of ours do; they are not let into the studio."""
    with served(hostile) as studio:
        page = window().open(studio)
        page.go("Export")
        page.click("Report page")
        page.sees("Open the report page")
        (report,) = (hostile / "pages").glob("*.html")
        ours = report.read_text(encoding="utf-8")
        free = ours.replace("Content-Security-Policy", "x-none")  # what ours forbids itself
        report.write_text(free + REACHING, encoding="utf-8")
        page.go("Error history")
        page.go("Export")
        with page.page.context.expect_page() as opened:
            page.page.get_by_text("Open the report page").first.click()
        shown = opened.value
        shown.wait_for_selector(".main-svg")
        shown.wait_for_function("() => window.told.length === 4")
        assert set(shown.evaluate("() => window.told")) == {
            "GET TypeError",
            "POST TypeError",
            "socket error",
            "cookie SecurityError",
        }
        assert not list((hostile / "logs").glob("[!<]*"))
