"""What a fit hands back: values, sigmas, errors by joint, the energy model, bodies."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from modeler.core.errors import DataError, ManifestError
from modeler.core.json import Document, ShortRepr, build_instance
from modeler.core.manifest import ModuleSpec
from modeler.core.result import Result
from modeler.core.table import POOLED, format_errors_by_unit, format_percent, pool_errors_by_unit
from modeler.estimation.parameters import (
    ParameterEstimate,
    ReducedModel,
    format_parameters,
    read_all,
    read_back,
)
from modeler.estimation.physical_consistency import PREFIXES, compute_pseudo_inertia
from modeler.estimation.thresholds import THRESHOLDS
from modeler.regression import Bands, DataWarning, Processing, read_processing


@dataclass(frozen=True)
class ModelFigures(ShortRepr):
    """Holds figures of one model fitted to the data.

    Attributes:
        model: "torque", "energy, Simpson" or "energy, trapezoid".
        rows: of its W.
        condition_scaled: of W with columns of length one.
        precise_count: parameters with a sigma below 10 % of their value.
        torque_error: ||tau - W beta|| / ||tau|| with its beta, on the rows of the torque model.
        torque_sigma: sqrt(tr(W C W^T)) / ||tau||: what its covariance C comes to in the same
            torques. Noise of the torques themselves is not in it.
        imbalance: share of the energy that integrals and derivatives miss: the work of inertia by
            the rule against the difference of kinetic energy; None for the torque model.
        bias: what that moves the parameter that it moves most, in sigmas; None for the torque
            model.
        joint_sigma: by joint, the root mean square of what the covariance comes to in its torques,
            N m or N.
    """

    model: str
    rows: int
    condition_scaled: float
    precise_count: int
    torque_error: float
    torque_sigma: float
    imbalance: float | None = None
    bias: float | None = None
    joint_sigma: Mapping[str, float] = field(default_factory=dict)

    def format_cells(self) -> tuple[str, ...]:
        """Returns the cells of the model's line of the table."""
        errors = (format_percent(x) for x in (self.torque_error, self.torque_sigma))
        missed = "-" if self.imbalance is None else f"{self.imbalance:.1e}"
        bias = "-" if self.bias is None else f"{self.bias:.2g} sigma"
        counts = f"{self.rows}", f"{self.condition_scaled:.4g}", f"{self.precise_count}"
        return *counts, *errors, missed, bias


@dataclass(frozen=True)
class EnergyReport(ShortRepr, Document):
    """Holds how the rows of energy were made, and how they compare with the torque model.

    Attributes:
        window: s.
        relative_error: ||y - W beta|| / ||y|| of the energies.
        figures: torque model, energy by Simpson's rule, energy by the trapezoid.
        parameters: estimated ones.
    """

    KEYS = "window relative_error parameters uncertainty_ratio figures sentences"

    window: float
    relative_error: float
    figures: tuple[ModelFigures, ...]
    parameters: int

    @property
    def uncertainty_ratio(self) -> float:
        """Returns the uncertainty of the torques over the torque model's, at the worst joint.

        Over all joints together the largest torques alone would count.
        """
        return self._find_worst_joint()[1]

    def _find_worst_joint(self) -> tuple[str, float]:
        torque, energy, _ = self.figures
        pairs = {
            f"joint {name}": (sigma, torque.joint_sigma.get(name, 0.0))
            for name, sigma in energy.joint_sigma.items()
        } or {"all joints": (energy.torque_sigma, torque.torque_sigma)}  # a file from before
        ratios = {name: a / b if b > 0.0 else 1.0 for name, (a, b) in pairs.items()}
        return max(ratios.items(), key=lambda item: item[1])

    def format_lines(self) -> list[str]:
        """Returns the lines of a table of the figures of both models, and what they mean."""
        head = ("rows", "cond", "known", "error", "sigma", "missed", "bias")
        rows = [("model", head), *((item.model, item.format_cells()) for item in self.figures)]
        widths = (7, 10, 7, 10, 10, 9, 13)
        table = [
            f"{name:<18}" + "".join(f"{c:>{w}}" for c, w in zip(cells, widths, strict=True))
            for name, cells in rows
        ]
        return [
            f"energy model: windows of {self.window:.4g} s, energies with an error of "
            f"{format_percent(self.relative_error)}; beside the torque model on the same data:",
            *table,
            "cond: columns of length one; known: sigma below 10 %; error, sigma: of the predicted "
            "torques; missed: energy error of the integration; bias: its largest effect",
            *self.sentences,
        ]

    @property
    def sentences(self) -> list[str]:
        """Returns which of the two models to take, and what the rule of integration does."""
        torque, energy, _ = self.figures
        where, ratio = self._find_worst_joint()
        known = (
            f"{energy.precise_count} (torque model: {torque.precise_count}) of {self.parameters} "
            "parameters"
        )
        first = (
            f"the energy model has {ratio:.3g} times the uncertainty of the torque model in the "
            f"torques of {where} and knows {known}; for torques and values take --model torque"
            if ratio > THRESHOLDS.different_sigma_ratio
            else f"the energy model has at most {ratio:.3g} times the uncertainty of the torque "
            f"model ({where}), knows {known}, and needs no acceleration"
        )
        simpson, trapezoid = (item.bias or 0.0 for item in self.figures[1:])
        second = (
            "integrals by Simpson's rule, and derivatives, change no parameter by more than "
            f"{simpson:.2g} sigma; with the trapezoid {trapezoid:.2g}"
        )
        if simpson > THRESHOLDS.max_bias_sigmas:
            second += "; log faster, or move more slowly"
        return [first, second]


