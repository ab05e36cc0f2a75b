"""The robot file that is edited: its text, the steps back, and where it is kept.

`robot.toml` is the last text in which nothing was wrong: what commands work on. A text in which
something is wrong stays beside it, in `robot.draft.toml`, until it is mended.
"""

import contextlib
import time
from pathlib import Path

from modeler.core.files import write_atomically
from modeler.studio.tasks import ROBOT

DRAFT = "robot.draft.toml"
_MOST = 500  # steps back
_STROKE = 1.0  # s within which typing is one step


class RobotText:
    """The text of a robot file and its past.

    Attributes:
        text: as it is now.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self._past: list[str] = []
        self._future: list[str] = []
        self._typed = 0.0

    def change_text(self, text: str, typing: bool = False) -> bool:
        """Makes it another text, one step further; of typing a step a second.

        Returns:
            False if it is the same.
        """
        if text == self.text:
            return False
        now = time.monotonic()
        if not (typing and now - self._typed < _STROKE and self._past):
            self._past = [*self._past[-_MOST:], self.text]
        self._typed = now if typing else 0.0
        self._future.clear()
        self.text = text
        return True

    def move_in_history(self, back: bool) -> bool:
        """Moves one step back or forth; returns False where there is none."""
        source, other = (self._past, self._future) if back else (self._future, self._past)
        if not source:
            return False
        other.append(self.text)
        self.text = source.pop()
        self._typed = 0.0
        return True


def save_text(folder: Path, text: str, right: bool) -> None:
    """Writes the text where it belongs.

    Args:
        folder: of the project.
        text: of the robot file.
        right: True if nothing is wrong in it.

    Raises:
        ModelerError: it cannot be written.
    """
    write_atomically(folder / (ROBOT if right else DRAFT), text)
    if right:
        with contextlib.suppress(OSError):
            (folder / DRAFT).unlink()
