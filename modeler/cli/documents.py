"""What commands write for scripts, where it is no result of a package by itself."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NotRequired, TypedDict

from modeler.core.json import Document

if TYPE_CHECKING:  # which take long to load
    from modeler.diagnosis import Diagnosis
    from modeler.estimation import Addition, FitResult, MethodResult
    from modeler.formats import Exported
    from modeler.formulas import CadRow, Explanation, KnownAgainstFit, RatedSet
    from modeler.logs import LogInspection, Mark
    from modeler.papers import CheckedLine, MethodTable
    from modeler.regression import Bands
    from modeler.simulation import HiddenEffect
    from modeler.validation import Comparison, ModelErrors


class WrittenRobot(TypedDict):
    """A robot file that was written."""

    robot: str
    out: str  # its place
    joints: list[str]  # that move
    loops: list[str]


class ConvertedRobot(WrittenRobot):
    """Another program's robot file as one of ours."""

    file: str  # that was read
    notes: list[str]  # what was decided, and what has no place in a robot file


class AssemblyMode(TypedDict):
    """A closed posture."""

    letter: str
    home: Mapping[str, float]  # variables, as [home] has them
    singular_value: float  # smallest one of the loops: the distance from a singular posture
    is_within_limits: bool
    copy_count: int
    distance: float | None  # from the posture that the file states


class AssemblyModes(TypedDict):
    """The closed postures of a robot."""

    robot: str
    chosen_mode: str  # its letter
    as_given: str | None  # letter of the mode that the file states
    modes: list[AssemblyMode]


class StudioAddress(TypedDict):
    """A studio that serves."""

    address: str  # to open in a browser, with the token that lets it in
    folder: str  # of the project
    pid: int  # of the process, until it is interrupted


class CompletionScript(TypedDict):
    """What completes words in a shell."""

    shell: str
    script: str


class RobotFile(TypedDict):
    """A robot file."""

    name: str
    text: str  # TOML


class RobotSummary(TypedDict):
    """A built-in robot."""

    name: str
    title: str
    joints: list[str]
    effects: list[str]  # ids


class EffectSummary(TypedDict):
    """An effect of the catalogue, or of a robot file."""

    id: str
    aliases: list[str]
    title: str
    equation: str
    parameters: list[str]
    unit: list[str]  # of each
    nonlinear_parameters: list[str]  # with their meanings
    equivalent_effects: list[str]  # ids of effects that no data tell from it
    signature: str  # how it shows itself in the residual
    confounders: str  # what it is mistaken for, and which motion tells them apart
    range: str  # that physics allows
    source: str


class GeneratedFolder(TypedDict):
    """C that was written; of a fitted model with its values."""

    robot: str
    folder: str
    files: list[str]
    fitted_signature: NotRequired[str]
    valid: NotRequired[bool | None]
    warnings: NotRequired[list[str]]


class SimulatedRun(TypedDict):
    """A log that was simulated, and its truth."""

    robot: str
    samples: int
    joints: list[str]
    parameters: Mapping[str, float]  # true values
    random_parameters: list[str]  # those that the robot file leaves open
    hidden_effects: list["HiddenEffect"]
    range_share: float  # of the way to the limits that the motion takes


class ShownFrame(TypedDict):
    """A frame at home."""

    name: str
    antecedent: str
    joint: str
    actuated: bool
    pose: list[list[float]]  # 4x4, in frame 0, m


class ShownLoop(TypedDict):
    """A loop at home."""

    loop: str
    frame: str
    meets: str
    joint: str
    gap: float  # m
    angle: float  # rad
    is_closed: bool


class ShownRobot(TypedDict):
    """A robot at its [home]."""

    robot: str
    title: str
    coordinates: list[str]
    home: Mapping[str, float]
    frames: list[ShownFrame]
    loops: list[ShownLoop]
    is_closed: bool
    is_as_stated: bool  # actuated joints stand where [home] states them
    loose_joints: list[str]  # that could move with the actuated joints locked
    note: str
    gravity: list[float]
    page: NotRequired[str]
    picture: NotRequired[str]


@dataclass(frozen=True)
class ExportReport(Document):
    """A file for another program, and its place."""

    KEYS = "*exported out"

    exported: "Exported"
    out: str


@dataclass(frozen=True)
class LogReport(Document):
    """A log by itself; with --robot beside what a fit says of it.

    Attributes:
        warnings: those of a fit too.
        bands: cut-offs that suit the noise of its positions.
        marks: where in its time something is wrong.
    """

    KEYS = "*inspection warnings bands marks"

    inspection: "LogInspection"
    warnings: Sequence[str]
    bands: "Bands"
    marks: Sequence["Mark"]


@dataclass(frozen=True)
class FitReport(Document):
    """A fit.

    Attributes:
        two_step: of that method, its configurations and the estimate in one step.
    """

    KEYS = "*fit two_step"

    fit: "FitResult"
    two_step: Mapping[str, object] | None


class MethodsReport(TypedDict):
    """Estimators on the same logs."""

    training: list[str]
    holdout: list[str]
    methods: list["MethodResult"]


@dataclass(frozen=True)
class ComparisonReport(Document):
    """Measured against predicted torques.

    Attributes:
        models: of several models the errors of each; empty for one.
        warnings: about the logs.
    """

    KEYS = "*comparison models warnings"

    comparison: "Comparison"
    models: Sequence["ModelErrors"]
    warnings: Sequence[str]


