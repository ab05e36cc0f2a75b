"""The MODEL file: one JSON file with all that later commands need; it can be mailed.

Checksums of its entries, and values that fit each other, show whether it still says what was
saved. A checksum distinguishes an edited value from a saved one; it is no proof of who saved the
file.
"""

import dataclasses
import hashlib
import itertools
import json
import os
import shlex
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, TypedDict, get_type_hints

import numpy as np

from modeler.core.errors import DataError, ManifestError, split_time_range
from modeler.core.files import compute_checksum, read_file, read_text, write_atomically
from modeler.core.json import (
    Change,
    Document,
    JsonError,
    SchemaError,
    convert_value,
    parse_json,
    select_attributes,
    shorten_value,
)
from modeler.core.manifest import FittedParameter, FittedSpec, ModuleSpec, build_manifest
from modeler.core.result import Result
from modeler.core.table import format_percent
from modeler.estimation.result import FitResult, read_fit
from modeler.estimation.thresholds import THRESHOLDS
from modeler.regression import DataReport, LogRows, Processing, has_shared_rows
from modeler.runtime import CompiledModel, load_module

FORMAT = 4
KIND = "modeler model"

CHECKSUMS = "checksums"
"""Name of the entry with the checksums of all others."""

_MEANING = {
    "fit": "fit (the values and how they were found)",
    "covariance": "covariance (uncertainty of the values)",
    "robot_text": "robot_text (the robot file; to change the robot, fit the changed file)",
    "manifest": "manifest (what the C looks like)",
    "sources": "sources (the C)",
    "logs": "logs (what was fitted)",
    "mapping": "mapping (which column of the logs is which quantity)",
    "history": "history (the effects added)",
}


@dataclass(frozen=True)
class LogProvenance:
    """Describes a log the model was fitted on.

    Attributes:
        name: its file name, no folder.
        rows: read.
        samples: after decimation.
        fingerprint: fingerprint of the whole file's measurements; it shows the file under any name.
        start, end: s, first and last row that was used of it.
        path: as it was given, `@START:END` of a piece of it too; relative to the folder of work, or
            to that of the model file. A hint, where the model was mailed; "" of what was no file.
        checksum: of the bytes of that file or folder, see `compute_checksum`; "" without one.
    """

    name: str
    rows: int
    samples: int
    fingerprint: str
    start: float
    end: float
    path: str = ""
    checksum: str = ""

    def find_places(self, folder: str | Path) -> dict[str, str]:
        """Returns {where it may be: checksum of what is there}: by its path, from a folder."""
        both = (self.path, str(Path(folder, self.path))) if self.path else ()
        return {place: compute_place_checksum(place) for place in both}

    def find_place(self, folder: str | Path) -> str:
        """Returns where it is, unchanged: by its path, or by that from a folder; "" if nowhere."""
        places = self.find_places(folder).items()
        return next((place for place, x in places if x and x == self.checksum), "")

    def has_rows_of(self, log: LogRows) -> bool:
        """Returns True if rows of `log` were fitted."""
        return has_shared_rows(log, self.fingerprint, self.start, self.end)


