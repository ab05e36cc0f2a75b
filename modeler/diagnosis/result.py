"""What a diagnosis says, as plain data; the share of the error that its effects close."""

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from modeler.core.json import Document, ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.core.result import Result
from modeler.core.table import format_error_pair, format_percent
from modeler.core.thresholds import THRESHOLDS as CORE_THRESHOLDS
from modeler.core.toml_cells import format_toml
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.plausibility import is_gain
from modeler.diagnosis.scoring import ErrorChange
from modeler.diagnosis.search import Search
from modeler.diagnosis.state import State
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import MOTION, Effect, EffectTarget
from modeler.estimation import MachineComparison, ParameterChange

# Does an effect explain what is systematic, or only part of it?


Key = tuple[str, str | None]
"""Effect and joint; the joint of an effect of the whole robot is None."""


@dataclass(frozen=True)
class EffectPlace:
    """An effect and its joint; None of the whole robot."""

    effect: str
    joint: str | None


@dataclass(frozen=True)
class Alternative(EffectPlace):
    """Another effect in place of the first one, and the variance reduction with it."""

    gain: float


@dataclass(frozen=True)
class CrossCheck(Document):
    """What another look says of one effect.

    Attributes:
        label: which look, in words.
        leading_effect: effect and joint that lead there on its joint; None if nothing does
            significantly.
        agrees: True if that is the effect, if the data there do not distinguish it from the effect,
            or if nothing is sure there.
        variance_reduction: fall of the residual variance of its joints there, cross-validated; NaN
            if unknown.
        expected_reduction: what the values that it was named with let expect of it there; 0 if
            unknown.
    """

    KEYS = "leading_effect=leading_place label agrees variance_reduction expected_reduction"

    label: str
    leading_effect: Key | None
    agrees: bool
    variance_reduction: float = math.nan
    expected_reduction: float = 0.0

    @property
    def leading_place(self) -> EffectPlace | None:
        """Returns the effect that leads there on its joint; None if nothing surely does."""
        return None if self.leading_effect is None else EffectPlace(*self.leading_effect)


@dataclass(frozen=True, eq=False)
class PushWindow:
    """A segment of time in which something pushed the robot.

    Attributes:
        log: index.
        start, end: s.
        ratio: energy of the steady torque there over the largest in any window elsewhere.
        torque: its mean by joint, N m or N.
        change: of the error of all joints by it, over all rows of the logs; None for what comes
            only once as well, but is no steady torque: a spike, a shock.
        held_out_push: when something pushed in the held-out logs too, in words; empty if never.
    """

    log: int
    start: float
    end: float
    ratio: float
    torque: Mapping[str, float] = field(default_factory=dict)
    change: ErrorChange | None = None
    held_out_push: str = ""

    def describe(self, logs: Sequence[str]) -> str:
        """Describes when it pushed in one of those logs."""
        seconds = f"{self.start:.1f} to {self.end:.1f} s of {logs[self.log]}"
        energy = f"{self.ratio:.0f} times the energy of any other window"
        return f"something pushed from {seconds} ({energy})"

    @property
    def span(self) -> tuple[float, float]:
        """Returns start and end with a margin, s: the rows between them are left out."""
        return self.start - THRESHOLDS.push_margin, self.end + THRESHOLDS.push_margin

    def merge_part(self, other: "PushWindow") -> "PushWindow | None":
        """Merges the push with a part of it; None if that is another push."""
        apart = THRESHOLDS.push_separation
        near = other.start < self.end + apart and other.end > self.start - apart
        if other.log != self.log or not near:
            return None
        return replace(self, start=min(self.start, other.start), end=max(self.end, other.end))


def compute_explained_fraction(
    squares: Sequence[Sequence[float]],
    touched: Sequence[int],
    systematic: Callable[[int], float],
    sigma: np.ndarray,
) -> float:
    """Computes what one effect explains, over that and what stays systematic.

    Squared residuals of the joints it touches, in units of their first residual. What a wrong name
    leaves, others are found to mend; so what they explain there counts as left.

    Args:
        squares: (J,) mean squared residuals, of the model before the effect, with it, and with the
            later ones.
        touched: joints whose residuals it explains.
        systematic: share of the last of these by joint.
        sigma: (J,) rms residual before the effect.
    """
    before, after, end = squares[0], squares[1], squares[-1]
    explained = left = 0.0
    for j in touched:
        unit = float(sigma[j]) ** 2
        explained += max(0.0, before[j] - after[j]) / unit
        left += (max(0.0, after[j] - end[j]) + systematic(j) * end[j]) / unit
    return explained / (explained + left) if explained > 0.0 else 0.0


