"""The screen "next motion": the most informative one, or distinguishes two effects."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nicegui import ui

from modeler.api.front_end import ModelerError, format_percent, parse_robot_text
from modeler.studio import figures
from modeler.studio.elements import (
    add_button,
    add_card,
    add_robot_frame,
    add_run_button,
    draw_error,
    draw_head,
    draw_note,
    draw_stale_warnings,
    draw_table,
    explain_missing,
)
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step, Task
from modeler.studio.thresholds import THRESHOLDS
from modeler.studio.timeline import add_player

if TYPE_CHECKING:  # who only draws loads nothing that computes
    from modeler.studio.robot_views import MotionPreview

_ALL = ""  # the question that has no two effects
_USED = ("lower", "upper", "speed", "acceleration", "torque")
_CHOSEN = "motion"
"""What this window asks for, `{"between": "a@1,b@2", "duration": 10.0}`; others may set it."""


async def draw(studio: Studio) -> None:
    """Draws the screen of the motion that the robot should do next."""
    draw_head(
        "Design experiment", "The motion within the robot's limits whose log identifies most."
    )
    project = studio.project
    if not project.robot:
        return explain_missing(studio, "There is no robot yet.", "To the robot", "robot")
    if project.model_file:
        draw_stale_warnings(studio)
    with add_card("Objective"):
        _draw_request(studio)
    step = project.find_step_about("excite")
    if step is None:
        return None
    try:
        result = studio.read_result(step)
        look: MotionPreview = await studio.ask_viewer("motion_look", step.output, step.result_file)
        with add_card(f"Found: {step.task.title}"):
            _draw_result(studio, step, result)
        await _draw_motion(studio, step, look)
    except ModelerError as error:
        draw_error(error)
    return None


def find_questions(result: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Finds equivalent effects of a diagnosis: words of `--between`, and a sentence."""
    known_pairs = set()
    for effect in result.get("effects", ()):
        for tie in effect.get("ties", ()):
            pair = [f"{e['effect']}@{e['joint']}" for e in (effect, tie) if e["joint"]]
            if len(pair) == 2 and pair[0] != pair[1] and frozenset(pair) not in known_pairs:
                known_pairs.add(frozenset(pair))
                one, other = (e.replace("_", " ").replace("@", " on joint ") for e in pair)
                yield ",".join(pair), f"distinguish {one} from {other}"


def _draw_request(studio: Studio) -> None:
    project = studio.project
    default = {"between": _ALL, "duration": THRESHOLDS.motion_duration}
    chosen = studio.state.setdefault(_CHOSEN, default)
    whose = "the current model" if project.model_file else "the robot"
    options = {_ALL: f"all parameters of {whose}"}
    step = project.find_step_about("diagnose")
    if project.model_file and step is not None:
        options |= find_questions(studio.read_result(step))
    if chosen["between"] not in options:
        chosen["between"] = _ALL
    with ui.row().classes("items-center w-full gap-6"):
        between = ui.radio(options, value=chosen["between"]).props("dense")
        duration = ui.number("duration, s", value=chosen["duration"], min=1, max=600, step=1)
        duration.classes("w-32")
    if len(options) == 1 and project.model_file:
        text = (
            "For two effects that a diagnosis cannot distinguish, the motion that does is offered."
        )
        draw_note(text, "studio-small")

    def open_limits() -> None:
        studio.state["robot tab"] = "Limits"
        studio.open_screen("robot")

    with ui.row().classes("items-center"):
        draw_note("Its limits are those of the robot file.")
        add_button("Change them", open_limits, "flat icon-right=east")
    renew = add_run_button(
        studio,
        "Find the motion",
        lambda: Task("excite", limit=tuple(find_changed_limits(studio)), **chosen),
    )

    def update_request() -> None:
        chosen["between"] = between.value
        chosen["duration"] = float(duration.value or THRESHOLDS.motion_duration)
        renew()

    between.on_value_change(update_request)
    duration.on_value_change(update_request)


def find_changed_limits(studio: Studio) -> list[str]:
    """Finds limits of the robot file that the model does not know, as `--limit` words.

    Raises:
        ModelerError: the robot file cannot be read as it is.
    """
    if not studio.project.model_file:
        return []
    model = studio.read_model(studio.project.collect_path()[-1])
    known = parse_robot_text(str(model["robot_text"]), "model")
    robot = parse_robot_text(studio.read_text(studio.project.robot), studio.project.robot)
    return [
        f"{joint}={','.join(f'{value:.6g}' for value in vars(joint_limits).values())}"
        for joint, joint_limits in robot.limits.items()
        if known.limits.get(joint) != joint_limits
    ]


def _draw_result(studio: Studio, step: Step, result: Mapping[str, Any]) -> None:
    random = result["random_motions"]
    ui.label(
        f"Condition number {result['condition_scaled']:.4g}, columns of length one; the best of "
        f"{random['count']} random motions has {random['condition_scaled_best']:.4g}."
    )
    for line in _describe_separation(result.get("discrimination")):
        ui.label(line)
    rows = []
    for joint, limits in result["joints"].items():
        cells = []
        for what in _USED:
            used, limit = limits[what]["value"], limits[what]["limit"]
            known = "" if used is None else f"{used:.3g}"
            cells.append(known if limit is None else f"{known} of {limit:.3g}")
        rows.append((joint, *cells))
    draw_table(("joint", *_USED), rows)

    async def download_parquet() -> None:
        content = await studio.try_viewer("motion_parquet", step.output, step.result_file)
        if content is not None:
            ui.download.content(content, f"{Path(step.output).stem}.parquet")

    with ui.row():
        name, place = f"motion-{step.number}.csv", studio.folder / step.output
        add_button("Download CSV", lambda: ui.download.file(place, name))
        add_button("Download Parquet", download_parquet)


def _describe_separation(separation: Mapping[str, Any] | None) -> list[str]:
    """How well two effects are distinguished along the motion."""
    if not separation:
        return []
    lines = []
    for (name, each), other in zip(separation.items(), [*separation][::-1], strict=True):
        here, there = (format_percent(each[k]) for k in ("unexplained_share", "random_share"))
        lines.append(
            f"{name}: {here} of its torque is explained by neither the model nor {other}; best of "
            f"the random motions {there}; that part is {each['gain']:.3g} times as large"
        )
    return lines


async def _draw_motion(studio: Studio, step: Step, look: "MotionPreview") -> None:
    """The motion in 3-D and over time, with one cursor."""
    name = step.output
    with ui.element("div").classes("studio-split"):
        with ui.column().classes("w-full"):
            figures.draw_picture(look.picture, name)
        with ui.column().classes("studio-beside w-full"):
            frame = await add_robot_frame(studio, "calc(100vh - 260px)", alone=True)
            line = add_player(name, (float(look.time[0]), float(look.time[-1])))
            line.frame = frame.element_id
            line.show_motion(look.time, look.q)