@dataclass(frozen=True)
class DiagnosisReport(Document):
    """A diagnosis; with --add what was not added, and why."""

    KEYS = "*diagnosis not_added"

    diagnosis: "Diagnosis"
    not_added: Sequence[str] = ()


@dataclass(frozen=True)
class AdditionReport(Document):
    """A fit with effects that were added.

    Attributes:
        waterfall: the model as it was first fitted, and every effect added since.
        not_added: effects, and why.
    """

    KEYS = "*fit waterfall not_added"

    fit: "FitResult"
    waterfall: Sequence["Addition"]
    not_added: Sequence[str]


@dataclass(frozen=True)
class StoryReport(Document):
    """A diagnosis of a demonstration, and the fall of the error."""

    KEYS = "*diagnosis waterfall"

    diagnosis: "Diagnosis"
    waterfall: Sequence["Addition"]


class ReproducedPaper(TypedDict):
    """A paper's printed results beside ours."""

    paper: str
    lines: NotRequired[list["CheckedLine"]]
    methods: NotRequired[list["MethodTable"]]


class TermDocument(TypedDict):
    """One term of a base parameter."""

    coefficient: str  # exact, as D4**2 or -1/D4
    parameter: str


class BaseParameterRow(TypedDict):
    """One base parameter, the sum of its terms."""

    name: str
    column_of: str  # standard parameter
    unit: str
    terms: list[TermDocument]


class KindCounts(TypedDict):
    """Base parameters by the kind of the standard parameter whose column they are."""

    inertial: int
    rotor_inertia: int
    friction: int
    offset: int


class BaseParameterDocument(TypedDict):
    """The base parameters of a robot and their proof."""

    robot: str
    standard: list[str]
    base: list[BaseParameterRow]
    unidentifiable: list[str]
    rank: int
    counts: KindCounts
    rank_gap: list[float | None]  # last singular value kept, first dropped
    proof: str
    certificate: Mapping[str, object]


class FormulaDefinition(TypedDict):
    """A line of a sheet of formulas."""

    section: str
    name: str
    formula: str
    result: bool  # it is asked for, and no intermediate


class FormulaSheet(TypedDict):
    """An equation and the definitions of its letters."""

    equation: list[str]
    angles: Mapping[str, str]
    definitions: list[FormulaDefinition]
    difference: NotRequired[float]  # from the derivation, of the largest


class DerivationReport(BaseParameterDocument):
    """Base parameters, their sums, the proof, and the forms that were asked for."""

    newton_euler_against_lagrange: float  # largest relative difference of the torques of both
    closed_form: NotRequired[FormulaSheet]
    regressor: NotRequired[FormulaSheet]
    blocks: NotRequired[FormulaSheet]
    energy: NotRequired[FormulaSheet]
    kane: NotRequired[FormulaSheet]


class PhysicalValue(TypedDict):
    """A physical parameter with its value."""

    parameter: str
    value: float | None
    sigma: float | None
    unit: str
    warning: str | None  # why it is not identifiable
    sensitivity: Mapping[str, float]  # derivatives by the inputs
    variance_shares: Mapping[str, float]  # by input


class PhysicalValues(TypedDict):
    """Values of physical parameters, and the known ones against the fit."""

    parameters: list[PhysicalValue]
    known_against_fit: list["KnownAgainstFit"]


class SetClass(TypedDict):
    """How many sets have so many parameters of each kind."""

    masses_and_lengths: int
    centres: int
    inertias: int
    count: int


class SufficientSets(TypedDict):
    """Sets of known parameters that make all others follow."""

    size: int
    smallest: int  # size of the smallest sets
    candidate_count: int
    count: int  # of those that suffice
    classes: list[SetClass]
    contains: Mapping[str, int]  # sets that contain a parameter
    easiest_sets: list[list[str]]
    ratings: list["RatedSet"]


class CadReport(TypedDict):
    """Identified quantities against CAD."""

    rows: list["CadRow"]
    limit: float  # of |z|
    chi_squared: float
    not_compared: Mapping[str, str]  # why
    implicated_parameters: list[str]
    explanations: list["Explanation"]


class PhysicalReport(TypedDict):
    """Physical parameters of a robot or model: formulas, values, sets, a comparison."""

    robot: str
    source: str  # what the formulas start from
    parameters: NotRequired[Mapping[str, str]]  # kinds
    without_effect: NotRequired[list[str]]
    smallest_count: NotRequired[int]  # of parameters to know so that all others follow
    suggested_set: NotRequired[list[str]]
    coefficients: NotRequired[list[str]]
    known_parameters: NotRequired[list[str]]
    lengths: NotRequired[Mapping[str, float]]
    abbreviations: NotRequired[Mapping[str, str]]
    formulas: NotRequired[list[Mapping[str, str]]]
    undetermined_parameters: NotRequired[list[str]]
    without_formula: NotRequired[list[str]]
    missing_count: NotRequired[int]
    redundant_count: NotRequired[int]
    verification: NotRequired[Mapping[str, int] | None]
    values: NotRequired[PhysicalValues]
    sets: NotRequired[SufficientSets]
    cad: NotRequired[CadReport]
