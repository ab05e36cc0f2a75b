"""Every line, in the order of the report."""

from benchmarks import (
    answers,
    callgrind,
    casadi_c,
    control,
    cortex,
    fleets,
    folder,
    least_squares,
    loops,
    memory,
    pictures,
    regressor,
    start,
    streams,
    tiles,
)

LINES = (
    *start.LINES,
    *regressor.LINES,
    *casadi_c.LINES,
    *tiles.LINES,
    *control.LINES,
    *callgrind.LINES,
    *cortex.LINES,
    *folder.LINES,
    *memory.LINES,
    *least_squares.LINES,
    *loops.LINES,
    *streams.LINES,
    *fleets.LINES,
    *pictures.LINES,
    *answers.LINES,
)
