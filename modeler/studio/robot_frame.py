"""The robot in 3-D inside a screen: the page of `modeler show` in a frame, and what it is told."""

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from nicegui import ui

from modeler.studio.studio import Studio


class RobotFrame:
    """The page of a robot in a frame.

    Attributes:
        frame: the element.
    """

    def __init__(self, studio: Studio, html: str, height: str, alone: bool = False) -> None:
        address = studio.hub.register_sheet(html)
        self.frame = ui.element("iframe").classes("studio-robot").style(f"height: {height}")
        self.frame.props(f'src="{address}#bare{"-alone" * alone}" title="the robot in 3-D"')

    @property
    def element_id(self) -> str:
        """Returns the id of the element, for scripts: `toRobot(id, message)`."""
        return self.frame.html_id

    def set_posture(self, q: Mapping[str, float]) -> None:
        """Moves joints; the loops follow."""
        self._send_message(modeler="posture", q=dict(q))

    def show_clearly(self, rows: Sequence[str]) -> None:
        """Shows links and joints clearly, the others faintly; none: all alike."""
        self._send_message(modeler="light", rows=list(rows))

    def replace_robot(self, content: Mapping[str, Any]) -> None:
        """Shows another robot from the same view."""
        self._send_message(modeler="robot", content=content)

    def connect_joint(self, handler: Callable[[str], Any]) -> None:
        """Calls it with the name of a joint or link that is clicked."""
        self.frame.on("joint", lambda event: handler(str(event.args["detail"])), args=["detail"])

    def _send_message(self, **message: Any) -> None:
        words = json.dumps(message, separators=(",", ":"))
        self.frame.client.run_javascript(f"toRobot({json.dumps(self.element_id)}, {words})")


async def add_robot_frame(studio: Studio, height: str = "420px", alone: bool = False) -> RobotFrame:
    """Adds the frame with the robot of the project.

    Args:
        studio: the window.
        height: of the frame, as CSS has it.
        alone: True for nothing but the picture: no sliders.

    Raises:
        ModelerError: the project has no robot that can be drawn; the line.
    """
    text = studio.read_text(studio.project.robot)
    return RobotFrame(studio, await studio.ask_viewer("robot_page", text), height, alone)
