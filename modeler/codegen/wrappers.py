"""Packages around the emitted C: a Functional Mock-up Unit, a controller for ROS 2."""

import re
from collections import Counter
from collections.abc import Sequence
from xml.sax.saxutils import escape

from modeler.codegen.control import SMOOTH, build_efforts, list_turning_joints
from modeler.codegen.functions import format_comment, format_grouping_relation, make_beta_symbols
from modeler.codegen.package import format_package_version, render
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.errors import EmitError
from modeler.core.files import locate_resources
from modeler.core.manifest import EmittedModule, ModuleSpec, digest_text
from modeler.derivation import BaseParameters, SymbolicModel

HEADERS = ("fmi3Functions.h", "fmi3FunctionTypes.h", "fmi3PlatformTypes.h")
"""Of FMI 3.0, as they were published; see templates/fmi3."""


_BASE = {
    "kg": "kg",
    "m": "m",
    "s": "s",
    "A": "A",
    "K": "K",
    "rad": "rad",
    "N": "kg m s-2",
    "J": "kg m2 s-2",
    "W": "kg m2 s-3",
    "V": "kg m2 s-3 A-1",
    "1": "",
}
"""Units as products of those that FMI knows."""


def find_fmu_roles(model: SymbolicModel, base: BaseParameters) -> tuple[str, ...]:
    """Returns the functions of the C that an FMU calls.

    Raises:
        EmitError: dry friction in loops; effects that read accelerations.
    """
    rubbing, name = list_turning_joints(model, base), model.robot.name
    if model.closure is not None and rubbing:
        raise EmitError(
            f"{name} has loops, and dry friction of joints {', '.join(rubbing)}, which leaps in C, "
            "as an FMU must not; leave coulomb out of [effects]"
        )
    if build_efforts(model, make_beta_symbols(model, base)).is_implicit:
        raise EmitError(
            f"{name}: its effects read accelerations, as load friction does, which the FMU does "
            "not solve for; leave them out of [effects]"
        )
    if model.closure is not None:
        return ("forward_dynamics",)
    return "inertia_matrix", f"{SMOOTH if rubbing else ''}inverse_dynamics"


def build_fmu_files(
    emitted: EmittedModule, model: SymbolicModel, base: BaseParameters, beta: Sequence[float]
) -> dict[str, str]:
    """Returns {place in the unit: text} of all but the binary.

    Args:
        emitted: the functions of `fmu_roles`.
        model: as derived.
        base: the base parameters of the same model.
        beta: their values at the start.

    Raises:
        EmitError: effects that read signals, which nothing gives here.
    """
    spec = emitted.spec
    if spec.signals:
        raise EmitError(
            f"{spec.robot}: its effects read {spec.signals[0].kind}, which an FMU is not given; "
            "leave them out of [effects]"
        )
    roles = find_fmu_roles(model, base)
    inputs = {f.name.removeprefix(f"{spec.prefix}_"): f.inputs for f in spec.every_function}
    closure = model.closure
    home = [closure.home[k] for k in closure.actuated] if closure else [0.0] * len(spec.joints)
    widths = list_turning_joints(model, base)
    variables = _list_variables(spec, base, widths, home, beta)
    code = {name: emitted.files[name] for name in spec.controller_sources}
    token = digest_text("".join(code.values()) + repr(variables))
    n = len(spec.joints)
    values = {
        "name": escape(spec.robot),
        "title": escape(spec.title or spec.robot, {'"': "&quot;"}),
        "prefix": spec.prefix,
        "token": f"{{{token}}}",
        "step": THRESHOLDS.max_fmu_step,
        "width": THRESHOLDS.fmu_friction_width,
        "joints": n,
        "widths": len(widths),
        "beta": beta,
        "home": _format_lines(home),
        "beta_lines": _format_lines(beta),
        "roles": roles,
        "reads": [argument.name for argument in inputs[roles[-1]]],
        "control": f"{spec.prefix}_control.h" in code,
    }
    code["fmu_model.h"] = render("fmu_model.h", **values)
    code["modeler_fmu.c"] = (locate_resources("csrc") / "fmu" / "modeler_fmu.c").read_text("utf-8")
    vendored = locate_resources("templates") / "fmi3"
    code |= {name: (vendored / name).read_text("utf-8") for name in HEADERS}
    values["sources"] = sorted(name for name in code if name.endswith(".c"))
    description_values = {
        **values,
        "units": {each["unit"]: _parse_unit_powers(each["unit"]) for each in variables},
        "variables": variables,
        "outputs": [*range(2, 2 + 2 * n), *range(2 + 3 * n, 2 + 4 * n)],
        "derivatives": range(2 + 2 * n, 2 + 4 * n),
        "unknown": range(2 + 2 * n, 2 + 4 * n),
    }
    return {
        "modelDescription.xml": render("fmu_description.xml", **description_values),
        "sources/buildDescription.xml": render("fmu_build.xml", **description_values),
        **{f"sources/{name}": text for name, text in code.items()},
        "documentation/licenses/fmi3.txt": (vendored / "LICENSE").read_text("utf-8"),
    }


def _format_lines(numbers: Sequence[float]) -> list[str]:
    return [f"{float(x)!r}," for x in numbers]


