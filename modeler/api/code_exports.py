"""A robot or a model for programs that compute with its equations: CasADi, FMU."""

import dataclasses
import io
import platform
import sys
import zipfile
from collections.abc import Iterator, Mapping

from modeler.api.workflow import emitted_anew
from modeler.codegen import Derivation, derive, generate
from modeler.core.errors import BuildError, DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation import IdentifiedModel, model_file
from modeler.exports import Exported, Value
from modeler.robot import Robot
from modeler.runtime import portable_library

OF_EQUATIONS = ("casadi", "fmu", "simulink")
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

    derivation, fitted = _derivation(thing), isinstance(thing, IdentifiedModel)
    values = tuple(_values(thing.spec, thing)) if fitted else ()
    data, functions, missing = casadi_file(
        derivation.model, derivation.base, [value.now for value in values] if fitted else None
    )
    notes = ("casadi.FileDeserializer(FILE).unpack() gives the list of functions", *missing)
    name = derivation.robot.name
    return Exported(name, "casadi", "", data, values, (), 0.0, notes, functions)


def _fmu(thing: Robot | IdentifiedModel) -> Exported:
    """FMI 3.0 with its sources, and a binary for this kind of machine."""
    from modeler.codegen import Control, fmu_files  # jinja2

    derivation = _derivation(thing)
    emitted = generate(derivation, control=Control())
    spec = emitted.spec
    values = tuple(_values(spec, thing if isinstance(thing, IdentifiedModel) else None))
    home = (0.0,) * len(spec.joints)
    widths: tuple[str, ...] = ()
    texts = fmu_files(emitted, widths, home, [value.now for value in values])
    files, notes = {name: text.encode() for name, text in texts.items()}, list[str]()
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


def _archive(files: Mapping[str, bytes]) -> bytes:
    """The same bytes for the same files."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return out.getvalue()


def _values(spec: ModuleSpec, model: IdentifiedModel | None) -> Iterator[Value]:
    """The base parameters of a model, beside those that the robot file states, or the latter.

    Raises:
        DataError: a robot whose file does not state them.
    """
    standard = {parameter.name: parameter for parameter in spec.standard}
    known = [None] * len(spec.base) if model is None else model_file.fitted_spec(model).parameters
    for base, fitted in zip(spec.base, known, strict=True):
        unknown = [t.parameter for t in base.terms if standard[t.parameter].nominal is None]
        was = None
        if not unknown:
            was = sum(t.value * (standard[t.parameter].nominal or 0.0) for t in base.terms)
        elif fitted is None:
            raise DataError(
                f"{spec.robot}: the robot file states no value of {', '.join(unknown)}, which "
                f"{base.name} needs; fit the robot and export the model, or state it in "
                "[parameters]"
            )
        now, sigma = (was or 0.0, None) if fitted is None else (fitted.value, fitted.sigma)
        joint = standard[base.column_of].joint
        yield Value(joint, base.name, base.unit, was, now, sigma, was != now)
