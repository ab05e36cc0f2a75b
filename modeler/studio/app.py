"""The server of the studio and its first page: a demonstration, a robot, a log."""

import dataclasses
import io
import socket
import zipfile
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any
from urllib.parse import quote

import uvicorn
from fastapi import FastAPI, Response
from fastapi.responses import FileResponse, HTMLResponse
from nicegui import Client, app as nicegui_app, background_tasks, ui

from modeler.api.front_end import (
    ModelerError,
    locate_resources,
    read_builtin_robot,
    read_text,
    write_atomically,
)
from modeler.studio import (
    comparison_screens,
    data_screen,
    diagnosis_screens,
    export_screen,
    file_inputs,
    fit_screen,
    motion_screen,
    robot_screen,
)
from modeler.studio.access import REPORTS, Guard
from modeler.studio.commands import build_command_words
from modeler.studio.elements import add_button, draw_command_line, draw_head, draw_note
from modeler.studio.places import lock_folder
from modeler.studio.project import FOREIGN, Project, ProjectLog, Workspace
from modeler.studio.studio import Hub, Studio
from modeler.studio.tasks import ROBOT, Task, TimeRange, format_command
from modeler.studio.thresholds import THRESHOLDS

_RUNS = (("logs/train.parquet", 1), ("logs/held_out.parquet", 2))


async def draw_start(studio: Studio) -> None:
    """Draws the screen on which a project starts."""
    draw_head(
        "Your robot's real dynamics",
        "Compare a model with measurements, see where it fails, learn which physical effect is "
        "missing, add it, and watch the error fall.",
    )
    acts: tuple[Callable[[], Any], ...] = (
        partial(open_demo, studio),
        partial(studio.open_screen, "robot"),
        partial(studio.open_screen, "data"),
    )
    with ui.row().classes("studio-choices"):
        for (title, icon, text), act in zip(_STARTS, acts, strict=True):
            face = ui.button(on_click=act).props("flat no-caps").classes("studio-choice")
            with face, ui.column():
                ui.icon(icon, size="2.5rem")
                ui.label(title).classes("studio-choice-title")
                draw_note(text)


_STARTS = (
    (
        "Try the demo",
        "play_circle",
        "An arm with three joints, two measured runs, and an effect that its model lacks.",
    ),
    (
        "Start from a table",
        "precision_manufacturing",
        "Paste the table of a paper, open a URDF, MJCF or .par, or take a built-in robot.",
    ),
    (
        "Start from a log",
        "show_chart",
        "CSV, Parquet, MAT, HDF5, MCAP, ROS bags, sheets: see what is in it.",
    ),
)


async def open_demo(studio: Studio) -> None:
    """Opens the demonstration; shows errors in the window."""
    with studio.show_errors():
        studio.check_writable()
        await begin_demo(studio.hub)
        if studio.screen == "start":  # nobody has gone elsewhere meanwhile
            studio.open_screen("data")


async def begin_demo(hub: Hub) -> None:
    """Writes the demonstration arm and simulates two runs with a hidden effect.

    Raises:
        ModelerError: the folder has a robot already, or cannot be written.
    """
    if hub.project.robot:
        raise ModelerError(
            f"{hub.workspace.folder}: holds a robot already; open the demonstration in a folder of "
            "its own: modeler studio FOLDER --demo"
        )
    write_atomically(hub.workspace.folder / ROBOT, read_builtin_robot("demo-arm"))
    for log, seed in _RUNS:
        await hub.run(Task("simulate", file=log, seed=seed))
    train, held_out_file = (log for log, _ in _RUNS)
    logs = ProjectLog(train, train=(TimeRange(),)), ProjectLog(held_out_file, test=(TimeRange(),))
    hub.workspace.save(dataclasses.replace(hub.project, robot=ROBOT, logs=logs))
    hub.refresh()


JOBS = {
    "robot": ("Robot", robot_screen.draw),
    "data": ("Data", data_screen.draw),
    "fit": ("Fit", fit_screen.draw),
    "fails": ("Where it fails", comparison_screens.draw_fails),
    "missing": ("What is missing", diagnosis_screens.draw_missing),
    "fall": ("Error history", diagnosis_screens.draw_history),
    "days": ("Compare and drift", comparison_screens.draw_days),
    "motion": ("Design experiment", motion_screen.draw),
    "take": ("Export", export_screen.draw),
}
"""The nine jobs, in the order in which they are done; Alt and the number goes there."""