# Friction by direction: what viscous, Coulomb, their asymmetry and the offset come to.


_LAW = (
    ("Fv", "+", {"viscous": 1.0, "asymmetric_viscous": 1.0}),
    ("Fs", "+", {"coulomb": 1.0, "offset": 1.0}),
    ("Fv", "-", {"viscous": 1.0, "asymmetric_viscous": -1.0}),
    ("Fs", "-", {"coulomb": 1.0, "offset": -1.0}),
)


@dataclass(frozen=True)
class DirectedFriction(Document):
    """Holds friction of one joint in one direction of its motion, a sum of base parameters.

    Attributes:
        name: "Fv1+", "Fs1+" for qd > 0, "Fv1-", "Fs1-" for qd < 0.
        unit: SI.
        value: its estimate.
        sigma: standard deviation.
        relation: "Fv1+ = Fv1 + Fva1".
    """

    KEYS = "name unit value sigma relation relative_sigma_percent"

    name: str
    unit: str
    value: float
    sigma: float
    relation: str

    @property
    def relative_sigma_percent(self) -> float | None:
        """Returns 100 sigma / |value|; None of the value 0."""
        return 100.0 * self.sigma / abs(self.value) if self.value else None


def compute_friction_by_direction(
    spec: ModuleSpec, fit: "FitResult"
) -> tuple[DirectedFriction, ...]:
    """Returns that of the joints whose viscous friction differs between the directions.

    The law of the columns qd, |qd|, sign(qd), 1 is that of two slopes and two levels,

        Fv qd + Fva |qd| + Fs sign(qd) + Off = Fv+ qd + Fs+ (qd > 0),  Fv- qd - Fs- (qd < 0),
        Fv+- = Fv +- Fva,  Fs+- = Fs +- Off

    (Fv1, Fs1 and Fv2, Fs2 of Houda et al., Table 1). A base parameter that carries others, such as
    a constant weight in OffR, carries them here too; its name in the relation says so.

    Args:
        spec: the robot.
        fit: its c base parameters, and the (c, c) covariance of their values.
    """
    parameters, covariance = fit.parameters, fit.covariance
    keys = {parameter.name: (parameter.effect, parameter.joint) for parameter in spec.standard}
    known = [(i, b) for i, b in enumerate(spec.base) if parameters[i].sigma is not None]
    column = {keys[base.column_of]: i for i, base in known if base.column_of in keys}
    frictions = []
    for joint in spec.joints:
        if ("asymmetric_viscous", joint.name) not in column:
            continue
        for prefix, sign, parts in _LAW:
            used = {column[k, joint.name]: c for k, c in parts.items() if (k, joint.name) in column}
            if (next(iter(parts)), joint.name) not in column:  # another carries it
                continue
            at, c = list(used), np.array(list(used.values()))
            name = f"{prefix}{joint.name}{sign}"
            signed = (f"{'+' if f > 0 else '-'} {parameters[i].name}" for i, f in used.items())
            terms = " ".join(signed)
            value = float(c @ [parameters[i].value for i in at])
            sigma = max(float(c @ covariance[np.ix_(at, at)] @ c), 0.0) ** 0.5
            relation, unit = f"{name} = {terms.removeprefix('+ ')}", parameters[at[0]].unit
            frictions.append(DirectedFriction(name, unit, value, sigma, relation))
    return tuple(frictions)


