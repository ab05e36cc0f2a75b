"""Options are declared once: Python and the command line know the same, and refuse them alike."""

from dataclasses import fields

import pytest

from modeler.cli import build_parser
from modeler.cli.parser import collect_command_parsers, read_commands
from modeler.core import options
from modeler.core.options import AddOptions, CompareOptions, OptionError, check_together
from tests.cli.running import refusal

DECLARED = {
    name: getattr(options, command["options"])
    for name, command in read_commands().items()
    if "options" in command
}


@pytest.mark.parametrize("command", DECLARED)
def test_every_field_is_an_option_with_the_same_default(command: str) -> None:
    actions = {a.dest: a for a in collect_command_parsers(build_parser())[command]._actions}
    for field in fields(DECLARED[command]):
        default = actions[field.name].default
        assert (tuple(default) if isinstance(default, list) else default) == field.default
        assert actions[field.name].help


def test_a_message_names_options_as_its_skin_writes_them() -> None:
    error = OptionError("{--payload_mass} of {j}: got 0")
    assert str(error) == "payload_mass of {j}: got 0"
    assert error.format_line(lambda name: f"<{name}>") == "<payload_mass> of {j}: got 0"


def test_options_that_need_others_are_refused_alike(capsys) -> None:
    with pytest.raises(
        OptionError, match=r"^window: needs free_run; give both, or leave window out"
    ):
        CompareOptions(window=2.0)
    told = refusal(capsys, "compare", "m.json", "a.csv", "--window", "2")
    assert "modeler: --window: needs --free-run; give both, or leave --window out" in told


def test_what_is_empty_or_false_is_not_given() -> None:
    rules = [("a", ["b or c"], ["d"])]
    for values in ({"a": None}, {"a": False}, {"a": []}, {"a": 0, "c": 0}):
        check_together(values, rules)
    with pytest.raises(OptionError, match=r"^a: needs b or c; give both"):
        check_together({"a": 0, "d": 1}, rules)
    with pytest.raises(OptionError, match=r"^d: got it with a; leave one of them out"):
        check_together({"a": 0, "b": True, "d": 1}, rules)


def test_lists_of_the_command_line_are_tuples() -> None:
    assert AddOptions.from_names({"of": ["q", "v"], "else": 1}) == AddOptions(of=("q", "v"))