def serve(
    folder: Path,
    allow: Sequence[Path] = (),
    port: int = 0,
    demo: bool = False,
    on_ready: Callable[[str, str, str], None] = lambda address, once, warning: None,
) -> None:
    """Serves the studio of a project folder on this machine, until it is interrupted.

    Args:
        folder: of the project; made if it is not there.
        allow: folders whose files may be chosen where they lie, besides it.
        port: 0: one that is free.
        demo: True: begin with the built-in arm that has a hidden effect.
        on_ready: is called when it answers, with the address, its token in it, one that can be
            opened once, and the line that says that the project is somebody else's, or "".

    Raises:
        ModelerError: the folder cannot be used, or the port is taken.
    """
    with ExitStack() as resources, socket.socket() as server_socket:
        workspace = Workspace(folder, writable=resources.enter_context(lock_folder(folder)))
        try:
            # One that ended may linger.
            server_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            server_socket.bind(("127.0.0.1", port))
            server_socket.listen()  # who comes before all is ready waits
        except OSError as error:
            raise ModelerError(
                f"--port {port}: cannot be opened ({error.strerror}); choose another one, or 0"
            ) from None
        screens = {name: draw for name, (_, draw) in JOBS.items()}
        hub = Hub(workspace, (folder, *allow), {"start": draw_start, **screens})
        hub.acquire_folder = lambda: resources.enter_context(lock_folder(folder))
        inner = FastAPI(openapi_url=None)
        _add_routes(inner, hub)
        _add_pages(hub, demo)
        ui.run_with(
            inner,
            title="modeler studio",
            dark=None,
            show_welcome_message=False,
            reconnect_timeout=THRESHOLDS.ping_timeout,
        )
        guard = Guard(inner, server_socket.getsockname()[1])
        config = uvicorn.Config(guard, log_level="warning", lifespan="on")
        nicegui_app.on_startup(hub.viewer.launch)  # it is there when the first page asks
        warning = FOREIGN.format(folder) if workspace.foreign else ""
        on_ready(guard.address, guard.one_time_address, warning)
        try:
            uvicorn.Server(config).run(sockets=[server_socket])
        finally:
            hub.close()


def _add_routes(app: FastAPI, hub: Hub) -> None:
    """What is no page of the studio itself."""
    file_inputs.add_route(app, hub.workspace.folder, lambda: hub.workspace.can_change)
    templates_folder = locate_resources("templates") / "studio"

    @app.get("/studio.{kind}")
    def serve_asset(kind: str) -> Response:
        types = {"js": "text/javascript", "css": "text/css"}
        if kind not in types:
            return Response(status_code=404)
        parts = [read_text(templates_folder / f"{name}.{kind}") for name in ("studio", "robot")]
        return Response("\n".join(parts), media_type=types[kind])

    @app.get("/download/{key}")
    def serve_download(key: str) -> Response:
        content, name = hub.downloads.get(key, (b"", ""))
        if not name:
            return Response(status_code=404)
        if isinstance(content, bytes):
            return _send_attachment(content, name)
        if content.is_dir():
            return _send_attachment(_pack_folder(content, name), f"{name}.zip")
        if not content.is_file():
            return Response("the file is gone; make it again\n", 404)
        return FileResponse(content, filename=name)

    @app.get("/sheet/{digest}.html")
    @app.get(f"{REPORTS}{{digest}}.html")
    def serve_sheet(digest: str) -> Response:
        html = hub.sheets.get(digest)
        return Response(status_code=404) if html is None else HTMLResponse(html)


