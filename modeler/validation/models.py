"""Several models on the same rows: which predicts each joint best, and is that significant?"""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtr

from modeler.core.errors import DataError
from modeler.core.json import Document, ShortRepr
from modeler.core.result import Result
from modeler.core.table import align_columns, format_percent
from modeler.estimation import IdentifiedModel
from modeler.regression import Log, Observation
from modeler.runtime import CompiledModel
from modeler.validation.prediction import (
    JointInfo,
    Prediction,
    compute_relative_error,
    compute_unit_errors,
    predict,
)
from modeler.validation.thresholds import THRESHOLDS


@dataclass(frozen=True)
class JointModelComparison(ShortRepr):
    """One joint; m models.

    Attributes:
        joint: it.
        errors: (m,) ||measured - predicted|| / ||measured||.
        rms: (m,) of the residual, N m or N.
        best: index of the model that is significantly better than every other; None: nobody is.
        chance: two-sided, that the best and the next best alternative are equally good; 1 where
            nothing can be reported.
    """

    joint: JointInfo
    errors: tuple[float, ...]
    rms: tuple[float, ...]
    best: int | None
    p_value: float


@dataclass(frozen=True)
class JointModelError:
    """One joint of one model.

    Attributes:
        relative_error: ||measured - predicted|| / ||measured||.
        rms: of the residual, in `unit`.
        unit: "N m" or "N".
        is_best: it is significantly better than every other model.
        p_value: that the best and its nearest rival are equally good.
    """

    relative_error: float
    rms: float
    unit: str
    is_best: bool
    p_value: float


@dataclass(frozen=True)
class ModelErrors:
    """One model of several; the relative errors of all rows, by unit and by joint."""

    model: str
    relative_error: float
    by_unit: Mapping[str, float]
    joints: Mapping[str, JointModelError]
    best_joints: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class ModelComparison(Result, Document):
    """Models side by side, m of them.

    Attributes:
        names: of the models.
        predictions: of each, on the same rows.
        samples: rows that count for at least one joint.
        pooled: (m,) relative errors over all rows as numbers, as `compare` has it.
        by_unit: (m,) relative errors by unit.
        joints: those with rows and a torque.
    """

    KEYS = "robot models"

    names: tuple[str, ...]
    predictions: tuple[Prediction, ...]
    samples: int
    pooled: tuple[float, ...]
    by_unit: tuple[Mapping[str, float], ...]
    joints: tuple[JointModelComparison, ...]

    def find_best_joints(self, model: int) -> list[str]:
        """Finds the joints that the model predicts significantly better than every other."""
        return [item.joint.name for item in self.joints if item.best == model]

    @property
    def robot(self) -> str:
        """Returns the name of the robot."""
        return self.predictions[0].robot

    @property
    def models(self) -> tuple["ModelErrors", ...]:
        """Returns the errors of each model, and where it is the best."""
        return tuple(
            ModelErrors(
                name,
                self.pooled[k],
                self.by_unit[k],
                {
                    item.joint.name: JointModelError(
                        item.errors[k], item.rms[k], item.joint.effort_unit, item.best == k,
                        item.p_value,
                    )
                    for item in self.joints
                },
                tuple(self.find_best_joints(k)),
            )
            for k, name in enumerate(self.names)
        )  # fmt: skip


def compare_models(names: Sequence[str], predictions: Sequence[Prediction]) -> ModelComparison:
    """Compares models joint by joint, with a significance test.

    S_b and T_b are the summed squared residuals of two models on one joint over block b of time, S
    and T those over all B blocks. log(S / T) is judged by Student's t with B - 1 degrees of
    freedom against its standard error, whose square is B / (B - 1) sum_b (S_b / S - T_b / T)^2:
    blocks are paired, and a block that makes most of a difference is no proof. The best of m models
    beats m - 1 others, so the chance of an error is shared among them (Bonferroni).

    Args:
        names: of the models.
        predictions: of each, on the same rows, from `predict_together`.

    Raises:
        DataError: fewer than two models.
    """
    if len(names) < 2 or len(names) != len(predictions):
        raise DataError(f"got {len(predictions)} models to set side by side; expected two or more")
    block = _assign_blocks(predictions[0])
    first = predictions[0]
    return ModelComparison(
        names=tuple(names),
        predictions=tuple(predictions),
        samples=int(first.used.any(axis=1).sum()),
        pooled=tuple(compute_relative_error(prediction) for prediction in predictions),
        by_unit=tuple(compute_unit_errors(prediction) for prediction in predictions),
        joints=tuple(
            _compare_joint(info, j, predictions, block)
            for j, info in enumerate(first.joints)
            if all(p.measured[p.used[:, j], j].any() for p in predictions)
        ),
    )