def format_directions(directions: tuple[DirectedFriction, ...]) -> list[str]:
    """Returns a table; nothing without one."""
    if not directions:
        return []
    width = max(9, *(len(item.name) for item in directions))
    lines = [f"{'direction':<{width}} {'value':>13} {'sigma':>10}  unit"]
    for item in directions:
        numbers = f"{item.value:>13.6g} {item.sigma:>10.3g}"
        lines.append(f"{item.name:<{width}} {numbers}  {item.unit:<10} {item.relation}")
    return lines


@dataclass(frozen=True)
class JointFit(Document):
    """Holds the fit of one joint.

    Attributes:
        name: joint.
        unit: "N m" or "N".
        rows: used.
        relative_error: ||tau - W chi|| / ||tau||, filtered; None without rows or torque.
        rms: of the residual.
        sigma: standard deviation of its rows, the inverse of their weight.
    """

    KEYS = "relative_error rms sigma rows unit"

    name: str
    unit: str
    rows: int
    relative_error: float | None
    rms: float
    sigma: float

    @property
    def squares(self) -> tuple[float, float]:
        """Returns ||tau - W chi||^2 and ||tau||^2; the latter 0 where nothing is known of it."""
        left = self.rows * self.rms**2
        return left, left / self.relative_error**2 if self.relative_error else 0.0


State = Literal["good", "doubtful", "undetermined"]
"""Of a joint: what is said of the prediction of its torque."""

Use = Literal["parameters", "prediction", "nothing"]
"""What a fit is valid for."""

PREDICTED = ("", "no_motor", "low_speed")
"""Causes of states of joints that are predicted, or have nothing to predict."""


@dataclass(frozen=True)
class JointVerdict(ShortRepr):
    """Holds what a fit is valid for on one joint.

    Attributes:
        state: "good": predicts its torque; "doubtful": predicts it with a large error, or at rest
            only; "undetermined": does not predict it, or its channels are wrong.
        why: sentences: its errors or what stands against it, then all warnings on it.
        cause: code of what makes it doubtful or undetermined; "" of its held-out errors alone.
    """

    state: State
    why: tuple[str, ...]
    cause: str = ""


@dataclass(frozen=True)
class VerdictWarning(ShortRepr):
    """Holds a sentence that speaks against a fit.

    Attributes:
        code: its kind: "clock", "lack_of_fit" ...
        joint: that it is about; None: the whole robot.
        text: where and what; after the last semicolon what to do.
    """

    code: str
    joint: str | None
    text: str


