"""Options of commands, declared once: for Python, the command line, and robot files.

A field of a class of options is an argument in Python, an option of the command by that name, and
may be an entry of a section of a robot file. Its metadata say what it means, in which unit, and
what it goes with.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, ClassVar, Literal, Self, get_args

from modeler.core.choices import (
    ABOUT,
    APART,
    GAIN_METHOD,
    LOW_SPEED,
    TWO_STEPS,
    Derivatives,
    Machine,
    Method,
    ModelKind,
    Precision,
)
from modeler.core.errors import DataError
from modeler.core.toml_cells import suggest_name

METHODS = (*get_args(Method), GAIN_METHOD, TWO_STEPS)
"""Ids of all estimators of `modeler fit`."""

_OPTION = re.compile(r"\{--([a-z_]+)\}")


class OptionError(DataError):
    """An option that cannot be, or options that do not go together.

    The text names options as `{--payload_mass}`: Python shows the name of the argument,
    `payload_mass`, the command line its own, `--payload-mass`.
    """

    def __init__(self, text: str) -> None:
        """Takes the text with options in braces."""
        super().__init__(_OPTION.sub(r"\1", text))
        self.text = text

    def format_line(self, spell: Callable[[str], str]) -> str:
        """Returns the text with every option as `spell` writes it."""
        return _OPTION.sub(lambda match: spell(match[1]), self.text)


Rule = tuple[str, Sequence[str], Sequence[str]]
"""Of an option: what it needs, each perhaps one of several, "a or b", and what it excludes."""


def check_together(values: Mapping[str, Any], rules: Iterable[Rule]) -> None:
    """Raises an error for options that do nothing alone, or that exclude each other.

    Raises:
        OptionError: names the options, and says what to do.
    """
    present = {name for name, value in values.items() if _is_present(value)}
    for name, needs, excludes in rules:
        if name not in present:
            continue
        for alternatives in (need.split(" or ") for need in needs):
            if not present & {*alternatives}:
                others = " or ".join(f"{{--{other}}}" for other in alternatives)
                raise OptionError(
                    f"{{--{name}}}: needs {others}; give both, or leave {{--{name}}} out"
                )
        for other in excludes:
            if other in present:
                raise OptionError(f"{{--{other}}}: got it with {{--{name}}}; leave one of them out")


def check_keywords(verb: str, names: Iterable[str], known: Sequence[str]) -> None:
    """Raises an error for a keyword that a function does not take."""
    for name in names:
        if name not in known:
            hint = suggest_name(name, known)
            raise DataError(f"{verb}: got {name}; expected some of {', '.join(known)}{hint}")


def _is_present(value: object) -> bool:
    return value is not None and value is not False and value not in ((), [], "")


@dataclass(frozen=True)
class Options:
    """Holds the options of a command; what does not go together is refused.

    Attributes:
        groups: titles of the help, each by the first field that stands under it.
    """

    groups: ClassVar[Mapping[str, str]] = {}

    def __post_init__(self) -> None:
        """Checks what the metadata of the fields say of each other."""
        rules = [(each.name, each.metadata["needs"], ()) for each in fields(self)]
        check_together(vars(self), rules)

    @classmethod
    def from_keywords(cls, verb: str, names: Mapping[str, Any]) -> Self:
        """Returns the options that keywords of a function state, by their names.

        Raises:
            DataError: a keyword that is none of them; begins with the verb.
        """
        check_keywords(verb, names, [each.name for each in fields(cls)])
        return cls.from_names(names)

    @classmethod
    def from_names(cls, values: Mapping[str, Any]) -> Self:
        """Returns the options among these values, by their names; others are ignored."""
        named = {each.name: values[each.name] for each in fields(cls) if each.name in values}
        return cls(**{n: tuple(v) if isinstance(v, list) else v for n, v in named.items()})


def _option(
    default: Any,
    help: str,
    unit: str = "",
    *,
    kind: str = "",
    word: str = "",
    needs: tuple[str, ...] = (),
) -> Any:
    """Declares an option.

    Args:
        default: its value where it is left out.
        help: what it means.
        unit: of the value, or its form, as `HZ` or `FRAME=X0,X1`.
        kind: type on the command line, of `cli.places` or `cli.parser`; "": that of the field.
        word: how the command line writes it; "": as the field.
        needs: options that it needs, "a or b" where one of them will do.
    """
    about = {"help": help, "unit": unit, "kind": kind, "word": word, "needs": needs}
    return field(default=default, metadata=about)


_EFFECTS_FROM = "with the effects that `modeler effects --export` wrote there"
_PAYLOAD_LINK = "the link that carries it; default: the last"


@dataclass(frozen=True)
class FitOptions(Options):
    """Describes how a fit is made, also `[fit]`; None lets the fit choose from the logs."""

    groups = {"cutoff": "processing"}

    method: str = _option(
        "weighted",
        "; ".join(f"{about.id}: {about.title}" for about in (*ABOUT.values(), *APART))
        + "; several with commas between, or all: compared on the same rows; `modeler estimators` "
        "says when each is the wrong one (default %(default)s)",
        "METHOD[,METHOD...]",
        kind="Methods",
    )
    model: ModelKind = _option(
        "torque",
        "one equation a joint and sample, or the energy balance of windows (default %(default)s)",
    )
    window: float | None = _option(
        None,
        "length of a window of --model energy; left out: the spacing of the torque model's rows",
        "S",
    )
    essential_below: float | None = _option(
        None,
        "keep in the reduced model what has a sigma below this share of its value (papers: 15); "
        "left out: what an F-test misses",
        "PERCENT",
    )
    cutoff: float | None = _option(
        None, "low-pass of the positions (zero phase, Butterworth order 4)", "HZ"
    )
    parallel_cutoff: float | None = _option(
        None, "the one low-pass of torques and all columns", "HZ"
    )
    decimate: int | None = _option(None, "keep every N-th row after it", "N")
    derivatives: Derivatives = _option(
        "auto", "logged velocities, or positions differentiated; auto: the quieter"
    )
    low_speed: float = _option(
        LOW_SPEED,
        "leave out rows below this share of the joint's top speed, where the sign of the speed is "
        "doubtful",
        "SHARE",
    )
    keep_saturated: bool = _option(False, "use rows whose torque is stuck at its limit")
    keep_contradicted: bool = _option(
        False, "use rows whose logged derivatives contradict the signals below them"
    )
    keep_damaged: bool = _option(
        False, "use leaps, spikes and repeated values, which no robot can have made, as logged"
    )


@dataclass(frozen=True)
class CompareOptions(Options):
    """Describes how models are compared with logs."""

    groups = {"payload_mass": "load", "free_run": "free run"}

    essential: bool = _option(
        False, "predict with the reduced model of the fit: its essential parameters, all others 0"
    )
    run_embedded_c: bool = _option(
        False, "compile the C in MODEL instead of emitting it anew: only for files that you trust"
    )
    payload_mass: float | None = _option(
        None, "its mass: the model of the robot with it, beside that without", "KG"
    )
    payload_centre: str | None = _option(
        None,
        "where its mass is, m, in the frame of the link; default: the origin",
        "X,Y,Z",
        needs=("payload_mass",),
    )
    payload_link: str | None = _option(None, _PAYLOAD_LINK, "J", needs=("payload_mass",))
    free_run: bool = _option(
        False,
        "simulate the robot under the torques of the logs, window after window from the measured "
        "state: fit of the positions per joint, how long the error stays within a bound, and "
        "whether errors grow by the robot's nature whatever the model; where commanded positions "
        "were logged, also under a controller that follows them",
    )
    window: float | None = _option(
        None, "seconds from one measured state to the next (default 1)", "S", needs=("free_run",)
    )
    bound: float | None = _option(
        None,
        "of a joint's range of motion: an error above it ends the horizon (default 0.05)",
        "SHARE",
        needs=("free_run",),
    )
    controller: str | None = _option(
        None,
        "the controller that follows the commands: speed loop, ratio of the position loop to it, "
        "integral action and feedforward (1 or 0); default: the one that comes nearest",
        "HZ,RATIO[,INTEGRAL[,FORWARD]]",
        needs=("free_run",),
    )


@dataclass(frozen=True)
class DiagnoseOptions(Options):
    """Describes what a diagnosis looks for; `without` is also `[diagnose]`."""

    groups = {"discover": "what has no name"}

    without: tuple[str, ...] = _option(
        (), "an effect that this robot does not have, on one joint or at all", "EFFECT[@J]"
    )
    effects_from: str | Path | None = _option(None, _EFFECTS_FROM, "FOLDER", kind="Input")
    discover: bool = _option(False, "propose equations, as [own_effects] to paste")


@dataclass(frozen=True)
class AddOptions(Options):
    """Describes how an effect is added to a model."""

    groups = {"of": "of `learned`, and of `auto`"}

    joint: str | None = _option(None, "default: where it explains most", "J")
    effects_from: str | Path | None = _option(None, _EFFECTS_FROM, "FOLDER", kind="Input")
    of: tuple[str, ...] = _option(
        (),
        "what the law is a function of, of the variables of [own_effects]: q,v or v,load or q "
        "(default: what predicts best)",
        "X[,Y]",
        kind="Names",
    )
    odd: bool = _option(False, "odd in v: times its sign, of |v|")
    monotone: Literal["rising", "falling"] | None = _option(None, "along the first quantity")
    learned: bool = _option(False, "`auto`: a learned law at last, for what is left")


@dataclass(frozen=True)
class GenerateOptions(Options):
    """Describes what the folder of emitted C holds."""

    precision: Precision = _option(
        "double", "of all numbers of the C: double, or float for a microcontroller"
    )
    cuda: bool = _option(False, "also the base regressor for graphics processors")
    structured_text: bool = _option(False, "also function blocks for a PLC, IEC 61131-3")
    a2l: bool = _option(False, "also a description of the parameter set for calibration tools")
    frames: tuple[str, ...] = _option(
        (), "also pose, Jacobian and twist of this row, or link of [frames]", "NAME", word="--frame"
    )
    only: tuple[str, ...] = _option(
        (),
        'leave out what is not named: "inverse_dynamics,gravity"; with values and without; '
        "observation is that of many samples",
        "LIST",
        kind="Names",
    )
    vectors: bool = _option(
        False,
        "also vectors.csv, 50 states with 50 digits, and a program in C that checks a port by them",
    )
    measure: Machine | None = _option(
        None,
        "also cost.json: stack, flash and instructions of every function there; needs gcc, for a "
        "Cortex-M arm-none-eabi-gcc",
    )


CONTROLLED = "frames only vectors structured_text a2l"
"""Of these: those that say what a controller gets."""


@dataclass(frozen=True)
class ExciteOptions(Options):
    """Describes the motion that is searched, and the log that is forecast of it."""

    groups = {
        "family": "the motion",
        "objective": "the search",
        "encoder_counts": "the forecast of sigmas",
    }

    family: Literal["fourier", "bspline", "trapezoid"] = _option(
        "fourier",
        "fourier: periodic; bspline: quintic; trapezoid: moves from place to place, speed a "
        "trapezoid, jerk limited (default %(default)s)",
    )
    duration: float = _option(10.0, "seconds, from rest to rest", "S")
    laps: int = _option(1, "times that this motion is driven in MOTION", "N")
    rate: float = _option(200.0, "samples per second of MOTION", "HZ")
    clearance: float | None = _option(
        None,
        "that links keep from each other and from planes, m; default: 0.01 if the robot file has "
        "[capsules], else links are not looked at",
        "M",
    )
    objective: Literal["both", "condition", "information"] | None = _option(
        None,
        "condition: the condition number, columns of length one; information: log det of the "
        "information matrix; both: the sum of their logarithms (default: both; with --from: "
        "information, of logs and motion together)",
    )
    harmonics: int | None = _option(
        None,
        "of the series; other families have as many coefficients, 2 N - 1 a joint; default: 5 to "
        "10, by the limits",
        "N",
    )
    starts: int = _option(6, "searches, from the best of 50 random motions", "N")
    seed: int = _option(0, "of the random motions", "N")
    time_limit: float | None = _option(None, "take the best after so many seconds", "S")
    encoder_counts: int | None = _option(None, "per turn, of the log; default: exact", "N")
    position_noise: float | None = _option(
        None, "rad or m, white, of its positions; default: none", "X"
    )
