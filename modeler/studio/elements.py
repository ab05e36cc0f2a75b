"""What several screens are made of: command lines, buttons that run them, lights, warnings."""

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal

from nicegui import ui
from nicegui.element import Element
from nicegui.elements.mixins.text_element import TextElement

from modeler.api.front_end import ModelerError, format_percent
from modeler.studio.access import REPORTS
from modeler.studio.commands import build_command_words
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Step, Task, format_command

Light = Literal["good", "doubtful", "bad"]

LIGHTS: tuple[Light, ...] = ("good", "doubtful", "bad")
"""The worse, the later."""

_SHAPES: dict[Light, str] = {"good": "\u25cf", "doubtful": "\u25b2", "bad": "\u25a0"}
"""A disc, a triangle, a square: distinguished without colour."""


def draw_head(title: str, text: str = "") -> None:
    """Draws the title of a screen and what it is for."""
    ui.label(title).classes("studio-head")
    if text:
        draw_note(text)


def draw_note(text: str, *classes: str) -> ui.label:
    """Draws a sentence of less weight."""
    return ui.label(text).classes(" ".join(("studio-soft", *classes)))


def draw_error(error: object) -> None:
    """Draws the line of an error in its place."""
    ui.label(str(error)).classes("studio-error").props("role=alert")


def add_button(title: str, act: Callable[..., object], props: str = "", **icon: str) -> ui.button:
    """Adds a button whose title is written as it is."""
    return ui.button(title, on_click=act, **icon).props("no-caps").props(props)


def add_card(title: str) -> Element:
    """Adds a card with a title; elements inside `with` belong to it."""
    with ui.card().classes("studio-card w-full") as card:
        ui.label(title).classes("studio-part")
    return card


def draw_step_line(studio: Studio, step: Step) -> None:
    """Draws the command line of a step, with a copy button."""
    draw_command_line(format_command(build_command_words(studio.project, step)))


def draw_command_line(text: str) -> ui.label:
    """Draws a command line with a copy button; returns the label of the line."""
    with ui.row().classes("items-center no-wrap studio-line"):
        line = ui.label(text).classes("studio-command").props("tabindex=0")
        copy = ui.button(icon="content_copy", on_click=lambda: ui.clipboard.write(line.text))
        copy.props("dense flat round size=sm aria-label='copy the command line'")
    return line


def add_run_button(
    studio: Studio,
    title: str,
    build_task: Callable[[], Task],
    on_done: Callable[[Step], object] = lambda step: None,
    current: bool = True,
    small: bool = False,
) -> Callable[[], None]:
    """Adds a button that runs a command, with its command line beside it.

    While a command runs, and where this window only reads, it cannot be pressed.

    Args:
        studio: the window.
        title: of the button.
        build_task: the command, requested when it is shown and when it is run.
        on_done: is called with the step when it is done; not if it failed.
        current: as of `Studio.run`.
        small: True for one among others.

    Returns:
        What writes the command line anew, after what it depends on was changed.
    """

    async def run_task() -> None:
        room = studio.room
        with studio.show_errors():
            step = await studio.run(build_task(), current)
            if step is not None and room is not None:
                with room:  # the screen with this button was drawn anew
                    on_done(step)

    with ui.row().classes("items-center no-wrap w-full"):
        button = add_button(title, run_task, "unelevated")
        disable_while_busy(studio, button.props("outline dense" if small else "size=lg"))
        line = draw_command_line("")

    def update_line() -> None:
        try:
            line.text = format_command(build_command_words(studio.project, build_task()))
        except ModelerError as error:
            line.text = str(error)

    update_line()
    return update_line


def disable_while_busy(studio: Studio, button: ui.button) -> ui.button:
    """Disables a button while a command runs or the window is read-only."""
    hub = studio.hub

    def is_free(running: object) -> bool:
        return (running is None or hub.gives_way) and not studio.is_read_only

    return button.bind_enabled_from(hub, "running", is_free)


def draw_light(which: Light, text: str = "") -> None:
    """Draws a light by shape, word and colour."""
    with ui.row().classes("items-center no-wrap gap-2"):
        ui.label(_SHAPES[which]).classes(f"studio-light studio-{which}").props("aria-hidden=true")
        ui.label(text or which).classes(f"studio-{which}")


_LEFT: Mapping[str, tuple[Light | None, str]] = {
    "noise": ("good", "what is left looks like noise"),
    "pattern": ("doubtful", "what is left has a pattern"),
    "other": ("doubtful", "what is left is no noise, and no pattern that was tried"),
    "untold": (None, "too few samples show what is left"),
}


def draw_residual_state(joint: str, error: float, kind: str) -> None:
    """Draws the error of a joint, with a light for the state of its residual."""
    which, description = _LEFT[kind]
    text = f"joint {joint}: error {format_percent(error)}, {description}"
    if which is None:
        ui.label(text)
    else:
        draw_light(which, text)


def draw_warnings(lines: Iterable[str], which: Light = "doubtful") -> None:
    """Draws warnings, each with its mark."""
    for line in lines:
        with ui.row().classes("items-start no-wrap gap-2"):
            ui.label(_SHAPES[which]).classes(f"studio-light studio-{which}")
            ui.label(line)


