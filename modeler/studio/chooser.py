"""A dialog in which files are chosen where they lie, on the side of the server."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from nicegui import ui

from modeler.core.errors import DataError
from modeler.studio.places import Entry, Roots, size_text
from modeler.studio.studio import Studio


class Chooser:
    """Folders and files under those that `--allow` names.

    Args:
        studio: the window.
        endings: of the files that may be chosen.
        taken: is called with what was chosen, relative to the folder of the project if it lies
            in it.
        several: False: one file at a time.
    """

    def __init__(
        self, studio: Studio, endings: Sequence[str], taken: Callable[[list[str]], Any],
        several: bool = True,
    ) -> None:  # fmt: skip
        self._studio, self._endings, self._taken, self._several = studio, endings, taken, several
        self._roots = Roots(studio.hub.allowed)
        self._marked: dict[str, None] = {}
        with ui.dialog() as self._dialog, ui.card().classes("studio-card chooser"):
            ui.label("Choose files where they lie").classes("studio-part")
            self._list = ui.column().classes("w-full gap-0 chooser-list")
            with ui.row():
                ui.button("Take", on_click=self._done).props("no-caps unelevated")
                ui.button("Close", on_click=self._dialog.close).props("no-caps flat")
        self._show(None)
        self._dialog.open()

    def _show(self, folder: Path | None) -> None:
        """The entries of a folder; None: the folders that may be read."""
        self._list.clear()
        with self._list:
            tops = {root.resolve() for root in self._roots.folders}
            if folder is None:
                entries = [Entry(str(top), top, None) for top in sorted(tops)]
            else:
                ui.label(str(folder)).classes("studio-soft")
                up = None if folder in tops else folder.parent
                self._folder("..", up)
                try:
                    entries = self._roots.listed(folder, self._endings)
                except DataError as error:
                    ui.label(str(error)).classes("studio-error").props("role=alert")
                    return
            for entry in entries:
                if entry.size is None:
                    self._folder(entry.name, entry.place)
                else:
                    self._file(entry, entry.size)

    def _folder(self, name: str, place: Path | None) -> None:
        button = ui.button(name, icon="folder", on_click=lambda: self._show(place))
        button.props("flat dense no-caps align=left").classes("w-full")

    def _file(self, entry: Entry, size: int) -> None:
        place = str(entry.place)

        def mark(event: Any) -> None:
            if not event.value:
                self._marked.pop(place, None)
                return
            self._marked[place] = None
            if not self._several:
                self._done()

        text = f"{entry.name}  ({size_text(size)})"
        ui.checkbox(text, value=place in self._marked, on_change=mark).props("dense")

    def _done(self) -> None:
        self._dialog.close()
        home = self._studio.folder.resolve()
        files = [Path(place) for place in self._marked]
        inside = [f.relative_to(home) if f.is_relative_to(home) else f for f in files]
        if inside:
            self._taken([file.as_posix() for file in inside])
