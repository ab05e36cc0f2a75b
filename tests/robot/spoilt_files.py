"""XML files of robots, spoilt as files are: read, or reported in one line, in bounded memory."""

import random
import re
import resource
import time
from pathlib import Path

from modeler.core.errors import LONGEST, ModelerError
from modeler.formats import read_robot

NUMBERS = [*b"1e300 -1e16 nan -inf 0 -1 1e-320 1e308 0x10 1_0 1,5 x".split(), b"", b"9" * 200]


def check_spoilt(data: bytes, path: Path, draws: int = 20) -> None:
    """Each mutant of the file is a robot, or one line that begins with the file; in 200 MB, 5 s."""
    draw, text = random.Random(f"{path.name} {len(data)}"), 0
    for _ in range(draws):
        path.write_bytes(spoilt(data, draw))
        before, begun = most_memory(), time.process_time()
        try:
            assert read_robot(path).moving_joints
        except ModelerError as error:
            text += 1
            line = str(error)
            assert line.startswith(str(path)), line
            assert len(line.splitlines()) == 1 and len(line) < LONGEST, line
        assert most_memory() - before < 200e6
        assert time.process_time() - begun < 5
    assert text > 0


def most_memory() -> float:
    """The most bytes that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024.0


def spoilt(data: bytes, draw: random.Random) -> bytes:
    """One of what happens to files: bytes, tags, blocks, ends, numbers, names."""
    place = draw.randrange(len(data))
    tags = [tag.span() for tag in re.finditer(rb"<[^>]*>", data)]
    values = [value.span(1) for value in re.finditer(rb'="([^"]*)"', data)]
    start, end = draw.choice(tags)
    until = draw.choice([e for _, e in tags if e >= end])
    whole = {
        "another byte": data[:place] + bytes([draw.randrange(256)]) + data[place + 1 :],
        "a tag less": data[:start] + data[end:],
        "a block twice": data[:until] + data[start:until] + data[until:],
        "the end lost": data[:place],
        "a block less": data[:start] + data[until:],
    }
    way = draw.choice([*whole, "another value", "another number"])
    if way in whole:
        return whole[way]
    start, end = draw.choice(values)
    if way == "another value":
        return data[:start] + data[slice(*draw.choice(values))] + data[end:]
    words = data[start:end].split() or [b""]
    words[draw.randrange(len(words))] = draw.choice(NUMBERS)
    return data[:start] + b" ".join(words) + data[end:]
