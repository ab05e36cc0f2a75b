"""All estimators on the logs of eight real machines, which are not part of the project."""

import sys
from collections.abc import Sequence
from pathlib import Path

from modeler import api
from modeler.estimation.identify import MethodResult, compare_methods
from tests.chain import chain_of
from tests.measured_sets.sets import SETS


def tried(name: str, data: Path, methods: Sequence[str]) -> tuple[MethodResult, ...]:
    """Every method on the training logs of one set, held-out error on its others."""
    item = SETS[name]
    compiled = chain_of(item.robot()).compiled
    training, held_out = item.logs(data, "forward")
    observation = api.observe(compiled, training)
    other = api.observe(compiled, held_out, observation.report.processing)
    return compare_methods(observation, compiled, other, methods)


def here(names: Sequence[str], data: Path) -> list[str]:
    """Sets whose logs are here; says which are not."""
    for name in names:
        if not (data / name).is_dir():
            print(f"NOT CHECKED: {name}, no measured logs in {data / name}", file=sys.stderr)
    return [name for name in names if (data / name).is_dir()]


HEADER = "| set | method | training % | held out % | farthest from weighted | seconds | remarks |"


def lines(name: str, found: Sequence[MethodResult]) -> str:
    """Rows of Markdown."""
    rows = []
    for item in found:
        if item.fit is None:
            said = f"refused: {item.refusal}"
            rows.append([name, item.method, "", "", "", f"{item.seconds:.1f}", said])
            continue
        far = (
            ""
            if item.largest_shift is None
            else f"{item.largest_shift[0]} {item.largest_shift[1]:.1f} sigma"
        )
        remarks = "; ".join(item.fit.estimator_notes)
        held_out = "" if item.held_out_error is None else f"{100 * item.held_out_error:.2f}"
        rows.append(
            [
                name,
                item.method,
                f"{100 * item.fit.relative_error:.2f}",
                held_out,
                far,
                f"{item.seconds:.1f}",
                remarks,
            ]
        )
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)
