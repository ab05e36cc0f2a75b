"""`modeler excite ROBOT --out MOTION`."""

import argparse
import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.api import compile_model, derive, generate, recompile
from modeler.cli.console import Json, progress, say, working
from modeler.cli.robots import robot_of
from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.effects import effect_named
from modeler.excite.between import Question, tell_apart
from modeler.excite.bounds import Bounds, Box
from modeler.excite.choose import choose
from modeler.excite.columns import signals
from modeler.excite.picture import check_kind, picture
from modeler.excite.result import Exciting, csv_text, motion_table
from modeler.excite.search import Wish, excite, usual_harmonics
from modeler.fit import IdentifiedModel, load_model
from modeler.robot import Limits, Robot, robot_from_text
from modeler.robot.place import near
from modeler.simulate import check_suffix, motion_limits, read_motion


@dataclasses.dataclass(frozen=True, eq=False)
class _Subject:
    """What is to be excited, and what is known of it."""

    robot: Robot
    compiled: CompiledModel
    sigma: np.ndarray | None = None
    kept: np.ndarray | None = None
    beta: np.ndarray | None = None
    model: IdentifiedModel | None = None


def run_excite(args: argparse.Namespace) -> Json:
    """Finds a motion and writes it, or chooses among motions."""
    _check_usage(args)
    subject = _subject(args)
    bounds = bounds_of(subject.robot, subject.compiled, args.limit, args.box)
    if args.choose is not None:
        return _choose(args, subject)
    wish = Wish(
        args.duration,
        usual_harmonics(bounds, args.duration) if args.harmonics is None else args.harmonics,
        args.objective, args.starts, args.seed, args.time_limit, args.laps,
    )  # fmt: skip
    with progress(f"looking for a motion of {subject.robot.name}") as bar:
        if args.between is not None:
            question = _question(args, subject)
            motion, apart = tell_apart(subject.compiled, bounds, wish, question, bar)
        else:
            motion = excite(
                subject.compiled, bounds, wish, subject.sigma, subject.kept, subject.beta, bar
            )
    lines = motion.summary() if args.between is None else [*apart.summary(), *motion.summary()[2:]]
    for line in lines:
        say(line)
    _write(args, motion, subject.compiled)
    extra = {} if args.between is None else {"between": apart.to_json()}
    return motion.to_json() | {"effects": [u.effect for u in subject.robot.effects]} | extra


def _check_usage(args: argparse.Namespace) -> None:
    """Before any long work."""
    if args.choose is None and args.out is None:
        raise DataError("--out: missing; expected the file of the motion, .csv or .parquet")
    if (args.choose is None) != (not args.candidates):
        raise DataError("--choose and --from go together: --choose 2 --from a.csv b.csv c.csv")
    for option in ("out", "picture", "between") if args.choose is not None else ():
        if getattr(args, option) is not None:
            raise DataError(
                f"--{option}: got it with --choose, which names motions of --from and writes none; "
                f"leave --{option} out"
            )
    if args.out is not None:
        check_suffix(Path(args.out))
    if args.picture is not None:
        check_kind(args.picture)
    if not (math.isfinite(args.rate) and 0.0 < args.rate <= 1e5):
        raise DataError(f"--rate: got {args.rate:g}; expected more than 0, at most 1e5")


def _subject(args: argparse.Namespace) -> _Subject:
    if not args.robot.endswith(".json"):
        if args.between is not None:
            raise DataError(
                f"--between: {args.robot} has no values; expected a model file of `modeler fit`"
            )
        robot = robot_of(args)
        with working(f"deriving {robot.name}"):
            compiled = compile_model(generate(derive(robot)))
        return _Subject(robot, compiled, beta=_nominal(compiled))
    if args.effects is not None:
        raise DataError(
            "--effects: of a robot file only; a model has the effects it was fitted with"
        )
    model = load_model(args.robot)
    with working("deriving the robot of the model"):
        compiled = recompile(model)
    robot = robot_from_text(model.robot_text, f"{args.robot}, robot")
    sigma = np.array([joint.sigma for joint in model.fit.joints])
    known = bool(np.all(np.isfinite(sigma)) and np.all(sigma > 0.0))
    kept = np.flatnonzero([parameter.essential for parameter in model.fit.parameters])
    return _Subject(robot, compiled, sigma if known else None, kept, model.beta, model)


def _nominal(compiled: CompiledModel) -> np.ndarray | None:
    """The base parameters that the robot file states; None where it leaves some open."""
    values = [parameter.nominal for parameter in compiled.spec.standard]
    if any(value is None for value in values):
        return None
    return compiled.base_parameters(values)


