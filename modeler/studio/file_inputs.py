"""Files that come in: dropped on a page, received as a stream, or chosen in a dialog."""

import asyncio
import contextlib
import errno
import os
import re
import secrets
import shutil
import unicodedata
from collections.abc import AsyncIterator, Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import unquote

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse
from nicegui import ui
from starlette.requests import ClientDisconnect

from modeler.api.front_end import LOG_ENDINGS, DataError, ModelerError
from modeler.studio.elements import add_button, draw_error, draw_note
from modeler.studio.places import BEGUN, ROBOT_ENDINGS, Entry, Roots, format_size
from modeler.studio.studio import Studio
from modeler.studio.thresholds import THRESHOLDS

KINDS = {"logs": LOG_ENDINGS, "originals": ROBOT_ENDINGS}
"""Folders of the project that files may be dropped into, and how their names end."""

NAME = "x-name"
"""Header of a request that says the name of its file, quoted as in an address."""

_AT_ONCE = 2**20


def safe_name(name: str) -> str:
    """Returns a file name without folders, leading dots and special characters.

    Args:
        name: as a browser says it.
    """
    last = re.split(r"[/\\]", unicodedata.normalize("NFC", name))[-1]
    plain = re.sub(r"[^\w .+()=,@-]", "_", last).strip()
    stem, dot, ending = plain.rpartition(".")
    stem, ending = (stem, f".{ending.strip()}") if dot else (ending, "")
    stem = stem.lstrip(".-@ ")
    while len((stem + ending).encode()) > THRESHOLDS.max_name_bytes and stem:
        stem = stem[:-1]
    return (stem.strip() or "log") + ending


class _Upload:
    """One file that is being received.

    Attributes:
        name: that it will have, if nobody has it.
    """

    def __init__(self, folder: Path, name: str) -> None:
        self.name = name
        self._folder = folder
        self._beside = folder / f"{BEGUN}{secrets.token_hex(8)}"
        self._file: BinaryIO = self._beside.open("xb", buffering=0)

    def write(self, data: bytes) -> None:
        view = memoryview(data)
        while view:
            view = view[self._file.write(view) :]

    def finish(self) -> str:
        """Closes the file, gives it its name at last, and returns that."""
        self._file.close()
        stem, ending = os.path.splitext(self.name)  # noqa: PTH122  of a name, not a path
        number = 1
        while os.path.lexists(self._folder / self.name):
            number += 1
            self.name = f"{stem}-{number}{ending}"
        self._beside.rename(self._folder / self.name)
        return self.name

    def discard(self) -> None:
        """Discards the file, as if it had never come."""
        with contextlib.suppress(OSError):
            self._file.close()
        with contextlib.suppress(OSError):
            self._beside.unlink()


async def receive_file(
    folder: Path, kind: str, name: str, size: int | None, stream: AsyncIterator[bytes]
) -> str:
    """Takes a file that a browser sends; where it is, relative to the folder of the project.

    Args:
        folder: of the project.
        kind: of `KINDS`.
        name: that the file has there.
        size: bytes that are to come, if it is said.
        stream: they.

    Raises:
        DataError: it is no file of that kind, or the connection ended; nothing of it is left.
        ModelerError: the disk is full; nothing of it is left.
    """
    if not name.lower().endswith(KINDS[kind]):
        raise DataError(f"{safe_name(name)}: cannot be taken; expected {', '.join(KINDS[kind])}")
    place, upload = folder / kind, None
    try:
        place.mkdir(exist_ok=True)
        free = shutil.disk_usage(place).free
        if size is not None and size + THRESHOLDS.spare_disk_bytes > free:
            raise OSError(errno.ENOSPC, f"{format_size(size)} to come, {format_size(free)} free")
        upload = _Upload(place, safe_name(name))
        async for piece in _merge_pieces(stream):
            await asyncio.to_thread(upload.write, piece)
        return f"{kind}/{upload.finish()}"
    except BaseException as error:
        if upload is not None:
            upload.discard()
        if isinstance(error, ClientDisconnect):
            raise DataError(f"{name}: the connection ended; drop the file again") from None
        if isinstance(error, OSError):
            what = error.strerror or error
            raise ModelerError(
                f"{safe_name(name)}: cannot be kept in {place} ({what}); make room, or use "
                "Browse (no copy)"
            ) from error
        raise


