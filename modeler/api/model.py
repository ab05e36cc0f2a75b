"""A model as one object: its parameters, what it predicts, what it lacks, what it is made into."""

from __future__ import annotations  # what a signature names need not be loaded

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from statistics import NormalDist
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler import diagnosis, estimation, validation, views
from modeler.api import checks
from modeler.api.checks import predict_torque
from modeler.api.log_maps import Mapped
from modeler.api.workflow import AnyLog, Logs, compile, convert_to_list, generate, observe
from modeler.core.errors import DataError
from modeler.core.files import read_file
from modeler.core.manifest import EmittedModule
from modeler.core.table import label_values
from modeler.estimation import IdentifiedModel, ParameterEstimate, model_file
from modeler.formats import read_robot
from modeler.regression import Log, Observation
from modeler.robot import Robot, suggest_name

if TYPE_CHECKING:
    from modeler.formats import Exported

_SURE = NormalDist().inv_cdf(0.975)  # of a 95 % interval


@dataclass(frozen=True, repr=False)
class Parameter(ParameterEstimate):
    """One parameter of a model; `float` of it is the value.

    >>> model["ZZ1R"].unit, model["ZZ1R"].relation
    ('kg m2', 'ZZ1R = ZZ1 + L1**2*M2')

    Attributes:
        relation: what it is the sum of, `ZZ1R = ZZ1 + L1**2*M2`; "" of what stands for itself.
    """

    relation: str = ""

    def conf_int(self, level: float = 0.95) -> tuple[float, float]:
        """Returns the confidence interval, for normally distributed errors.

        Args:
            level: 0.95 for 95 %.

        Raises:
            DataError: no such level.
        """
        wide = _compute_half_width(level)
        if self.sigma is None:
            return float("nan"), float("nan")
        if self.interval is not None:  # of an effect whose shapes were fitted too
            low, high = ((side - self.value) * wide / _SURE for side in self.interval)
            return self.value + low, self.value + high
        return self.value - wide * self.sigma, self.value + wide * self.sigma

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        if self.sigma is None:
            return f"{self.name}: fixed, not identifiable from these logs"
        relation = f"  ({self.relation})" if self.relation else ""
        return f"{self.name} = {self.value:.6g} +- {self.sigma:.2g} {self.unit}{relation}"


def _compute_half_width(level: float) -> float:
    """Half the width of an interval, in standard deviations."""
    if not 0.5 <= level < 1.0:
        raise DataError(
            f"conf_int: got {level:g}; expected the level of the interval, as 0.95 for 95 %"
        )
    return NormalDist().inv_cdf(0.5 + 0.5 * level)


