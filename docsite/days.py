"""What takes long on the site: with EVERY=N in the environment each day has a share of it.

Without it, all is made; the links are the same on any day.
"""

import os
import time


def every() -> int:
    """Days, of which each picture has one."""
    return int(os.environ.get("EVERY") or 1)


def has_its_turn(place: int) -> bool:
    """Whether what stands at this place of its list is made today (UTC)."""
    return (place + int(time.time() // 86400)) % every() == 0
