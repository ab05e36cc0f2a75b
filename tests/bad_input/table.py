"""All rows."""

from tests.bad_input import (
    command_lines,
    environment,
    log_signals,
    log_texts,
    models,
    python_api,
    robot_loops,
    robot_sections,
    robot_tables,
)  # fmt: skip
from tests.bad_input.row import Row

ROWS: tuple[Row, ...] = tuple(
    row
    for theme in (
        robot_tables, robot_sections, robot_loops, log_texts, log_signals, models, command_lines,
        environment, python_api,
    )
    for row in theme.ROWS
)  # fmt: skip
