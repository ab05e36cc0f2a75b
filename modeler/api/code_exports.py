"""A robot or a model for programs that compute with its equations: CasADi, FMU, ROS 2."""

import dataclasses
import io
import platform
import sys
import zipfile
from collections.abc import Mapping

from modeler.api.workflow import emit_model
from modeler.codegen import Derivation, derive, generate
from modeler.core.errors import BuildError, DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation import IdentifiedModel, model_file
from modeler.exports import Exported, Value
from modeler.robot import Robot
from modeler.runtime import build_portable_library

OF_EQUATIONS = ("casadi", "fmu", "simulink", "ros2")
"""Formats that are made of the equations."""

_BINARIES = {"linux": ("linux", "so"), "darwin": ("darwin", "dylib"), "win32": ("windows", "dll")}
_PROCESSORS = {"amd64": "x86_64", "arm64": "aarch64"}


def export_code(thing: Robot | IdentifiedModel, to: str) -> Exported:
    """Exports a robot or a model to a format that is made of its equations.

    Args:
        thing: a robot, or a model.
        to: one of `OF_EQUATIONS`.

    Raises:
        DataError: what the format cannot hold.
    """
    if to == "casadi":
        return _export_casadi(thing)
    if to == "ros2":
        return _export_ros2(thing)
    exported = _export_fmu(thing)
    if to == "simulink":
        note = "Simulink imports FMUs: put this one into its block FMU"
        exported = dataclasses.replace(exported, notes=(note, *exported.notes))
    return exported


def _derive_model(thing: Robot | IdentifiedModel) -> Derivation:
    return emit_model(thing)[0] if isinstance(thing, IdentifiedModel) else derive(thing)


def _export_casadi(thing: Robot | IdentifiedModel) -> Exported:
    """Functions of q, qd, qdd and beta; of a model with its values in place of beta."""
    from modeler.codegen import write_casadi  # slow to load

    derivation = _derive_model(thing)
    values = _collect_values(thing.spec, thing)[0] if isinstance(thing, IdentifiedModel) else ()
    data, functions, missing = write_casadi(
        derivation.model, derivation.base, [value.now for value in values] or None
    )
    notes = ("casadi.FileDeserializer(FILE).unpack() gives the list of functions", *missing)
    name = derivation.robot.name
    return Exported(name, "casadi", "", data, values, (), 0.0, notes, functions)


def _export_fmu(thing: Robot | IdentifiedModel) -> Exported:
    """FMI 3.0 with its sources, and a binary for this kind of machine."""
    from modeler.codegen import Control, build_fmu_files, find_fmu_roles  # jinja2

    derivation = _derive_model(thing)
    roles = find_fmu_roles(derivation.model, derivation.base)
    emitted = generate(derivation, control=Control(only=roles))
    spec = emitted.spec
    values, value_notes = _collect_values(
        spec, thing if isinstance(thing, IdentifiedModel) else None
    )
    beta = [value.now for value in values]
    texts = build_fmu_files(emitted, derivation.model, derivation.base, beta)
    files, notes = {name: text.encode() for name, text in texts.items()}, [*value_notes]
    system, ending = _BINARIES.get(sys.platform, (sys.platform, "so"))
    machine = platform.machine().lower()
    place = f"binaries/{_PROCESSORS.get(machine, machine)}-{system}/{spec.prefix}.{ending}"
    sources = {name.removeprefix("sources/"): text for name, text in texts.items()}
    try:
        files[place] = build_portable_library(
            {n: t for n, t in sources.items() if n.endswith((".c", ".h"))}
        )
        notes.append(f"{place}; other machines compile sources/, as buildDescription.xml says")
    except BuildError as error:
        notes.append(f"sources only, for nothing could be compiled here: {error}")
    return Exported(spec.robot, "fmu", "", _pack_files(files), values, (), 0.0, tuple(notes))


def _export_ros2(thing: Robot | IdentifiedModel) -> Exported:
    """A package with a chainable controller."""
    from modeler.codegen import Control, build_ros2_files  # jinja2

    emitted = generate(_derive_model(thing), control=Control(only=("inverse_dynamics", "friction")))
    fitted = thing if isinstance(thing, IdentifiedModel) else None
    values, value_notes = _collect_values(emitted.spec, fitted)
    source = (
        "Values of the robot file" if fitted is None else f"Values of a fit, {fitted.fit.method}"
    )
    texts = build_ros2_files(emitted, [value.now for value in values], source)
    files = {name: text.encode() for name, text in texts.items()}
    notes = (
        "the ROS part was never built or run with ROS; see README.md of the package",
        *value_notes,
    )
    name = emitted.spec.robot
    return Exported(name, "ros2", "", b"", values, (), 0.0, notes, files=files)


def _pack_files(files: Mapping[str, bytes]) -> bytes:
    """The same bytes for the same files."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return out.getvalue()


def _collect_values(
    spec: ModuleSpec, model: IdentifiedModel | None
) -> tuple[tuple[Value, ...], tuple[str, ...]]:
    """The base parameters of a model, or those that the robot file states; what it does not.

    Raises:
        DataError: a robot whose file states none.
    """
    standard = {parameter.name: parameter for parameter in spec.standard}
    stated = {name: p.nominal for name, p in standard.items() if p.nominal is not None}
    if model is None and not stated:
        raise DataError(
            f"{spec.robot}: a robot without values; write [parameters] into its file, or export a "
            "model of `modeler fit`"
        )
    known = (
        [None] * len(spec.base) if model is None else model_file.build_fitted_spec(model).parameters
    )
    values, unknown = list[Value](), dict[str, None]()
    for base, fitted in zip(spec.base, known, strict=True):
        missing = [term.parameter for term in base.terms if term.parameter not in stated]
        stated_value = sum(term.value * stated.get(term.parameter, 0.0) for term in base.terms)
        unknown |= dict.fromkeys(missing)
        value, sigma = (stated_value, None) if fitted is None else (fitted.value, fitted.sigma)
        before, joint = None if missing else stated_value, standard[base.column_of].joint
        values.append(Value(joint, base.name, base.unit, before, value, sigma, before != value))
    note = f"not stated in the robot file, so 0 here: {', '.join(unknown)}"
    return tuple(values), (note,) * bool(unknown and model is None)