def compute_mean_square(values: np.ndarray) -> float:
    """Computes the mean square; 0 of none."""
    return float(np.mean(values**2)) if values.size else 0.0


# Is an effect named? One rule, of `diagnose`, `add` and `auto`.


_NONE: Mapping[str, float] = {}


def explain_weak_evidence(
    pick: Candidate,
    errors: tuple[float, float],
    caveat: str = "",
    sigmas: Mapping[str, float] = _NONE,
    closed: float | None = None,
    checks: Sequence[CrossCheck] = (),
    ties: Sequence[Candidate] = (),
    refines: bool = False,
    left: Sequence[float] = (),
) -> str:
    """Explains why an effect is possible only; empty if it is named.

    Args:
        pick: the effect, with its shapes.
        errors: relative errors of its joints without and with it, on unseen motion.
        caveat: why its values cannot be; a drive gain may be in another unit.
        sigmas: standard deviations of its shapes, by name, where they are known.
        closed: share of what is systematic that it explains.
        checks: what others say of it.
        ties: effects that these data do not distinguish from it.
        refines: True for what mends a law of the model, which may be small.
        left: relative errors with it of the joints that it touches.
    """
    before, after = errors
    worst = max([after, *left])
    reasons = [caveat] if caveat and not is_gain(pick) else []
    if worst > THRESHOLDS.max_joint_error:
        left_error = f"with it the error is {format_percent(worst)} still"
        reasons.append(f"{left_error}, so the fit does not determine a joint")
    small = not refines and (closed is None or closed < THRESHOLDS.min_explained_fraction)
    if small and after > (1.0 - THRESHOLDS.min_error_reduction) * before:
        least = format_percent(THRESHOLDS.min_error_reduction)
        reasons.append(f"the error falls by less than {least} of itself")
    if pick.effect.orders and pick.effect.orders[1] < math.inf:
        sigma = max(sigmas.get(s.name, math.inf) for s in pick.form.nonlinear_parameters)
        spread = THRESHOLDS.max_order_deviation * sigma
        if abs(pick.wave_order - round(pick.wave_order)) > spread:
            reasons.append(f"{pick.wave_order:.1f} waves a turn are no number of teeth or poles")
    joints = sorted({tie.joint for tie in ties if tie.joint not in (None, pick.joint)})
    if joints and pick.joint is not None and not is_gain(pick):
        reasons.append(f"it may as well be one of joint {', '.join(joints)}")
    kinds = sorted({tie.effect.id for tie in ties if tie.effect.family != pick.effect.family})
    if kinds and not is_gain(pick):
        reasons.append(f"it may as well be of another kind: {', '.join(kinds)}")
    unit = bool(caveat) and is_gain(pick)  # it bends what every look weighs the joints by
    for check in () if unit else checks:
        if not check.agrees and check.leading_effect is not None:
            reasons.append(f"{check.leading_effect[0]} explains its joint better ({check.label})")
        expected = check.expected_reduction > THRESHOLDS.min_expected_reduction and not is_gain(
            pick
        )
        if (
            expected
            and check.variance_reduction < THRESHOLDS.min_confirmed_share * check.expected_reduction
        ):
            reasons.append(f"it explains nothing {check.label}")
    return "; ".join(reasons)


def explain_exclusion(effect: Effect, spec: ModuleSpec) -> str:
    """Explains why an effect cannot go into a model of this robot; empty if it can."""
    if effect.obstacle:
        return effect.obstacle
    moved = all(name.startswith(MOTION) for name in effect.forms[0].names)
    moved = moved and effect.acts is not EffectTarget.POSITION
    if spec.closure is None or effect.acts not in JOINTED or moved:
        return ""
    # the C of a robot with loops reads the motion of its joints, nothing else
    return (
        f"{spec.robot} has loops, and there effects may read positions, speeds and accelerations "
        "only; keep it in mind as a finding"
    )


JOINTED = (EffectTarget.JOINT, EffectTarget.MOTOR, EffectTarget.POSITION, EffectTarget.PASSIVE)
"""Effects that act on a joint."""