@dataclass(frozen=True, eq=False)
class Model(IdentifiedModel):
    """A model with all that can be asked of it.

    >>> model = identify("two-link", simulate(load("two-link"), duration=6.0, seed=1))
    >>> model["ZZ1R"].relation
    'ZZ1R = ZZ1 + L1**2*M2'
    >>> bool(model.error(simulate(load("two-link"), duration=6.0, seed=2)) < 0.01)
    True

    What is a Series or a DataFrame below is one where pandas is installed; else a dict.

    Attributes:
        given: logs that it was fitted on, of those that came from no file.
        held_out: logs that were kept from the fit: paths, or what was read of frames.
        folder: in which it was made, or of the file that it was opened from: paths of its logs
            may be relative to it.
    """

    in_memory_logs: tuple[Log, ...] = ()
    held_out: tuple[AnyLog, ...] = ()
    folder: str = ""

    @classmethod
    def from_identified(cls, model: IdentifiedModel, **more: Any) -> Model:
        """Returns an identified model as an object of this class."""
        fields = {f.name: getattr(model, f.name) for f in dataclasses.fields(IdentifiedModel)}
        return cls(**fields, **more)

    def __repr__(self) -> str:
        return f"Model({self.summary().splitlines()[0].removeprefix('model of ')})"

    # Its parameters, one by one and together.

    def __getitem__(self, name: str) -> Parameter:
        """One parameter: value, sigma, unit, `conf_int(0.95)`, `relation`.

        Raises:
            DataError: it is no parameter of the model; says which one holds it.
        """
        parameter = self._parameters.get(name)
        if parameter is None:
            raise DataError(f'model["{name}"]: {self._explain_absent(str(name))}')
        return parameter

    def __contains__(self, name: object) -> bool:
        return name in self._parameters

    __iter__ = None  # no list of anything: `params` lists the parameters

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._parameters)

    @cached_property
    def _parameters(self) -> dict[str, Parameter]:
        sums = {base.name: views.format_relation(base) or base.column_of for base in self.spec.base}
        parameters = {}
        every = (*self.fit.gains, *self.fit.parameters, *self.fit.elastic, *self.fit.loads)
        for one in every:
            terms = sums.get(one.name, one.name)
            relation = "" if terms == one.name else f"{one.name} = {terms}"
            parameters[one.name] = Parameter(**vars(one), relation=relation)
        for direction in self.fit.directions:
            plain = (
                direction.name,
                direction.unit,
                direction.value,
                direction.sigma,
                True,
                "estimated",
            )
            parameters.setdefault(direction.name, Parameter(*plain, relation=direction.relation))
        return parameters

    def _explain_absent(self, name: str) -> str:
        """Why there is no parameter of that name."""
        holds = [b.name for b in self.spec.base if any(t.parameter == name for t in b.terms)]
        if holds:
            one = self._parameters[holds[0]]
            verb = "holds" if len(holds) == 2 else "hold"
            others = f" ({', '.join(holds[1:])} {verb} it too)" if holds[1:] else ""
            return (
                f"the torques fix no value of {name} alone; {one.relation} holds it{others}: ask "
                f'for model["{one.name}"]'
            )
        if name in self.spec.unidentifiable:
            return f"{name} has no effect on any torque of {self.spec.robot}, so no log shows it"
        known = list(self._parameters)
        return f"no such parameter{suggest_name(name, known)}; expected one of {', '.join(known)}"

    @property
    def _parameter_names(self) -> list[str]:
        return [parameter.name for parameter in self.fit.parameters]

    @property
    def _parameter_sigmas(self) -> np.ndarray:
        return np.array([np.nan if p.sigma is None else p.sigma for p in self.fit.parameters])

    @property
    def params(self) -> Any:
        """Returns the base parameters by name, SI units: a Series.

        >>> bool(model.params["Fv1"] == model["Fv1"].value)
        True
        """
        return label_values(self.beta, self._parameter_names)

    @property
    def bse(self) -> Any:
        """Returns the standard deviations; NaN for parameters that are fixed.

        >>> bool(model.bse["Fv1"] == model["Fv1"].sigma)
        True
        """
        return label_values(self._parameter_sigmas, self._parameter_names)

    def conf_int(self, level: float = 0.95) -> Any:
        """Returns confidence intervals: a DataFrame with the columns `lower` and `upper`.

        >>> list(model.conf_int(0.9).columns)
        ['lower', 'upper']

        Args:
            level: 0.95 for 95 %; it is 1 - alpha of statsmodels.

        Raises:
            DataError: no such level.
        """
        sides = np.array([self._parameters[name].conf_int(level) for name in self._parameter_names])
        return label_values(sides, self._parameter_names, ["lower", "upper"])

    def cov_params(self) -> Any:
        """Returns the covariance of the base parameters: a DataFrame.

        >>> model.cov_params().shape
        (10, 10)
        """
        return label_values(self.covariance, self._parameter_names, self._parameter_names)

    # Its logs, and others: what it predicts, how well.

    @property
    def nobs(self) -> int:
        """Returns the number of rows of the fit.

        >>> model.nobs == model.fit.rows
        True
        """
        return self.fit.rows

    @property
    def fittedvalues(self) -> Any:
        """Returns the predicted torque on the rows of the fit: a DataFrame, a column a joint.

        NaN where a row does not count. It needs the logs of the fit, found unchanged.
        """
        rows = self._fit_observation
        return self._attach_row_labels(rows.predict(self.beta))

    @property
    def resid(self) -> Any:
        """Returns measured minus predicted torque on the rows of the fit.

        >>> list(model.resid.columns)
        ['tau1', 'tau2']
        """
        rows = self._fit_observation
        return self._attach_row_labels(rows.torque - rows.predict(self.beta))

    def _attach_row_labels(self, values: np.ndarray) -> Any:
        rows = self._fit_observation
        logs = np.array(rows.logs)[rows.run]
        names = [f"tau{joint.name}" for joint in rows.joints]
        values = np.where(rows.used, values, np.nan)
        return label_values(values, {"log": logs, "time": rows.time}, names)

    @cached_property
    def _fit_observation(self) -> Observation:
        return observe(compile(self), self.find_logs(None, "resid"), self.processing)

    def predict(self, log: AnyLog, mapping: Mapped = ()) -> Any:
        """Predicts the torque at every row of a log, in its names and units.

        >>> run = simulate(robot, duration=2.0, seed=1)
        >>> model.predict({"time": run.time, "q": run.q})["tau"].shape
        (2000, 2)

        Args:
            log: positions over time, and velocities and accelerations if there are any.
            mapping: as of `read_logs`.

        Returns:
            A frame of the same library for a frame, a dict for a dict (with an array `tau` if that
            is how it came), a DataFrame of pandas for a file. NaN at the ends, where the filter of
            the positions starts up, and in gaps.

        Raises:
            DataError: the log cannot be read, or lacks a position.
        """
        return predict_torque(self, compile(self), log, mapping)

    def compare(self, logs: Logs | None = None, mapping: Mapped = ()) -> validation.Comparison:
        """Compares measured with predicted torque; None: on the held-out logs.

        >>> model.compare().prediction.logs
        ('tue.parquet',)
        """
        return checks.compare(self, self._select_test_logs(logs, "compare"), mapping)

    def error(self, logs: Logs | None = None, mapping: Mapped = ()) -> float:
        """Returns the relative error of the torque, ||measured - predicted|| / ||measured||.

        >>> model.error("tue.parquet") == model.error()
        True

        After the same filters on both sides, all joints together; `compare` has it by joint.

        Args:
            logs: of motion that was not fitted; None: those that were held out.
            mapping: as of `read_logs`.
        """
        test_logs = self._select_test_logs(logs, "error")
        return checks.compare(self, test_logs, mapping).relative_error

    def missing(
        self,
        held_out: Logs | None = None,
        logs: Logs | None = None,
        without: Sequence[str] = (),
        mapping: Mapped = (),
    ) -> diagnosis.Diagnosis:
        """Finds the physical effects that the model lacks, ranked, with their status.

        >>> found = model.missing()
        >>> len(found), found[0].effect
        (1, 'spring')

        Args:
            held_out: logs of other motion, on which errors are reported; None: those of `identify`.
            logs: of the fit; None: they are found again, if they have not changed.
            without: effects that are not looked for, as "backlash" or "spring@2".
            mapping: as of `read_logs`.
        """
        held_out_logs = self.held_out if held_out is None else convert_to_list(held_out)
        fit_logs = self.find_logs(logs, "missing")
        from modeler.api import improve  # a fit has no use for it

        return improve.diagnose(
            self, fit_logs, held_out_logs, mapping=mapping, without=tuple(without)
        )

    def add(
        self,
        effect: str,
        joint: str | int | None = None,
        logs: Logs | None = None,
        held_out: Logs | None = None,
        mapping: Mapped = (),
    ) -> Model:
        """Adds one effect and returns a new model; `table("waterfall")` lists the errors.

        >>> model.add("spring", joint=1).error() < model.error()
        True

        Args:
            effect: id, as `effects()` lists them; "auto": all that a diagnosis names.
            joint: None: where it explains most.
            logs: of the fit; None: they are found again, if they have not changed.
            held_out: logs of other motion to judge on; None: those of `identify`.
            mapping: as of `read_logs`.
        """
        held_out_logs = self.held_out if held_out is None else tuple(convert_to_list(held_out))
        fit_logs = self.find_logs(logs, "add")
        place = None if joint is None else str(joint)
        from modeler.api import improve  # a fit has no use for it

        better = improve.add(self, effect, fit_logs, held_out_logs, mapping=mapping, joint=place)
        memory_logs = tuple(log for log in fit_logs if isinstance(log, Log))
        return dataclasses.replace(
            better, in_memory_logs=memory_logs or self.in_memory_logs, held_out=held_out_logs
        )

    def find_logs(self, logs: Logs | None, what: str) -> Sequence[AnyLog]:
        """Returns the logs as given, or those of the fit.

        Args:
            logs: None for those of the fit.
            what: begins the message.

        Raises:
            DataError: a log of the fit is not where it was, or has changed, or was no file.
        """
        if logs is not None:
            return convert_to_list(logs)
        if self.fit.loads:
            why = "some logs of the fit carried a load, which is no part of the model"
            raise DataError(f"{what}: {why}; {_suggest_logs(what)} without it")
        return [self._find_log(log, what) for log in self.logs]

    def _find_log(self, log: model_file.LogProvenance, what: str) -> AnyLog:
        for memory_log in self.in_memory_logs:
            if memory_log.content == log.fingerprint and memory_log.name == log.name:
                return memory_log
        ask = _suggest_logs(what)
        if not log.path:
            raise DataError(f"{what}: {log.name} was no file, and is not kept with a model; {ask}")
        if place := log.find_place(self.folder):
            return place
        has_file = any(log.find_places(self.folder).values())
        why = "has changed since it was fitted" if has_file else "is not there any more"
        raise DataError(f"{what}: {log.path} {why}; {ask}")

    def _select_test_logs(self, logs: Logs | None, what: str) -> Sequence[AnyLog]:
        if logs is None and not self.held_out:
            raise DataError(f"{what}: no logs were held out; give some: {what}(logs)")
        return self.held_out if logs is None else convert_to_list(logs)

    # What it is made into.

    def with_load(
        self, mass: float, centre: Sequence[float] = (0.0, 0.0, 0.0), link: str | None = None
    ) -> Model:
        """Returns the model of the robot with a known load: to predict, to compare, as C.

        >>> compare_models({"loaded": model.with_load(0.5), "bare": model}, ["tue.parquet"]).names
        ('loaded', 'bare')

        Args:
            mass: of the load, kg.
            centre: of its mass, m, in the frame of the link.
            link: that carries it; None: the platform, or the last one.

        Raises:
            DataError: no such link, or a load that can be none.
        """
        return estimation.add_known_load(self, mass, centre, link)

    def to_c(self, folder: str | Path, force: bool = False) -> EmittedModule:
        """Writes the C of the model with its values into a folder, as `generate` does.

        >>> model.to_c("arm_c").spec.prefix
        'two_link'
        """
        return generate(self, folder, force=force)

    def export(
        self,
        out: str | Path | None = None,
        to: str | None = None,
        like: str | Path | None = None,
        force: bool = False,
    ) -> Exported:
        """Exports the model, as the function `export` does.

        >>> model.export("two-link.urdf").format
        'urdf'
        """
        from modeler.api.exporting import export  # a fit has no use for it

        return export(self, out, to, like, force)

    def __getstate__(self) -> dict[str, Any]:
        """Without what can be computed again."""
        return {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}


