"""The screen "next motion": the one that tells most, or tells two effects apart."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from nicegui import ui

from modeler import excitation
from modeler.core.errors import ModelerError
from modeler.robot import robot_from_text
from modeler.studio import figures
from modeler.studio.elements import go_button, head, part, run_button, stale, table
from modeler.studio.robot_frame import robot_frame
from modeler.studio.robot_views import MotionLook
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step, Task
from modeler.studio.timeline import Timeline

_SECONDS = 10.0
_ALL = ""  # the question that has no two effects
_USED = ("lower", "upper", "speed", "acceleration", "torque")
_CHOSEN = "motion"
"""What this window asks for, `{"between": "a@1,b@2", "duration": 10.0}`; others may set it."""


async def draw(studio: Studio) -> None:
    """Draws it."""
    head(
        "Next motion", "What the robot should do next, within its limits, so that a log tells most."
    )
    project = studio.project
    if not project.robot:
        ui.label("There is no robot yet.")
        go_button(studio, "To the robot", "robot")
        return
    if project.model:
        stale(studio)
    with part("What it shall tell"):
        _wish(studio)
    step = project.about("excite")
    if step is None:
        return
    try:
        found = studio.result(step)
        look: MotionLook = await studio.view("motion_look", step.output, step.result)
        with part(f"Found: {step.task.title}"):
            _found(studio, step, found)
        await _shown(studio, step, look)
    except ModelerError as error:
        ui.label(str(error)).classes("studio-error").props("role=alert")


def questions(result: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """What a diagnosis leaves open between two effects: words of `--between`, and a sentence."""
    seen = set()
    for effect in result.get("effects", ()):
        for tie in effect.get("ties", ()):
            pair = [f"{e['effect']}@{e['joint']}" for e in (effect, tie) if e["joint"]]
            if len(pair) == 2 and pair[0] != pair[1] and frozenset(pair) not in seen:
                seen.add(frozenset(pair))
                one, other = (e.replace("_", " ").replace("@", " on joint ") for e in pair)
                yield ",".join(pair), f"tell {one} from {other}"


def _wish(studio: Studio) -> None:
    project = studio.project
    chosen = studio.kept.setdefault(_CHOSEN, {"between": _ALL, "duration": _SECONDS})
    whose = "the current model" if project.model else "the robot"
    options = {_ALL: f"all parameters of {whose}"}
    step = project.about("diagnose")
    if project.model and step is not None:
        options |= questions(studio.result(step))
    if chosen["between"] not in options:
        chosen["between"] = _ALL
    with ui.row().classes("items-center w-full gap-6"):
        between = ui.radio(options, value=chosen["between"]).props("dense")
        duration = ui.number("duration, s", value=chosen["duration"], min=1, max=600, step=1)
        duration.classes("w-32")
    if len(options) == 1 and project.model:
        ui.label(
            "Where a diagnosis cannot tell two effects apart, the motion that does is offered here."
        ).classes("studio-soft studio-small")

    def change() -> None:
        studio.kept["robot tab"] = "Limits"
        studio.go("robot")

    with ui.row().classes("items-center"):
        ui.label("Its limits are those of the robot file.").classes("studio-soft")
        ui.button("Change them", on_click=change).props("no-caps flat icon-right=east")
    renew = run_button(
        studio, "Find the motion",
        lambda: Task(
            "excite", between=chosen["between"], duration=chosen["duration"],
            limit=tuple(changed_limits(studio)),
        ),
    )  # fmt: skip

    def changed() -> None:
        chosen.update(between=between.value, duration=float(duration.value or _SECONDS))
        renew()

    between.on_value_change(changed)
    duration.on_value_change(changed)


def changed_limits(studio: Studio) -> list[str]:
    """What `--limit` says where the robot file has other limits by now than the model knows.

    Raises:
        ModelerError: the robot file cannot be read as it is.
    """
    if not studio.project.model:
        return []
    known = robot_from_text(str(studio.model(studio.project.path()[-1])["robot_text"]), "model")
    robot = robot_from_text(studio.text(studio.project.robot), studio.project.robot)
    return [
        f"{joint}={','.join(f'{value:.6g}' for value in vars(own).values())}"
        for joint, own in robot.limits.items()
        if known.limits.get(joint) != own
    ]


def _found(studio: Studio, step: Step, found: Mapping[str, Any]) -> None:
    random = found["random"]
    ui.label(
        f"Condition number {found['condition_scaled']:.4g}, columns of length one; the best of "
        f"{random['motions']} random motions has {random['condition_scaled_best']:.4g}."
    )
    for line in _between(found.get("between")):
        ui.label(line)
    rows = []
    for joint, limits in found["joints"].items():
        cells = []
        for what in _USED:
            used, limit = limits[what]["used"], limits[what]["limit"]
            known = "" if used is None else f"{used:.3g}"
            cells.append(known if limit is None else f"{known} of {limit:.3g}")
        rows.append((joint, *cells))
    table(("joint", *_USED), rows)

    async def as_parquet() -> None:
        place = Path(step.output)
        try:
            content = await studio.view("motion_parquet", str(place), step.result)
        except ModelerError as error:
            studio.show_error(str(error))
            return
        ui.download.content(content, f"{place.stem}.parquet")

    with ui.row():
        name, place = f"motion-{step.number}.csv", studio.folder / step.output
        ui.button("Download CSV", on_click=lambda: ui.download.file(place, name)).props("no-caps")
        ui.button("Download Parquet", on_click=as_parquet).props("no-caps")


def _between(told: Mapping[str, Any] | None) -> list[str]:
    """How well two effects are told apart along the motion."""
    if not told:
        return []
    (one, a), (other, b) = told.items()
    shares = ((a[key], b[key]) for key in ("left", "left_random", "gain"))
    return excitation.Separation((one, other), *shares).lines()


async def _shown(studio: Studio, step: Step, look: MotionLook) -> None:
    """The motion in 3-D and over time, with one cursor."""
    name = step.output
    with ui.element("div").classes("studio-split"):
        with ui.column().classes("w-full"):
            figures.draw(look.picture, name)
        with ui.column().classes("studio-beside w-full"):
            frame = await robot_frame(studio, "calc(100vh - 260px)", alone=True)
            with ui.row().classes("items-center no-wrap w-full"):
                button = ui.button(icon="play_arrow").props("round aria-label='play the motion'")
                ends = float(look.time[0]), float(look.time[-1])
                line = Timeline(name, ends).style(
                    "flex: 1 1 0; min-width: 0; margin: 8px 0 16px 8px"
                )
            line.frame = frame.id
            button.on_click(lambda: line.play(1.0))

            def playing(event: Any) -> None:
                button.props(f"icon={'pause' if event.args else 'play_arrow'}")

            line.on("playing", playing)
            line.show(look.time, look.q)
