"""Eight jobs in a row, as a person does them with an arm.

With --regenerate the windows of the arm become the pictures of the studio page and of the README.
"""

import io
from collections.abc import Callable
from pathlib import Path

from tests.studio.window import Served, Window, served

DOCS = Path(__file__).resolve().parents[2] / "docs" / "studio"
KEPT = {"robot": 900, "data": 1000, "fit": 900, "fails": 1400, "missing": 1250, "fall": 1150}
"""Pictures, and the heights of their windows."""
STORY, GAP = {"missing": 832, "fall": 574}, 24
"""`story.png`, of the README: the upper rows of the named effect and of the error that falls."""

Kept = Callable[[str], None]


class Person:
    """Somebody who goes through the jobs and looks at each.

    Attributes:
        window: in which that is done.
        studio: that is looked at.
        keep: is told when a window is worth a picture.
    """

    def __init__(self, window: Window, studio: Served, keep: Kept) -> None:
        self.window, self.studio, self.keep = window, studio, keep
        self.page = window.page

    def count(self, kind: str) -> int:
        return sum(step.verb == kind for step in self.studio.project.steps)

    def until(self, holds: Callable[[], bool], seconds: float = 120.0) -> None:
        for _ in range(int(5 * seconds)):
            if holds():
                return
            self.page.wait_for_timeout(200)
        raise TimeoutError

    def runs(self, button: str, kind: str) -> None:
        """A command by its button, until it is a step and the screen shows it."""
        before = self.count(kind)
        self.window.click(button, exact=True)
        self.until(lambda: self.count(kind) > before)
        self.window.idle()

    def sees_a_curve(self) -> None:
        self.page.locator(".js-plotly-plot .scatterlayer path.js-line").first.wait_for()

    def derives(self) -> None:
        self.window.go("1  Robot")
        self.page.get_by_role("tab", name="Base parameters").click()
        self.runs("Derive", "derive")
        self.window.sees("proof: exact")
        self.keep("robot")

    def plays(self) -> None:
        self.window.go("2  Data")
        self.sees_a_curve()
        self.page.wait_for_timeout(1500)  # the robot stands
        self.keep("data")

    def fits(self) -> None:
        self.window.go("3  Fit")
        self.runs("Fit", "fit")
        self.window.sees("What it is worth")
        self.keep("fit")

    def sees_where_it_fails(self) -> None:
        self.window.go("4  Where it fails")
        self.sees_a_curve()
        self.window.sees("What the residual follows")
        self.page.locator(".js-plotly-plot .heatmaplayer").first.wait_for()
        self.keep("fails")

    def learns_what_is_missing(self) -> list[str]:
        """Ids of the effects that can be added, with their joints."""
        self.window.go("5  What is missing")
        self.runs("Look", "diagnose")
        self.window.sees("Verdict")
        self.page.wait_for_timeout(1000)
        self.keep("missing")
        step = next(step for step in self.studio.project.steps if step.verb == "diagnose")
        found = self.studio.result(step)
        return [f"{one['effect']}@{one['joint']}" for one in found["effects"]]

    def adds_it(self) -> None:
        before = self.studio.project.current
        self.runs("Preview", "add")
        self.window.sees("Preview. ")
        assert self.studio.project.current == before
        self.window.click("Add", exact=True)
        self.until(lambda: self.studio.project.current != before)

    def watches_it_fall(self) -> None:
        self.window.go("6  Watch it fall")
        self.page.locator(".js-plotly-plot .bars").first.wait_for()
        self.keep("fall")

    def compares_days(self) -> None:
        self.window.go("7  Days and machines")
        self.runs("Compare", "compare")
        self.window.sees("Residuals of both logs")
        self.keep("days")

    def takes_c_away(self) -> None:
        self.window.go("9  Take away")
        self.runs("Write C", "generate")
        with self.page.expect_download() as coming:
            self.page.get_by_role("button", name="Download").first.click()
        assert Path(coming.value.path()).stat().st_size > 1000
        self.keep("take")


def all_of(person: Person) -> list[str]:
    """From the fit on; the effects that were named."""
    person.derives()
    person.plays()
    person.fits()
    person.sees_where_it_fails()
    named = person.learns_what_is_missing()
    if named:
        person.adds_it()
        person.watches_it_fall()
    person.compares_days()
    person.takes_c_away()
    assert person.window.complaints == []
    return named


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


def test_an_arm_with_a_hidden_effect(tmp_path, window, regenerate: bool) -> None:
    """Its jobs are tested one by one elsewhere; here they are gone through for the pictures."""
    if not regenerate:
        kept = [*KEPT, "story"]
        assert all((DOCS / f"{name}.png").is_file() for name in kept), "run `make regenerate`"
        return
    with served(tmp_path / "arm") as studio:
        seat = window(accept_downloads=True)

        def keep(name: str) -> None:
            if regenerate and name in KEPT:
                seat.page.set_viewport_size({"width": 1280, "height": KEPT[name]})
                seat.page.wait_for_timeout(1200)
                DOCS.mkdir(exist_ok=True)
                (DOCS / f"{name}.png").write_bytes(in_few_colours(seat.page.screenshot()))

        person = Person(seat.open(studio), studio, keep)
        seat.click("Try the demo")
        seat.page.wait_for_url("**/data")
        person.until(lambda: person.count("log") == 2)
        assert all_of(person) == ["load_friction@2"]
    (DOCS / "story.png").write_bytes(story(DOCS))
