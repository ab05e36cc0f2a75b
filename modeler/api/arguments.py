"""What a function of the API is given is of the kind that it declares, or a line says what is not.

Without it, a wrong kind shows as an error of Python's deep inside.
"""

import functools
import inspect
import re
import types
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from numbers import Integral, Real
from pathlib import Path
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from modeler.core.errors import DataError, ModelerError
from modeler.core.json import shown
from modeler.core.toml_cells import near

F = TypeVar("F", bound=Callable[..., Any])

_KINDS = {
    "Robot": "a robot (load gives one)",
    "IdentifiedModel": "a model (open_model and fit give one)",
    "Derivation": "a derivation (derive gives one)",
    "Emitted": "the C of a robot (generate gives it)",
    "CompiledModel": "a compiled robot (compile_model gives one)",
    "Observation": "an observation (observe gives one)",
    "HomeModes": "assembly modes (home gives them)",
    "Log": "a log",
    "SimulatedLog": "a simulated log",
    "Frame": "a frame",
    "Model": "a model",
    "str": "a text",
    "Path": "a path",
    "float": "a number",
    "int": "a whole number",
    "bool": "True or False",
    "NoneType": "None",
}
"""What classes are called in messages; others by their own names."""

_NUMBERS: dict[type, tuple[type, ...]] = {float: (Real,), int: (Integral,), bool: (Integral,)}


class _WrongKind(Exception):
    """A value is of none of the kinds that are expected."""


def checked(function: F) -> F:
    """The function, which refuses arguments of a kind that it does not declare.

    Where it takes a list, one thing alone stands for a list of it; a text is never a list of
    letters.

    Raises:
        DataError: by the function returned: which argument, what was got, what was expected.
    """
    return _wrapper_of(function)  # the types of a function would be lost in its cache


@functools.cache
def _wrapper_of(function: Callable[..., Any]) -> Any:
    signature = inspect.signature(function)

    @functools.wraps(function)
    def checked_call(*args: Any, **kwargs: Any) -> Any:
        try:
            given = signature.bind(*args, **kwargs)
        except TypeError as error:  # Python's to tell, with the name that may be meant
            wrong = next((name for name in kwargs if repr(name) in str(error)), "")
            hint = near(wrong, signature.parameters)
            raise TypeError(f"{function.__name__}() {error}{hint}") from None
        hints = _hints(function)
        for name, value in given.arguments.items():
            if signature.parameters[name].kind is not inspect.Parameter.VAR_KEYWORD:
                hint = hints.get(name, Any)  # `self` has none
                given.arguments[name] = fitting(function.__name__, name, hint, value)
        try:
            return function(*given.args, **given.kwargs)
        except ModelerError as error:
            error.args = (in_python(str(error)),)
            raise

    return checked_call


_OPTION = re.compile(r"`[^`]*`|(?<![\w-])--([a-z][a-z-]*)")
_ARGUMENTS = {
    "cutoff": "position_cutoff", "decimate": "decimation", "map": "mapping",
    "payload-log": "load", "payload-mass": "mass", "payload-moved": "moved",
    "run-embedded-c": "model.compile()", "drive-gain": "drive_gains", "controller": "gains",
    "from": "of", "mode": "letter", "workers": "processes",
}  # fmt: skip
"""Options of the command line that have another name in Python."""


def in_python(message: str) -> str:
    """A message in the words of Python: options of commands are arguments, but in a command line.

    >>> in_python("no column q3; say which it is, --map q3=COLUMN")
    'no column q3; say which it is, mapping q3=COLUMN'
    """

    def renamed(found: re.Match[str]) -> str:
        option = found[1]
        return _ARGUMENTS.get(option, option.replace("-", "_")) if option else found[0]

    return _OPTION.sub(renamed, message)


@functools.cache
def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    return get_type_hints(function)


def fitting(where: str, name: str, hint: Any, value: Any) -> Any:
    """The value as the kind that is expected: itself, or a list of it alone.

    Args:
        where: begins the message.
        name: of the argument.
        hint: the kind, as it is declared.
        value: as it was given.

    Raises:
        DataError: it is of another kind.
    """
    try:
        return _taken(hint, value)
    except _WrongKind as error:
        raise DataError(f"{where}: got {error} as {name}; expected {_told(hint)}") from None


def _taken(hint: Any, value: Any) -> Any:
    if isinstance(hint, TypeVar):
        hint = hint.__bound__
    origin, of = get_origin(hint), get_args(hint)
    if hint is Any:
        return value
    if origin in (Union, types.UnionType):
        return _one_of(of, value)
    if origin is Literal:
        return _one_of([type(choice) for choice in of], value)  # which one: its function tells
    if origin is Sequence:
        return _listed(of[0], value)
    if origin is Mapping:
        return _mapped(of[1], value)
    if origin is Callable:
        return _sure(callable(value), value)
    if isinstance(hint, type):
        return _sure(isinstance(value, _NUMBERS.get(hint, hint)), value)
    return value


def _sure(fits: bool, value: Any) -> Any:
    if not fits:
        raise _WrongKind(_got(value))
    return value


def _one_of(hints: Sequence[Any], value: Any) -> Any:
    """As it is for the first kind that it fits; what is said is of the last list, if any."""
    wrong = _WrongKind(_got(value))
    for hint in hints:
        try:
            return _taken(hint, value)
        except _WrongKind as error:
            wrong = error if get_origin(hint) in (Sequence, Mapping) else wrong
    raise wrong


def _listed(hint: Any, value: Any) -> Any:
    one = isinstance(value, str | bytes | Mapping) or hasattr(value, "__arrow_c_stream__")
    if one or not isinstance(value, Iterable):
        return [_taken(hint, value)]
    kept = value if isinstance(value, Sequence) else list(value)
    for each in kept:
        _taken(hint, each)
    return kept


def _mapped(hint: Any, value: Any) -> Any:
    _sure(isinstance(value, Mapping), value)
    for each in value.values():
        _taken(hint, each)
    return value


def _got(value: Any) -> str:
    """What a value is, in words."""
    if isinstance(value, str):
        return f"the text {shown(value)}"
    if value is None or isinstance(value, Real):
        return str(value)
    if isinstance(value, Path):
        return f"the path {value}"
    name = type(value).__name__
    known = _KINDS.get(name)
    return known.partition(" (")[0] if known else f"a {name}"


def _told(hint: Any) -> str:
    """What is expected, in words."""
    if isinstance(hint, TypeVar):
        hint = hint.__bound__
    origin, of = get_origin(hint), get_args(hint)
    if origin in (Union, types.UnionType):
        return " or ".join(_told(each) for each in of)
    if origin is Literal:
        return "one of " + ", ".join(map(str, of))
    if origin is Sequence:
        return f"a list, each {_told(of[0])}"
    if origin is Mapping:
        return "a mapping" if of[1] is Any else f"a mapping of names, each to {_told(of[1])}"
    if origin is Callable:
        return "a function"
    return _KINDS.get(hint.__name__, hint.__name__)


Steps = Callable[[str], AbstractContextManager[None]]
"""Called with the title of a step, which lasts as long as the context."""


def silent(title: str) -> AbstractContextManager[None]:
    """Says nothing."""
    return nullcontext()
