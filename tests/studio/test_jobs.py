"""Six jobs in a row, as a person does them with an arm.

With --regenerate the windows of the arm become the pictures of the studio page and of the README.
"""

import io
import json
from pathlib import Path

from tests.studio.window import Served, Window, served

DOCS = Path(__file__).resolve().parents[2] / "docs" / "studio"
KEPT = {"robot": 900, "data": 1000, "fit": 900, "fails": 1400, "missing": 1250, "fall": 1150}
"""Pictures, and the heights of their windows."""
STORY, GAP = {"missing": 832, "fall": 574}, 24
"""`story.png`, of the README: the upper rows of the named effect and of the error that falls."""


class Person:
    """Somebody who goes through the jobs of a studio in a window and keeps pictures of it."""

    def __init__(self, window: Window, studio: Served) -> None:
        self.window, self.studio, self.page = window, studio, window.page

    def keep(self, name: str) -> None:
        """What is seen, as a picture of the documentation."""
        self.page.set_viewport_size({"width": 1280, "height": KEPT[name]})
        self.page.wait_for_timeout(1200)
        (DOCS / f"{name}.png").write_bytes(in_few_colours(self.page.screenshot()))

    def count(self, kind: str) -> int:
        return sum(step.verb == kind for step in self.studio.project.steps)

    def runs(self, button: str, kind: str) -> None:
        """A command by its button, until it is a step and the screen shows it."""
        before = self.count(kind)
        self.window.click(button, exact=True)
        self.window.until(lambda: self.count(kind) > before)
        self.window.idle()

    def draws(self, kind: str) -> None:
        self.page.locator(f".js-plotly-plot {kind}").first.wait_for()


def do_jobs(person: Person) -> None:
    """From the robot on; the effect that is missing is named and added."""
    window, page, project = person.window, person.page, lambda: person.studio.project
    window.go("1  Robot")
    page.get_by_role("tab", name="Base parameters").click()
    person.runs("Derive", "derive")
    window.sees("proof: exact")
    person.keep("robot")
    window.go("2  Data")
    person.draws(".scatterlayer path.js-line")
    page.wait_for_timeout(1500)  # the robot stands
    person.keep("data")
    window.go("3  Fit")
    person.runs("Fit", "fit")
    window.sees("Fit quality")
    person.keep("fit")
    window.go("4  Where it fails")
    person.draws(".scatterlayer path.js-line")
    window.sees("What the residual follows")
    person.draws(".heatmaplayer")
    person.keep("fails")
    window.go("5  What is missing")
    person.runs("Diagnose", "diagnose")
    window.sees("Verdict")
    page.wait_for_timeout(1000)
    person.keep("missing")
    (step,) = (step for step in project().steps if step.verb == "diagnose")
    (result,) = json.loads((person.studio.folder / step.result_file).read_text())["effects"]
    assert (result["effect"], result["joint"]) == ("load_friction", "2")
    before = project().current
    person.runs("Preview", "add")
    window.sees("Preview. ")
    window.click("Add", exact=True)
    person.window.until(lambda: project().current != before)
    window.go("6  Error history")
    person.draws(".bars")
    person.keep("fall")
    assert window.complaints == []


def in_few_colours(picture: bytes) -> bytes:
    """A PNG of a quarter of the bytes, which differs to no eye."""
    from PIL import Image

    whole = io.BytesIO()
    small = Image.open(io.BytesIO(picture)).convert("RGB").quantize(192)
    small.save(whole, "PNG", optimize=True)
    return whole.getvalue()


def story(folder: Path) -> bytes:
    """The upper parts of kept pictures, one under the other."""
    from PIL import Image

    whole = Image.new("RGB", (1280, sum(STORY.values()) + GAP * (len(STORY) - 1)), "white")
    top = 0
    for name, height in STORY.items():
        window = Image.open(folder / f"{name}.png").convert("RGB")
        whole.paste(window.crop((0, 0, 1280, height)), (0, top))
        top += height + GAP
    written = io.BytesIO()
    whole.save(written, "PNG")
    return in_few_colours(written.getvalue())


def test_an_arm_with_a_hidden_effect(tmp_path, request, regenerate: bool) -> None:
    """Its jobs are tested one by one elsewhere; here they are gone through for the pictures."""
    if not regenerate:
        pictures = [*KEPT, "story"]
        assert all((DOCS / f"{name}.png").is_file() for name in pictures), "run `make regenerate`"
        return
    with served(tmp_path / "arm") as studio:
        person = Person(request.getfixturevalue("window")().open(studio), studio)
        person.window.click("Try the demo")
        person.page.wait_for_url("**/data")
        person.window.until(lambda: person.count("log") == 2)
        do_jobs(person)
    (DOCS / "story.png").write_bytes(story(DOCS))