def _compare_joint(
    info: JointInfo, j: int, predictions: Sequence[Prediction], block: np.ndarray
) -> JointModelComparison:
    used = predictions[0].used[:, j]
    left = [(p.measured - p.predicted)[used, j] for p in predictions]
    size = [float(np.linalg.norm(p.measured[used, j])) for p in predictions]
    norms = [float(np.linalg.norm(e)) for e in left]
    errors = tuple(norm / whole for norm, whole in zip(norms, size, strict=True))
    top = int(np.argmin(errors))
    sums = [np.bincount(block[used], (e / whole) ** 2) for e, whole in zip(left, size, strict=True)]
    rivals = [k for k in range(len(predictions)) if k != top]
    p_values = [_compute_p_value(sums[k], sums[top]) for k in rivals]
    worth = all(errors[top] < (1.0 - THRESHOLDS.min_error_change) * errors[k] for k in rivals)
    return JointModelComparison(
        joint=info,
        errors=errors,
        rms=tuple(norm / math.sqrt(len(left[0])) for norm in norms),
        best=top if worth and max(p_values) < THRESHOLDS.max_p_value / len(rivals) else None,
        p_value=max(p_values),
    )


def _compute_p_value(other: np.ndarray, best: np.ndarray) -> float:
    """Two-sided chance that two models that are equally good differ so much.

    Args:
        other: (blocks,) squared residuals.
        best: (blocks,) those of the better model.
    """
    seen = (other > 0.0) | (best > 0.0)
    count, sums = int(seen.sum()), (float(other.sum()), float(best.sum()))
    if count < THRESHOLDS.min_blocks or min(sums) <= 0.0:
        return 1.0 if sums[0] <= 0.0 or count < THRESHOLDS.min_blocks else 0.0
    shares = other[seen] / sums[0] - best[seen] / sums[1]
    spread = math.sqrt(float(shares @ shares) * count / (count - 1))
    if spread <= 0.0:
        return 1.0 if sums[0] <= sums[1] else 0.0
    return float(2.0 * stdtr(count - 1, -math.log(sums[0] / sums[1]) / spread))


def _assign_blocks(prediction: Prediction) -> np.ndarray:
    """(n,) number of the block of time of each row, none in two logs."""
    runs = np.unique(prediction.run)
    spans = {r: prediction.time[prediction.run == r] for r in runs}
    length = max(
        THRESHOLDS.min_block_seconds,
        sum(float(np.ptp(time)) for time in spans.values()) / THRESHOLDS.max_blocks,
    )
    number, count = np.zeros(prediction.time.size, dtype=int), 0
    for r, time in spans.items():
        pieces = max(1, round(float(np.ptp(time)) / length))
        share = (time - time.min()) / (float(np.ptp(time)) or 1.0)
        number[prediction.run == r] = count + np.minimum((share * pieces).astype(int), pieces - 1)
        count += pieces
    return number


# Several models on the same rows of the same logs.


def predict_together(
    models: Sequence[IdentifiedModel],
    compiled: Sequence[CompiledModel],
    logs: Sequence[Sequence[Log]],
    names: Sequence[str],
) -> tuple[list[Prediction], list[Observation]]:
    """Predicts the same rows with each model.

    All are processed as the first model's logs were, but for a delay, which belongs to its model; a
    row counts if it counts for every model.

    Args:
        models: two or more, of robots with the same joints.
        compiled: their robots.
        logs: the same logs, as each robot reads them.
        names: of the models, for errors.

    Raises:
        DataError: other joints, no usable row, or none that counts for every model.
    """
    check_joints(models, names)
    first = models[0].processing
    made = []
    for model, robot, read in zip(models, compiled, logs, strict=True):
        processing = dataclasses.replace(first, delay=model.processing.delay)
        fit = dataclasses.replace(model.fit, processing=processing)
        made.append(predict(dataclasses.replace(model, fit=fit), read, robot))
    predictions = [prediction for prediction, _ in made]
    for prediction, name in zip(predictions[1:], names[1:], strict=True):
        if not _has_same_rows(predictions[0], prediction):
            raise DataError(
                f"{name}: its rows of these logs are not those of {names[0]}, so errors cannot be "
                "set side by side; expected robots that read the same columns; compare them one "
                "by one"
            )
    used = np.logical_and.reduce([prediction.used for prediction in predictions])
    if not used.any():
        raise DataError(
            f"{', '.join(names)}: no row of these logs counts for every model; compare them one by "
            "one to see why"
        )
    # what counts for one model alone is masked unnamed
    common = [dataclasses.replace(p, used=used, full=None) for p in predictions]
    return common, [observation for _, observation in made]


