"""Reference of the commands, from their parsers: what `--help` says, as pages."""

import argparse

from docsite.markdown import block, cell, code, table
from modeler.cli.parser import build_parser, collect_command_parsers, read_families
from modeler.core.choices import ABOUT


def command_pages() -> dict[str, str]:
    """{"commands/derive.md": text} of every command, and an index of them."""
    parsers = commands()
    pages = {f"commands/{name}.md": _page(name, item) for name, item in parsers.items()}
    return {"commands/index.md": _index(parsers), **pages}


def commands() -> dict[str, argparse.ArgumentParser]:
    """{name: parser} in the order of `modeler --help`."""
    return collect_command_parsers(build_parser())


def _subparsers(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            return dict(action.choices)
    return {}


def _summaries() -> dict[str, str]:
    """{name: the line of `modeler --help`}."""
    action = next(a for a in build_parser()._actions if isinstance(a, argparse._SubParsersAction))
    return {choice.dest: choice.help or "" for choice in action._choices_actions}


def _index(parsers: dict[str, argparse.ArgumentParser]) -> str:
    text = _summaries()
    parts = [f"# Commands\n\n{cell(build_parser().description or '')}\n"]
    for family, members in read_families().items():
        rows = [
            (f"[`modeler {name}`]({name}.md)", cell(text[name]), code(_example(parsers[name])))
            for name in members
        ]
        parts += [f"## {family.capitalize()}\n", table(("command", "does", "example"), rows)]
    return "\n".join(parts)


def _page(name: str, parser: argparse.ArgumentParser) -> str:
    parts = [f"# modeler {name}", "", cell(parser.description or ""), ""]
    if example := _example(parser):
        parts += ["Example:", "", block(example, "sh")]
    parts += _arguments(parser)
    for inner, child in _subparsers(parser).items():
        parts += [f"## modeler {name} {inner}", "", cell(child.description or ""), ""]
        parts += [block(_example(child), "sh"), *_arguments(child)]
    if name == "estimators":
        parts += ["## All of them", "", estimators()]
    return "\n".join([*parts, "## As the command prints it", "", block(_help(parser), "text")])


def estimators() -> str:
    """What the command shows, as a table."""
    head = ("method", "is", "law", "source", "do not use it", "assumes")
    lines = [(a.title, a.law, a.source, a.limitations, a.motion) for a in ABOUT.values()]
    named = zip(ABOUT, lines, strict=True)
    return table(head, [(code(id), *map(cell, words)) for id, words in named])


def _help(parser: argparse.ArgumentParser) -> str:
    """The help at 96 letters a line, wherever the site is built."""
    parser.formatter_class = lambda prog: argparse.HelpFormatter(prog, width=96)
    return parser.format_help()


def _example(parser: argparse.ArgumentParser) -> str:
    return (parser.epilog or "").removeprefix("example:").removeprefix("examples:").strip()


def _arguments(parser: argparse.ArgumentParser) -> list[str]:
    """A table of each group of arguments."""
    parts = []
    for group in parser._action_groups:
        rows = [_row(parser, action) for action in group._group_actions if _told(action)]
        if rows:
            title = (group.title or "arguments").capitalize()
            parts += [f"## {title}", "", table(("argument", "meaning"), rows)]
    return parts


def _told(action: argparse.Action) -> bool:
    return action.help != argparse.SUPPRESS and not isinstance(action, argparse._SubParsersAction)


def _row(parser: argparse.ArgumentParser, action: argparse.Action) -> tuple[str, str]:
    names = action.option_strings or [_value(action)]
    value = _value(action) if action.option_strings and action.nargs != 0 else ""
    text = parser._get_formatter()._expand_help(action) if action.help else ""
    return ", ".join(code(f"{name} {value}".strip()) for name in names), cell(text)


def _value(action: argparse.Action) -> str:
    """What stands for the value: METAVAR, {a,b}, with dots for several."""
    if action.metavar is not None:
        name = action.metavar if isinstance(action.metavar, str) else " ".join(action.metavar)
    elif action.choices is not None:
        name = "{" + ",".join(map(str, action.choices)) + "}"
    else:
        name = action.dest.upper()
    marks = {"?": f"[{name}]", "*": f"[{name} ...]", "+": f"{name} [{name} ...]"}
    return marks.get(str(action.nargs), name)