def bounds_of(
    robot: Robot, compiled: CompiledModel, limits: Sequence[str], boxes: Sequence[str]
) -> Bounds:
    """The limits of the robot file, with those of the command line in their place.

    Raises:
        DataError: a text that cannot be read, a joint or frame that is not there.
        RobotError: an empty range.
    """
    coordinates = [joint.name for joint in compiled.spec.joints]
    moving = [joint.name for joint in robot.moving]
    changes, torques = {}, {}
    for text in limits:
        name, values = _assigned("--limit", text, moving, (4, 5), "LOWER,UPPER,SPEED,ACCELERATION")
        changes[name] = Limits(*values[:4])
        if len(values) == 5:
            torques[name] = values[4]
    every = motion_limits(robot, changes)
    of = {name: every[moving.index(name)] for name in moving}
    stated = {**robot.limits, **changes}
    lower, upper, speed, acceleration = np.array(
        [dataclasses.astuple(of[name])[:4] for name in coordinates]
    ).T
    closure = compiled.spec.closure
    follow = () if closure is None else tuple(
        (place, stated[name].lower, stated[name].upper)
        for place, name in enumerate(closure.variables)
        if place not in closure.given and name in stated
    )  # fmt: skip
    home = None if closure is None else np.array(closure.home)[list(closure.given)]
    return Bounds(
        tuple(coordinates), lower, upper, speed, acceleration,
        torque=np.array([torques.get(name, np.inf) for name in coordinates]),
        boxes=tuple(_box(text, moving) for text in boxes), passive=follow, home=home,
    )  # fmt: skip


def _box(text: str, moving: list[str]) -> Box:
    name, values = _assigned("--box", text, moving, (6,), "X0,X1,Y0,Y1,Z0,Z1")
    return Box(
        name, moving.index(name),
        (values[0], values[2], values[4]), (values[1], values[3], values[5]),
    )  # fmt: skip


def _assigned(
    option: str, text: str, names: list[str], counts: tuple[int, ...], form: str
) -> tuple[str, list[float]]:
    name, equals, cells = text.partition("=")
    try:
        values = [float(cell) for cell in cells.split(",")]
    except ValueError:
        values = []
    if not equals or len(values) not in counts:
        raise DataError(f"{option} {text}: expected {names[0]}={form}, numbers in SI units")
    if name not in names:
        raise DataError(
            f"{option} {text}: no moving joint {name}{near(name, names)}; expected one of "
            f"{', '.join(names)}"
        )
    if any(math.isnan(value) for value in values):
        raise DataError(f"{option} {text}: got nan; expected numbers")
    return name, values


def _question(args: argparse.Namespace, subject: _Subject) -> Question:
    """The two effects of --between."""
    joints = [joint.name for joint in subject.compiled.spec.joints]
    catalogue = subject.robot.catalogue
    ids = [effect.id for effect in catalogue]
    found = []
    for text in args.between.split(","):
        name, _, joint = text.strip().partition("@")
        effect = effect_named(name, catalogue)
        if effect is None:
            raise DataError(
                f"--between {text}: no such effect{near(name, ids)}; expected some of "
                f"{', '.join(ids)}"
            )
        if joint not in joints:
            raise DataError(
                f"--between {text}: got joint {joint or '(none)'}; expected EFFECT@J with one of "
                f"{', '.join(joints)}"
            )
        if subject.robot.has_effect(effect.id, joint):
            raise DataError(
                f"--between {text}: the model has {effect.id} on joint {joint} already; expected "
                "effects that it lacks"
            )
        found.append((effect, joint))
    if len(found) != 2 or found[0] == found[1]:
        raise DataError(f"--between {args.between}: expected two effects, as stribeck@2,spring@2")
    assert subject.beta is not None
    return Question((found[0], found[1]), subject.beta, subject.sigma)


def _choose(args: argparse.Namespace, subject: _Subject) -> Json:
    names = [joint.name for joint in subject.compiled.spec.joints]
    kept = slice(None) if subject.kept is None else subject.kept
    weights = 1.0 if subject.sigma is None else 1.0 / subject.sigma[:, None]
    rows = []
    with working("building the rows of the motions"):
        for place in args.candidates:
            motion = read_motion(place, names)
            s = signals(subject.compiled.spec, motion.q, motion.time)
            phi = subject.compiled.base_regressor(motion.q, motion.qd, motion.qdd, s)[:, :, kept]
            rows.append((phi * weights).reshape(-1, phi.shape[2]))
        choice = choose(rows, args.choose)
    for k, place in enumerate(args.candidates):
        mark = "chosen  " if k in choice.places else "        "
        say(f"{mark}{place}: condition number {choice.alone[k]:.4g} by itself")
    say(
        f"{len(choice.places)} chosen: condition number {choice.condition:.4g} together, all "
        f"{len(rows)} {choice.whole:.4g}, columns of length one"
    )
    return {
        "robot": subject.robot.name,
        "chosen": [str(args.candidates[k]) for k in choice.places],
        "condition_scaled": choice.condition,
        "condition_scaled_all": choice.whole if math.isfinite(choice.whole) else None,
        "alone": [value if math.isfinite(value) else None for value in choice.alone],
        "exhaustive": choice.exhaustive,
    }


def _write(args: argparse.Namespace, motion: Exciting, compiled: CompiledModel) -> None:
    columns = motion.sampled(args.rate)
    if args.out.endswith(".csv"):
        write_atomically(Path(args.out), csv_text(columns))
    else:
        write_atomically(Path(args.out), motion_table(columns))
    say(f"written: {args.out}, {len(columns['time'])} samples, {motion.seconds:.1f} s of search")
    if args.picture is not None:
        with working("drawing"):
            drawn = picture(motion, compiled, check_kind(args.picture))
        write_atomically(Path(args.picture), drawn)
        say(f"written: {args.picture}")
