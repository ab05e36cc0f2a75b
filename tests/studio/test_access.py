"""Who is let in: a real server, asked as foreign pages, other users and broken clients would."""

import re

import pytest

from tests.coroutines import run_coroutine
from tests.rotation import with_cases
from tests.studio.conftest import SECRET
from tests.studio.requests import ask, let_in, port_of, websocket_status
from tests.studio.window import Served

EVERYWHERE = tuple(
    """
    / /fit /studio.js /drop/logs /sheet/x.html /_nicegui/x /favicon.ico /no-such-place
    /_nicegui_ws/socket.io/?EIO=4&transport=polling
""".split()
)


@pytest.mark.parametrize("path", EVERYWHERE)
@pytest.mark.parametrize("method", ["GET", "POST", "PUT", "DELETE", "OPTIONS"])
def test_without_the_cookie_nothing_answers(studio: Served, path: str, method: str) -> None:
    answer = ask(studio, path, method)
    assert answer.status == 403 and answer.text.count("\n") == 1
    assert "open the address that it printed in the terminal" in answer.text
    assert "set-cookie" not in answer.headers


def test_the_token_becomes_a_cookie_and_leaves_the_address(studio: Served) -> None:
    path = studio.address.removeprefix(studio.root)
    answer = ask(studio, path)
    assert answer.status == 303 and answer.headers["location"] == "/"
    inputs = answer.headers["set-cookie"].lower()
    assert "; httponly" in inputs and "; samesite=strict" in inputs and "token" not in inputs
    token = path.partition("token=")[2]
    assert len(token) >= 43 and token not in answer.headers["set-cookie"]
    assert ask(studio, cookie=answer.headers["set-cookie"].partition(";")[0]).status == 200
    # Where a page led here, the page goes on by itself: a strict cookie would not be sent after a
    # redirect.
    seen = {"sec_fetch_site": "cross-site", "sec_fetch_mode": "navigate"}
    answer = ask(studio, path, sec_fetch_dest="document", **seen)
    assert answer.status == 200 and "refresh" in answer.text and "set-cookie" in answer.headers
    assert ask(studio, path, sec_fetch_dest="iframe", **seen).status == 403


@pytest.mark.parametrize("wrong", ["", "x", "{}x", "x{}", "{0}&token={0}x", "%00", "%C3%A9"])
def test_a_wrong_token_is_none(studio: Served, wrong: str) -> None:
    token = studio.address.partition("token=")[2]
    status = ask(studio, f"/?token={wrong.format(token)}").status
    assert status == (303 if wrong.startswith("{0}&") else 403)


def test_another_port_has_another_cookie(studio: Served, cookie: str) -> None:
    """Browsers send the cookies of all ports; a forwarded port is another name of the cookie."""
    name, _, value = cookie.partition("=")
    assert str(port_of(studio)) in name
    assert ask(studio, cookie=f"modeler-studio-1={value}").status == 403
    assert ask(studio, cookie=f"{name}=x{value}").status == 403
    assert ask(studio, cookie=f'bad cookie=["; modeler-studio-1=x; {cookie}').status == 200
    forwarded = let_in(studio, host="localhost:9")
    assert forwarded.startswith("modeler-studio-9=")
    assert ask(studio, cookie=forwarded, host="localhost:9").status == 200


@pytest.mark.parametrize("host", ["localhost:{}", "LocalHost", "[::1]:{}", "127.0.0.1:{}"])
def test_names_of_this_machine_are_known(studio: Served, cookie: str, host: str) -> None:
    named = host.format(port_of(studio))
    assert ask(studio, cookie=let_in(studio, host=named), host=named).status == 200
    assert (ask(studio, cookie=cookie, host=named).status == 200) == ("{}" in host)


@with_cases(
    "host",
    "evil.example",
    "127.0.0.1.evil.example:{}",
    "localhost.evil.example",
    "evil.example:{}",
    "127.0.0.1:{}@evil.example",
    "0.0.0.0:{}",
    "2130706433:{}",
    "",
    "localhost:",
    "127.0.0.1:{}, evil.example",
    "127.0.0.1:{}\xa0",
)
def test_foreign_names_are_refused_even_with_the_cookie(studio, cookie, host: str) -> None:
    """DNS rebinding."""
    answer = ask(studio, cookie=cookie, host=host.format(port_of(studio)))
    assert answer.status == 403 and "got another host" in answer.text


