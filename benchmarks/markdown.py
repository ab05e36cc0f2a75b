"""The tables of a report, as Markdown: a row per family of keys, a column per robot."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from benchmarks.all import LINES
from benchmarks.line import Key


@dataclass(frozen=True)
class _Family:
    """Keys `name.variant` that mean the same but for the variant; or one key, without variants."""

    name: str
    meaning: str
    keys: Mapping[str, Key]


def markdown(report: Mapping[str, Any], wanted: Callable[[str], bool] = lambda name: True) -> str:
    """Machine, then a row per family of wanted keys: values with must and aim, what they mean."""
    about = report["machine"]
    head = (
        f"Measured {about['date']}: {about['processor']} ({about['vectors']}), {about['cores']} "
        f"cores, {about['memory_gb']} GB; {about['gcc']}; Python {about['python']}."
    )
    families = _families(key for line in LINES for key in line.keys if wanted(key.name))
    return "\n\n".join([head, *(_table(report, table) for table in _tables(families))])


def number(value: float) -> str:
    """Three digits, and all before the point."""
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"


def _families(keys: Iterable[Key]) -> list[_Family]:
    """In the order of their first keys."""
    table: dict[tuple[str, str], dict[str, Key]] = {}
    for key in keys:
        name, _, variant = key.name.rpartition(".")
        named = rf"(?<![A-Za-z0-9]){re.escape(variant)}(?![A-Za-z0-9])"
        meaning = re.sub(named, "X", key.meaning) if name else key.meaning
        table.setdefault((name, meaning), {})[variant] = key
    return [
        _Family(name, meaning, of) if len(of) > 1 else _alone(*of.values())
        for (name, meaning), of in table.items()
    ]


def _alone(key: Key) -> _Family:
    return _Family(key.name, key.meaning, {"": key})


def _tables(families: Iterable[_Family]) -> Iterator[list[_Family]]:
    """Neighbours of the same variants share a table."""
    table: list[_Family] = []
    for family in families:
        if table and family.keys.keys() != table[0].keys.keys():
            yield table
            table = []
        table.append(family)
    if table:
        yield table


def _table(report: Mapping[str, Any], families: list[_Family]) -> str:
    variants = list(families[0].keys)
    columns = ["key", *(variant or "value" for variant in variants), "what"]
    rows = [
        [
            f"`{family.name}`",
            *(_cell(report, family.keys[variant]) for variant in variants),
            family.meaning.replace("|", "\\|"),
        ]
        for family in families
    ]
    head, *below = (f"| {' | '.join(row)} |" for row in [columns, *rows])
    return "\n".join([head, "|---" * len(columns) + "|", *below])


def _cell(report: Mapping[str, Any], key: Key) -> str:
    value = report["values"].get(key.name)
    if value is None:
        return f"missing: {report['missing'].get(key.name, 'not measured')}"
    goals = ("-" if goal is None else f"{goal:g}" for goal in (key.must, key.aim))
    text = "/".join(goals)
    return number(value) if text == "-/-" else f"{number(value)} ({text})"
