"""How far a diagnosis is: told often, although nobody knows beforehand how much there is to do."""

from collections.abc import Callable

_STRIDE = 0.04  # of what is left of a stage


class Meter:
    """A share between 0 and 1 that only grows.

    Args:
        tell: called with the share.
    """

    def __init__(self, tell: Callable[[float], None] = lambda share: None) -> None:
        self._tell = tell
        self._share = self._end = 0.0

    def stage(self, end: float) -> None:
        """What comes next ends at that share."""
        self._share, self._end = max(self._share, self._end), end
        self._tell(self._share)

    def tick(self) -> None:
        """A piece of work is done: nearer to the end of the stage, never there."""
        self._share += _STRIDE * max(0.0, self._end - self._share)
        self._tell(self._share)
