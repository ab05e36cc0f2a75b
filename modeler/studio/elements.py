"""What several screens are made of: command lines, buttons that run them, lights, doubts."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Literal

from nicegui import ui
from nicegui.element import Element
from nicegui.elements.mixins.text_element import TextElement

from modeler.core.errors import ModelerError
from modeler.core.table import percent
from modeler.studio.access import REPORTS
from modeler.studio.commands import words_of
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Step, Task, typed

Light = Literal["good", "doubtful", "bad"]

LIGHTS: tuple[Light, ...] = ("good", "doubtful", "bad")
"""The worse, the later."""

_SHAPES: dict[Light, str] = {"good": "\u25cf", "doubtful": "\u25b2", "bad": "\u25a0"}
"""A disc, a triangle, a square: told apart without colour."""


def head(title: str, text: str = "") -> None:
    """What a screen is, and what one does there."""
    ui.label(title).classes("studio-head")
    if text:
        ui.label(text).classes("studio-soft")


def part(title: str) -> Element:
    """A card with a title; what is drawn inside `with` belongs to it."""
    with ui.card().classes("studio-card w-full") as card:
        ui.label(title).classes("studio-part")
    return card


def step_line(studio: Studio, step: Step) -> None:
    """The command line of a step, beside a button that copies it."""
    command_line(typed(words_of(studio.project, step)))


def command_line(text: str) -> ui.label:
    """A command line beside a button that copies it; `text` of the label makes it another one."""
    with ui.row().classes("items-center no-wrap studio-line"):
        line = ui.label(text).classes("studio-command").props("tabindex=0")
        copy = ui.button(icon="content_copy", on_click=lambda: ui.clipboard.write(line.text))
        copy.props("dense flat round size=sm aria-label='copy the command line'")
    return line


def run_button(
    studio: Studio,
    title: str,
    asked: Callable[[], Task],
    then: Callable[[Step], object] = lambda step: None,
    current: bool = True,
    small: bool = False,
) -> Callable[[], None]:
    """A button that carries out a command, with its command line beside it.

    While a command runs, and where this window only reads, it cannot be pressed.

    Args:
        studio: the window.
        title: of the button.
        asked: the command, asked for when it is shown and when it is run.
        then: is called with the step when it is done; not if it failed.
        current: as of `Studio.run`.
        small: True for one among others.

    Returns:
        What writes the command line anew, after what it depends on was changed.
    """

    async def pressed() -> None:
        room = studio.room
        try:
            wanted = asked()
        except ModelerError as error:
            studio.show_error(str(error))
            return
        step = await studio.run(wanted, current)
        if step is not None and room is not None:
            with room:  # the screen with this button was drawn anew
                then(step)

    with ui.row().classes("items-center no-wrap w-full"):
        button = ui.button(title, on_click=pressed).props("no-caps unelevated")
        button.props("outline dense" if small else "size=lg")
        busy_with(studio, button)
        line = command_line("")

    def renew() -> None:
        try:
            line.text = typed(words_of(studio.project, asked()))
        except ModelerError as error:
            line.text = str(error)

    renew()
    return renew


def busy_with(studio: Studio, button: ui.button) -> ui.button:
    """A button that changes the project: while a command runs, or another window may, it rests."""
    hub = studio.hub

    def free(running: object) -> bool:
        return (running is None or hub.gives_way) and not studio.read_only

    return button.bind_enabled_from(hub, "running", free)


def light(which: Light, text: str = "") -> None:
    """A light by shape, word and colour."""
    with ui.row().classes("items-center no-wrap gap-2"):
        ui.label(_SHAPES[which]).classes(f"studio-light studio-{which}").props("aria-hidden=true")
        ui.label(text or which).classes(f"studio-{which}")


_LEFT: Mapping[str, tuple[Light | None, str]] = {
    "noise": ("good", "what is left looks like noise"),
    "pattern": ("doubtful", "what is left has a pattern"),
    "other": ("doubtful", "what is left is no noise, and no pattern that was tried"),
    "untold": (None, "too few samples tell what is left"),
}


def what_is_left(joint: str, error: float, kind: str) -> None:
    """Of a joint: its error, and a light for what `modeler compare` says of the residual."""
    which, said = _LEFT[kind]
    text = f"joint {joint}: error {percent(error)}, {said}"
    if which is None:
        ui.label(text)
    else:
        light(which, text)


def doubt_lines(lines: Iterable[str], which: Light = "doubtful") -> None:
    """Sentences that warn, each with its mark."""
    for line in lines:
        with ui.row().classes("items-start no-wrap gap-2"):
            ui.label(_SHAPES[which]).classes(f"studio-light studio-{which}")
            ui.label(line)


def stale(studio: Studio) -> None:
    """Says where the current model is not that of the project as it is now."""
    project, way = studio.project, studio.project.path()
    first, last = way[0], way[-1]
    changed = {
        "the robot was": studio.hub.robot_of(last) != studio.text(ROBOT),
        "the mapping of columns was": first.task.mapping != project.mapping,
        "the training stretches were": last.task.logs != project.parts("train"),
    }
    lines = [f"{what} changed since this model was fitted" for what, so in changed.items() if so]
    newer = [log.file for log in project.logs if studio.newer(log.file, last)]
    lines += [f"the file {file} is newer than this model" for file in newer]
    doubt_lines(f"{line}; fit again" for line in lines)


def told(lines: Iterable[str]) -> None:
    """Sentences, one below the other."""
    for line in lines:
        ui.label(line)


def folded(title: str, lines: Sequence[str] | Sequence[Sequence[str]], *heads: str) -> None:
    """Sentences, or with heads a table, under a title that opens them; nothing of none."""
    if lines:
        with ui.expansion(f"{title} ({len(lines)})").classes("w-full studio-folded"):
            if heads:
                table(heads, lines)
            else:
                told(map(str, lines))


def number(value: float | None) -> str:
    """Three digits; a dash for none."""
    return "-" if value is None else f"{value:.3g}"


class Markup(str):
    """A text that is HTML already."""


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], faint: Sequence[bool] = ()) -> None:
    """Plain texts in rows; what stands in a text after a tab is shown when the mouse is over it.

    Args:
        heads: of the columns; all empty: no line of heads.
        rows: of texts.
        faint: by row, True for what is of less weight.
    """
    with ui.element("table").classes("studio-table"):
        if any(heads):
            with ui.element("tr"):
                for name in heads:
                    TextElement(tag="th", text=name).props("scope=col")
        for k, row in enumerate(rows):
            with ui.element("tr") as line:
                line.classes("studio-faint" if k < len(faint) and faint[k] else "")
                for text in row:
                    with ui.element("td"):
                        _cell(text)


def _cell(text: str) -> None:
    if isinstance(text, Markup):
        ui.html(text, sanitize=False)
        return
    shown, _, hint = text.partition("\t")
    own = TextElement(tag="span", text=shown)
    if hint:
        own.classes("studio-hint").props("tabindex=0").props["title"] = hint


def page_button(studio: Studio, step: Step) -> None:
    """The page of a step, self-contained: written when it is asked for, shown in a tab."""
    written = studio.project.about("page", step.number)
    if written is None or not (studio.folder / written.output).is_file():
        page = Task("page", step=step.number)
        run_button(studio, "Report page", lambda: page, small=True)
        return
    with ui.row().classes("items-center no-wrap w-full"):
        address = studio.hub.sheet(studio.text(written.output), REPORTS)
        ui.link("Open the report page", address, new_tab=True)
        step_line(studio, written)


def lacks_model(studio: Studio) -> None:
    """What a screen says before there is a model, and the way to one."""
    ui.label("There is no model yet: fit one first.")
    go_button(studio, "To the fit", "fit")


def go_button(studio: Studio, title: str, screen: str) -> None:
    """To another screen."""
    ui.button(title, on_click=lambda: studio.go(screen)).props("no-caps flat icon-right=east")
