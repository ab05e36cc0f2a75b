"""The screen "fails"."""

from nicegui import ui

from modeler.studio.studio import Studio


async def draw(studio: Studio) -> None:
    """Draws it."""
    ui.label("fails")