def draw_stale_warnings(studio: Studio) -> None:
    """Says where the current model is not that of the project as it is now."""
    project, model_path = studio.project, studio.project.collect_path()
    first, last = model_path[0], model_path[-1]
    changed = {
        "the robot was": studio.hub.read_step_robot(last) != studio.read_text(ROBOT),
        "the mapping of columns was": first.task.mapping != project.mapping,
        "the training segments were": last.task.logs != project.collect_parts("train"),
    }
    lines = [f"{what} changed since this model was fitted" for what, so in changed.items() if so]
    newer = [log.file for log in project.logs if studio.is_newer(log.file, last)]
    lines += [f"the file {file} is newer than this model" for file in newer]
    draw_warnings(f"{line}; fit again" for line in lines)


def draw_lines(lines: Iterable[str]) -> None:
    """Draws sentences, one below the other."""
    for line in lines:
        ui.label(line)


def draw_folded(title: str, lines: Sequence[str] | Sequence[Sequence[str]], *heads: str) -> None:
    """Draws sentences, or a table, under a title that opens them."""
    if lines:
        with ui.expansion(f"{title} ({len(lines)})").classes("w-full studio-folded"):
            if heads:
                draw_table(heads, lines)
            else:
                draw_lines(map(str, lines))


def format_number(value: float | None) -> str:
    """Formats a number with three digits; None as a dash."""
    return "-" if value is None else f"{value:.3g}"


class Markup(str):
    """A text that is HTML already."""


def draw_table(
    heads: Sequence[str], rows: Iterable[Sequence[str]], faint: Sequence[bool] = ()
) -> None:
    """Draws a table; text after a tab in a cell is its tooltip.

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
                        _draw_cell(text)


def _draw_cell(text: str) -> None:
    if isinstance(text, Markup):
        ui.html(text, sanitize=False)
        return
    visible, _, hint = text.partition("\t")
    span = TextElement(tag="span", text=visible)
    if hint:
        span.classes("studio-hint").props("tabindex=0").props["title"] = hint


def add_page_button(studio: Studio, step: Step) -> None:
    """Adds the button that writes and opens the report page of a step."""
    written = studio.project.find_step_about("page", step.number)
    if written is None or not (studio.folder / written.output).is_file():
        page = Task("page", step=step.number)
        add_run_button(studio, "Report page", lambda: page, small=True)
        return
    with ui.row().classes("items-center no-wrap w-full"):
        address = studio.hub.register_sheet(studio.read_text(written.output), REPORTS)
        ui.link("Open the report page", address, new_tab=True)
        draw_step_line(studio, written)


def explain_missing_model(studio: Studio) -> None:
    """Draws the hint that there is no model yet, with the way to the fit."""
    explain_missing(studio, "There is no model yet: fit one first.", "To the fit", "fit")


def explain_missing(studio: Studio, line: str, title: str, screen: str) -> None:
    """Draws what is missing for a screen, with the way to where it is made."""
    ui.label(line)
    add_go_button(studio, title, screen)


def add_go_button(studio: Studio, title: str, screen: str) -> None:
    """Adds a button that opens another screen."""
    add_button(title, lambda: studio.open_screen(screen), "flat icon-right=east")


class RobotFrame:
    """The page of a robot in a frame.

    Attributes:
        frame: the element.
    """

    def __init__(self, studio: Studio, html: str, height: str, alone: bool = False) -> None:
        address = studio.hub.register_sheet(html)
        self.frame = ui.element("iframe").classes("studio-robot").style(f"height: {height}")
        self.frame.props(f'src="{address}#bare{"-alone" * alone}" title="the robot in 3-D"')

    @property
    def element_id(self) -> str:
        """Returns the id of the element, for scripts: `toRobot(id, message)`."""
        return self.frame.html_id

    def show_clearly(self, rows: Sequence[str]) -> None:
        """Shows links and joints clearly, the others faintly; none: all alike."""
        self._send_message(modeler="light", rows=list(rows))

    def replace_robot(self, content: Mapping[str, Any]) -> None:
        """Shows another robot from the same view."""
        self._send_message(modeler="robot", content=content)

    def connect_joint(self, handler: Callable[[str], Any]) -> None:
        """Calls `handler` with the name of a joint or link that is clicked."""
        self.frame.on("joint", lambda event: handler(str(event.args["detail"])), args=["detail"])

    def _send_message(self, **message: Any) -> None:
        words = json.dumps(message, separators=(",", ":"))
        self.frame.client.run_javascript(f"toRobot({json.dumps(self.element_id)}, {words})")


async def add_robot_frame(studio: Studio, height: str = "420px", alone: bool = False) -> RobotFrame:
    """Adds the frame with the robot of the project.

    Args:
        studio: the window.
        height: of the frame, as CSS has it.
        alone: True for nothing but the picture: no sliders.

    Raises:
        ModelerError: the project has no robot that can be drawn; the line.
    """
    text = studio.read_text(studio.project.robot)
    return RobotFrame(studio, await studio.ask_viewer("robot_page", text), height, alone)
