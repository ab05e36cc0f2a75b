"""The table of a report, as Markdown."""

from collections.abc import Callable, Mapping
from typing import Any

from benchmarks.all import LINES
from benchmarks.line import Key


def markdown(report: Mapping[str, Any], wanted: Callable[[str], bool] = lambda name: True) -> str:
    """Machine, then a row per wanted key: value, what it must reach, what it means."""
    about = report["machine"]
    head = (
        f"Measured {about['date']}: {about['processor']} ({about['vectors']}), {about['cores']} "
        f"cores, {about['memory_gb']} GB; {about['gcc']}; Python {about['python']}."
    )
    rows = [
        _row(key, report["values"].get(key.name), report["missing"].get(key.name, "not measured"))
        for line in LINES
        for key in line.keys
        if wanted(key.name)
    ]
    return "\n".join(
        [head, "", "| key | value | must | aim | what |", "|---|---|---|---|---|", *rows]
    )


def number(value: float) -> str:
    """Three digits, and all before the point."""
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"


def _row(key: Key, value: float | None, why: str) -> str:
    told = f"missing: {why}" if value is None else f"{number(value)} {key.unit}".removesuffix(" 1")
    must, aim = ("" if goal is None else f"{goal:g}" for goal in (key.must, key.aim))
    return f"| `{key.name}` | {told} | {must} | {aim} | {key.meaning.replace('|', chr(92) + '|')} |"