@dataclass(frozen=True)
class Addition(Result, Document):
    """Describes one effect that was added to a model.

    Attributes:
        effect: id; "" for the model as it was first fitted.
        joint: name; None for an effect of the whole robot.
        nonlinear_parameters: values of its nonlinear parameters, SI.
        error: relative error with it on held-out logs, root mean square over the joints; on the
            fitted logs, eight parts left out in turn, where none were held out.
        training_error: the same on the fitted logs.
        held_out_logs: names of the held-out logs.
        robot_text: the robot file with it.
        delay: s, of the processing with it.
        nonlinear_sigmas: standard deviations of the nonlinear parameters.
        nonlinear_intervals: 95 % intervals of the nonlinear parameters.
        joints: relative error before and with it, by joint, on the logs of `error`.
        changed_joints: joints whose error changed significantly.
        is_improvement: True if the error falls significantly, and rises on no joint.
        warning: why a diagnosis would call it possible only; empty if it would call it likely.
        shifts_in_sigmas: by how much each parameter that was there moved, in its sigmas; of learned
            laws only.
        pushes: as of the processing with it.
        left_out: windows that it leaves out, a sentence each.
    """

    KEYS = """
        effect=effect_id joint error training_error nonlinear_parameters nonlinear_sigmas
        nonlinear_intervals held_out_logs joints=joint_changes changed_joints is_improvement warning
        is_learned shifts_in_sigmas left_out
    """

    effect: str
    joint: str | None
    nonlinear_parameters: Mapping[str, float]
    error: float
    training_error: float
    held_out_logs: tuple[str, ...]
    robot_text: str
    delay: float = 0.0
    nonlinear_sigmas: Mapping[str, float] = field(default_factory=dict)
    nonlinear_intervals: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    joints: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    changed_joints: tuple[str, ...] = ()
    is_improvement: bool = True
    warning: str = ""
    shifts_in_sigmas: Mapping[str, float] = field(default_factory=dict)
    pushes: Mapping[str, tuple[tuple[float, float], ...]] | None = None
    left_out: tuple[str, ...] = ()

    @property
    def is_learned(self) -> bool:
        """Returns True of a law that was learned, which is no physics."""
        return bool(self.shifts_in_sigmas)

    @property
    def effect_id(self) -> str | None:
        """Returns the id of the effect; None of the model as it was first fitted."""
        return self.effect or None

    @property
    def joint_changes(self) -> dict[str, Change]:
        """Returns the relative error without and with it, by joint."""
        return {joint: Change(*errors) for joint, errors in self.joints.items()}


@dataclass(frozen=True, eq=False)
class IdentifiedModel(Result, Document):
    """Holds a robot with values.

    Attributes:
        robot_text: the robot file, TOML.
        spec: the manifest.
        sources: C by file name, as `EmittedModule.code`.
        fit: the estimate; `fit.processing` is how its data were processed.
        logs: what it was fitted on.
        history: the model as first fitted and every effect added since; empty before the first.
        mapping: which columns of its logs are ours, a table as [log] of a robot file, over that;
            empty if the robot file says it all.
    """

    KEYS = "*fit waterfall=history logs"

    robot_text: str
    spec: ModuleSpec
    sources: Mapping[str, str]
    fit: FitResult
    logs: tuple[LogProvenance, ...]
    history: tuple[Addition, ...] = ()
    mapping: Mapping[str, Any] = field(default_factory=dict)

    @property
    def error_reduction_shares(self) -> tuple[float, float] | None:
        """Returns what physics and what learned laws took of the error since the first fit.

        Falls of the relative error, in the order in which they were added; None without learned
        laws.
        """
        if not any(step.is_learned for step in self.history):
            return None
        pairs = itertools.pairwise(self.history)
        falls = [(new.is_learned, old.error - new.error) for old, new in pairs]
        physics, learned = (sum(fall for x, fall in falls if x is kind) for kind in (False, True))
        return physics, learned

    @property
    def beta(self) -> np.ndarray:
        """Returns the base parameters (c,) in the order of the manifest."""
        return self.fit.beta

    @property
    def covariance(self) -> np.ndarray:
        """Returns the covariance (c, c) of the base parameters beta."""
        return self.fit.covariance

    @property
    def processing(self) -> Processing:
        """Returns how the fitted data were processed; use it for held-out logs."""
        return self.fit.processing

    @property
    def warning(self) -> list[str]:
        """Returns a line of warning if the fit is not valid, else no line."""
        return [] if self.fit.verdict is None else self.fit.verdict.format_warning()

    def compile(self) -> CompiledModel:
        """Returns the compiled robot; its elastic joints wind up with the values of the fit.

        Raises:
            BuildError: no C compiler, or it refused the sources.
        """
        try:
            table = tomllib.loads(self.robot_text).get("log", {})
        except ValueError:
            table = {}
        mapping = self.mapping or (table if isinstance(table, Mapping) else {})
        compiled = load_module(self.spec, self.sources, mapping)
        return compiled.set_windup(self.beta, self.fit.elastic_values)


def collect_provenance(report: DataReport) -> tuple[LogProvenance, ...]:
    """Returns which logs went into an observation."""
    logs = []
    for log in report.logs:
        place = os.fsencode(log.path).decode(errors="replace"), compute_place_checksum(log.path)
        known = log.name, log.rows, log.samples, log.content, *log.span, *place
        logs.append(LogProvenance(*known))
    return tuple(logs)


