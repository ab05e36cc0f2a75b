"""The examples in docstrings of what Python users are offered print what they say."""

import doctest
import importlib
import inspect

import pytest

import modeler.api as api

MODULES = sorted(
    {
        "modeler.core.table",
        *(
            thing.__module__
            for name in api.__all__
            if inspect.isfunction(thing := getattr(api, name))
        ),
    }
)


def examples(module: str) -> list[doctest.DocTest]:
    found = doctest.DocTestFinder().find(
        importlib.import_module(module), extraglobs={n: getattr(api, n) for n in api.__all__}
    )
    return [example for example in found if example.examples]


def test_there_are_examples() -> None:
    assert sum(len(example.examples) for name in MODULES for example in examples(name)) >= 8


@pytest.mark.parametrize("module", [name for name in MODULES if examples(name)])
def test_examples_print_what_they_say(module: str) -> None:
    for example in examples(module):
        said: list[str] = []
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        assert runner.run(example, out=said.append).failed == 0, "".join(said)