@dataclass(frozen=True)
class Verdict(ShortRepr):
    """Holds what a fit is valid for.

    Attributes:
        valid: True if it predicts the torques of motion like that of its logs, on some joint.
        valid_for: "parameters" (its values are those of a machine: simulation, control, other
            motion), "prediction" (torques of motion like that of its logs), "nothing".
        line: for people: for what, on which joints, why, what to do.
        warnings: all that speaks against it; one on several joints is there for each.
        undetectable_faults: faults that these logs would not show, in words.
        by_joint: the same joint by joint; empty in files that lack it.
        physically_consistent: whether the values are physically consistent; None where the logs are
            at fault.
    """

    valid: bool
    valid_for: Use
    line: str
    warnings: tuple[VerdictWarning, ...]
    undetectable_faults: tuple[str, ...] = ()
    by_joint: Mapping[str, JointVerdict] = field(default_factory=dict)
    physically_consistent: bool | None = None

    @property
    def lines(self) -> list[str]:
        """Returns the sentences of all warnings."""
        return list(dict.fromkeys(warning.text for warning in self.warnings))

    @property
    def is_valid_everywhere(self) -> bool:
        """Returns True if it predicts every joint that has a motor, and not at rest only."""
        return self.valid and all(one.cause in PREDICTED for one in self.by_joint.values())

    @property
    def needs_motion(self) -> bool:
        """Returns True if another motion would determine a joint."""
        return any(one.cause in ("few_rows", "little_motion") for one in self.by_joint.values())

    def format_warning(self) -> list[str]:
        """Returns a line for whoever uses a model that is not valid on every joint; else none."""
        line = self.line[:1].lower() + self.line[1:]
        return [] if self.is_valid_everywhere else [f"the fit of this model is {line}"]


@dataclass(frozen=True)
class JudgedJoint(Document):
    """Holds the fit of one joint and what it is valid for; None: nobody has judged it."""

    KEYS = "*fit *verdict"

    fit: JointFit
    verdict: JointVerdict | None


@dataclass(frozen=True)
class LoadFit(Document):
    """Holds the fits of the joints on the logs with a payload, or on those without."""

    KEYS = "relative_error joints=joints[name]"

    joints: tuple[JointFit, ...]

    @property
    def relative_error(self) -> float:
        """Returns ||y - W beta|| / ||y|| over the joints; NaN without torque."""
        return combine_errors(self.joints)


