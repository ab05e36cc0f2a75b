"""Mutants of good inputs: of their bytes, of their words, of their structure."""

import copy
import json
from typing import Any

NUMBERS = tuple(f"0 -1 1e308 -1e-308 nan inf -inf 1e400 {'9' * 30} 0.1 2 1_0 0x7f 1e17 3.5".split())


def edited_bytes(data, made, tokens):
    """The bytes after the edits; places count modulo what is there."""
    for kind, place, extent, which in made:
        at = place % (len(data) + 1)
        token = tokens[which % len(tokens)].encode()
        head, part, tail = data[:at], data[at : at + extent], data[at + extent :]
        data = {
            "cut": head + tail,
            "repeat": head + part * 3 + tail,
            "replace": head + token + tail,
            "insert": head + token + part + tail,
            "flip": head + bytes(byte ^ (1 << which % 8) for byte in part[:1]) + part[1:] + tail,
            "end": head if which % 8 == 0 else head + tail,
            "exchange": head + part[::-1] + tail,
        }[kind]
    return data


VALUES_DRAWN = (
    *(None, True, 0, -1, 3, 10**19, 0.5, 1e308, -0.0, float("nan"), float("inf"), ""),
    *("q1", "pi/2", "1/0", "sin(", "all", "L1", "q1 + q2", "x" * 500, "\x00", "../../x", "𝛑"),
    *([], {}, [[]], [1, [2, [3]]], {"a": {"b": 1}}),
)
"""Some of what may stand anywhere in a structure."""


def edited_structure(raw: Any, made: list[tuple[list[int], str, Any]]) -> Any:
    """The structure, edited in place."""
    for way, kind, value in made:
        node, others = raw, raw
        for step in way[:-1]:
            keys = list(_keys(node))
            below = node[keys[step % len(keys)]] if keys else None
            if not isinstance(below, dict | list) or not below:
                break
            node, others = below, node
        keys = list(_keys(node))
        if keys:
            _edit(node, keys[way[-1] % len(keys)], kind, value, others)
    return raw


def _keys(node: Any) -> Any:
    return node if isinstance(node, dict) else range(len(node))


def _edit(node: Any, key: Any, kind: str, value: Any, others: Any) -> None:
    if kind == "put":
        node[key] = copy.deepcopy(value)
    elif kind == "take out":
        del node[key]
    elif kind == "copy":  # what stands first one level up
        first = next(iter(others.values() if isinstance(others, dict) else others))
        node[key] = copy.deepcopy(first)
    elif isinstance(node, list):
        node.append(copy.deepcopy(node[key]))
    elif kind == "double":
        node[f"{key}2"] = copy.deepcopy(node[key])
    else:
        node[str(value)[:8]] = node.pop(key)


def toml_text(document: dict[str, Any]) -> str:
    """A structure as TOML: plain keys first, then tables."""
    plain = {k: v for k, v in document.items() if not isinstance(v, dict)}
    lines = [f"{json.dumps(k)} = {_toml(v)}" for k, v in plain.items()]
    for name, table in document.items():
        if isinstance(table, dict):
            lines += [f"[{json.dumps(name)}]"]
            lines += [f"{json.dumps(k)} = {_toml(v)}" for k, v in table.items()]
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {_toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, bool) or value is None:
        return str(bool(value)).lower()
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value)
