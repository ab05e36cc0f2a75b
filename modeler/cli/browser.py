"""`--open`: the page that a command writes is shown in the browser."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from modeler.cli.console import print_note
from modeler.cli.places import DemoFolder, FilePlace, Output


@contextmanager
def open_page_when_done(args: argparse.Namespace) -> Iterator[None]:
    """Opens the page of `--open` in the browser when the command is done.

    A page that has no place gets one in a temporary folder, which stays if the command is done.
    """
    args.page_is_temporary = False
    if vars(args).get("open") and "report" in args and args.report is None:
        import tempfile  # these are loaded where they are wanted

        folder = tempfile.mkdtemp(prefix="modeler-")
        args.report = Output(Path(folder) / f"{args.command}.html")
        args.page_is_temporary = True
    try:
        yield
    except BaseException:
        discard_page(args)
        raise
    _show_page(args)


def discard_page(args: argparse.Namespace) -> None:
    """Removes the temporary page when the command writes none."""
    if args.page_is_temporary:
        with suppress(OSError):  # not empty: the page was written
            Path(args.report).parent.rmdir()
        args.report, args.open = None, False


def _show_page(args: argparse.Namespace) -> None:
    """One line where there is no browser, or no page."""
    if not vars(args).get("open"):
        return
    import webbrowser

    page = _locate_page(vars(args).get("report") or args.out)
    if not page.is_file():
        print_note("--open: no page was written, so none is shown")
    elif not webbrowser.open(page.resolve().as_uri()):
        print_note(f"--open: no browser was found; open {page} in one")


def _locate_page(place: str) -> Path:
    if isinstance(place, DemoFolder):
        return Path(place) / "index.html"
    return place.file if isinstance(place, FilePlace) else Path(place)
