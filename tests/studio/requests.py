"""Requests to a studio as no browser would send them: any header, any path, any body."""

import base64
import http.client
import os
import re
import socket
from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import urlsplit

from tests.studio.window import Served


@dataclass(frozen=True)
class Answer:
    """What came back."""

    status: int
    headers: dict[str, str]
    body: bytes

    @property
    def text(self) -> str:
        return self.body.decode(errors="replace")


def port_of(studio: Served) -> int:
    return urlsplit(studio.address).port or 0


def ask(studio, path="/", method="GET", body=None, **headers):
    """Sends a request; `host=` replaces the header, `sec_fetch_site=` is Sec-Fetch-Site."""
    cells = {"host": f"127.0.0.1:{port_of(studio)}"}
    cells |= {name.replace("_", "-"): value for name, value in headers.items()}
    connection = http.client.HTTPConnection("127.0.0.1", port_of(studio), timeout=60)
    try:
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        if isinstance(body, bytes):
            cells["content-length"] = str(len(body))
        for name, value in cells.items():
            connection.putheader(name, value)
        connection.endheaders()
        for part in [body] if isinstance(body, bytes) else body or ():
            connection.send(part)
        answer = connection.getresponse()
        table = {name.lower(): value for name, value in answer.getheaders()}
        return Answer(answer.status, table, answer.read())
    finally:
        connection.close()


def let_in(studio: Served, **headers: str) -> str:
    """The cookie, in exchange for the token."""
    answer = ask(studio, studio.address.removeprefix(studio.root), **headers)
    return answer.headers["set-cookie"].partition(";")[0]


def websocket_request(headers: Mapping[str, str]) -> bytes:
    """That a websocket be opened."""
    key = base64.b64encode(os.urandom(16)).decode()
    lines = [
        "GET /_nicegui_ws/socket.io/?EIO=4&transport=websocket HTTP/1.1",
        "Connection: Upgrade",
        "Upgrade: websocket",
        "Sec-WebSocket-Version: 13",
        f"Sec-WebSocket-Key: {key}",
        *(f"{name}: {value}" for name, value in headers.items()),
    ]
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def websocket_status(studio: Served, headers: Mapping[str, str]) -> int:
    """What a websocket is answered with: 101 if it is taken."""
    with socket.create_connection(("127.0.0.1", port_of(studio)), timeout=20) as line:
        line.sendall(websocket_request(headers))
        return int(re.match(rb"HTTP/1\.1 (\d+)", line.recv(4096))[1])
