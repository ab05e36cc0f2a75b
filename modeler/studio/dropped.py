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
from python_multipart.multipart import MultipartParser, parse_options_header
from starlette.requests import ClientDisconnect

from modeler.core.builtin import LOG_ENDINGS
from modeler.core.errors import DataError, ModelerError
from modeler.studio.places import BEGUN, ROBOT_ENDINGS, size_text

KINDS = {"logs": LOG_ENDINGS, "originals": ROBOT_ENDINGS}
"""Folders of the project that files may be dropped into, and how their names end."""

_AT_ONCE = 2**20
_LONGEST = 120  # bytes of a name
_SPARE = 64 * 2**20  # bytes of the disk that stay free


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


class _Form:
    """The form in which a browser sends files.

    Attributes:
        whole: files that are there as a whole, not yet under their names.
        ended: whether the form came to its end.
    """

    def __init__(self, folder: Path, boundary: bytes, endings: tuple[str, ...]) -> None:
        self.whole: list[_Drop] = []
        self.ended = False
        self._folder, self._endings = folder, endings
        self._open: _Drop | None = None
        self._header, self._value, self._about = b"", b"", b""
        names = ("part_begin", "part_data", "part_end", "header_field", "header_value",
                 "header_end", "headers_finished", "end")  # fmt: skip
        calls: Any = {f"on_{name}": getattr(self, f"_{name}") for name in names}
        self._parser = MultipartParser(boundary, calls)

    def write(self, data: bytes) -> None:
        """What came next."""
        self._parser.write(data)

    def drop(self) -> None:
        """All that came."""
        for each in (*self.whole, self._open):
            if each is not None:
                each.drop()

    def _part_begin(self) -> None:
        self._header, self._value, self._about = b"", b"", b""

    def _header_field(self, data: bytes, start: int, end: int) -> None:
        self._header += data[start:end]

    def _header_value(self, data: bytes, start: int, end: int) -> None:
        self._value += data[start:end]

    def _header_end(self) -> None:
        if self._header.lower() == b"content-disposition":
            self._about = self._value
        self._header = self._value = b""

    def _headers_finished(self) -> None:
        name = parse_options_header(self._about)[1].get(b"filename")
        if name is None:
            return  # a field of the form, no file
        told = unquote(name.decode(errors="replace"))
        if not told.lower().endswith(self._endings):
            raise DataError(
                f"{safe_name(told)}: cannot be taken; expected {', '.join(self._endings)}"
            )
        self._open = _Drop(self._folder, safe_name(told))

    def _part_data(self, data: bytes, start: int, end: int) -> None:
        if self._open is not None:
            self._open.write(data[start:end])

    def _part_end(self) -> None:
        if self._open is not None:
            self.whole.append(self._open)
            self._open = None

    def _end(self) -> None:
        self.ended = True


async def receive(
    folder: Path, kind: str, content_type: str, size: int | None, stream: AsyncIterator[bytes]
) -> list[str]:
    """Takes what a browser sends; the files, relative to the folder of the project.

    Args:
        folder: of the project.
        kind: of `KINDS`.
        content_type: of the request.
        size: bytes that it says it has, if it does.
        stream: its body.

    Raises:
        DataError: it is no form of files of that kind.
        ModelerError: the disk is full, or the connection ended; nothing of it is left.
    """
    form_kind, options = parse_options_header(content_type)
    if form_kind != b"multipart/form-data" or not options.get(b"boundary"):
        raise DataError("upload: got no form with files; drop them on the page")
    place = folder / kind
    form: _Form | None = None
    try:
        place.mkdir(exist_ok=True)
        free = shutil.disk_usage(place).free
        if size is not None and size + _SPARE > free:
            raise OSError(errno.ENOSPC, f"{size_text(size)} to come, {size_text(free)} free")
        form = _Form(place, options[b"boundary"], KINDS[kind])
        async for piece in _pieces(stream):
            await asyncio.to_thread(form.write, piece)
        if not form.ended:
            raise DataError("upload: ended before its end; drop the file again")
        return [f"{kind}/{each.keep()}" for each in form.whole]
    except BaseException as error:
        if form is not None:
            form.drop()
        if isinstance(error, ClientDisconnect):
            raise DataError("upload: the connection ended; drop the file again") from None
        if isinstance(error, OSError):
            what = error.strerror or error
            raise ModelerError(
                f"upload: cannot be kept in {place} ({what}); make room, or choose the file where "
                "it lies"
            ) from error
        if isinstance(error, ValueError):  # of the parser
            raise DataError("upload: got a broken form; drop the file again") from None
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
            content_type = request.headers.get("content-type", "")
            files = await receive(folder, kind, content_type, size, request.stream())
        except ModelerError as error:
            return JSONResponse({"error": str(error)}, 400)
        return JSONResponse({"files": files})


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
    zone.props(f'url="/drop/{kind}" accept="{endings}" flat bordered')

    def answered(event: Any) -> None:
        answer = event.args if isinstance(event.args, dict) else {}
        if files := answer.get("files"):
            taken([str(file) for file in files])
        elif "error" in answer:
            told(str(answer["error"]))

    read = "({xhr}) => { try { emit(JSON.parse(xhr.responseText)) } catch { emit({error: "
    read += "'upload: the connection ended; drop the file again'}) } }"
    zone.on("uploaded", answered, js_handler=read)
    zone.on("failed", answered, js_handler=read)
    zone.on("rejected", lambda: told(f"upload: cannot be taken; expected {endings}"), args=[])
    return zone
