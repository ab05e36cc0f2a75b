"""A package for ROS 2: computed torque with the emitted C as a chainable controller."""

import re
from collections.abc import Sequence
from xml.sax.saxutils import escape

from modeler.codegen.functions import format_comment
from modeler.codegen.package import format_package_version, render
from modeler.core.errors import EmitError
from modeler.core.manifest import EmittedModule

_PLACES = {
    "package.xml": "", "CMakeLists.txt": "", "plugin.xml": "", "README.md": "",
    "controller.yaml": "config/", "computed_torque.hpp": "src/", "controller.hpp": "src/",
    "controller.cpp": "src/",
}  # fmt: skip
"""{template of templates/ros2: where it goes}."""

_BANDWIDTH = 4.0 * 3.141592653589793  # rad/s


def build_ros2_files(emitted: EmittedModule, beta: Sequence[float], source: str) -> dict[str, str]:
    """{place in the package: text}.

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
    for role, out, speed in (
        ("inverse_dynamics", "tau", "qd"), ("friction", "f", "qd"),
        ("friction", "f_d", "wanted.qd"),
    ):  # fmt: skip
        c_names = {"q": "q", "qd": speed, "qdd": "v", "beta": "beta"}
        words = [f"{c_names[argument.name]}.data()" for argument in roles[role].inputs]
        call = f"{roles[role].name}({', '.join(words)}, {out}.data())"
        if status:
            call = (
                f"int status = {call}" if not calls else f"status = status != 0 ? status : {call}"
            )
        calls.append(f"{call};")
    names = [joint.name for joint in spec.joints]
    title = spec.title or spec.robot
    code = {name: emitted.files[name] for name in spec.controller_sources}
    values = {
        "title": format_comment(title), "xml_title": escape(title), "name": spec.robot,
        "prefix": spec.prefix, "macro": spec.prefix.upper(), "calls": calls, "status": status,
        "package": re.sub("_+", "_", f"{spec.prefix}_computed_torque"), "names": names,
        "version": ".".join(format_package_version(spec.compute_signature()).split(".")[:3]),
        "source": source,
        "beta": [
            f"{float(x)!r},  /* {base.name}, {base.unit} */"
            for base, x in zip(spec.base, beta, strict=True)
        ],
        "effort": " or ".join(dict.fromkeys(joint.effort_unit for joint in spec.joints)),
        "kp": ", ".join([f"{_BANDWIDTH**2:.1f}"] * len(names)),
        "kd": ", ".join([f"{2 * _BANDWIDTH:.1f}"] * len(names)),
        "sources": sorted(name for name in code if name.endswith(".c")),
    }  # fmt: skip
    return {
        **{f"{place}{name}": render(f"ros2/{name}", **values) for name, place in _PLACES.items()},
        **{f"src/{name}": text for name, text in code.items()},
    }
