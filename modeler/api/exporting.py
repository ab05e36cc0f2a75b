"""A robot or a model for programs that compute with its equations: CasADi, FMU, ROS 2."""

import dataclasses
import io
import platform
import sys
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from modeler import views
from modeler.api.thresholds import THRESHOLDS
from modeler.api.workflow import compile, compile_model, emit_model, observe
from modeler.codegen import Derivation, derive, generate
from modeler.core.errors import BuildError, DataError
from modeler.core.files import write_atomically, write_without_overwriting
from modeler.core.manifest import ModuleSpec
from modeler.core.result import find_presentation
from modeler.derivation import complete_home
from modeler.estimation import IdentifiedModel, model_file
from modeler.formats import Equations, Exported, Torques, Value, choose_format, export_robot
from modeler.robot import Robot
from modeler.runtime import build_portable_library

if TYPE_CHECKING:
    from modeler.diagnosis import Diagnosis
    from modeler.estimation import MethodComparison
    from modeler.logs import LogInspection
    from modeler.validation import Comparison, Fleet, ModelComparison

    Reported = (
        Robot
        | LogInspection
        | IdentifiedModel
        | Comparison
        | ModelComparison
        | Diagnosis
        | MethodComparison
        | Fleet
    )
    """What has a page."""

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
        derivation.model, derivation.base, [value.after for value in values] or None
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
    beta = [value.after for value in values]
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
    texts = build_ros2_files(emitted, [value.after for value in values], source)
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


def export(
    thing: Robot | IdentifiedModel,
    out: str | Path | None = None,
    to: str | None = None,
    like: str | Path | None = None,
    force: bool = False,
) -> Exported:
    """Exports a robot or a model for another program; `table()` of the result lists the numbers.

    >>> export(model, to="urdf").table("lost effects").column("effect")
    []

    Args:
        thing: a robot with values, or a model.
        out: the file that is written, of "ros2" the folder; None: none.
        to: "urdf", "mjcf", "sdf", "casadi", "fmu", "simulink" or "ros2"; None: by the original, or
            the ending of `out`.
        like: a file of the same robot, of which only the numbers are replaced.
        force: write also over a file with another content.

    Raises:
        DataError: no values, no format, or what the format cannot state.
        RobotError: a mistake in the original.
        ModelerError: there is such a file, or it cannot be written.
    """
    kind = choose_format(to, str(like or ""), str(out or ""))
    if kind in OF_EQUATIONS:
        result = _export_equations(thing, kind, like)
    else:
        if isinstance(thing, Robot) and thing.loops:
            thing = complete_home(thing).write_to_text(thing)
        torques = _build_torque_function(thing) if isinstance(thing, IdentifiedModel) else None
        equations = partial(_build_equations, thing) if isinstance(thing, Robot) else None
        result = export_robot(thing, kind, None if like is None else Path(like), torques, equations)
    if out is not None:
        for name, data in result.files.items():
            write_without_overwriting(Path(out) / name, data, force)
        if not result.files:
            write_without_overwriting(Path(out), result.data, force)
    return result


def _export_equations(
    thing: Robot | IdentifiedModel, kind: str, like: str | Path | None
) -> Exported:
    if like is not None:
        raise DataError(f"--like {like}: is for robot files, and --to says {kind}; leave out one")
    return export_code(thing, kind)


def _build_equations(robot: Robot) -> Equations:
    """Its parameters, and torques at random motion around home, which are requested rarely."""
    emitted = generate(derive(robot))

    def compute_torques(beta: np.ndarray) -> np.ndarray:
        compiled, rng = compile_model(emitted), np.random.default_rng(THRESHOLDS.export_seed)
        home = [robot.home.get(joint.name, 0.0) for joint in robot.coordinates]
        q, qd, qdd = rng.uniform(-1.0, 1.0, (3, THRESHOLDS.export_states, len(home)))
        q = home + THRESHOLDS.export_amplitude * q
        if emitted.spec.closure is not None:
            q = q[compiled.closing_status(q) == 0]
        return np.asarray(compiled.inverse_dynamics(q, qd[: len(q)], qdd[: len(q)], beta))

    return Equations(emitted.spec, compute_torques)


def _build_torque_function(model: IdentifiedModel) -> Torques | None:
    """Torques of base parameters on the rows of the fit; None where its logs are not there."""
    find = getattr(model, "find_logs", None)  # of `api.model.Model`
    try:
        logs = find(None, "export") if find else []
    except DataError:
        return None
    if not logs:
        return None
    rows: list[Callable[[np.ndarray], np.ndarray]] = []
    names = tuple(joint.name for joint in model.spec.joints)

    def compute_torques(beta: np.ndarray) -> tuple[np.ndarray, tuple[str, ...]]:
        if not rows:  # read when they are first requested
            observation = observe(compile(model), logs, model.processing)
            rows.append(lambda each: np.where(observation.used, observation.predict(each), 0.0))
        return rows[0](beta), names

    return compute_torques


def write_report(thing: "Reported", path: str | Path, notes: Sequence[str] = ()) -> Path:
    """Writes the page of a result; it needs no other file.

    >>> write_report(model, "fit.html").name
    'fit.html'

    Args:
        thing: a robot, a look at a log, a model (its fit; of one with additions, what they
            gained), a comparison, models side by side, a diagnosis, estimators side by side, or a
            fleet.
        path: of an .html file.
        notes: lines for the foot of the page: where the logs come from.

    Raises:
        ModelerError: the place cannot be written.
    """
    presentation = find_presentation(type(thing))
    if presentation is None or presentation.document is None:
        raise TypeError(f"write_report: got a {type(thing).__name__}, which has no page")
    sheet = presentation.document(thing, notes)
    if isinstance(sheet, views.Page):
        return views.write_page(Path(path), sheet)
    write_atomically(Path(path), sheet)
    return Path(path)
