"""How far a diagnosis is: told often, although nobody knows beforehand how much there is to do."""

from collections.abc import Callable

_STRIDE = 0.04  # of what is left of a stage


class Meter:
    """A share between 0 and 1 that only grows.

    Args:
        tell: called with the share.
        end: of the first stage.
    """

    def __init__(self, tell: Callable[[float], None] | None, end: float) -> None:
        self._tell = tell or (lambda share: None)
        self._share, self._end = 0.0, end
        self._tell(0.0)

    def stage(self, end: float) -> None:
        """What comes next ends at that share; nothing changes if it is the same stage again."""
        if end > self._end:
            self._share, self._end = self._end, end
        self._tell(self._share)

    def tick(self) -> None:
        """A piece of work is done: nearer to the end of the stage, never there."""
        self._share += _STRIDE * (self._end - self._share)
        self._tell(self._share)

    def done(self) -> None:
        """All is done."""
        self._tell(1.0)
