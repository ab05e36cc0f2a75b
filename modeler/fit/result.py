"""What a fit hands back: values, how sure they are, and how much they leave unexplained."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from modeler.core.brief import Brief
from modeler.core.by_unit import POOLED, errors_by_unit, told_by_unit
from modeler.core.errors import DataError, ManifestError
from modeler.core.json_text import nulled
from modeler.core.presented import Presented
from modeler.fit.directions import Directed, directed_from_json, direction_lines
from modeler.fit.energy_report import EnergyReport, energy_report_from_json
from modeler.fit.parameter import ParameterEstimate as ParameterEstimate
from modeler.fit.parameter import parameter_lines, read_parameter
from modeler.fit.reduced import Reduced, reduced_from_json
from modeler.observation import Processing, processing_from_json

_ROUND = "{:.4g}".format


@dataclass(frozen=True)
class JointFit:
    """One joint.

    Attributes:
        name: joint.
        unit: "N m" or "N".
        rows: used.
        relative_error: ||tau - W chi|| / ||tau||, filtered; None without rows or torque.
        rms: of the residual.
        sigma: standard deviation of its rows, the inverse of their weight.
    """

    name: str
    unit: str
    rows: int
    relative_error: float | None
    rms: float
    sigma: float


@dataclass(frozen=True)
class Verdict(Brief):
    """How a fit ends.

    Attributes:
        usable: True if it predicts the torques of motion like that of its logs.
        usable_for: "physics" (its values are those of a machine: simulation, control, other
            motion), "like motion" (torques of motion like that of its logs), "nothing".
        line: for people: usable or not, why, what to do.
        doubts: all that speaks against it.
    """

    usable: bool
    usable_for: str
    line: str
    doubts: tuple[str, ...]

    def warning(self) -> list[str]:
        """A line for whoever uses a model that is not usable; none for one that is."""
        return [] if self.usable else [f"the fit of this model is {self.line}"]


@dataclass(frozen=True, eq=False)
class FitResult(Presented):
    """A fitted model.

    Attributes:
        robot: name.
        method: id of the estimator, see `core.estimators`.
        status: "ok" | "rank deficient" | "not settled".
        samples: after decimation.
        rows: of W.
        condition_number: of W, parameters set aside left out.
        condition_scaled: with columns of length one.
        relative_error: ||y - W beta|| / ||y||, after the same filter on both sides.
        essential_error: the same with the essential parameters only.
        joints: in the order of the manifest.
        parameters: (c,) base parameters in the order of the manifest.
        covariance: (c, c) of their values; 0 for those set aside.
        loads: parameters of payloads, named `M6_load`; empty without payloads.
        sentences: what a reader must know, plain text.
        processing: with all choices filled in; use it for held-out logs.
        verdict: usable or not; None if nobody has judged it.
        standard: all standard parameters by name, SI, of an estimator that ends in them.
        own: those of the sentences that the estimator says of itself; not kept in model files.
        essential: the reduced model; None if it has no parameter, or in files that lack it.
        directions: friction by direction, of joints whose viscous friction differs.
        energy: how it compares with the torque model; None for the torque model itself.
        gains: drive gains, named `g_tau1`, N m or N per drive unit; empty if none were fitted.
        singular_values: that tell the gains apart, descending; 1 is noise (see `estimate.tls`).
        reading: of long logs: passes, chunks, rows, windows, rows_in_windows; empty of others.
        by_load: the joints on the "bare" and on the "loaded" logs; empty without payloads.
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
    own: tuple[str, ...] = ()
    essential: Reduced | None = None
    directions: tuple[Directed, ...] = ()
    energy: EnergyReport | None = None
    gains: tuple[ParameterEstimate, ...] = ()
    singular_values: tuple[float, ...] = ()
    reading: Mapping[str, int] = field(default_factory=dict)
    by_load: Mapping[str, tuple[JointFit, ...]] = field(default_factory=dict)

    @property
    def beta(self) -> np.ndarray:
        """(c,) values of the base parameters, manifest order, SI units."""
        return np.array([parameter.value for parameter in self.parameters])

    @property
    def by_unit(self) -> dict[str, float]:
        """Relative error over the joints of one unit, by unit; NaN without torque."""
        return errors_by_unit(
            (joint.unit, left, left / joint.relative_error**2 if joint.relative_error else 0.0)
            for joint in self.joints
            for left in [joint.rows * joint.rms**2]
        )

    def error_told(self, form: str = "{:.3f} %") -> str:
        """The relative error as text; of torques and forces apart where the robot has both."""
        if self.energy is None and len(self.by_unit) > 1:
            return told_by_unit(self.by_unit, form)
        return form.format(100.0 * self.relative_error)

    def lines(self) -> list[str]:
        """Lines of text: parameters, joints, remarks, the verdict last."""

        def share(joint: JointFit) -> str:
            error = joint.relative_error
            return "-" if error is None else f"{100.0 * error:.2f} %"

        alone = self.essential.parameters if self.essential and self.essential.dropped else ()
        lines = parameter_lines((*self.gains, *self.parameters, *self.loads), alone)
        lines += direction_lines(self.directions)
        lines += [
            f"{self.rows} rows of {self.samples} samples, condition number "
            f"{self.condition_number:.4g} ({self.condition_scaled:.4g} with columns of length one)",
            f"relative error {self.error_told()}",
        ]
        for k, joint in enumerate(self.joints):
            apart = "".join(f", {name} {share(own[k])}" for name, own in self.by_load.items())
            lines.append(
                f"  joint {joint.name}: {share(joint)}{apart}, rms {joint.rms:.4g} {joint.unit}"
            )
        lines += [*bodies_told(self.standard), *self.sentences]
        lines += self.essential.lines() if self.essential is not None else []
        lines += self.energy.lines() if self.energy is not None else []
        if self.verdict is not None:
            others = (line for line in self.verdict.doubts if line not in self.verdict.line)
            lines += [*(f"doubt: {line}" for line in others), self.verdict.line]
        return lines

    def to_json(self) -> dict[str, Any]:
        """The `fit` object that scripts read; numbers that mean nothing are null."""
        return nulled({
            "robot": self.robot,
            "method": self.method,
            "status": self.status,
            "samples": self.samples,
            "rows": self.rows,
            "condition_number": self.condition_number,
            "condition_scaled": self.condition_scaled,
            "relative_error": self.relative_error,
            "relative_error_pools": POOLED,
            "by_unit": self.by_unit,
            "essential_error": self.essential_error,
            "joints": _joints_to_json(self.joints),
            "by_load": {
                name: {"relative_error": pooled(own), "joints": _joints_to_json(own)}
                for name, own in self.by_load.items()
            },
            "parameters": [parameter.to_json() for parameter in self.parameters],
            "loads": [parameter.to_json() for parameter in self.loads],
            "gains": [parameter.to_json() for parameter in self.gains],
            "singular_values": list(self.singular_values),
            "sentences": list(self.sentences),
            "processing": self.processing.to_json(),
            "standard": dict(self.standard),
            "essential": None if self.essential is None else self.essential.to_json(),
            "directions": [item.to_json() for item in self.directions],
            "model": "torque" if self.energy is None else "energy",
            "energy": None if self.energy is None else self.energy.to_json(),
            **_verdict_to_json(self.verdict),
            **({"reading": dict(self.reading)} if self.reading else {}),
        })  # fmt: skip


