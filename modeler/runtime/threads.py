"""Work on parts in threads; what a part gives must not depend on how many there are."""

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import TypeVar

A = TypeVar("A")
T = TypeVar("T")


def count_processors() -> int:
    """How many this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def split_samples(samples: int, least: int) -> list[slice]:
    """The samples in about equal parts, one for each thread that is worth starting.

    Args:
        samples: how many.
        least: that a thread is worth starting for.
    """
    count = max(1, min(count_processors(), samples // least))
    borders = [samples * k // count for k in range(count + 1)]
    return [slice(a, b) for a, b in pairwise(borders)]


def map_parts(function: Callable[[A], T], parts: Sequence[A]) -> Iterator[T]:
    """The function of each part, in their order; in threads where there are several."""
    threads = min(len(parts), count_processors())
    if threads < 2:
        yield from map(function, parts)
        return
    with ThreadPoolExecutor(threads) as pool:
        yield from pool.map(function, parts)
