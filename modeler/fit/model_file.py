"""The MODEL file: one JSON file with all that later commands need; it can be mailed."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler.core.contract import ModuleSpec, module_from_json
from modeler.core.errors import ManifestError
from modeler.core.files import write_atomically
from modeler.fit.result import FitResult, fit_from_json
from modeler.observation import DataReport, Log, Processing
from modeler.observation.log import shared_rows

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

FORMAT = 2
KIND = "modeler model"


@dataclass(frozen=True)
class LogProvenance:
    """A log the model was fitted on.

    Attributes:
        name: its file name, no folder.
        rows: read.
        samples: after decimation.
        content: fingerprint of the whole file's measurements; it tells the file under any name.
        start, end: s, first and last row that was used of it.
    """

    name: str
    rows: int
    samples: int
    content: str
    start: float
    end: float

    def shares_rows(self, log: Log) -> bool:
        """True if rows of `log` were fitted."""
        return shared_rows(log, self.content, self.start, self.end)


@dataclass(frozen=True)
class Addition:
    """One effect that was added to a model.

    Attributes:
        effect: id; "" for the model as it was first fitted.
        joint: name; None for an effect of the whole robot.
        shapes: values of its shape parameters, SI.
        error: relative error on held-out logs with it; on the fitted logs where none were given.
        training_error: relative error on the fitted logs.
        held_out: names of the held-out logs.
        robot_text: the robot file with it.
        delay: s, of the processing with it.
    """

    effect: str
    joint: str | None
    shapes: Mapping[str, float]
    error: float
    training_error: float
    held_out: tuple[str, ...]
    robot_text: str
    delay: float = 0.0

    def to_json(self) -> dict[str, Any]:
        """Plain data, without the robot file."""
        return {
            "effect": self.effect or None,
            "joint": self.joint,
            "error": self.error,
            "training_error": self.training_error,
            "shapes": dict(self.shapes),
            "held_out": list(self.held_out),
        }


@dataclass(frozen=True, eq=False)
class IdentifiedModel:
    """A robot with values.

    Attributes:
        robot_text: the robot file, TOML.
        spec: the manifest.
        sources: C sources by file name.
        fit: the estimate; `fit.processing` is how its data were processed.
        logs: what it was fitted on.
        history: the model as first fitted and every effect added since; empty before the first.
    """

    robot_text: str
    spec: ModuleSpec
    sources: Mapping[str, str]
    fit: FitResult
    logs: tuple[LogProvenance, ...]
    history: tuple[Addition, ...] = ()

    @property
    def beta(self) -> np.ndarray:
        """(c,) base parameters, manifest order."""
        return self.fit.beta

    @property
    def covariance(self) -> np.ndarray:
        """(c, c) of beta."""
        return self.fit.covariance

    @property
    def processing(self) -> Processing:
        """How the fitted data were processed; use it for held-out logs."""
        return self.fit.processing

    def compile(self) -> "CompiledModel":
        """The compiled robot.

        Raises:
            BuildError: no C compiler, or it refused the sources.
        """
        # Only here: a model file can be read and printed where there is no compiler.
        from modeler.compiled import load

        return load(self.spec, self.sources)


def provenance(report: DataReport) -> tuple[LogProvenance, ...]:
    """Which logs went into an observation."""
    return tuple(
        LogProvenance(log.name, log.rows, log.samples, log.content, *log.span)
        for log in report.logs
    )


def _provenance_from_json(raw: Any) -> LogProvenance:
    log = LogProvenance(**raw)
    texts, numbers = (log.name, log.content), (log.rows, log.samples, log.start, log.end)
    if not all(isinstance(value, str) for value in texts):
        raise ValueError(f"log {log.name!r}: its name and content are texts")
    if not all(isinstance(value, int | float) for value in numbers):
        raise ValueError(f"log {log.name}: its rows, samples and times are numbers")
    return log


def save_model(path: str | Path, model: IdentifiedModel) -> None:
    """Write the model file; an interrupted write leaves the old file.

    Raises:
        ModelerError: the folder cannot be written.
    """
    content = {
        "kind": KIND,
        "format": FORMAT,
        "robot": model.spec.robot,
        "signature": model.spec.signature(),
        "fit": model.fit.to_json(),
        "covariance": model.fit.covariance.tolist(),
        "logs": [vars(log) for log in model.logs],
        "robot_text": model.robot_text,
        "history": [vars(step) for step in model.history],
        "manifest": json.loads(model.spec.to_json()),
        "sources": dict(model.sources),
    }
    write_atomically(Path(path), json.dumps(content, indent=1, allow_nan=False) + "\n")


def _check_values(fit: FitResult, path: Path) -> None:
    for p in fit.parameters:
        if not isinstance(p.value, (int, float)) or not np.isfinite(p.value):
            raise ManifestError(
                f"{path}: the value of {p.name} is {p.value!r}; expected a finite number; fit the "
                "model again"
            )


def load_model(path: str | Path) -> IdentifiedModel:
    """Read a model file.

    Raises:
        ManifestError: missing, not a model file, of another format, or damaged.
    """
    path = Path(path)
    raw = _read(path)
    spec = module_from_json(json.dumps(_entry(raw, "manifest", dict, path)), f"{path}, manifest")
    if _entry(raw, "signature", str, path) != spec.signature():
        raise ManifestError(
            f"{path}: the manifest does not match its signature, so it was changed after it was "
            "saved; fit the model again"
        )
    values, given = _entry(raw, "covariance", list, path), _entry(raw, "logs", list, path)
    fitted = _entry(raw, "fit", dict, path)
    try:
        covariance = np.array(values, dtype=float)
        history = tuple(_addition(entry) for entry in raw.get("history", []))
        logs = tuple(_provenance_from_json(entry) for entry in given)
        fit = fit_from_json(fitted, covariance)
    except (TypeError, ValueError, KeyError) as error:
        raise ManifestError(f"{path}: damaged ({error}); fit the model again") from None
    except ManifestError as error:
        raise ManifestError(f"{path}: {error}") from None
    expected = [base.name for base in spec.base]
    if [p.name for p in fit.parameters] != expected or covariance.shape != (len(expected),) * 2:
        raise ManifestError(
            f"{path}: the values are not those of the {len(expected)} base parameters of its "
            "manifest; fit the model again"
        )
    _check_values(fit, path)
    return IdentifiedModel(
        robot_text=_entry(raw, "robot_text", str, path),
        spec=spec,
        sources=_entry(raw, "sources", dict, path),
        fit=fit,
        logs=logs,
        history=history,
    )


def _addition(raw: Any) -> Addition:
    step = Addition(**{**raw, "held_out": tuple(raw["held_out"])})
    if not isinstance(step.robot_text, str) or not isinstance(step.error, int | float):
        raise ValueError("a step of the history is not as saved")
    return step


def _read(path: Path) -> dict[str, Any]:
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ManifestError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    except (json.JSONDecodeError, UnicodeDecodeError):
        raise ManifestError(
            f"{path}: not a model file, or cut off; expected the output of `modeler fit --out`"
        ) from None
    if not isinstance(raw, dict) or raw.get("kind") != KIND:
        raise ManifestError(
            f"{path}: JSON, but not a model file; expected the output of `modeler fit --out`"
        )
    if raw.get("format") != FORMAT:
        raise ManifestError(
            f"{path}: model format {raw.get('format')}, this version reads {FORMAT}; fit the "
            "model again"
        )
    return raw


def _entry(raw: Mapping[str, Any], name: str, kind: type, path: Path) -> Any:
    if not isinstance(raw.get(name), kind):
        raise ManifestError(
            f"{path}: damaged, {name} is {'missing' if name not in raw else 'not as saved'}; fit "
            "the model again"
        )
    return raw[name]