def _list_variables(
    spec: ModuleSpec,
    base: BaseParameters,
    widths: Sequence[str],
    home: Sequence[float],
    beta: Sequence[float],
) -> list[dict[str, str]]:
    """Attributes of all, in the order of the array of modeler_fmu.c."""
    n, variables = len(spec.joints), list[dict[str, str]]()

    def add_variable(name: str, unit: str, about: str, causality: str, **more: object) -> None:
        changes = "tunable" if causality == "parameter" else "continuous"
        attributes = {
            "name": name,
            "valueReference": len(variables),
            "unit": _format_unit(unit),
            "variability": changes,
            "description": about,
            "causality": causality,
            **more,
        }
        quotes = {'"': "&quot;"}
        variables.append({key: escape(str(value), quotes) for key, value in attributes.items()})

    def add_parameter(name: str, unit: str, about: str, start: float) -> None:
        add_variable(name, unit, about, "parameter", initial="exact", start=start)

    add_variable("time", "s", "time", "independent")
    add_parameter("step", "s", "largest step of co-simulation", THRESHOLDS.max_fmu_step)
    for name, about, kind, per, start in (
        ("q", "position", "output", "", home),
        ("qd", "speed", "output", "/s", [0.0] * n),
        ("dq", "derivative of the position", "local", "/s", None),
        ("qdd", "acceleration", "output", "/s2", None),
        ("tau", "effort of the drive", "input", "", [0.0] * n),
    ):
        for k, joint in enumerate(spec.joints):
            more: dict[str, object] = {} if start is None else {"start": float(start[k])}
            if kind != "input":
                more["initial"] = "calculated" if start is None else "exact"
            if start is None:  # of the state of the same joint
                more["derivative"] = len(variables) - 2 * n
            unit = joint.effort_unit if name == "tau" else joint.unit + per
            add_variable(
                f"{name}{joint.name}", unit, f"{about} of joint {joint.name}", kind, **more
            )
    for known, each, value in zip(spec.base, base.parameters, beta, strict=True):
        add_parameter(known.name, known.unit, format_grouping_relation(each), float(value))
    units = {joint.name: joint.unit for joint in spec.joints}
    for name in widths:
        about = f"width over which the Coulomb friction of joint {name} turns"
        add_parameter(
            f"width{name}", f"{units.get(name, 'rad')}/s", about, THRESHOLDS.fmu_friction_width
        )
    return variables


def _format_unit(unit: str) -> str:
    """`N m s/rad` as FMI writes it: `N.m.s/rad`."""
    return unit.replace(" ", ".")


def _parse_unit_powers(unit: str) -> dict[str, int]:
    """Of base units, of a unit as `_name` gives it; empty where one is not known."""
    powers: Counter[str] = Counter()
    over, *under = unit.split("/")
    for text, sign in [(over, 1), *((part, -1) for part in under)]:
        for word in text.split("."):
            match = re.fullmatch(r"([A-Za-z]+|1)(\d*)", word)
            if match is None or match[1] not in _BASE:
                return {}
            for base in _BASE[match[1]].split():
                letters, power = re.fullmatch(r"([A-Za-z]+)(-?\d*)", base).groups()  # type: ignore[union-attr]
                powers[letters] += sign * int(match[2] or 1) * int(power or 1)
    return {name: power for name, power in powers.items() if power}


# A package for ROS 2: computed torque with the emitted C as a chainable controller.


_PLACES = {
    "package.xml": "",
    "CMakeLists.txt": "",
    "plugin.xml": "",
    "README.md": "",
    "controller.yaml": "config/",
    "computed_torque.hpp": "src/",
    "controller.hpp": "src/",
    "controller.cpp": "src/",
}
"""{template of templates/ros2: where it goes}."""


def build_ros2_files(emitted: EmittedModule, beta: Sequence[float], source: str) -> dict[str, str]:
    """Returns {place in the package: text}.

    Args:
        emitted: the module.
        beta: its base parameters.
        source: where they are from, one phrase.

    Raises:
        EmitError: effects that read signals, which no hardware interface gives.
    """
    spec = emitted.spec
    if spec.signals:
        raise EmitError(
            f"{spec.robot}: its effects read {spec.signals[0].kind}, which a controller of "
            "ros2_control is not given; leave them out of [effects]"
        )
    roles = {f.name.removeprefix(f"{spec.prefix}_"): f for f in spec.functions}
    status = roles["inverse_dynamics"].status
    calls: list[str] = []
    called = (("inverse_dynamics", "tau", "qd"), ("friction", "f", "qd"))
    for role, out, speed in (*called, ("friction", "f_d", "wanted.qd")):
        c_names = {"q": "q", "qd": speed, "qdd": "v", "beta": "beta"}
        words = [f"{c_names[argument.name]}.data()" for argument in roles[role].inputs]
        call = f"{roles[role].name}({', '.join(words)}, {out}.data())"
        if status:
            call = f"status = status != 0 ? status : {call}" if calls else f"int status = {call}"
        calls.append(f"{call};")
    names = [joint.name for joint in spec.joints]
    title = spec.title or spec.robot
    code = {name: emitted.files[name] for name in spec.controller_sources}
    values = {
        "title": format_comment(title),
        "xml_title": escape(title),
        "name": spec.robot,
        "prefix": spec.prefix,
        "macro": spec.prefix.upper(),
        "calls": calls,
        "status": status,
        "package": re.sub("_+", "_", f"{spec.prefix}_computed_torque"),
        "names": names,
        "version": ".".join(format_package_version(spec.compute_signature()).split(".")[:3]),
        "source": source,
        "beta": [
            f"{float(x)!r},  /* {base.name}, {base.unit} */"
            for base, x in zip(spec.base, beta, strict=True)
        ],
        "effort": " or ".join(dict.fromkeys(joint.effort_unit for joint in spec.joints)),
        "kp": ", ".join([f"{THRESHOLDS.controller_bandwidth**2:.1f}"] * len(names)),
        "kd": ", ".join([f"{2 * THRESHOLDS.controller_bandwidth:.1f}"] * len(names)),
        "sources": sorted(name for name in code if name.endswith(".c")),
    }
    files = {f"{place}{name}": render(f"ros2/{name}", **values) for name, place in _PLACES.items()}
    return files | {f"src/{name}": text for name, text in code.items()}