def fit_from_json(raw: Mapping[str, Any], covariance: np.ndarray) -> FitResult:
    """Read `FitResult.to_json` back; the covariance is stored beside it.

    Raises:
        ManifestError: an entry is missing or of the wrong kind; names it.
    """
    try:
        return FitResult(
            robot=raw["robot"],
            method=raw["method"],
            status=raw["status"],
            samples=int(raw["samples"]),
            rows=int(raw["rows"]),
            condition_number=_number(raw["condition_number"]),
            condition_scaled=_number(raw["condition_scaled"]),
            relative_error=_number(raw["relative_error"], float("nan")),
            essential_error=_number(raw["essential_error"], float("nan")),
            joints=_joints_from_json(raw["joints"]),
            parameters=tuple(read_parameter(entry) for entry in raw["parameters"]),
            covariance=covariance,
            loads=tuple(read_parameter(entry) for entry in raw["loads"]),
            sentences=tuple(raw["sentences"]),
            processing=processing_from_json(raw["processing"]),
            verdict=_verdict_from_json(raw),
            standard={str(k): float(v) for k, v in raw.get("standard", {}).items()},
            essential=reduced_from_json(raw.get("essential")),
            directions=tuple(directed_from_json(item) for item in raw.get("directions", ())),
            energy=energy_report_from_json(raw.get("energy")),
            gains=tuple(read_parameter(entry) for entry in raw.get("gains", [])),
            singular_values=tuple(map(float, raw.get("singular_values", []))),
            reading={str(k): int(v) for k, v in raw.get("reading", {}).items()},
            by_load={
                str(name): _joints_from_json(own["joints"])
                for name, own in raw.get("by_load", {}).items()
            },
        )
    except (KeyError, TypeError, ValueError, AttributeError, DataError) as error:
        raise ManifestError(f"the fit is damaged ({error}); fit the model again") from None


