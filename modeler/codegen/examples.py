"""The example programs of a fitted module: which there are, and their calls as finished strings."""

from collections.abc import Mapping
from typing import Any

from modeler.core.manifest import FunctionSpec, ModuleSpec

FOLDER = "programs"
"""Of a module's folder, so that all C files beside the library's are the library's."""

EXAMPLES = ("example_computed_torque", "example_residual_observer")
"""Templates, and names of the programs."""

SELF_CHECK = "self_check"
COUNT = "count_instructions"
PROGRAMS = (SELF_CHECK, COUNT, *EXAMPLES)
"""All programs that a module may have."""


def examples_of(spec: ModuleSpec) -> tuple[str, ...]:
    """Those of a module: none without values, nor where a joint of q has no motor to obey."""
    every = all(joint.actuated for joint in spec.joints)
    return EXAMPLES if spec.fitted is not None and every else ()


def count_values(spec: ModuleSpec) -> dict[str, Any] | None:
    """What the template of the program that counts instructions needs besides.

    None of a robot with loops: how many turns of Newton close them depends on the posture.
    """
    if spec.closure is not None:
        return None
    functions = (*spec.functions, *(spec.fitted.functions if spec.fitted else ()))
    counted = [
        {
            "name": function.name,
            "role": function.name.removeprefix(f"{spec.prefix}_"),
            "inputs": [argument.name for argument in function.inputs],
        }
        for function in functions
    ]
    return {
        "states": 16,
        "largest": max(f.outputs[0].size for f in functions),
        "counted": counted,
        "counts_of_inputs": sorted({len(function.inputs) for function in functions}),
    }


def example_values(spec: ModuleSpec, name: str) -> dict[str, Any]:
    """What the template of an example needs besides the values of all templates."""
    assert spec.fitted is not None
    roles = {f.name.removeprefix(f"{spec.prefix}_fitted_"): f for f in spec.fitted.functions}
    measured = [k for k, signal in enumerate(spec.signals) if signal.kind == "temperature"]
    return {
        "temperatures": measured,
        **(_torque(roles, measured) if name == EXAMPLES[0] else _observer(roles, measured)),
    }


def _torque(roles: Mapping[str, FunctionSpec], measured: list[int]) -> dict[str, Any]:
    now = {"q": "now->q", "qd": "now->qd", "qdd": "v", "s": "own->s"}
    commanded = {**now, "qd": "now->qd_d"}
    return {
        "line": _line("q, qd, commanded q, qd, qdd", measured),
        "torque": call_head(roles["inverse_dynamics"], now),
        "friction": call_head(roles["friction"], now),
        "friction_d": call_head(roles["friction"], commanded),
    }


def _observer(roles: Mapping[str, FunctionSpec], measured: list[int]) -> dict[str, Any]:
    now = {"qdd": "a", "s": "own->s"}
    reads = {argument.name for argument in roles["friction"].inputs}
    return {
        "line": _line("q, qd, tau", measured),
        "matrix": call_head(roles["inertia_matrix"], now),
        "gravity": call_head(roles["gravity"], now),
        "friction": call_head(roles["friction"], now),
        "coriolis_ahead": call_head(roles["coriolis"], {**now, "qd": "ahead"}),
        "coriolis_behind": call_head(roles["coriolis"], {**now, "qd": "behind"}),
        "friction_reads_acceleration": "qdd" in reads,
        "uses_own": "s" in reads,
    }


def _line(numbers: str, measured: list[int]) -> str:
    return f"{numbers}, temperatures" if measured else numbers


def call_head(function: FunctionSpec, named: Mapping[str, str] | None = None) -> str:
    """The call up to its output: `wrist_gravity(q, beta`.

    Args:
        function: that is called.
        named: {argument: C text that stands for it}; others are called as they are named.
    """
    given = ((named or {}).get(argument.name, argument.name) for argument in function.inputs)
    return f"{function.name}({', '.join(given)}"
