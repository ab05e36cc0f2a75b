"""What the true form of a law takes of the error on held-out motion."""

from dataclasses import dataclass

import numpy as np

from modeler import api
from modeler.diagnosis import SignalReference, analyse_logs
from modeler.diagnosis.candidates import Rows, build_rows
from modeler.diagnosis.state import observe_in_band
from tests.unnamed_laws.laws import Motion, TrueForm
from tests.unnamed_laws.machines import Machine

PASSES = 3  # of least squares with the deviations of the joints


@dataclass(frozen=True)
class Errors:
    """(n,) rms error of each joint on held-out motion, in percent of the rms torque.

    Attributes:
        without, with_form: of the refitted robot file alone, and with the column of the true form.
    """

    without: np.ndarray
    with_form: np.ndarray

    @property
    def taken(self) -> np.ndarray:
        """(n,) share of the error that the true form takes."""
        return 1 - self.with_form / self.without


def rows_of_machine(own: Machine) -> tuple[Rows, Rows]:
    """Rows of the training and the held-out logs, in the band of a diagnosis."""
    model = api.open_model(own.model)
    compiled = api.compile(model)
    train, holdout = (api.read_logs(compiled, logs) for logs in (own.train, own.holdout))
    seen = analyse_logs(compiled, train, model.processing)
    held = observe_in_band(compiled, holdout, seen.report.processing)
    reference = SignalReference(compiled, model.beta, 0.0, {})
    return build_rows(seen, reference), build_rows(held, reference)


def true_column(rows: Rows, form: TrueForm) -> np.ndarray:
    """(rows of its joint, 1) column of the true form, filtered as the rows are."""
    seen = [Motion(s.q, s.v, s.a, s.load, s.time) for s in rows.signals]
    return rows.filter_samples(form.joint, [form.column(motion) for motion in seen])[:, None]


def errors(own: Machine) -> Errors:
    """Without and with the true form, if there is one; all parameters fitted anew to training."""
    train, held = rows_of_machine(own)
    size = [np.sqrt((y**2).mean()) for y in held.y]
    values = []
    for form in (None, own.truth):
        fitted, seen = (
            matrices(rows) if form is None else matrices(rows, form.joint, true_column(rows, form))
            for rows in (train, held)
        )
        beta = least_squares(train.y, fitted)
        left = zip(held.y, seen, strict=True)
        values.append(np.array([np.sqrt(((y - W @ beta) ** 2).mean()) for y, W in left]))
    return Errors(*(100 * error / size for error in values))


def matrices(rows: Rows, j: int = 0, more: np.ndarray | None = None) -> list[np.ndarray]:
    """Base columns by joint, and (rows of joint j, k) more on joint j."""
    if more is None:
        return list(rows.W)
    none = [np.zeros((len(W), more.shape[1])) for W in rows.W]
    return [np.column_stack([W, more if k == j else none[k]]) for k, W in enumerate(rows.W)]


def least_squares(y: tuple[np.ndarray, ...], W: list[np.ndarray]) -> np.ndarray:
    """(c,) joints weighed by their deviations."""
    sigma = [float(item.std()) for item in y]
    beta = np.zeros(W[0].shape[1])
    for _ in range(PASSES):
        matrix = np.vstack([entry / s for entry, s in zip(W, sigma, strict=True)])
        right = np.concatenate([local / s for local, s in zip(y, sigma, strict=True)])
        scale = np.linalg.norm(matrix, axis=0) + 1e-30
        beta = np.linalg.lstsq(matrix / scale, right, rcond=1e-10)[0] / scale
        sigma = [float((actual - w @ beta).std()) for actual, w in zip(y, W, strict=True)]
    return beta
