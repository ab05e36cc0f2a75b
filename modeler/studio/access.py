"""Who may talk to the studio: the browser that opened the address which the terminal printed.

The server listens on 127.0.0.1 only, but every page of the web can send requests there, and so can
every other user of the machine. Four questions are asked of each request, and of each websocket:

* `Host` is a name of this machine. Else a foreign name was made to lead here (DNS rebinding). Any
  port will do: over SSH the browser sees the port at its own end.
* `Origin`, where a browser sends it, is the studio's own, and so is `Sec-Fetch-Site`, but for a
  page that somebody goes to: no foreign page acts in the user's name (CSRF), not even one of this
  machine on another port, to which cookies make no difference.
* The path means what it says: no `..`, no backslash, no NUL.
* The cookie is there, or the token in the address, which becomes a cookie.
"""

import re
import secrets
from collections.abc import Iterable
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

TOKEN = "token"
"""Its name in the address."""

_HOST = re.compile(r"(?:127\.0\.0\.1|localhost|\[::1\])(?::(\d{1,5}))?", re.IGNORECASE)
_SAFE = ("GET", "HEAD")

REPORTS = "/report/"
"""Where pages of the project are that a file holds: they are no part of the studio. Their scripts
may draw, but reach nothing of it, whoever wrote the file."""

_REFUSED = "modeler studio: open the address that it printed in the terminal; its token is needed\n"
_FOREIGN = "modeler studio: asked by another page; open the address that it printed\n"
_NO_HOST = "modeler studio: got another host; open it as 127.0.0.1 or localhost, with its port\n"
_NO_PATH = "modeler studio: there is no such place\n"

# A browser does not send a strict cookie where a page of another site led here; the page itself may
# then go on.
_GO_ON = '<!doctype html><meta http-equiv="refresh" content="0;url=/"><a href="/">studio</a>'


class Guard:
    """Lets through what the user's own browser asks.

    Args:
        app: what answers.
        port: at which it does.

    Attributes:
        address: to open, with its token.
        once: the same, with one that is good for one time: while a browser is started with it, all
            users of the machine can read it.
    """

    def __init__(self, app: ASGIApp, port: int) -> None:
        self.app = app
        self._token, self._tokens_once = secrets.token_urlsafe(32), [secrets.token_urlsafe(32)]
        self.address, self.one_time_address = (
            f"http://127.0.0.1:{port}/?{TOKEN}={token}"
            for token in (self._token, *self._tokens_once)
        )
        self._cookie_value = secrets.token_urlsafe(
            32
        )  # value of the cookie; it shows nothing of the token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """As a server calls it."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        answer = self._refuse_request(scope, headers)
        if answer is None and not self._has_cookie(headers):
            answer = self._exchange_token(scope, headers)
        if answer is None:
            await self.app(scope, receive, _add_security_headers(send, scope, headers["host"]))
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008})  # before it is accepted: 403
        else:
            await answer(scope, receive, _add_security_headers(send, scope, "127.0.0.1"))

    def _refuse_request(self, scope: Scope, headers: Headers) -> Response | None:
        """Of what no cookie makes right."""
        hosts = headers.getlist("host")
        if len(hosts) != 1 or not _HOST.fullmatch(hosts[0]):
            return PlainTextResponse(_NO_HOST, 403)
        if any(origin != f"http://{hosts[0]}" for origin in headers.getlist("origin")):
            return PlainTextResponse(_FOREIGN, 403)
        goes_there = (
            scope["type"] == "http"
            and scope["method"] in _SAFE
            and headers.get("sec-fetch-mode") == "navigate"
            and headers.get("sec-fetch-dest") == "document"
        )
        if headers.get("sec-fetch-site") in ("cross-site", "same-site") and not goes_there:
            return PlainTextResponse(_FOREIGN, 403)
        path = scope["path"]
        if "\0" in path or "\\" in path or ".." in path.split("/"):
            return PlainTextResponse(_NO_PATH, 403)
        return None

    def _has_cookie(self, headers: Headers) -> bool:
        """Whether the cookie is there."""
        name = _build_cookie_name(headers["host"])
        return any(
            _compare_secrets(value, self._cookie_value) for value in _read_cookies(headers, name)
        )

    def _exchange_token(self, scope: Scope, headers: Headers) -> Response:
        """The cookie, for the token; then the address without it."""
        token = parse_qs(scope["query_string"].decode("latin-1")).get(TOKEN, [""])[0]
        once = [each for each in self._tokens_once if _compare_secrets(token, each)]
        right = _compare_secrets(token, self._token) or bool(once)
        if not right or scope["type"] != "http" or scope["method"] != "GET":
            return PlainTextResponse(_REFUSED, 403)
        self._tokens_once = [each for each in self._tokens_once if each not in once]
        answer: Response = RedirectResponse("/", 303)
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            answer = HTMLResponse(_GO_ON)
        answer.set_cookie(
            _build_cookie_name(headers["host"]),
            self._cookie_value,
            httponly=True,
            samesite="strict",
        )
        return answer


def _build_cookie_name(host: str) -> str:
    """Its name: browsers share cookies among all ports, and two studios may be open."""
    port = _HOST.fullmatch(host)
    return f"modeler-studio-{(port and port[1]) or 80}"


def _read_cookies(headers: Headers, name: str) -> Iterable[str]:
    for line in headers.getlist("cookie"):
        for part in line.split(";"):  # one that is malformed must not hide ours
            try:
                morsel = SimpleCookie(part.strip()).get(name)
            except CookieError:
                continue
            if morsel is not None:
                yield morsel.value


def _compare_secrets(one: str, other: str) -> bool:
    """Compared in a time that shows nothing."""
    return secrets.compare_digest(one.encode(), other.encode())


def _add_security_headers(send: Send, scope: Scope, host: str) -> Send:
    """With headers that tell the browser what the pages may do.

    Pages load from here alone, and talk to nobody else: what a name in a log might smuggle into a
    page could send nothing away. NiceGUI needs inline scripts, and templates that are compiled in
    the browser.
    """
    policy = (
        "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; "
        "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
        f"connect-src 'self' ws://{host} data: blob:; frame-src 'self' blob:; "
        "worker-src 'self' blob:; object-src 'none'; base-uri 'self'; form-action 'self'; "
        "frame-ancestors 'self'"
    )
    report = scope["path"].startswith(REPORTS)
    if report:
        policy += "; sandbox allow-scripts allow-popups allow-downloads allow-modals"

    async def send_with_headers(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            headers["content-security-policy"] = policy
            headers["x-content-type-options"] = "nosniff"
            headers["referrer-policy"] = "no-referrer"
            headers["cross-origin-resource-policy"] = "same-origin"
            if not report:  # browsers show no sandbox that says so
                headers["cross-origin-opener-policy"] = "same-origin"
            if not scope["path"].startswith("/_nicegui/"):  # scripts, which have their version
                headers["cache-control"] = "no-store"
        await send(message)

    return send_with_headers
