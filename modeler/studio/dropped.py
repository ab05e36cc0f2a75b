"""Files that are dropped on a page: received as a stream, and there as a whole or not at all.

NiceGUI's own way of receiving keeps a file twice in the temporary folder, which is memory on many
machines; here it goes straight to the disk of the project, a megabyte at a time, beside its place.
"""

import asyncio
import contextlib
import errno
import os
import re
import secrets
import shutil
import unicodedata
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import unquote

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse
from nicegui import ui
from starlette.requests import ClientDisconnect

from modeler.core.builtin import LOG_ENDINGS
from modeler.core.errors import DataError, ModelerError
from modeler.studio.places import BEGUN, ROBOT_ENDINGS, size_text

KINDS = {"logs": LOG_ENDINGS, "originals": ROBOT_ENDINGS}
"""Folders of the project that files may be dropped into, and how their names end."""

NAME = "x-name"
"""Header of a request that says the name of its file, quoted as in an address."""

_AT_ONCE = 2**20
_LONGEST = 120  # bytes of a name
_SPARE = 2**20  # bytes of the disk that stay free


def safe_name(name: str) -> str:
    """A name of a file without folders, hidden beginnings, and letters that mean something.

    Args:
        name: as a browser says it.
    """
    last = re.split(r"[/\\]", unicodedata.normalize("NFC", name))[-1]
    plain = re.sub(r"[^\w .+()=,@-]", "_", last).strip()
    stem, dot, ending = plain.rpartition(".")
    stem, ending = (stem, f".{ending.strip()}") if dot else (ending, "")
    stem = stem.lstrip(".-@ ")
    while len((stem + ending).encode()) > _LONGEST and stem:
        stem = stem[:-1]
    return (stem.strip() or "log") + ending


class _Drop:
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

    def keep(self) -> str:
        """Its name at last."""
        self._file.close()
        stem, ending = os.path.splitext(self.name)  # noqa: PTH122  of a name, not a path
        number = 1
        while os.path.lexists(self._folder / self.name):
            number += 1
            self.name = f"{stem}-{number}{ending}"
        self._beside.rename(self._folder / self.name)
        return self.name

    def drop(self) -> None:
        """As if it had never come."""
        with contextlib.suppress(OSError):
            self._file.close()
        with contextlib.suppress(OSError):
            self._beside.unlink()


async def receive(
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
    place, begun = folder / kind, None
    try:
        place.mkdir(exist_ok=True)
        free = shutil.disk_usage(place).free
        if size is not None and size + _SPARE > free:
            raise OSError(errno.ENOSPC, f"{size_text(size)} to come, {size_text(free)} free")
        begun = _Drop(place, safe_name(name))
        async for piece in _pieces(stream):
            await asyncio.to_thread(begun.write, piece)
        return f"{kind}/{begun.keep()}"
    except BaseException as error:
        if begun is not None:
            begun.drop()
        if isinstance(error, ClientDisconnect):
            raise DataError(f"{name}: the connection ended; drop the file again") from None
        if isinstance(error, OSError):
            what = error.strerror or error
            raise ModelerError(
                f"{safe_name(name)}: cannot be kept in {place} ({what}); make room, or choose the "
                "file where it lies"
            ) from error
        raise


async def _pieces(stream: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    """The same in larger pieces, so that few threads are asked."""
    held = bytearray()
    async for data in stream:
        held += data
        if len(held) >= _AT_ONCE:
            yield bytes(held)
            held.clear()
    if held:
        yield bytes(held)


def add_route(app: FastAPI, folder: Path, writable: Callable[[], bool]) -> None:
    """Where files are sent to.

    Args:
        app: that answers.
        folder: of the project.
        writable: False: nothing is taken.
    """

    @app.post("/drop/{kind}")
    async def drop(kind: str, request: Request) -> JSONResponse:
        try:
            if kind not in KINDS:
                raise DataError(f"upload: got {kind}; expected one of {', '.join(KINDS)}")
            if not writable():
                raise DataError("upload: this studio only reads; the project is open elsewhere")
            said = request.headers.get("content-length", "")
            size = int(said) if said.isdecimal() else None
            name = unquote(request.headers.get(NAME, ""))
            file = await receive(folder, kind, name, size, request.stream())
        except ModelerError as error:
            return JSONResponse({"error": str(error)}, 400)
        return JSONResponse({"file": file})


def drop_zone(
    kind: str, label: str, taken: Callable[[list[str]], Any], told: Callable[[str], Any]
) -> ui.upload:
    """Where files are dropped or chosen.

    Args:
        kind: of `KINDS`.
        label: on it.
        taken: is called with files that came, relative to the folder of the project.
        told: is called with the line that says why one did not.
    """
    zone = ui.upload(multiple=True, auto_upload=True, label=label)
    endings = ",".join(KINDS[kind])
    zone.props(f'url="/drop/{kind}" accept="{endings}" flat bordered send-raw')
    named = f"[{{name: '{NAME}', value: encodeURIComponent(files[0].name)}}]"
    zone.props(f':headers="files => {named}"')

    def answered(event: Any) -> None:
        answer = event.args if isinstance(event.args, dict) else {}
        if file := answer.get("file"):
            taken([str(file)])
        elif "error" in answer:
            told(str(answer["error"]))

    read = "({xhr}) => { try { emit(JSON.parse(xhr.responseText)) } catch { emit({error: "
    read += "'upload: the connection ended; drop the file again'}) } }"
    zone.on("uploaded", answered, js_handler=read)
    zone.on("failed", answered, js_handler=read)
    zone.on("rejected", lambda: told(f"upload: cannot be taken; expected {endings}"), args=[])
    return zone