FOREIGN = [
    {"origin": "http://evil.example"},
    {"origin": "null"},
    {"origin": "https://127.0.0.1:{}"},
    {"origin": "http://127.0.0.1:1"},
    {"origin": "http://127.0.0.1"},
    {"origin": "http://localhost:{}"},
    {"sec_fetch_site": "cross-site"},
    {"sec_fetch_site": "same-site"},
]


@pytest.mark.parametrize("headers", FOREIGN, ids=str)
def test_foreign_pages_are_refused_even_with_the_cookie(studio, cookie, headers) -> None:
    """CSRF, and sockets opened by other pages: their browser sends the cookie where it may."""
    sent = {name: value.format(port_of(studio)) for name, value in headers.items()}
    forged = {"x_name": "forged.csv", "cookie": cookie, **sent}
    answer = ask(studio, "/drop/logs", "POST", b"a\n1\n", **forged)
    assert answer.status == 403 and "asked by another page" in answer.text
    assert ask(studio, "/", cookie=cookie, **sent).status == 403
    assert not list(studio.folder.glob("logs/forged*"))
    named = {name.replace("_", "-"): value for name, value in sent.items()}
    host = {"Host": f"127.0.0.1:{port_of(studio)}"}
    assert websocket_status(studio, {**host, "Cookie": cookie, **named}) == 403


def test_a_websocket_needs_the_cookie_and_takes_no_token(studio: Served, cookie: str) -> None:
    host = f"127.0.0.1:{port_of(studio)}"
    local = {"Host": host, "Origin": f"http://{host}"}
    assert websocket_status(studio, local) == 403
    assert websocket_status(studio, {**local, "Cookie": f"{cookie}x"}) == 403
    assert websocket_status(studio, {**local, "Cookie": cookie, "Host": "evil.example"}) == 403
    assert websocket_status(studio, {**local, "Cookie": cookie}) == 101


CLIMBING = tuple(
    """
    ../secret.csv ../../secret.csv ../../../../../../../../etc/passwd /etc/passwd %2e%2e/secret.csv
    ..%2f..%2fsecret.csv %2e%2e%2f%2e%2e%2fsecret.csv %2fetc%2fpasswd ..%5csecret.csv
    ....//secret.csv %252e%252e/secret.csv secret.csv%00 %00 logs/out.csv
    project.toml/../../secret.csv file:///etc/passwd ~/.bashrc
""".split()
)


def test_no_path_leads_out(studio: Served, cookie: str) -> None:
    page = ask(studio, "/", cookie=cookie).text
    linked = {part.rpartition("/")[0] for part in re.findall(r'(?:href|src)="(/[^"?]+)', page)}
    prefixes = {"", "/studio.", "/sheet", "/drop", *linked}
    prefixes |= {f"/_nicegui/3.18.0/{kind}/x" for kind in ("resources", "esm", "libraries")}
    assert len(prefixes) > 7
    for prefix in sorted(prefixes):
        for path in CLIMBING:
            answer = ask(studio, f"{prefix}/{path}", cookie=cookie)
            assert SECRET not in answer.text and "root:" not in answer.text, (prefix, path)


def test_pages_say_what_they_may_do_and_are_not_kept(studio: Served, cookie: str) -> None:
    answer = ask(studio, "/", cookie=cookie)
    policy = answer.headers["content-security-policy"]
    assert "frame-ancestors 'self'" in policy and "default-src 'self'" in policy
    assert not re.search(r"https?:|\*", policy)  # nobody else is talked to
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert answer.headers["referrer-policy"] == "no-referrer"
    assert answer.headers["cache-control"] == "no-store"


def test_the_address_for_the_browser_is_good_once() -> None:
    from modeler.studio.access import Guard

    async def app(scope, receive, send) -> None:
        raise AssertionError("nobody was let in")

    guard = Guard(app, 5)

    def status(address: str) -> int:
        sent: list[dict] = []

        async def send(message) -> None:
            sent.append(message)

        scope = {"type": "http", "method": "GET", "path": "/"}
        scope |= {"headers": [(b"host", b"localhost:5")]}
        scope |= {"query_string": address.partition("?")[2].encode()}
        run_coroutine(guard(scope, lambda: None, send))
        return sent[0]["status"]

    assert [status(guard.one_time_address), status(guard.one_time_address)] == [303, 403]
    assert [status(guard.address), status(guard.address)] == [303, 303]