def _has_same_rows(one: Prediction, other: Prediction) -> bool:
    return (
        one.time.shape == other.time.shape
        and np.array_equal(one.run, other.run)
        and np.array_equal(one.time, other.time)
    )


def check_joints(models: Sequence[IdentifiedModel], names: Sequence[str]) -> None:
    """Refuses models of robots whose joints differ.

    Raises:
        DataError: names the first of them.
    """

    def describe_joints(model: IdentifiedModel) -> list[tuple[str, str]]:
        return [(joint.name, joint.effort_unit) for joint in model.spec.joints]

    for model, name in zip(models[1:], names[1:], strict=True):
        if describe_joints(model) != describe_joints(models[0]):
            said = [
                ", ".join(f"{j} [{u}]" for j, u in describe_joints(m)) for m in (models[0], model)
            ]
            raise DataError(
                f"{name}: joints {said[1]}; expected those of {names[0]}, {said[0]}; only models "
                "of robots with the same joints are set side by side"
            )


# Models side by side in words and as a table of text.


MARK = "*"


def format_model_comparison(comparison: ModelComparison) -> list[str]:
    """Formats errors by joint and model, the significantly best one marked, and conclusions."""
    names = [name.removesuffix(".json").removesuffix(".model") for name in comparison.names]
    rows = [["joint", *names, "unit", "rms", *[""] * (len(names) - 1)]]
    for item in comparison.joints:
        errors = [
            format_percent(error) + (MARK if item.best == k else " ")
            for k, error in enumerate(item.errors)
        ]
        sizes = [f"{rms:.3g}" for rms in item.rms]
        rows.append([item.joint.name, *errors, item.joint.effort_unit, *sizes])
    for unit in comparison.by_unit[0]:
        errors = [format_percent(model_errors[unit]) + " " for model_errors in comparison.by_unit]
        rows.append(["all", *errors, unit, *[""] * len(names)])
    lines = [line.rstrip() for line in align_columns(rows, (0, len(names) + 1))]
    lines.append(f"{comparison.samples} samples; {MARK} significantly better than every other")
    return [*lines, "", *describe_model_comparison(comparison)]


def describe_model_comparison(comparison: ModelComparison) -> list[str]:
    """Describes which model predicts which joints best, and what remains open."""
    said = []
    for k, name in enumerate(comparison.names):
        won = comparison.find_best_joints(k)
        if won:
            which = " and ".join(filter(None, (", ".join(won[:-1]), won[-1])))
            said.append(
                f"{name} predicts joint{'s' * (len(won) > 1)} {which} significantly better."
            )
    doubtful = [
        f"joint {i.joint.name} ({_describe_uncertainty(i)})"
        for i in comparison.joints
        if i.best is None
    ]
    if doubtful:
        said.append(f"No model is significantly better on {', '.join(doubtful)}.")
    return said


def describe_winner(comparison: ModelComparison) -> tuple[str, str]:
    """Returns on how many joints the best model wins, and a sentence."""
    wins = [len(comparison.find_best_joints(k)) for k in range(len(comparison.names))]
    top = max(range(len(wins)), key=wins.__getitem__)
    if not wins[top]:
        return "no winner", "no model is significantly better than the others on any joint"
    count = f"{wins[top]} of {len(comparison.joints)}"
    if wins.count(wins[top]) > 1:
        tied = " and ".join(
            n for n, w in zip(comparison.names, wins, strict=True) if w == wins[top]
        )
        return f"{count} each", f"joints that {tied} predict significantly better"
    lost = sum(wins) - wins[top]
    rest = f"; others on {lost}" if lost else "; no other on any"
    return count, f"joints that {comparison.names[top]} predicts significantly better{rest}"


def _describe_uncertainty(item: JointModelComparison) -> str:
    if item.p_value >= 1.0 or item.p_value < 1e-3:  # too short, or too small a difference
        return "practically equal" if item.p_value < 1e-3 else "too few blocks of time"
    return f"chance alone makes such a difference in {format_percent(item.p_value)} of cases"
