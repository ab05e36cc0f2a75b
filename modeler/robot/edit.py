"""Changing the effects of a robot file, and nothing else in it."""

import tomllib
from collections.abc import Mapping

from modeler.core.errors import RobotError


def with_effects(text: str, effects: Mapping[str, str | list[str]]) -> str:
    """The robot file with another `[effects]` table: {id: "all" or joint names}.

    Raises:
        RobotError: the file's own table is written in a way that cannot be replaced line by line.
    """
    kept, inside = [], False
    for line in text.splitlines():
        if line.startswith("["):
            inside = line.split("#")[0].strip() == "[effects]"
        if not inside:
            kept.append(line)
    table = ["[effects]", *(f"{name} = {_toml(joints)}" for name, joints in effects.items())]
    changed = "\n".join([*kept, "", *table]) + "\n"
    before, after = tomllib.loads(text), tomllib.loads(changed)
    before.pop("effects", None)
    after.pop("effects", None)
    if before != after:
        raise RobotError(
            "the [effects] table cannot be replaced; write it as a table of its own, one effect a "
            "line, each with its joints on the same line"
        )
    return changed


def _toml(joints: str | list[str]) -> str:
    if isinstance(joints, str):
        return f'"{joints}"'
    return "[" + ", ".join(f'"{joint}"' for joint in joints) + "]"
