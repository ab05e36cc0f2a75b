"""The README of an emitted folder: every file, every function, what the robot at hand needs."""

import pytest

from modeler.codegen.package import format_package_version
from tests.codegen.fitted_library import with_values
from tests.modules import module

EMITTED = {
    "wrist": lambda: module("wrist").emitted,
    "slow-arm": lambda: with_values("slow-arm"),
    "five-bar": lambda: with_values("five-bar"),
}


@pytest.mark.parametrize("name", EMITTED)
def test_it_says_what_every_file_is_what_functions_cost_and_what_they_need(name):
    emitted = EMITTED[name]()
    text, spec = emitted.files["README.md"], emitted.spec
    for file in emitted.files.keys() - {"README.md"}:
        assert f"`{file}`" in text, file
    for function in (*spec.functions, *(spec.fitted.functions if spec.fitted else ())):
        row = f"| `{function.name}` | {function.additions} | {function.multiplications} |"
        assert row in text, function.name
    signature = spec.fitted.signature if spec.fitted else spec.compute_signature()
    assert signature in text and format_package_version(signature) in text
    assert ("## Status" in text) == ("turn of Newton" in text) == (spec.closure is not None)
    assert ("## s\n" in text) == bool(spec.signals)
    assert all(f"of joint {signal.joint}" in text for signal in spec.signals)
    call = "_fitted_inverse_dynamics(q, qd, v" if spec.fitted else "_inverse_dynamics(q, qd, v"
    assert call in text
    assert ("programs/example_computed_torque.c" in emitted.files) == (spec.fitted is not None)