@dataclass(frozen=True, eq=False)
class FitResult(Result, Document):
    """Holds a fitted model.

    Attributes:
        robot: name.
        method: id of the estimator, see `core.choices`.
        status: "ok" | "rank deficient" | "not settled".
        samples: after decimation.
        rows: of W.
        condition_number: of W, without dropped parameters.
        condition_scaled: with columns of length one.
        relative_error: ||y - W beta|| / ||y||, after the same filter on both sides.
        essential_error: the same with the essential parameters only.
        joints: in the order of the manifest.
        parameters: (c,) base parameters in the order of the manifest.
        covariance: (c, c) of their values; 0 for dropped ones.
        loads: parameters of payloads, named `M6_load`; empty without payloads.
        sentences: what a reader must know, plain text.
        processing: with all choices filled in; use it for held-out logs.
        verdict: valid or not; None if it was not judged.
        standard: all standard parameters by name, SI, of an estimator that ends in them.
        estimator_notes: those of the sentences that are the estimator's; not kept in model files.
        joint_warnings: those of the sentences on single joints; not kept in model files.
        essential: the reduced model; None if it has no parameter, or in files that lack it.
        directions: friction by direction, of joints whose viscous friction differs.
        energy: how it compares with the torque model; None for the torque model itself.
        elastic: stiffness and damping of elastic joints, `K2` of all of them, then `D2`.
        gains: drive gains, named `g_tau1`, N m or N per drive unit; empty if none were fitted.
        singular_values: of the drive gains, descending; 1 is noise (see `solve_mixed_tls`).
        reading: of long logs: passes, chunks, rows, windows, rows_in_windows; empty of others.
        prior_conflicts: lines on what the prior of the robot file says and the data contradict.
        by_load: the joints on the "bare" and on the "loaded" logs; empty without payloads.
        bands: the cut-offs, what chose them, the noise of the motion; None in files that lack it.
    """

    KEYS = """
        robot method status samples rows condition_number condition_scaled relative_error
        relative_error_pools by_unit essential_error joints=joint_results by_load=load_results
        parameters loads elastic gains singular_values sentences processing standard essential
        prior_conflicts directions model energy bands valid=verdict.valid
        valid_for=verdict.valid_for verdict=verdict.line warnings undetectable_faults
        physically_consistent=verdict.physically_consistent reading
    """

    robot: str
    method: str
    status: str
    samples: int
    rows: int
    condition_number: float
    condition_scaled: float
    relative_error: float
    essential_error: float
    joints: tuple[JointFit, ...]
    parameters: tuple[ParameterEstimate, ...]
    covariance: np.ndarray
    loads: tuple[ParameterEstimate, ...]
    sentences: tuple[str, ...]
    processing: Processing
    verdict: Verdict | None = None
    standard: Mapping[str, float] = field(default_factory=dict)
    estimator_notes: tuple[str, ...] = ()
    joint_warnings: tuple[DataWarning, ...] = ()
    essential: ReducedModel | None = None
    directions: tuple[DirectedFriction, ...] = ()
    energy: EnergyReport | None = None
    gains: tuple[ParameterEstimate, ...] = ()
    singular_values: tuple[float, ...] = ()
    reading: Mapping[str, int] = field(default_factory=dict)
    by_load: Mapping[str, tuple[JointFit, ...]] = field(default_factory=dict)
    bands: Bands | None = None
    prior_conflicts: tuple[str, ...] = ()
    elastic: tuple[ParameterEstimate, ...] = ()

    @property
    def elastic_values(self) -> np.ndarray | None:
        """Returns (2 E,) stiffnesses, then dampings of elastic joints; None if none was fitted."""
        return np.array([one.value for one in self.elastic]) if self.elastic else None

    @property
    def beta(self) -> np.ndarray:
        """Returns the values (c,) of the base parameters, manifest order, SI units."""
        return np.array([parameter.value for parameter in self.parameters])

    @property
    def joint_results(self) -> dict[str, "JudgedJoint"]:
        """Returns the joints with what their fit is valid for."""
        verdicts = self.verdict.by_joint if self.verdict else {}
        return {joint.name: JudgedJoint(joint, verdicts.get(joint.name)) for joint in self.joints}

    @property
    def load_results(self) -> dict[str, "LoadFit"]:
        """Returns the joints on the "bare" and on the "loaded" logs; empty without payloads."""
        return {name: LoadFit(joints) for name, joints in self.by_load.items()}

    @property
    def model(self) -> Literal["torque", "energy"]:
        """Returns which model was fitted."""
        return "torque" if self.energy is None else "energy"

    @property
    def warnings(self) -> tuple[VerdictWarning, ...]:
        """Returns all that speaks against the fit."""
        return () if self.verdict is None else self.verdict.warnings

    @property
    def undetectable_faults(self) -> tuple[str, ...]:
        """Returns faults that these logs would not show."""
        return () if self.verdict is None else self.verdict.undetectable_faults

    @property
    def relative_error_pools(self) -> str:
        """Returns what `relative_error` puts together."""
        return POOLED

    @property
    def by_unit(self) -> dict[str, float]:
        """Returns the relative error over the joints of one unit, by unit; NaN without torque."""
        return pool_errors_by_unit((joint.unit, *joint.squares) for joint in self.joints)

    def format_error(self) -> str:
        """Returns the relative error as text; of torques and forces apart where both occur."""
        if self.energy is None and len(self.by_unit) > 1:
            return format_errors_by_unit(self.by_unit)
        return format_percent(self.relative_error)

    def format_lines(self) -> list[str]:
        """Returns lines of text: parameters, joints, remarks, the verdict last."""
        alone = (
            self.essential.parameters
            if self.essential and self.essential.dropped_parameters
            else ()
        )
        every = (*self.gains, *self.parameters, *self.elastic, *self.loads)
        lines = format_parameters(every, alone)
        lines += format_directions(self.directions)
        lines += [
            f"{self.rows} rows of {self.samples} samples, condition number "
            f"{self.condition_number:.4g} ({self.condition_scaled:.4g} with columns of length one)",
            f"relative error {self.format_error()}",
        ]
        for k, joint in enumerate(self.joints):
            loads = self.by_load.items()
            apart = "".join(f", {n} {format_percent(fits[k].relative_error)}" for n, fits in loads)
            lines.append(
                f"  joint {joint.name}: {format_percent(joint.relative_error)}{apart}, rms "
                f"{joint.rms:.4g} {joint.unit}"
            )
        lines += [*format_bodies(self.standard), *self.sentences]
        lines += self.energy.format_lines() if self.energy is not None else []
        if self.verdict is not None:
            said = (self.verdict.line, *self.sentences)
            others = (x for x in self.verdict.lines if not any(x in line for line in said))
            lines += [*(f"warning: {line}" for line in others), *self.verdict.undetectable_faults]
            lines.append(self.verdict.line)
        return lines