def _pack_folder(folder: Path, name: str) -> bytes:
    """A folder as ZIP, in a folder of that name."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(file for file in folder.rglob("*") if file.is_file()):
            archive.write(file, f"{name}/{file.relative_to(folder).as_posix()}")
    return buffer.getvalue()


def _send_attachment(content: bytes, name: str) -> Response:
    """Bytes that the browser saves."""
    headers = {"content-disposition": f"attachment; filename*=UTF-8''{quote(name)}"}
    return Response(content, media_type="application/octet-stream", headers=headers)


def _add_pages(hub: Hub, demo: bool) -> None:
    @ui.page("/", reconnect_timeout=THRESHOLDS.reconnect_delay)
    async def show_first_screen(client: Client) -> None:
        studio = await _build_page(client, hub, "robot" if hub.project.robot else "start")
        if demo and not hub.project.robot and hub.running is None and not studio.is_read_only:
            await open_demo(studio)

    @ui.page("/{screen}", reconnect_timeout=THRESHOLDS.reconnect_delay)
    async def show_screen(client: Client, screen: str) -> None:
        await _build_page(client, hub, screen if screen in hub.screens else "start")


async def _build_page(client: Client, hub: Hub, screen: str) -> Studio:
    ui.add_head_html('<link rel="stylesheet" href="/studio.css"><script src="/studio.js"></script>')
    studio = Studio(hub, screen)
    hub.studios.append(studio)
    client.on_disconnect(lambda: _move_window_last(hub, studio))
    client.on_delete(lambda: _remove_window(hub, studio))
    ui.colors(primary="#0072b2", negative="#b3261e", positive="#00694a", warning="#b45f06")
    ui.page_title(f"{hub.workspace.folder.name} - modeler studio")
    _draw_navigation(studio)
    _draw_status(studio)
    studio.room = ui.element("main").classes("studio-room")
    if not hub.workspace.writable:
        ui.timer(2.0, hub.follow_changes)
    await client.connected()
    studio.redraw()
    background_tasks.create(hub.viewer.launch())
    return studio


def _move_window_last(hub: Hub, studio: Studio) -> None:
    """A window is loaded anew, or its line is cut: another that is open may change things."""
    if studio in hub.studios:
        hub.studios.remove(studio)
        hub.studios.append(studio)
    hub.notify_windows()


def _remove_window(hub: Hub, studio: Studio) -> None:
    """A window was closed; the next one may change things."""
    if studio in hub.studios:
        hub.studios.remove(studio)
    hub.notify_windows()


def _draw_navigation(studio: Studio) -> None:
    """The nine jobs, with what is done of them."""
    with ui.left_drawer(value=True, bordered=True).props("width=200").classes("studio-jobs"):
        ui.label(studio.folder.name).classes("studio-title")
        buttons = {}
        for number, (name, (title, _)) in enumerate(JOBS.items(), start=1):
            act = partial(studio.open_screen, name)
            button = add_button(f"{number}  {title}", act, "flat align=left")
            buttons[name] = button.props(f"accesskey={number}")

        def update_marks() -> None:
            done = _find_done_jobs(studio.project)
            for name, button in buttons.items():
                here = "add" if name == studio.screen else "remove"
                button.classes(**{here: "studio-here"}).props(**{here: "aria-current=page"})
                button.props(**{"add" if name in done else "remove": "icon-right=check"})

        studio.listeners.append(update_marks)
        update_marks()


def _find_done_jobs(project: Project) -> set[str]:
    """The jobs of which something is there."""
    kinds = {"fails": "compare", "missing": "diagnose"}
    done_jobs = {name for name, kind in kinds.items() if project.find_step_about(kind) is not None}
    done_jobs |= {"robot"} if project.robot else set()
    done_jobs |= {"data"} if project.collect_words("train") else set()
    done_jobs |= {"fit"} if project.current else set()
    return done_jobs | ({"fall"} if len(project.collect_path()) > 1 else set())


def _draw_status(studio: Studio) -> None:
    """What runs, what went wrong, and the command lines."""
    with ui.footer(bordered=True).classes("studio-status"):
        error = ui.label().classes("studio-error").props("role=alert")
        with ui.row().classes("items-center w-full no-wrap studio-running") as running:
            ui.spinner(size="sm")
            doing = ui.label()
            bar = ui.linear_progress(show_value=False).classes("studio-bar")
            add_button("Cancel", lambda: _cancel(studio), "dense flat")
        with ui.row().classes("items-center w-full no-wrap") as last:
            draw_note("last command")
            line = draw_command_line("")
            add_button("All commands", lambda: _show_commands(studio), "dense flat")
        with ui.row().classes("items-center w-full") as reading:
            why = ui.label().classes("studio-doubtful")
            over = ui.button(on_click=lambda: _take_over(studio)).props("dense no-caps")

        def update_status() -> None:
            hub = studio.hub
            error.text = studio.state.get("error", "")
            error.visible = bool(error.text)
            running.visible = hub.running is not None
            if hub.running is not None:
                doing.text = f"{hub.running.title}: {hub.running.doing}"
                share = hub.running.share
                bar.props(**{"add" if share is None else "remove": "indeterminate"})
                bar.value = bar.value if share is None else share
            steps = studio.project.steps
            words = hub.last or (build_command_words(studio.project, steps[-1]) if steps else ())
            last.visible = bool(words) and hub.running is None
            line.text = format_command(words)
            reading.visible = studio.is_read_only
            why.text = studio.read_only_reason
            space = hub.workspace
            over.text = "Accept the project" if space.writable and space.foreign else "Take over"

        studio.listeners.append(update_status)
        update_status()


def _show_commands(studio: Studio) -> None:
    """What was done, as it would be typed in the folder of the project."""
    project = studio.project
    every = ((build_command_words(project, step), step.seconds) for step in project.steps)
    lines = [f"{format_command(words)}  # {seconds:.1f} s" for words, seconds in every]
    with ui.dialog(value=True), ui.card().classes("studio-card studio-commands"):
        ui.label(f"Commands, in {studio.folder}").classes("studio-part")
        ui.code("\n".join(lines), language="bash")


def _cancel(studio: Studio) -> None:
    if studio.hub.running is not None and not studio.is_read_only:
        studio.hub.running.cancel()


def _take_over(studio: Studio) -> None:
    """This window may change things from now on, the others only read."""
    with studio.show_errors():
        if studio.hub.workspace.foreign and studio.hub.workspace.writable:
            studio.hub.workspace.accept()
        studio.hub.give_control(studio)