@dataclass(frozen=True, eq=False)
class FittedCandidate(ShortRepr):
    """An effect ready to go into a model: nothing has to be searched for again.

    Attributes:
        candidate: effect, joint, shapes.
        values: (k,) of its columns, SI; a delay is that of the logs as they are.
        state: the model with all effects that were found, about which it is linearised.
        visible_share: share of its columns that the model does not hide.
    """

    candidate: Candidate
    values: np.ndarray
    state: State
    visible_share: float


@dataclass(frozen=True)
class Finding(ShortRepr, Document):
    """One missing effect.

    Attributes:
        effect: id.
        joint: name; None for an effect of the whole robot.
        error_before, error_after: relative error of its joints without and with it, on unseen
            motion: the same rows, and the same weight of each joint. NaN where it is not known.
        parameters: its parameters and shapes by name, SI.
        sigmas: standard deviations of the parameters and shapes; those of an effect with shapes
            hold for all shapes that the data do not refuse.
        units: of the parameters and shapes.
        equivalents: effects that the data do not distinguish from it.
        evidence: why, in one or two sentences.
        explained_fraction: share of what is systematic on its joints that it explains itself; None
            for contacts and play, which are no columns of the model.
        is_refinement: true if it refines a law of the model, or an effect named before.
        caveat: why its values cannot be those of this robot; empty if they can.
        intervals: 95 % intervals of the parameters and shapes of an effect with shapes.
        cross_checks: what other logs and another band say of it; empty for contacts and play.
        warning: why it is possible only; empty if it is named.
        is_first: True if nothing was named before it.
        pick: what `modeler add` puts in; None for contacts and play.
        is_event: True if it came once.
    """

    KEYS = """
        effect joint status gain error_before error_after parameters sigmas intervals units ties
        evidence explained_fraction caveat warning splits=cross_checks
    """

    effect: str
    joint: str | None
    error_before: float
    error_after: float
    parameters: Mapping[str, float]
    sigmas: Mapping[str, float]
    units: Mapping[str, str]
    equivalents: tuple[Key, ...]
    evidence: str
    explained_fraction: float | None
    is_refinement: bool
    caveat: str = ""
    intervals: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    cross_checks: tuple[CrossCheck, ...] = ()
    pick: FittedCandidate | None = field(default=None, repr=False, compare=False)
    is_event: bool = False
    warning: str = ""
    is_first: bool = True

    @property
    def is_confirmed(self) -> bool:
        """Returns whether it is the cause, or one of those that these data do not distinguish."""
        closed = (
            self.explained_fraction is None
            or self.explained_fraction >= THRESHOLDS.min_explained_fraction
        )
        sure = not self.warning and not self.caveat and not math.isnan(self.gain)
        return closed and sure and self.is_first

    @property
    def status(self) -> Literal["confirmed", "likely", "possible"]:
        """Returns "confirmed" of what is stated as missing, else "likely" or "possible"."""
        if self.warning:
            return "possible"
        alone = not self.is_refinement and not self.equivalents
        return "confirmed" if self.is_confirmed and alone else "likely"

    @property
    def gain(self) -> float:
        """Returns the variance reduction of its joints, 1 - (error_after / error_before)^2."""
        before = self.error_before
        return 1.0 - (self.error_after / before) ** 2 if before > 0.0 else math.nan

    @property
    def ties(self) -> tuple[EffectPlace, ...]:
        """Returns effects that the data do not tell from it."""
        return tuple(EffectPlace(*key) for key in self.equivalents)