def compute_place_checksum(place: str) -> str:
    """Returns that of the file or folder of a log, `@START:END` left aside; "" if there is none."""
    try:
        return compute_checksum(Path(split_time_range(place)[0])) if place else ""
    except OSError:
        return ""


class ModelFile(TypedDict):
    """What a model file holds."""

    kind: Literal["modeler model"]
    format: int
    robot: str
    signature: str  # of the manifest
    fit: FitResult
    covariance: list[list[float]]  # of the base parameters
    logs: list[LogProvenance]  # that were fitted
    mapping: Mapping[str, Any]  # which columns of the logs are ours
    robot_text: str  # the robot file
    history: list[Mapping[str, Any]]  # the model as first fitted, and effects added since
    manifest: ModuleSpec
    sources: Mapping[str, str]  # the C
    checksums: Mapping[str, str]  # of all other entries


def save_model(path: str | Path, model: IdentifiedModel) -> None:
    """Writes the model file; an interrupted write leaves the old file.

    Raises:
        ModelerError: the folder cannot be written.
    """
    content = {
        "kind": KIND,
        "format": FORMAT,
        "robot": model.spec.robot,
        "signature": model.spec.compute_signature(),
        "fit": model.fit.to_json(),
        "covariance": model.fit.covariance.tolist(),
        "logs": [vars(log) for log in model.logs],
        "mapping": dict(model.mapping),
        "robot_text": model.robot_text,
        "history": [vars(step) for step in model.history],
        "manifest": json.loads(model.spec.to_json()),
        "sources": dict(model.sources),
    }
    content = json.loads(json.dumps(content, allow_nan=False))  # as it will be read back
    content[CHECKSUMS] = compute_checksums(content)
    write_atomically(Path(path), json.dumps(content, indent=1, allow_nan=False) + "\n")


def load_model(path: str | Path) -> IdentifiedModel:
    """Reads a model file.

    Raises:
        ManifestError: missing, not a model file, of another format, damaged, or changed since it
            was saved.
    """
    where = str(path)
    raw = _read_model_file(Path(path))
    check_checksums(raw, where)
    spec = build_manifest(_read_entry(raw, "manifest", Any, where), f"{where}, manifest")
    if _read_entry(raw, "signature", str, where) != spec.compute_signature():
        raise _make_refusal(where, "the manifest was changed after it was saved: wrong signature")
    fit, count = _read_fit(raw, where), len(spec.base)
    same = [p.name for p in fit.parameters] == [base.name for base in spec.base]
    same = same and spec.robot == _read_entry(raw, "robot", str, where)
    if not same or fit.covariance.shape != (count, count):
        what = f"the values are not those of the {count} base parameters of its manifest"
        raise _make_refusal(where, what)
    for what in itertools.chain(_find_wrong_values(fit), _find_wrong_covariance(fit)):
        raise _make_refusal(where, what)
    kinds = get_type_hints(IdentifiedModel)
    as_saved = ("robot_text", "sources", "logs", "history", "mapping")
    further = {name: _read_entry(raw, name, kinds[name], where) for name in as_saved}
    return IdentifiedModel(spec=spec, fit=fit, **further)


def _make_refusal(where: str, what: str) -> ManifestError:
    return ManifestError(f"{where}: {what}; fit the model again")


def _read_fit(raw: Mapping[str, Any], where: str) -> FitResult:
    """Returns the estimate, every entry of the type that its class declares."""
    rows = _read_entry(raw, "covariance", tuple[tuple[float, ...], ...], where)
    fitted = _read_entry(raw, "fit", Mapping[str, Any], where)
    if any(len(row) != len(rows) for row in rows):
        raise _make_refusal(where, "damaged, covariance is not square")
    try:
        return read_fit(fitted, np.array(rows, dtype=float).reshape(len(rows), len(rows)))
    except ManifestError as error:
        raise ManifestError(f"{where}: {error}") from None