_LISTS: Mapping[str, type] = {
    **dict.fromkeys(("parameters", "loads", "elastic", "gains"), ParameterEstimate),
    "directions": DirectedFriction,
}
_NULLS = {
    **dict.fromkeys(("condition_number", "condition_scaled"), np.inf),
    **dict.fromkeys(("relative_error", "essential_error"), np.nan),
}
"""Numbers that are null in JSON, and what they were."""


def read_fit(raw: Mapping[str, Any], covariance: np.ndarray) -> FitResult:
    """Reads `FitResult.to_json` back; the covariance is stored beside it.

    Raises:
        ManifestError: an entry is missing or of the wrong kind; names it.
    """
    try:
        reduced, energy = raw.get("essential"), raw.get("energy")
        if reduced is not None:
            parameters = read_all(ParameterEstimate, reduced, "parameters")
            reduced = {**reduced, "parameters": parameters}
            reduced = build_instance(ReducedModel, reduced, "essential")
        loads = raw.get("by_load", {}).items()
        values: dict[str, Any] = {
            **{name: read_all(kind, raw, name) for name, kind in _LISTS.items() if name in raw},
            **{name: unknown for name, unknown in _NULLS.items() if raw[name] is None},
            "joints": _add_names(raw["joints"]),
            "by_load": {load: _add_names(part["joints"]) for load, part in loads},
            "essential": reduced,
            "energy": None if energy is None else read_back(EnergyReport, energy, "energy"),
            "covariance": covariance,
            "processing": read_processing(raw["processing"]),
            "verdict": _read_verdict(raw),
        }
        return read_back(FitResult, {**raw, **values}, "")
    except (KeyError, TypeError, ValueError, AttributeError, DataError) as error:
        raise ManifestError(f"the fit is damaged ({error}); fit the model again") from None


def combine_errors(joints: Sequence[JointFit]) -> float:
    """Returns ||y - W beta|| / ||y|| over joints; NaN without torque."""
    seen = [joint.squares for joint in joints if joint.relative_error]
    left, total = np.sum(seen, axis=0) if seen else (0.0, 0.0)
    return float(np.sqrt(left / total)) if total else float("nan")


_JUDGED = ("state", "why", "cause")


def _add_names(joints: Mapping[str, Any]) -> list[dict[str, Any]]:
    return [
        {"name": name} | {key: value for key, value in joint.items() if key not in _JUDGED}
        for name, joint in joints.items()
    ]


def _read_verdict(raw: Mapping[str, Any]) -> Verdict | None:
    """Returns None where the fit was not judged."""
    if raw.get("valid") is None:
        return None
    joints = {name: joint for name, joint in raw["joints"].items() if "state" in joint}
    judged = {name: {key: joint[key] for key in _JUDGED} for name, joint in joints.items()}
    values = {**raw, "line": raw["verdict"], "by_joint": judged}
    return read_back(Verdict, values, "its verdict")


def format_bodies(standard: Mapping[str, float]) -> list[str]:
    """Returns a line per link: mass, mass centre in its frame, principal moments about it.

    Args:
        standard: standard parameters by name; links of which one of the ten is missing are left
            out.
    """
    lines = []
    for name, mass in standard.items():
        link = name[1:]
        ten = [standard.get(f"{prefix}{link}") for prefix in PREFIXES]
        if not name.startswith("M") or mass <= 0.0 or None in ten:
            continue
        P = compute_pseudo_inertia(np.array(ten, dtype=float))
        centre = P[:3, 3] / mass
        second = P[:3, :3] - mass * np.outer(centre, centre)
        moments = np.linalg.eigvalsh(np.trace(second) * np.eye(3) - second)
        x, m = (", ".join(f"{value:.4g}" for value in values) for values in (centre, moments))
        lines.append(f"link {link}: {mass:.4g} kg, centre ({x}) m, principal moments {m} kg m2")
    return lines
