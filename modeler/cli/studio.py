"""`modeler studio`: where the workbench is served, and what is printed of it."""

import argparse
import os
import threading
from pathlib import Path
from urllib.parse import urlsplit

from modeler.cli.console import flush_stdout, print_note, print_result
from modeler.cli.program import exit_on_interrupt
from modeler.core.errors import ModelerError, suggest_install

_PORTS = range(65536)


def run_studio(args: argparse.Namespace) -> None:
    """Serves until Ctrl-C."""
    if args.port not in _PORTS:
        raise ModelerError(f"--port: got {args.port}; expected 1 to {_PORTS[-1]}, 0 for a free one")
    for place in args.allow:
        if not Path(place).is_dir():
            raise ModelerError(f"--allow {place}: no such folder; expected one that holds logs")
    try:
        with exit_on_interrupt():
            from modeler.studio import serve
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] == "modeler":
            raise
        raise ModelerError(
            f"studio: needs the package {error.name}, which is not installed; "
            f"run: {suggest_install('studio')}"
        ) from None
    folder = Path(args.folder).resolve()
    allowed = [Path.cwd(), *(Path(place).resolve() for place in args.allow)]

    def announce_address(address: str, once: str, warning: str) -> None:
        before = os.umask(0o077)  # who has the token is let in
        try:
            args.tell({"address": address, "folder": str(folder), "pid": os.getpid()})
        finally:
            os.umask(before)
        print_result(f"studio of {folder}: {address}")
        port = urlsplit(address).port
        print_result(
            f"over SSH: ssh -L {port}:127.0.0.1:{port} HOST, and the same address; Ctrl-C ends it"
        )
        flush_stdout()
        if warning:
            print_note(warning)
        if not args.no_open:
            threading.Thread(target=_open_browser, args=[once], daemon=True).start()

    serve(folder, allow=allowed, port=args.port, demo=args.demo, on_ready=announce_address)


def _open_browser(address: str) -> None:
    """In the browser, where there is one with windows."""
    import webbrowser

    far, screens = "SSH_CONNECTION", ("DISPLAY", "WAYLAND_DISPLAY")
    if far in os.environ and not any(name in os.environ for name in screens):
        return  # what it would find is a browser of this terminal
    if not webbrowser.open(address):
        print_note("no browser was found; open the address in one")
