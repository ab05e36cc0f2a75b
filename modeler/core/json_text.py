"""JSON and TOML that others wrote, read strictly; JSON that we write, without false numbers."""

import json
import math
import reprlib
import sys
import tomllib
from collections.abc import Mapping
from typing import Any

_LARGEST = 2**63
_BYTE_ORDER = (b"\xff\xfe", b"\xfe\xff")


class JsonError(ValueError):
    """What is wrong with the text, without its place; readers add the file and what to do."""


class TomlError(ValueError):
    """What is wrong with a TOML text, without its place."""


def parse_json(data: bytes | str) -> Any:
    """The value of a JSON text in UTF-8.

    Stricter than `json.loads`: what is no number (NaN, Infinity), what no double or 64-bit integer
    holds, an entry given twice, and half a character are refused.

    Raises:
        JsonError: not such a text; says why, where if that is known.
    """
    text = data if isinstance(data, str) else _decoded(data)
    if not text.strip():
        raise JsonError("is empty" if not text else "is blank")
    try:
        value = json.loads(
            text, parse_int=_integer, parse_float=_float, parse_constant=_constant,
            object_pairs_hook=_object,
        )  # fmt: skip
        json.dumps(value, ensure_ascii=False).encode()
    except json.JSONDecodeError as error:
        raise JsonError(
            f"is not JSON, or cut off: {error.msg}, line {error.lineno}, column {error.colno}"
        ) from None
    except RecursionError:
        raise JsonError("is nested too deep") from None
    except UnicodeEncodeError:
        raise JsonError("has an escape \\ud800 to \\udfff that is half a character") from None
    return value


def nulled(content: Any) -> Any:
    """Plain data with null for every number that is not finite; arrays become lists."""
    if hasattr(content, "tolist"):
        content = content.tolist()
    if isinstance(content, Mapping):
        return {key: nulled(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [nulled(value) for value in content]
    unknown = isinstance(content, float) and not math.isfinite(content)
    return None if unknown else content


def parse_toml(text: str) -> dict[str, Any]:
    """The table of a TOML text.

    Raises:
        TomlError: not such a text; says why, where if that is known.
    """
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise TomlError(str(error)) from None
    except RecursionError:
        raise TomlError("lists or tables are nested hundreds deep; write them flat") from None
    except ValueError:  # the one that is left: Python's limit against endless conversions
        most = sys.get_int_max_str_digits()
        raise TomlError(f"an integer has more than {most} digits; write a shorter one") from None


def shown(value: Any) -> str:
    """The value for a message: short, however long it is."""
    return reprlib.repr(value)


def _decoded(data: bytes) -> str:
    if data.startswith(_BYTE_ORDER) or b"\x00" in data[:4]:
        raise JsonError("is UTF-16, UTF-32 or binary; expected text in UTF-8")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise JsonError(f"is no text in UTF-8 from byte {error.start + 1} on") from None


def _integer(text: str) -> int:
    if len(text) > len(str(_LARGEST)) + 1 or abs(int(text)) >= _LARGEST:
        raise JsonError(f"has a whole number of {len(text.lstrip('-'))} digits: {shown(text)}")
    return int(text)


def _float(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise JsonError(f"has the number {shown(text)}, too large for double precision")
    return value


def _constant(text: str) -> float:
    raise JsonError(f"has {text}, which is no number of JSON")


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in found if names.count(name) > 1)
        raise JsonError(f"has the entry {shown(twice)} twice")
    return found