def _suggest_logs(what: str) -> str:
    if what == "resid":
        return "`compare(logs)` takes the logs of the fit"
    return f"give the logs of the fit: {what}(..., logs=[...])"


# Opening files: robots and models, by what is in them.


def open_model(path: str | Path) -> Model:
    """Reads a model file; `open_robot` reads robots, `load` either.

    >>> open_model(save(model, "arm.json"))["Fv1"].unit
    'N m s/rad'

    Raises:
        ManifestError: missing, not a model file, of another format, damaged, or changed since it
            was saved.
    """
    return Model.from_identified(model_file.load_model(path), folder=str(Path(path).parent))


def open_robot(robot: str | Path) -> Robot:
    """Reads a robot file (TOML, URDF, MJCF, .par) or a built-in robot by its name.

    >>> open_robot("emps").joints[0].name
    '1'
    """
    return read_robot(robot)


def load(place: str | Path) -> Any:
    """Reads a robot or a model, by what the file holds; or a built-in robot by its name.

    >>> load("two-link").table().column("theta")
    ['q1', 'q2', '0']

    Type checkers take what comes for anything: `open_robot` and `open_model` say which it is.

    Raises:
        RobotError: no such file or name, or a mistake in a robot file.
        ManifestError: a model file that cannot be read.
    """
    return open_model(place) if is_model_file(place) else open_robot(place)


def is_model_file(place: str | Path) -> bool:
    """Returns True for a model file, by its ending or because it begins as JSON does."""
    try:
        text = read_file(Path(place)) if Path(place).is_file() else b""
    except OSError:
        text = b""  # the robot's reader says why
    if text.lstrip()[:1] == b"{":
        return True
    return Path(place).suffix.lower() == ".json" and b"mdh" not in text