async def _merge_pieces(stream: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    """The same in larger pieces, so that few threads are asked."""
    buffer = bytearray()
    async for data in stream:
        buffer += data
        if len(buffer) >= _AT_ONCE:
            yield bytes(buffer)
            buffer.clear()
    if buffer:
        yield bytes(buffer)


def add_route(app: FastAPI, folder: Path, writable: Callable[[], bool]) -> None:
    """Adds the route that receives uploads.

    Args:
        app: that answers.
        folder: of the project.
        writable: False: nothing is taken.
    """

    @app.post("/drop/{kind}")
    async def receive_upload(kind: str, request: Request) -> JSONResponse:
        try:
            if kind not in KINDS:
                raise DataError(f"upload: got {kind}; expected one of {', '.join(KINDS)}")
            if not writable():
                raise DataError("upload: this studio only reads; the project is open elsewhere")
            stated_size = request.headers.get("content-length", "")
            size = int(stated_size) if stated_size.isdecimal() else None
            name = unquote(request.headers.get(NAME, ""))
            file = await receive_file(folder, kind, name, size, request.stream())
        except ModelerError as error:
            return JSONResponse({"error": str(error)}, 400)
        return JSONResponse({"file": file})


def add_drop_zone(
    kind: str, label: str, on_received: Callable[[list[str]], Any], on_error: Callable[[str], Any]
) -> ui.upload:
    """Adds the area where files are dropped or chosen.

    Args:
        kind: of `KINDS`.
        label: on it.
        on_received: is called with files that came, relative to the folder of the project.
        on_error: is called with the line that says why one did not.
    """
    zone = ui.upload(multiple=True, auto_upload=True, label=label)
    endings = ",".join(KINDS[kind])
    zone.props(f'url="/drop/{kind}" accept="{endings}" flat bordered send-raw')
    named = f"[{{name: '{NAME}', value: encodeURIComponent(files[0].name)}}]"
    zone.props(f':headers="files => {named}"')

    def handle_answer(event: Any) -> None:
        answer = event.args if isinstance(event.args, dict) else {}
        if file := answer.get("file"):
            on_received([str(file)])
        elif "error" in answer:
            on_error(str(answer["error"]))

    read = "({xhr}) => { try { emit(JSON.parse(xhr.responseText)) } catch { emit({error: "
    read += "'upload: the connection ended; drop the file again'}) } }"
    zone.on("uploaded", handle_answer, js_handler=read)
    zone.on("failed", handle_answer, js_handler=read)
    zone.on("rejected", lambda: on_error(f"upload: cannot be taken; expected {endings}"), args=[])
    return zone


def choose_files(
    studio: Studio, endings: Sequence[str], on_chosen: Callable[[list[str]], Any]
) -> None:
    """Shows a dialog of the folders and files that `--allow` names.

    Args:
        studio: the window.
        endings: of the files that may be chosen.
        on_chosen: is called with those that were, relative to the folder of the project if they lie
            in it.
    """
    roots, home, marked = Roots(studio.hub.allowed), studio.folder.resolve(), list[Path]()
    tops = sorted({root.resolve() for root in roots.folders})

    def show_folder(folder: Path | None) -> None:
        """Shows the entries of a folder; of None, the folders that may be read."""
        entries = [Entry(str(top), top, None) for top in tops]
        places.clear()
        with places:
            if folder is not None:
                draw_note(str(folder))
                add_folder_button("..", None if folder in tops else folder.parent)
                try:
                    entries = roots.read_entries(folder, endings)
                except DataError as error:
                    draw_error(error)
                    return
            for entry in entries:
                if entry.size is None:
                    add_folder_button(entry.name, entry.place)
                    continue
                box = ui.checkbox(f"{entry.name}  ({format_size(entry.size)})").props("dense")
                box.value = entry.place in marked
                box.on_value_change(partial(mark_file, entry.place))

    def mark_file(place: Path, event: Any) -> None:
        if event.value:
            marked.append(place)
        else:
            marked.remove(place)

    def add_folder_button(name: str, place: Path | None) -> None:
        props, act = "flat dense align=left", partial(show_folder, place)
        add_button(name, act, props, icon="folder").classes("w-full")

    def finish_choice() -> None:
        dialog.close()
        files = [f.relative_to(home) if f.is_relative_to(home) else f for f in marked]
        if files:
            on_chosen([file.as_posix() for file in files])

    with ui.dialog(value=True) as dialog, ui.card().classes("studio-card chooser"):
        ui.label("Browse (no copy)").classes("studio-part")
        places = ui.column().classes("w-full gap-0 chooser-list")
        with ui.row():
            add_button("Take", finish_choice, "unelevated")
            add_button("Close", dialog.close, "flat")
    show_folder(None)