def _read_model_file(path: Path) -> dict[str, Any]:
    expected = "expected the output of `modeler fit --out`"
    try:
        raw = parse_json(read_file(path))
    except OSError as error:
        raise ManifestError(
            f"{path}: cannot be read ({error.strerror}); check the path; expected a model, which "
            "`modeler fit --out` writes, no robot"
        ) from None
    except JsonError as error:
        if _is_robot_file(path):
            raise ManifestError(
                f"{path}: is a robot; expected a model: make one with "
                f"`modeler fit {shlex.quote(str(path))} LOG --out MODEL.json`"
            ) from None
        raise ManifestError(f"{path}: not a model file: it {error}; {expected}") from None
    if not isinstance(raw, dict) or raw.get("kind") != KIND:
        raise ManifestError(f"{path}: JSON, but not a model file; {expected}")
    if (got := raw.get("format")) != FORMAT:
        version = f"model format {shorten_value(got)}" if "format" in raw else "no model format"
        newer = isinstance(got, int) and got > FORMAT
        raise ManifestError(
            f"{path}: {version}, this version opens {FORMAT}; "
            f"{'install a newer modeler' if newer else 'fit the model again'}"
        )
    return raw


def _is_robot_file(path: Path) -> bool:
    try:
        return "mdh" in tomllib.loads(read_text(path))
    except (ValueError, RecursionError):  # of TOML, or of UTF-8
        return path.suffix.lower() == ".toml"


def _read_entry(raw: Mapping[str, Any], name: str, kind: Any, where: str) -> Any:
    if name not in raw:
        raise _make_refusal(where, f"damaged, {name} is missing")
    try:
        return convert_value(kind, raw[name], name)
    except SchemaError as error:
        raise _make_refusal(where, f"damaged, {error}") from None


def compute_checksums(content: Mapping[str, Any]) -> dict[str, str]:
    """Returns {entry: checksum} of every entry of a model file but the checksums themselves."""
    # Entries stay in their order: that of the joints says which torque is whose.
    texts = {
        name: json.dumps(value, separators=(",", ":"), allow_nan=False)
        for name, value in content.items()
        if name != CHECKSUMS
    }
    return {name: hashlib.sha256(text.encode()).hexdigest()[:16] for name, text in texts.items()}


def check_checksums(content: Mapping[str, Any], where: str) -> None:
    """Refuses a model file of which anything was changed since it was saved.

    Raises:
        ManifestError: names the entries that do not fit.
    """
    stored = content.get(CHECKSUMS)
    if not isinstance(stored, dict):
        what = "not as saved" if CHECKSUMS in content else "missing"
        raise _make_refusal(where, f"damaged, {CHECKSUMS} is {what}")
    expected = compute_checksums(content)
    every = dict.fromkeys([*expected, *stored])
    wrong = [name for name in every if expected.get(name, "none") != stored.get(name, "missing")]
    if wrong:
        changed = ", ".join(_MEANING.get(name, shorten_value(name)) for name in wrong[:3])
        more = f" and {len(wrong) - 3} more" if len(wrong) > 3 else ""
        raise ManifestError(
            f"{where}: changed since it was saved, the checksum does not fit: {changed}{more}; "
            "take the file as it was saved, or fit the model again"
        )


def _find_wrong_values(fit: FitResult) -> Iterator[str]:
    """Yields which values and deviations no fit gives, and why."""
    for p in (*fit.gains, *fit.parameters, *fit.elastic, *fit.loads):
        for what, number in (("value", p.value), ("sigma", p.sigma)):
            if number is not None and not np.isfinite(number):
                yield f"the {what} of {p.name} is {number!r}; expected a finite one"
        if p.sigma is not None and p.sigma < 0.0:
            yield f"the sigma of {p.name} is {p.sigma:g}; expected 0 or more"


