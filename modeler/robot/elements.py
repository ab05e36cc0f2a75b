"""What a reader makes of every element and attribute of a format, by a table, and what it tells.

A table is a TOML file. `read`: path of an element -> attributes that are taken, or `**` for all
that is in it. `idle`: the same of what has no influence on the mechanics, `*` for the element and
all that is in it. `told` and `refused`: path of an element, or behind @ of an attribute ->
sentence, {} for the names. `default`: path -> values that change nothing, else 0 and false.
What stands in no part is told by name: nothing is passed over in silence.
"""

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from modeler.core.errors import RobotError, flatten_message
from modeler.robot.body_tree import summarise_names
from modeler.robot.xml_source import Element

_NOTHING = ("", "false", "no", "none")
_UNKNOWN = "{} is not known here and is passed over: {{}}"
_MOST_NOTES = 40


@dataclass(frozen=True)
class ElementTable:
    """The table of a format.

    Attributes:
        read, idle: path -> attributes.
        told, refused: path, or path@attribute -> sentence.
        default: the same -> values that change nothing.
        same: tag -> that under which it stands in paths.
    """

    read: Mapping[str, str]
    idle: Mapping[str, str]
    told: Mapping[str, str]
    refused: Mapping[str, str]
    default: Mapping[str, str]
    same: Mapping[str, str]

    def classify_path(self, path: str, attribute: str = "") -> str:
        """read, idle, told or refused; "" for what the table does not know."""
        name = f"{path}@{attribute}" if attribute else path
        for part in ("refused", "told"):
            if name in getattr(self, part):
                return part
        if self.idle.get(path) == "*":
            return "idle"
        if not attribute:
            return "read" if path in self.read else ""
        known = {part: getattr(self, part).get(path, "").split() for part in ("read", "idle")}
        return next((p for p, names in known.items() if attribute in names or "**" in names), "")

    def extend_path(self, parent: str, tag: str) -> str:
        """Of a child; bodies in bodies, and defaults in defaults, count once."""
        path_name = self.same.get(tag, tag)
        known = tag in self.same
        return (
            parent
            if known and (not path_name or parent.endswith(f"/{path_name}"))
            else f"{parent}/{path_name}"
        )

    def collect_notes(self, roots: Iterable[tuple[str, Element]]) -> list[str]:
        """What to tell of files, those that are included behind their own.

        Raises:
            RobotError: the first that is refused.
        """
        names_by_sentence: dict[str, list[str]] = {}
        for where, root in roots:
            for element, name, key, sentence in self._find_reported(root):
                called = name or f"line {element.line}"
                if key in self.refused:
                    line = f"{where}: line {element.line}: {sentence}"
                    raise RobotError(flatten_message(line.format(called)))
                if sentence not in names_by_sentence and len(names_by_sentence) >= _MOST_NOTES:
                    sentence = "other elements are not known here and are passed over: {}"
                names_by_sentence.setdefault(sentence, []).append(called)
        return [
            sentence.format(summarise_names(names)) for sentence, names in names_by_sentence.items()
        ]

    def _find_reported(self, root: Element) -> Iterator[tuple[Element, str, str, str]]:
        """What is told or refused: element, what it belongs to, key in the table, sentence."""
        waiting = [(root, self.same.get(root.tag, root.tag), "")]
        while waiting:
            element, path, name = waiting.pop()
            attributes = element.attributes
            name = (attributes.get("name") or attributes.get("reference") or name).strip()
            for attribute, value in (("", _get_value_text(element)), *attributes.items()):
                key = f"{path}@{attribute}" if attribute else path
                verdict = self.classify_path(path, attribute)
                if not verdict and not attribute.startswith("xmlns"):
                    unknown = f"{attribute[:60]} of " * bool(attribute) + f"<{element.tag[:60]}>"
                    yield element, name, "", _UNKNOWN.format(unknown)
                elif verdict in ("told", "refused") and not self._is_default(key, value):
                    yield element, name, key, getattr(self, verdict)[key]
                if not attribute and (verdict != "read" or self.read[path] == "**"):
                    break
            else:
                name = name if "/" in path else ""
                waiting += [
                    (e, self.extend_path(path, e.tag), name) for e in reversed(element.children)
                ]

    def _is_default(self, name: str, value: str | None) -> bool:
        if value is None:
            return False
        if name in self.default:
            return value in self.default[name].split()
        return all(map(_is_nothing, value.lower().split()))


@cache
def load_element_table(format: str) -> ElementTable:
    """Of "urdf" or "mjcf"."""
    text = Path(__file__).with_name(f"{format}_elements.toml").read_text(encoding="utf-8")
    parts = tomllib.loads(text)
    return ElementTable(**{key: parts.get(key, {}) for key in ElementTable.__annotations__})


def _is_nothing(word: str) -> bool:
    try:
        return float(word) == 0.0
    except ValueError:
        return word in _NOTHING


def _get_value_text(element: Element) -> str | None:
    """Its value, where it is a value and nothing else."""
    if element.children:
        return None
    attributes = {key: value for key, value in element.attributes.items() if key != "name"}
    return attributes.get("value") if attributes else element.text or None
