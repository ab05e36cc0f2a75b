"""Changing the effects of a robot file, and nothing else in it."""

import re
import tomllib
from collections.abc import Mapping

from modeler.core.errors import RobotError
from modeler.effects import CATALOGUE, effect_named
from modeler.robot.robot import INERTIAL

Effects = Mapping[str, str | list[str]]
"""Effect id or alias -> "all" or the names of the joints that have it."""


def with_effects(text: str, effects: Effects) -> str:
    """The robot file with another `[effects]` table.

    Nominal values of effects that are gone leave `[parameters]` with them: they would be values
    of parameters that the robot does not have.

    Raises:
        RobotError: the file's own table is written in a way that cannot be replaced line by line.
    """
    kept, table = [], ""
    for line in text.splitlines():
        if line.startswith("["):
            table = line.split("#")[0].strip()
        gone = table == "[parameters]" and not _belongs(_key(line), effects)
        if table != "[effects]" and not gone:
            kept.append(line)
    lines = ["[effects]", *(f"{name} = {_toml(joints)}" for name, joints in effects.items())]
    changed = "\n".join([*kept, "", *lines]) + "\n"
    try:
        same = _others(text, effects) == _others(changed, effects)
    except tomllib.TOMLDecodeError:
        same = False
    if not same:
        raise RobotError(
            "the [effects] table cannot be replaced; write it as a table of its own, one effect a "
            "line, each with its joints on the same line"
        )
    return changed


def _others(text: str, effects: Effects) -> dict:
    """What the file says but for its effects and the values of effects that are gone."""
    document = tomllib.loads(text)
    document.pop("effects", None)
    values = document.get("parameters", {})
    return document | {"parameters": {n: v for n, v in values.items() if _belongs(n, effects)}}


def _key(line: str) -> str:
    """The key of a line `key = value`; empty where there is none."""
    found = re.match(r"\s*[\"']?([\w{}]+)[\"']?\s*=", line)
    return found[1] if found else ""


def _belongs(parameter: str, effects: Effects) -> bool:
    """True if the parameter is a link's, or one of these effects'; the longest prefix tells."""
    owners = {column.prefix: effect.id for effect in CATALOGUE for column in effect.columns}
    prefixes = [p for p in (*INERTIAL, *owners) if parameter.startswith(p)]
    prefix = max(prefixes, key=len, default="")
    if prefix not in owners:
        return True
    for name, joints in effects.items():
        effect = effect_named(name)
        if effect is not None and effect.id == owners[prefix]:
            return joints == "all" or parameter[len(prefix) :] in joints
    return False


def _toml(joints: str | list[str]) -> str:
    if isinstance(joints, str):
        return f'"{joints}"'
    return "[" + ", ".join(f'"{joint}"' for joint in joints) + "]"
