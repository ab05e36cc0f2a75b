"""Structured Text: read back by a reader of its own, it gives what the C gives."""

import re

import numpy as np
import pytest

from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.codegen.printers import make_identifier
from modeler.core.errors import EmitError
from tests.codegen.fitted_library import Functions, fitted_of, motion, robot_module
from tests.codegen.structured_text import Program, TextError
from tests.modules import module
from tests.rotation import ROTATING, rotating, with_cases

ROLES = ("inverse_dynamics", "inertia_matrix", "gravity", "coriolis", "friction")


def made_of(name: str, fitted: bool):
    made = robot_module(name)
    values = fitted_of(made.emitted.spec, seed=int(np.random.default_rng().integers(1000)))
    control = Control(structured_text=True)
    return emit(made.model, made.base, values if fitted else None, control=control)


def distance(program: Program, functions: Functions, role: str, state, **widths: float) -> float:
    """How far what the function block of that role writes is from the C, over its size."""
    expected, block = functions(role, state), make_identifier(f"{functions.spec.prefix}_{role}")
    expected = expected.reshape(len(expected), -1)
    written = np.full_like(expected, np.nan)
    for i, row in enumerate(written):
        output = {functions.output(role): row}
        for a in functions.inputs(role):
            array = state[a.name] if state[a.name].ndim == 1 else state[a.name][i]
            output["signals" if a.name == "s" else a.name] = [*map(float, array)]
        program(block, **output, **widths)
    return float(np.abs(written - expected).max() / max(1.0, np.abs(expected).max()))


@pytest.mark.parametrize("name", ["slow-arm", *rotating("ur10e", "sr400-tree")])
def test_the_text_read_back_gives_what_the_c_gives(name: str) -> None:
    emitted = made_of(name, fitted=False)
    program, functions = Program(emitted.files[f"{emitted.spec.prefix}.st"]), Functions(emitted)
    values = motion(name, samples=4, seed=int(np.random.default_rng().integers(1000)))
    values["beta"] = np.random.default_rng().normal(size=len(emitted.spec.base))
    values["chi"] = np.random.default_rng().normal(size=len(emitted.spec.standard))
    for role in (*ROLES, "base_parameters"):
        assert distance(program, functions, role, values) <= 1e-12, role


@pytest.mark.parametrize("name", [pytest.param("two-link", marks=pytest.mark.rotating), "slow-arm"])
def test_values_and_widths_are_those_of_the_fitted_c(name: str) -> None:
    emitted = made_of(name, fitted=True)
    text = emitted.files[f"{emitted.spec.prefix}.st"]
    program, inputs = Program(text), motion(name, samples=3)
    assert "Values of a test." in text and emitted.spec.fitted.signature in text
    for width in (0.0, 0.3):
        functions = Functions(emitted, **({"COULOMB_WIDTH": width} if width else {}))
        for role in (f"fitted_{role}" for role in ROLES):
            unit = program.units[make_identifier(f"{emitted.spec.prefix}_{role}")]
            widths = {n: width for n, kind in unit.kinds.items() if kind == "var_input"}
            assert bool(widths) == (role in ("fitted_friction", "fitted_inverse_dynamics"))
            assert distance(program, functions, role, inputs, **widths) <= 1e-12, role


def test_nothing_is_kept_between_calls_and_each_function_is_declared_once() -> None:
    text = made_of("scara", fitted=False).files["scara.st"]
    assert len(re.findall(r"^FUNCTION_BLOCK", text, re.M)) == 6
    assert not re.search(r"^VAR$", text.split("FUNCTION_BLOCK", 1)[1], re.M)  # VAR_TEMP alone
    assert max(map(len, text.splitlines())) <= 100 and text.isascii()


@with_cases(
    "name",
    pytest.param("emps", marks=pytest.mark.rotating("readers of standards")),
    *(pytest.param(n, marks=ROTATING) for n in ("two-link", "slow-arm")),
)
def test_another_parser_of_the_standard_reads_it(name: str) -> None:
    blark = pytest.importorskip("blark.parse", reason="blark reads Structured Text: pip install it")
    emitted = made_of(name, fitted=True)
    read = blark.parse_source_code(emitted.files[f"{emitted.spec.prefix}.st"])
    assert read.exception is None and read.tree is not None
    wrong = blark.parse_source_code("FUNCTION_BLOCK a VAR x : ; END_VAR END_FUNCTION_BLOCK")
    assert "No terminal" in str(wrong.exception)


def test_the_reader_refuses_what_is_not_of_the_standard() -> None:
    head = "FUNCTION_BLOCK f\nVAR_IN_OUT\n q : ARRAY [0..1] OF LREAL;\nEND_VAR\n{}\n"
    head += "END_FUNCTION_BLOCK"
    Program(head.format("q[1] := q[0];"))
    for wrong in (
        "q[2] := 1.0;",
        "q[0] := r;",
        "q[0] := 1e5;",
        "q[0] = 1.0;",
        "if := 1.0;",
        "a__b := 1.0;",
        "q[0] := tanh(q[1]);",
    ):
        with pytest.raises(TextError):
            Program(head.format(wrong))


def test_loops_and_single_precision_have_none() -> None:
    loop, arm = module("five-bar"), module("wrist")
    with pytest.raises(EmitError, match=r"five-bar has loops.*leave --structured-text out"):
        emit(loop.model, loop.base, control=Control(structured_text=True))
    with pytest.raises(EmitError, match=r"LREAL.*leave out one of the two"):
        emit(arm.model, arm.base, precision="single", control=Control(structured_text=True))


def test_names_are_of_the_standard() -> None:
    assert make_identifier("a__b_") == "a_b" and make_identifier("geo_L1") == "geo_L1"
