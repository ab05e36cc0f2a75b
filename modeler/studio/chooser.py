"""A dialog in which files are chosen where they lie, on the side of the server."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from nicegui import ui

from modeler.core.errors import DataError
from modeler.studio.places import Entry, Roots, format_size
from modeler.studio.studio import Studio


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
        """The entries of a folder; None: the folders that may be read."""
        entries = [Entry(str(top), top, None) for top in tops]
        places.clear()
        with places:
            if folder is not None:
                ui.label(str(folder)).classes("studio-soft")
                add_folder_button("..", None if folder in tops else folder.parent)
                try:
                    entries = roots.read_entries(folder, endings)
                except DataError as error:
                    ui.label(str(error)).classes("studio-error").props("role=alert")
                    return
            for entry in entries:
                if entry.size is None:
                    add_folder_button(entry.name, entry.place)
                    continue
                box = ui.checkbox(f"{entry.name}  ({format_size(entry.size)})").props("dense")
                box.value = entry.place in marked
                box.on_value_change(
                    lambda event, place=entry.place: (
                        marked.append(place) if event.value else marked.remove(place)
                    )
                )

    def add_folder_button(name: str, place: Path | None) -> None:
        into = ui.button(name, icon="folder", on_click=lambda: show_folder(place)).classes("w-full")
        into.props("flat dense no-caps align=left")

    def finish_choice() -> None:
        dialog.close()
        files = [f.relative_to(home) if f.is_relative_to(home) else f for f in marked]
        if files:
            on_chosen([file.as_posix() for file in files])

    with ui.dialog(value=True) as dialog, ui.card().classes("studio-card chooser"):
        ui.label("Choose files where they lie").classes("studio-part")
        places = ui.column().classes("w-full gap-0 chooser-list")
        with ui.row():
            ui.button("Take", on_click=finish_choice).props("no-caps unelevated")
            ui.button("Close", on_click=dialog.close).props("no-caps flat")
    show_folder(None)