def _find_wrong_covariance(fit: FitResult) -> Iterator[str]:
    """Yields why no fit gives this covariance, or sigmas beside it."""
    names, C = [p.name for p in fit.parameters], fit.covariance
    for i, j in np.argwhere(~np.isfinite(C)):
        yield f"the covariance of {names[i]} and {names[j]} is not finite"
    for p, variance in zip(fit.parameters, np.diag(C), strict=True):
        if variance < 0.0:
            yield f"the variance of {p.name} is {variance:g}; expected 0 or more"
        deviation = float(np.sqrt(variance))
        if abs((p.sigma or 0.0) - deviation) > THRESHOLDS.sigma_tolerance * deviation:
            got = "none" if p.sigma is None else f"{p.sigma:g}"
            yield f"the sigma of {p.name} is {got}, the root of its variance {deviation:g}"
    deviations = np.sqrt(np.diag(C))
    known = deviations > 0.0
    for i in np.flatnonzero(~known & np.any(C != 0.0, axis=1)):
        yield f"{names[i]} varies with others, but its variance is 0"
    safe = np.where(known, deviations, 1.0)
    correlation = np.where(np.outer(known, known), C / np.outer(safe, safe), 0.0)
    uneven = np.abs(correlation - correlation.T)
    if uneven.max(initial=0.0) > THRESHOLDS.symmetry_tolerance:
        i, j = np.unravel_index(int(np.argmax(uneven)), uneven.shape)
        yield f"the covariance of {names[i]} and {names[j]} is not symmetric"
    if np.linalg.eigvalsh(correlation).min(initial=0.0) < THRESHOLDS.min_eigenvalue:
        yield "the covariance gives a sum of parameters a negative variance"


# What of a fit goes into the C of a controller.


def build_fitted_spec(model: IdentifiedModel) -> FittedSpec:
    """Returns the values of a model for `codegen.emit`: all parameters, as `compare` uses them.

    Dropped parameters are 0. Drive gains, fitted or not, are those of the robot file; they are
    left out unless every joint has one.
    """
    fit, joints = model.fit, model.spec.joints
    verdict = fit.verdict
    gains = tuple(joint.drive_gain for joint in joints if joint.drive_gain is not None)
    judged: tuple[bool | None, str, tuple[str, ...]] = (None, "", ())
    if verdict is not None:
        judged = verdict.valid, verdict.line, tuple(verdict.lines)
    every = [(p.name, p.unit, p.value, p.sigma, p.essential) for p in fit.parameters]
    values = tuple(FittedParameter(*p) for p in every)
    gains = gains if len(gains) == len(joints) else ()
    remarks = tuple(_write_remarks(model))
    elastic = () if fit.elastic_values is None else tuple(map(float, fit.elastic_values))
    return FittedSpec(fit.method, *judged, remarks, values, gains, elastic=elastic)


def _write_remarks(model: IdentifiedModel) -> list[str]:
    """Returns sentences on what the values are of."""
    fit = model.fit
    energy = "" if fit.energy is None else ", of the energies instead of the torques"
    remarks = [
        f"Values by the method {fit.method}{energy}, {fit.samples} samples, relative error "
        f"{format_percent(fit.relative_error)}."
    ]
    steps = [step for step in model.history if step.effect]
    added = [f"{s.effect} (joint {s.joint})" if s.joint is not None else s.effect for s in steps]
    if added:
        remarks.append(f"Effects added since the first fit: {', '.join(added)}.")
    if fit.processing.delay:
        side = "before" if fit.processing.delay > 0.0 else "after"
        remarks.append(
            f"The torques of the logs stood {1e3 * abs(fit.processing.delay):.3g} ms {side} the "
            "motion that they belong to; the values are without that delay."
        )
    if fit.loads:
        loads = ", ".join(f"{load.name} {load.value:.6g} {load.unit}" for load in fit.loads)
        remarks.append(f"Without the load that some logs carried: {loads}.")
    return remarks


def keep_essential(model: IdentifiedModel, where: str) -> IdentifiedModel:
    """Returns the model with the values of its reduced model, all others 0.

    Args:
        model: as it was loaded.
        where: its file, for the error.

    Raises:
        DataError: the model was saved without one.
    """
    fit, reduced = model.fit, model.fit.essential
    if reduced is None:
        raise DataError(f"{where}: holds no reduced model (--essential); fit it again")
    estimates = {parameter.name: parameter for parameter in reduced.parameters}
    none: Any = {"value": 0.0, "sigma": None, "essential": False, "interval": None}
    values = [estimates.get(p.name, dataclasses.replace(p, **none)) for p in fit.parameters]
    fit = dataclasses.replace(
        fit,
        parameters=tuple(values),
        covariance=np.diag([(p.sigma or 0.0) ** 2 for p in values]),
        **select_attributes(reduced, "relative_error condition_number condition_scaled"),
    )
    return dataclasses.replace(model, fit=fit)