@dataclass(frozen=True, eq=False)
class EquationProposal(ShortRepr, Document):
    """An equation for what has no name on a joint.

    Attributes:
        finding: its values, errors and units, as those of an effect with a name.
        definition: its table of `[own_effects]`.
        equation: its columns, each times its parameter.
        effects_line: that of `[effects]`.
        explained_share: share of what a learned law explains there.
        symbols: what its price counts.
        replaced_effects: effects of the catalogue in place of which it stands.
        nearest_effect: id of the nearest effect with a name.
        similarity: share of its torque that this explains.
        difference: what differs, in plain words.
        final_search: the search with it as its last step, for pictures.
        discriminating_command: the command that looks for a motion which distinguishes it from the
            next.
        discriminating_state: the state of the joint in these logs in which they differ most.
    """

    KEYS = """
        effect=finding.effect joint=finding.joint error_before=finding.error_before
        error_after=finding.error_after gain=finding.gain parameters=finding.parameters
        sigmas=finding.sigmas intervals=finding.intervals units=finding.units text equation
        effects_line explained_share symbols replaced_effects nearest_effect similarity
        difference discriminating_command discriminating_state
    """

    finding: Finding
    definition: Mapping[str, Any]
    equation: str
    effects_line: str
    explained_share: float
    symbols: int
    replaced_effects: tuple[str, ...]
    nearest_effect: str
    similarity: float
    difference: str
    final_search: Search = field(repr=False)
    discriminating_command: str = ""
    discriminating_state: str = ""

    @property
    def text(self) -> str:
        """Returns the text for a robot file, with the line of `[effects]` as a comment."""
        lines = (f"{key} = {format_toml(value)}" for key, value in self.definition.items())
        line = f"# [effects] {self.effects_line}"
        return "\n".join([f"[own_effects.{self.finding.effect}]", *lines, line])

    @property
    def summary_lines(self) -> list[str]:
        """Returns the lines for people."""
        f = self.finding
        units = {name: f" {unit}" for name, unit in f.units.items() if unit != "1"}
        values = ", ".join(
            f"{name} = {value:.4g} +- {f.sigmas.get(name, math.nan):.2g}{units.get(name, '')}"
            for name, value in f.parameters.items()
        )
        change = " -> ".join(format_error_pair(f.error_before, f.error_after))
        instead = (
            f", in place of {', '.join(self.replaced_effects)}" if self.replaced_effects else ""
        )
        law = f"{format_percent(self.explained_share)} of what a learned law explains"
        law = "a learned law explains nothing" if math.isnan(self.explained_share) else law
        first = f"joint {f.joint}: {self.equation}: error {change}{instead}; {law}"
        apart = (
            f"  discriminating motion: {self.discriminating_command}",
            f"  {self.discriminating_state}",
        )
        return [
            first,
            f"  {values}",
            f"  {self.difference}",
            *(apart if self.discriminating_command else ()),
        ]

    def format_lines(self) -> list[str]:
        """Formats these, and the text to paste."""
        return [*self.summary_lines, *(f"    {line}" for line in self.text.splitlines())]


@dataclass(frozen=True, eq=False)
class JointDiscovery(ShortRepr, Document):
    """What was looked for on one joint.

    Attributes:
        joint: name.
        share: of the residual's variance that a learned law explains on motion left out.
        law: of what the law is a function; empty where it is the nonparametric baseline's.
        proposals: best first.
        reason: why there are none.
    """

    KEYS = "joint share law reason proposals"

    joint: str
    share: float
    law: str
    proposals: tuple[EquationProposal, ...] = ()
    reason: str = ""

    def format_lines(self) -> list[str]:
        """Formats the lines for people."""
        if not self.proposals:
            return [f"joint {self.joint}: {self.reason}"]
        return [line for proposal in self.proposals for line in proposal.format_lines()]


@dataclass(frozen=True)
class JointState(ShortRepr):
    """One joint before and after.

    Attributes:
        error_before, error_after: relative error, held out.
        unit: of the torque.
        rms_before, rms_after: of the residual on the training logs.
        explained_share: share of the torque's variance that the model explains; NaN without torque.
        systematic_share: share of it that is left and is no noise: predictable, repeatable,
            lasting, or in bursts.
        noise_share: the rest.
    """

    error_before: float
    error_after: float
    unit: str
    rms_before: float
    rms_after: float
    explained_share: float
    systematic_share: float
    noise_share: float

    @property
    def is_unexplained(self) -> bool:
        """Returns whether a significant systematic residual remains."""
        left = self.systematic_share + self.noise_share
        share = THRESHOLDS.min_systematic_share * left
        return self.systematic_share > max(THRESHOLDS.min_systematic_torque**2, share)


@dataclass(frozen=True)
class JointDiagnosis(Document):
    """One joint of a diagnosis.

    Attributes:
        relative_error: of the model on these logs in its own band, as `compare` has it.
    """

    KEYS = "relative_error *state"

    state: JointState
    relative_error: float


