"""The unit of tiles: base regressors of some samples at once, each in a lane of its own.

The arithmetic is that of the scalar function of the entries, with vectors in the place of numbers.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from modeler.codegen.block import Block, make_block
from modeler.codegen.functions import Function
from modeler.codegen.target import TILE

UNIT = "_tile"
"""C file of the tiles, without the robot's name and `.c`."""

ENTRIES = "base_regressor_nonzeros"
"""Role of the scalar function whose values a tile has."""


@dataclass(frozen=True)
class Tile:
    """The finished strings of a unit.

    Attributes:
        lines: of the function of one vector.
        steps: statements that take the inputs to the next samples.
        symbols: names of the graph's symbols that are read.
        additions: for each sample.
        multiplications: the same, divisions included.
        signals: how many there are.
    """

    lines: tuple[str, ...]
    steps: tuple[str, ...]
    symbols: frozenset[str]
    additions: int
    multiplications: int
    signals: int


def tile_of(
    functions: Iterable[Function],
    places: Mapping[str, str],
    nonzeros: Sequence[tuple[int, int]],
) -> Tile | None:
    """The tile of a module; None where it has no function of the entries: with loops.

    Args:
        functions: of the module.
        places: C text of every symbol of the graph.
        nonzeros: (joint, column) of the entries.
    """
    function = next((f for f in functions if f.role == ENTRIES), None)
    if function is None or not function.entries:
        return None
    # Column after column as there; the link's own joint first is another 5 % faster with vectors.
    entries = sorted(
        function.entries, key=lambda entry: (nonzeros[entry[0]][1], -nonzeros[entry[0]][0])
    )
    outputs = [(f"MODELER_PUT({index})", value) for index, value in entries]
    block = make_block(outputs, {s: _lane(place) for s, place in places.items()}, target=TILE)
    lengths = {argument.name: argument.shape[0] for argument in function.inputs}
    loads = _loads(lengths, block)
    unread = tuple(name for name in ("q", "qd", "qdd", "s") if not loads.get(name))
    parts = [
        [f"(void){name};" for name in unread], block.constants,
        [line for lines in loads.values() for line in lines], block.calls, block.body,
    ]  # fmt: skip
    return Tile(
        lines=tuple([line for part in parts if part for line in ("", *part)][1:]),
        steps=tuple(
            f"{name} += {length}*MODELER_WIDTH;"
            for name, length in lengths.items()
            if name not in unread
        ),
        symbols=block.symbols,
        additions=block.additions,
        multiplications=block.multiplications,
        signals=lengths.get("s", 0),
    )


def _loads(lengths: Mapping[str, int], block: Block) -> dict[str, list[str]]:
    """Of each input, the statements that take what is read of it."""
    return {
        name: [
            f"const modeler_lanes {name}_{i} = {_load(name, length, i)};"
            for i in range(length)
            if f"{name}[{i}]" in block.symbols
        ]
        for name, length in lengths.items()
    }


def _lane(place: str) -> str:
    """`q[3]` of all lanes is the variable q_3."""
    entry = re.fullmatch(r"(q|qd|qdd|s)\[(\d+)\]", place)
    return f"{entry[1]}_{entry[2]}" if entry else place


def _load(name: str, length: int, index: int) -> str:
    if length == 1:
        return f"MODELER_ROWS_OF_ONE({name})"
    return f"MODELER_ROWS({name}, {length}, {index})"
