"""A robot or a model for programs that compute with its equations: CasADi, FMU, ROS 2."""

import dataclasses
import io
import platform
import sys
import zipfile
from collections.abc import Mapping

from modeler.api.workflow import emitted_anew
from modeler.codegen import Derivation, derive, generate
from modeler.core.errors import BuildError, DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation import IdentifiedModel, model_file
from modeler.exports import Exported, Value
from modeler.robot import Robot
from modeler.runtime import portable_library

OF_EQUATIONS = ("casadi", "fmu", "simulink", "ros2")
"""Formats that are made of the equations."""

_BINARIES = {"linux": ("linux", "so"), "darwin": ("darwin", "dylib"), "win32": ("windows", "dll")}
_PROCESSORS = {"amd64": "x86_64", "arm64": "aarch64"}


def code_exported(thing: Robot | IdentifiedModel, to: str) -> Exported:
    """The file, and what it holds.

    Args:
        thing: a robot, or a model.
        to: one of `OF_EQUATIONS`.

    Raises:
        DataError: what the format cannot hold.
    """
    if to == "casadi":
        return _casadi(thing)
    if to == "ros2":
        return _ros2(thing)
    found = _fmu(thing)
    if to == "simulink":
        note = "Simulink imports FMUs: put this one into its block FMU"
        found = dataclasses.replace(found, notes=(note, *found.notes))
    return found


def _derivation(thing: Robot | IdentifiedModel) -> Derivation:
    return emitted_anew(thing)[0] if isinstance(thing, IdentifiedModel) else derive(thing)


def _casadi(thing: Robot | IdentifiedModel) -> Exported:
    """Functions of q, qd, qdd and beta; of a model with its values in place of beta."""
    from modeler.codegen import casadi_file  # slow to load

    derivation = _derivation(thing)
    values = _values(thing.spec, thing)[0] if isinstance(thing, IdentifiedModel) else ()
    data, functions, missing = casadi_file(
        derivation.model, derivation.base, [value.now for value in values] or None
    )
    notes = ("casadi.FileDeserializer(FILE).unpack() gives the list of functions", *missing)
    name = derivation.robot.name
    return Exported(name, "casadi", "", data, values, (), 0.0, notes, functions)


def _fmu(thing: Robot | IdentifiedModel) -> Exported:
    """FMI 3.0 with its sources, and a binary for this kind of machine."""
    from modeler.codegen import Control, fmu_files, fmu_roles  # jinja2

    derivation = _derivation(thing)
    roles = fmu_roles(derivation.model, derivation.base)
    emitted = generate(derivation, control=Control(only=roles))
    spec = emitted.spec
    values, told = _values(spec, thing if isinstance(thing, IdentifiedModel) else None)
    beta = [value.now for value in values]
    texts = fmu_files(emitted, derivation.model, derivation.base, beta)
    files, notes = {name: text.encode() for name, text in texts.items()}, [*told]
    system, ending = _BINARIES.get(sys.platform, (sys.platform, "so"))
    machine = platform.machine().lower()
    place = f"binaries/{_PROCESSORS.get(machine, machine)}-{system}/{spec.prefix}.{ending}"
    sources = {name.removeprefix("sources/"): text for name, text in texts.items()}
    try:
        files[place] = portable_library(
            {n: t for n, t in sources.items() if n.endswith((".c", ".h"))}
        )
        notes.append(f"{place}; other machines compile sources/, as buildDescription.xml says")
    except BuildError as error:
        notes.append(f"sources only, for nothing could be compiled here: {error}")
    return Exported(spec.robot, "fmu", "", _archive(files), values, (), 0.0, tuple(notes))


def _ros2(thing: Robot | IdentifiedModel) -> Exported:
    """A package with a chainable controller."""
    from modeler.codegen import Control, ros2_files  # jinja2

    emitted = generate(_derivation(thing), control=Control(only=("inverse_dynamics", "friction")))
    fitted = thing if isinstance(thing, IdentifiedModel) else None
    values, told = _values(emitted.spec, fitted)
    source = (
        "Values of the robot file" if fitted is None else f"Values of a fit, {fitted.fit.method}"
    )
    texts = ros2_files(emitted, [value.now for value in values], source)
    files = {name: text.encode() for name, text in texts.items()}
    notes = ("the ROS part was never built or run with ROS; see README.md of the package", *told)
    name = emitted.spec.robot
    return Exported(name, "ros2", "", b"", values, (), 0.0, notes, files=files)


def _archive(files: Mapping[str, bytes]) -> bytes:
    """The same bytes for the same files."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return out.getvalue()


def _values(
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
    known = [None] * len(spec.base) if model is None else model_file.fitted_spec(model).parameters
    found, unknown = list[Value](), dict[str, None]()
    for base, fitted in zip(spec.base, known, strict=True):
        missing = [term.parameter for term in base.terms if term.parameter not in stated]
        was = sum(term.value * stated.get(term.parameter, 0.0) for term in base.terms)
        unknown |= dict.fromkeys(missing)
        now, sigma = (was, None) if fitted is None else (fitted.value, fitted.sigma)
        before, joint = None if missing else was, standard[base.column_of].joint
        found.append(Value(joint, base.name, base.unit, before, now, sigma, before != now))
    note = f"not stated in the robot file, so 0 here: {', '.join(unknown)}"
    return tuple(found), (note,) * bool(unknown and model is None)