def pooled(joints: Sequence[JointFit]) -> float:
    """||y - W beta|| / ||y|| over joints; NaN without torque."""
    seen = [joint for joint in joints if joint.relative_error]
    left = sum(joint.rows * joint.rms**2 for joint in seen)
    total = sum(j.rows * (j.rms / j.relative_error) ** 2 for j in seen if j.relative_error)
    return float(np.sqrt(left / total)) if total else float("nan")


def _joints_to_json(joints: Sequence[JointFit]) -> dict[str, Any]:
    return {
        joint.name: {
            "relative_error": joint.relative_error,
            "rms": joint.rms,
            "sigma": joint.sigma,
            "rows": joint.rows,
            "unit": joint.unit,
        }
        for joint in joints
    }


def _joints_from_json(raw: Mapping[str, Any]) -> tuple[JointFit, ...]:
    return tuple(JointFit(name=name, **entry) for name, entry in raw.items())


def _verdict_to_json(verdict: Verdict | None) -> dict[str, Any]:
    if verdict is None:
        return {"usable": None, "usable_for": None, "verdict": None, "doubts": []}
    return {
        "usable": verdict.usable,
        "usable_for": verdict.usable_for,
        "verdict": verdict.line,
        "doubts": list(verdict.doubts),
    }


def _verdict_from_json(raw: Mapping[str, Any]) -> Verdict | None:
    """None where nobody has judged the fit, as in files of earlier versions."""
    usable, line, doubts = raw.get("usable"), raw.get("verdict"), raw.get("doubts", [])
    if usable is None:
        return None
    if not (isinstance(usable, bool) and isinstance(line, str) and isinstance(doubts, list)):
        raise ValueError("its verdict is not as saved")
    return Verdict(usable, str(raw["usable_for"]), line, tuple(map(str, doubts)))


def _number(value: float | None, unknown: float = float("inf")) -> float:
    return unknown if value is None else float(value)


def bodies_told(standard: Mapping[str, float]) -> list[str]:
    """A line per link: mass, mass centre in its frame, principal moments about the mass centre.

    Args:
        standard: standard parameters by name; links of which one of the ten is missing are left
            out.
    """
    lines = []
    for link in [
        name[1:] for name in standard if name.startswith("M") and _is_link(name, standard)
    ]:
        mass, centre, moments = _body(link, standard)
        lines.append(
            f"link {link}: {_ROUND(mass)} kg, centre ({', '.join(map(_ROUND, centre))}) m, "
            f"principal moments {', '.join(map(_ROUND, moments))} kg m2"
        )
    return lines


def _is_link(name: str, standard: Mapping[str, float]) -> bool:
    prefixes = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ")
    return standard[name] > 0.0 and all(f"{p}{name[1:]}" in standard for p in prefixes)


def _body(link: str, standard: Mapping[str, float]) -> tuple[float, np.ndarray, np.ndarray]:
    xx, xy, xz, yy, yz, zz, mx, my, mz, mass = (
        standard[f"{p}{link}"] for p in ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
    )
    centre = np.array([mx, my, mz]) / mass
    origin = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    about = origin - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    return mass, centre, np.linalg.eigvalsh(about)
