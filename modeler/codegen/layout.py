"""Finished strings that the templates lay out: relations, comments, argument lists, bodies."""

import textwrap
from collections.abc import Iterable, Sequence

from modeler.base.relation_text import relation_text
from modeler.base.result import BaseParameter
from modeler.codegen.block import Block
from modeler.codegen.functions import Function
from modeler.core.contract import ModuleSpec

_WIDTH = 100
_FEW = 16  # outputs that are always 0, up to which each is written in its own line
_RUN = 8  # of more, as many as one statement writes: a line of the cache


def relation(parameter: BaseParameter) -> str:
    """`ZZ2R = ZZ2 + YY3 + D4**2*M4`; a name alone where nothing is grouped."""
    name, text = parameter.name, relation_text(parameter)
    return name if text == f"{name} = {name}" else text


def comment_text(text: str) -> str:
    """`text` such that it can stand in a C comment: no end of comment, ASCII only, short lines."""
    text = " ".join(text.replace("*/", "* /").replace("/*", "/ *").split())
    text = text.encode("ascii", "replace").decode()
    return "\n * ".join(textwrap.wrap(text, _WIDTH - 4))


def comment_lines(sentences: Iterable[str]) -> list[str]:
    """Sentences as lines for the inside of a C comment."""
    return [line for each in sentences for line in comment_text(each).split("\n * ")]


def parameter_lines(spec: ModuleSpec, relations: Sequence[str]) -> tuple[list[str], list[str]]:
    """Comment lines that say which column is which parameter: (standard, base).

    Args:
        spec: of the module.
        relations: what `relation` writes of each base parameter.
    """
    standard = [
        f"{i:4d}  {parameter.name:<8} {parameter.unit}" for i, parameter in enumerate(spec.standard)
    ]
    base = []
    for i, (parameter, text) in enumerate(zip(spec.base, relations, strict=True)):
        base += _wrap(f"{i:4d}  {text}  [{parameter.unit}]", " " * 8)
    return [comment_line(line) for line in standard], base


def _wrap(text: str, indent: str) -> list[str]:
    lines = textwrap.wrap(
        text, _WIDTH - 4, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False,
        drop_whitespace=True, initial_indent="",
    )  # fmt: skip
    return [line.replace("*/", "* /") for line in lines]


def comment_line(text: str) -> str:
    """One line for the inside of a C comment, spaces kept."""
    return text.rstrip().replace("*/", "* /")


def argument_lines(function: Function) -> list[str]:
    """Comment lines that say of every argument its length, order and unit."""
    given = (*function.inputs, function.output)
    lengths = [" x ".join(str(size) for size in argument.shape) for argument in given]
    width = max(9, *(len(length) + 1 for length in lengths))
    lines = []
    for argument, length in zip(given, lengths, strict=True):
        order = ", row-major" if len(argument.shape) > 1 else ""
        text = f"{argument.meaning}{order} [{argument.unit}]"
        lines.append(f"{argument.name:<7}{length:<{width}}{text}")
    return lines


def arguments(function: Function, restrict: str) -> list[str]:
    """C parameters: inputs const; `restrict`, or nothing, is put before the output's name."""
    return [
        *(f"const double *{argument.name}" for argument in function.inputs),
        f"double *{restrict}{function.output.name}",
    ]


def prototype(name: str, parameters: Sequence[str], returns: str = "void") -> str:
    """`void name(...)`, in lines of readable length."""
    indent = " " * (len(returns) + len(name) + 2)
    return "\n".join(
        textwrap.wrap(
            f"{returns} {name}({', '.join(p.replace(' ', chr(160)) for p in parameters)})",
            _WIDTH,
            subsequent_indent=indent,
            break_long_words=False,
            break_on_hyphens=False,
        )
    ).replace(chr(160), " ")


def signal_lines(spec: ModuleSpec) -> list[str]:
    """Comment lines that say what each entry of the input s is."""
    meaning = {
        "time": "time since the start",
        "temperature": "temperature of joint {joint}",
        "slip": "bristle of joint {joint}, which turns over {value:g}; start with 0",
    }
    return [
        f"{k:4d}  {meaning[s.kind].format(joint=s.joint, value=s.value)} [{s.unit}]"
        for k, s in enumerate(spec.signals)
    ]


def observation_prototype(
    prefix: str, restrict: str, status: bool = False, signals: bool = False
) -> str:
    """Prototype of the loop over samples that fills W."""
    states = ["const double *q", "const double *qd", "const double *qdd"]
    states += ["const double *s"] if signals else []
    outputs = [f"double *{restrict}W", *(["int *status"] if status else [])]
    return prototype(f"{prefix}_observation", ["size_t samples", *states, *outputs])


def body_lines(function: Function, block: Block | None) -> list[str]:
    """All statements of a function."""
    size = function.output.size
    written = {index for index, _ in function.entries}
    zeros = [index for index in range(size) if index not in written]
    lines = [f"(void){name};" for name in unread(function, block)]
    body = block.body if block is not None else ()
    if len(zeros) > _FEW:
        name = function.output.name
        lines.append(f"MODELER_ALL_ZEROS({name}, {size});")
        body = _mixed(body, [f"MODELER_ZEROS({name} + {a}, {n});" for a, n in _runs(zeros)])
    else:
        lines += [f"{function.output.name}[{index}] = 0.0;" for index in zeros]
    for part in (block.constants, block.calls, body) if block is not None else (body,):
        lines += ["", *part] if lines and part else part
    return lines


def _runs(places: Sequence[int]) -> list[tuple[int, int]]:
    """(first, length) of neighbouring places."""
    runs: list[tuple[int, int]] = []
    for place in places:
        first, length = runs[-1] if runs else (place, 0)
        if place == first + length and 0 < length < _RUN:
            runs[-1] = (first, length + 1)
        else:
            runs.append((place, 1))
    return runs


def _mixed(statements: Sequence[str], more: Sequence[str]) -> tuple[str, ...]:
    """The statements with `more` evenly between them: stores that wait for no arithmetic."""
    mixed: list[str] = []
    done = 0
    for k, statement in enumerate(statements):
        due = k * len(more) // len(statements)
        mixed += [*more[done:due], statement]
        done = due
    return (*mixed, *more[done:])


def unread(function: Function, block: Block | None) -> Iterable[str]:
    """Names of the inputs of which no entry is read."""
    read = block.symbols if block else frozenset()
    for argument in function.inputs:
        if read.isdisjoint(f"{argument.name}[{i}]" for i in range(argument.shape[0])):
            yield argument.name


def number_lines(numbers: Sequence[int]) -> list[str]:
    """The numbers of a C table, in lines of readable length."""
    return name_lines([str(number) for number in numbers])


def name_lines(names: Sequence[str]) -> list[str]:
    """Words of a C table or enum, in lines of readable length."""
    return textwrap.wrap(
        ", ".join(names), _WIDTH - 4, break_long_words=False, break_on_hyphens=False
    )
