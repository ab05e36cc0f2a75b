"""The chain that is asked: a case fitted, diagnosed, and mended by what the diagnosis names."""

import dataclasses
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

from modeler import api
from modeler.diagnosis.add import add_findings
from modeler.diagnosis.added_model import LogSplit, build_rows, compute_residuals
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.diagnosis.scoring import Residuals, Score, score_change
from modeler.estimation.model_file import IdentifiedModel
from modeler.regression import THRESHOLDS
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.runtime.model import CompiledModel, load_module as load_compiled
from tests.chain import Chain, chain_of
from tests.measured_sets.answer import Answer
from tests.measured_sets.sanity import faults
from tests.measured_sets.sets import SETS, Case


@dataclasses.dataclass(frozen=True, eq=False)
class Fitted:
    """A set fitted in one direction.

    Attributes:
        chain: its robot.
        model: with the cut-offs that the fit chose.
        logs: fitted and held out.
    """

    chain: Chain
    model: IdentifiedModel
    logs: LogSplit


def diagnosed(case: Case, data: Path) -> Answer:
    """What `modeler diagnose` says, and what is wrong with its values."""
    seconds: dict[str, float] = {}
    with _clock(seconds, "robot"):
        chain_of(SETS[case.set].robot())
    with _clock(seconds, "fit"):
        fitted = _fitted(case.set, case.direction, data)
        if case.factor != 1.0:
            fitted = _at(fitted, case.factor)
    with _clock(seconds, "diagnosis"):
        result = _found(fitted)
    return Answer(case, result.to_json(), seconds, faults(result))


def improved(case: Case, data: Path) -> Answer:
    """What `modeler add auto` makes of the model, and the error of the held-out motion."""
    seconds: dict[str, float] = {}
    with _clock(seconds, "fit"):
        fitted = _fitted(case.set, case.direction, data)
    with _clock(seconds, "diagnosis"):
        result = _found(fitted)
    with _clock(seconds, "add"):
        findings = [*result.effects, *result.refinements]
        better, left_out = add_findings(fitted.model, fitted.chain.compiled, findings, fitted.logs)
    score = score_change(
        _unseen(fitted, fitted.model, fitted.chain.compiled),
        _unseen(fitted, better, load_compiled(better.spec, better.sources)),
    )
    return Answer(case, _told(better, left_out, score), seconds)


def _told(better: IdentifiedModel, left_out: tuple[str, ...], score: Score) -> dict[str, Any]:
    """Plain data of a model with effects added."""
    return {
        "joints": {name: list(pair) for name, pair in score.errors.items()},
        "whole": score.whole.after,
        "scatter": score.whole.t_ratio,
        "rises": [change.joint for change in score.joints if change.is_increased],
        "spoilt": score.has_spoilt_joint,
        "kept": [step.to_json() for step in better.history[1:]],
        "left_out": [line.removeprefix("left out: ") for line in left_out],
    }


@contextmanager
def _clock(seconds: dict[str, float], name: str) -> Iterator[None]:
    start = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - start


@lru_cache(maxsize=1)
def _fitted(name: str, direction: str, data: Path) -> Fitted:
    """With the default processing; the cases of one direction come one after the other."""
    chain = chain_of(SETS[name].robot())
    logs = LogSplit(
        *(api.read_logs(chain.compiled, some) for some in SETS[name].logs(data, direction))
    )
    return Fitted(chain, chain.fit(logs.training), logs)


def _at(fitted: Fitted, factor: float) -> Fitted:
    """Fitted anew with both cut-offs given: those that were chosen, times a factor."""
    processing = scaled(fitted.model.processing, factor, fitted.logs.training)
    return dataclasses.replace(fitted, model=fitted.chain.fit(fitted.logs.training, processing))


def scaled(chosen: Processing, factor: float, logs: Sequence[Log]) -> Processing:
    """The defaults with both cut-offs given, as far as the sampling rate goes."""
    highest = THRESHOLDS.max_cutoff_share / max(log.step for log in logs)
    pair = (chosen.position_cutoff, chosen.parallel_cutoff)
    wanted = (min(factor * (cutoff or 0.0), highest) for cutoff in pair)
    position, parallel = (float(f"{cutoff:.6g}") for cutoff in wanted)
    return Processing(position_cutoff=position, parallel_cutoff=parallel)


def _found(fitted: Fitted) -> Diagnosis:
    robot, logs = fitted.chain.derivation.robot, fitted.logs
    known = StatedEffects(robot.catalogue, robot.coupling)
    return diagnose(fitted.model, fitted.chain.compiled, logs.training, logs.held_out, known=known)


def _unseen(fitted: Fitted, model: IdentifiedModel, compiled: CompiledModel) -> Residuals:
    rows = build_rows(compiled, fitted.logs, model.processing)
    return compute_residuals(model, compiled, rows.observations[-1])