@dataclass(frozen=True, eq=False)
class Diagnosis(Result, Document):
    """What is missing in a model.

    Attributes:
        robot: name.
        verdict: missing | closest description | nothing significant | unexplained | cannot tell.
        effects: named, best first.
        refinements: of laws that the model has, or of effects named before.
        alternatives: of the first effect: effect, joint, gain.
        undetectable: what these data cannot show, by effect and joint.
        joints: by name; those with rows.
        unmoved_joints: joints of which no row can be used.
        held_out_logs: names of the logs that errors come from; empty for cross-validation.
        sentences: for people: verdict first.
        fit_band: Hz up to which the model was fitted, and `modeler add` fits.
        data_warnings: warnings about the logs themselves.
        has_contradictions: True if channels of the logs contradict the model: then nothing is
            named.
        machine: that of the held-out logs, compared with that of the training logs; None where
            they are not. What changed is removed from the held-out torques; where that does not
            explain the difference, errors are cross-validated within the training logs.
        window: when something pushed, if anything did.
        search: everything behind it.
        discoveries: equations proposed by joint; None where none were requested.
        errors: by joint, of the model on these logs in its own band, as `compare` has them.
    """

    KEYS = """
        robot verdict effects refinements alternatives=alternative_effects
        undetectable=undetectable_places joints=joint_results unmoved_joints unjudged_joints
        held_out_logs sentences band fit_band data_warnings has_changed has_contradictions
        machine_changed unexplained_change discoveries
    """

    robot: str
    verdict: str
    effects: tuple[Finding, ...]
    refinements: tuple[Finding, ...]
    alternatives: tuple[tuple[str, str | None, float], ...]
    undetectable: tuple[Key, ...]
    joints: Mapping[str, JointState]
    unmoved_joints: tuple[str, ...]
    held_out_logs: tuple[str, ...]
    sentences: tuple[str, ...]
    fit_band: float
    data_warnings: tuple[str, ...]
    has_contradictions: bool
    machine: MachineComparison | None
    window: PushWindow | None
    search: Search
    discoveries: tuple[JointDiscovery, ...] | None = None
    errors: Mapping[str, float] = field(default_factory=dict)

    def __repr__(self) -> str:
        most = CORE_THRESHOLDS.max_repr_length
        line = textwrap.shorten(self.sentences[0], most, placeholder=" ...")
        return f"Diagnosis({self.robot}: {line})"

    def __len__(self) -> int:
        return len(self.effects)

    def __iter__(self) -> Iterator[Finding]:
        return iter(self.effects)

    def __getitem__(self, place: int) -> Finding:
        """One of the effects that it names, best first."""
        return self.effects[place]

    @property
    def band(self) -> float:
        """Returns the band of the residuals, Hz; values are those of this band too."""
        return self.search.start.data.observation.report.processing.parallel_cutoff

    @property
    def unjudged_joints(self) -> tuple[str, ...]:
        """Returns joints whose motion a fit to the logs does not predict, whatever is added."""
        most = THRESHOLDS.max_predictive_error
        return tuple(name for name, joint in self.joints.items() if joint.error_after > most)

    @property
    def addable_findings(self) -> tuple[Finding, ...]:
        """Returns the effects that `modeler add` puts in."""
        spec, least = self.search.spec, THRESHOLDS.min_addable_share
        has = {(p.effect, p.joint) for p in spec.standard}

        def can_add(finding: Finding) -> bool:
            if finding.is_event:
                return True
            if finding.pick is None or finding.pick.visible_share < least:
                return False
            effect = finding.pick.candidate.effect
            new = (finding.effect, finding.joint) not in has or effect.is_repeatable
            return new and not explain_exclusion(effect, spec)

        return () if self.unexplained_change else tuple(filter(can_add, self.effects))

    @property
    def machine_changed(self) -> tuple[ParameterChange, ...]:
        """Returns what changed between the training and the held-out logs, largest first."""
        return () if self.machine is None else self.machine.changes

    @property
    def unexplained_change(self) -> tuple[str, ...]:
        """Returns joints that differ between the training and the held-out logs unexplained."""
        return () if self.machine is None else self.machine.unexplained

    @property
    def has_changed(self) -> bool:
        """Returns whether the robot has changed since the fit, so that parameters were fixed."""
        return self.search.start.data.fixed_parameters is not None

    @property
    def alternative_effects(self) -> tuple[Alternative, ...]:
        """Returns the alternatives to the first effect, with their variance reduction."""
        return tuple(Alternative(*one) for one in self.alternatives)

    @property
    def undetectable_places(self) -> tuple[EffectPlace, ...]:
        """Returns what these data cannot show, by effect and joint."""
        return tuple(EffectPlace(*key) for key in self.undetectable)

    @property
    def joint_results(self) -> dict[str, "JointDiagnosis"]:
        """Returns the joints before and after, with the error of the model in its own band."""
        return {
            name: JointDiagnosis(state, self.errors.get(name, math.nan))
            for name, state in self.joints.items()
        }
