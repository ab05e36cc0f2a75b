"""What an export wrote: every number before and after, and what the file cannot hold."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from modeler.core.json import Document, ShortRepr
from modeler.core.result import Presentation, Result, register_presentations
from modeler.core.table import Table, format_percent
from modeler.formats.bodies import (
    ExportParameters,
    compute_central_parameters,
    compute_magnitudes,
    express_parameters,
    propagate_deviations,
)
from modeler.formats.body_tree import Pose
from modeler.formats.completion import compute_distance
from modeler.formats.linkage import compute_gravity
from modeler.formats.original import TENSOR
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import Joint

Torques = Callable[[np.ndarray], tuple[np.ndarray, tuple[str, ...]]]
"""From base parameters to the (rows, n) torques of the fit, and the names of their joints."""

_USUAL = 9.81  # m/s2, of programs that get no gravity


@dataclass(frozen=True)
class LostEffect(ShortRepr):
    """An effect of a joint that the format has no place for.

    Attributes:
        effect: id; "" of a parameter of no effect.
        joint: row; "" of gravity.
        values: by name, SI.
        share: of the torque; None of a robot, or where it is not reported.
        share_of: "joint 2", or "all torques" of shares that C computes.
    """

    effect: str
    joint: str
    values: dict[str, float]
    share: float | None = None
    share_of: str = ""

    @property
    def summary_line(self) -> str:
        """Returns the effect, its values and its share of the torque as a line."""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in self.values.items())
        share = "" if self.share is None else f", about {format_percent(self.share, 2)}"
        share += f" of {self.share_of}" if share else ""
        where = f" of joint {self.joint}" if self.joint else ""
        return f"{self.effect or 'parameter'}{where} ({values}){share}"


def find_lost_effects(
    physics: ExportParameters, to: str, torques: Torques | None = None, has_elastic: bool = False
) -> tuple[LostEffect, ...]:
    """Lists the effects that the format cannot hold, by share of torque.

    URDF and SDF models hold the direction of gravity alone, and programs take 9.81 m/s2.

    Args:
        physics: all numbers.
        to: the format.
        torques: of the logs of the fit, if they are there.
        has_elastic: the file has a second joint behind the motor of each elastic one.
    """
    robot, lost_effects = physics.robot, list[LostEffect]()
    g = float(np.linalg.norm(compute_gravity(robot)))
    if to != "mjcf" and abs(g - _USUAL) > THRESHOLDS.max_gravity_difference * _USUAL:
        lost_effects.append(LostEffect("size of gravity", "", {"g": g}))
    joint_terms = [physics.collect_drive_terms(j.name, to) for j in robot.moving_joints]
    stated_names = {name for terms in joint_terms for each in terms.values() for name in each}
    for joint in robot.moving_joints:
        for effect, form, instance in robot.find_joint_effects(joint.name):
            if form.is_windup and not has_elastic:
                sizes = dict(instance.nonlinear_parameters)
                lost_effects.append(LostEffect(effect.id, joint.name, sizes))
            names = [f"{column.prefix}{joint.name}{instance.label}" for column in form.columns]
            values = {
                n: float(physics.completion.chi[physics.indices[n]])
                for n in names
                if n in physics.indices and n not in stated_names
            }
            if any(values.values()):
                share, of = _compute_torque_share(physics, list(values), joint.name, torques)
                if share is None or share >= THRESHOLDS.min_lost_share:
                    lost_effects.append(LostEffect(effect.id, joint.name, values, share, of))
    return tuple(sorted(lost_effects, key=lambda one: -(one.share or float(not one.joint))))


def _compute_torque_share(
    physics: ExportParameters, names: list[str], joint: str, torques: Torques | None
) -> tuple[float | None, str]:
    if physics.fit is None:
        return None, ""
    at = [physics.indices[name] for name in names]
    contribution = physics.machine.K[:, at] @ physics.completion.chi[at]
    beta, C = physics.fit
    if torques is None:
        whole = compute_distance(beta, C)
        return (compute_distance(contribution, C) / whole if whole else None), "all torques"
    part, joints = torques(contribution)
    total_torques, _ = torques(beta)
    place, of = [*range(len(joints))], "all torques"
    if joint in joints:
        place, of = [joints.index(joint)], f"the torque of joint {joint}"
    size = float(np.linalg.norm(total_torques[:, place]))
    return (float(np.linalg.norm(part[:, place])) / size if size else None), of


# What was written: every number as it was and is, and what the file cannot hold.


_HEAD = b"<!-- modeler export: "
_OURS = re.compile(re.escape(_HEAD) + rb".*?-->\r?\n?", re.DOTALL)
_DECLARATION = re.compile(rb"\A(?:\xef\xbb\xbf)?(?:\s*<\?xml[^>]*\?>[ \t]*(?:\r?\n)?)?")

QUANTITIES = ("mass", *(f"centre {axis}" for axis in "xyz"), *TENSOR)
"""Of a body, as `written` orders them: centre in the link's frame, inertia about it along the axes
of the file."""

_UNITS = ("kg", *3 * ("m",), *6 * ("kg m2",))
_DRIVE_UNITS = {
    "damping": ("N m s/rad", "N s/m"),
    "friction": ("N m", "N"),
    "armature": ("kg m2", "kg"),
    "stiffness": ("N m/rad", "N/m"),
}


@dataclass(frozen=True)
class Value(ShortRepr):
    """A number of the file.

    Attributes:
        part: link or joint.
        quantity: one of `QUANTITIES`, or damping, friction, armature, stiffness.
        unit: SI.
        before: in the original, or in the robot file; None if nowhere.
        after: written.
        sigma: its standard deviation; None of a robot.
        is_changed: False where the number is the one that was there, but for rounding.
    """

    part: str
    quantity: str
    unit: str
    before: float | None
    after: float
    sigma: float | None
    is_changed: bool


@dataclass(frozen=True, eq=False)
class Exported(Result, Document):
    """A file for another program.

    Attributes:
        robot: name.
        format: one of `FORMATS`.
        template: the original whose numbers were replaced; "" of a file of its own.
        data: the file.
        values: its numbers.
        not_held: effects that it has no place for.
        moved: by how many sigmas of the fit the base parameters moved so that they can be built.
        notes: what was decided.
        functions: {name: inputs and outputs} of a file of equations.
        files: of a folder, by name; `data` is empty then.
    """

    KEYS = """
        robot format template=template_name shift_in_sigmas values lost_effects notes functions
        files=file_names
    """

    robot: str
    format: str
    template: str
    data: bytes
    values: tuple[Value, ...]
    lost_effects: tuple[LostEffect, ...]
    shift_in_sigmas: float
    notes: tuple[str, ...]
    functions: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def template_name(self) -> str | None:
        """Returns the original whose numbers were replaced; None of a file of its own."""
        return self.template or None

    @property
    def file_names(self) -> list[str]:
        """Returns the names of the files of a folder."""
        return sorted(self.files)


def format_numbers(values: Iterable[float]) -> str:
    """Returns shortest decimals that read as the same numbers."""
    return " ".join(repr(float(x) + 0.0).removesuffix(".0") for x in values)


def keep_unchanged(now: np.ndarray, was: np.ndarray | None) -> np.ndarray:
    """Returns a body (10,) with the numbers that were there where these are the same.

    Both are as of `compute_central_parameters`.
    """
    if was is None:
        return now
    size = np.maximum(compute_magnitudes(now), compute_magnitudes(was))
    is_same = np.abs(now - was) <= THRESHOLDS.max_unchanged_difference * size
    return np.where(is_same, was, now)


def compute_sigmas(
    physics: ExportParameters,
    row: str,
    pose: Pose | None = None,
    attached_inertia: np.ndarray | float = 0.0,
    axes: np.ndarray | None = None,
) -> np.ndarray | None:
    """Returns (10,) standard deviations of the body of a row as `compute_central_parameters`.

    None of a robot.

    Args:
        physics: all numbers.
        row: whose link it is.
        pose: of the frame of the body on the row.
        attached_inertia: (10,) what hangs on it and keeps its numbers, in the frame of the row.
        axes: (3, 3) along which its inertia is written, in its frame.
    """
    if physics.fit is None:
        return None
    places, back = physics.find_link_indices(row), (pose or Pose()).inverse()
    spread = physics.completion.covariance[np.ix_(places, places)]

    def compute_central(ten: np.ndarray) -> np.ndarray:
        return compute_central_parameters(express_parameters(ten - attached_inertia, back), axes)

    return propagate_deviations(compute_central, physics.completion.chi[places], spread)


def build_body_values(
    part: str, was: np.ndarray | None, now: np.ndarray, sigma: np.ndarray | None = None
) -> Iterator[Value]:
    """Yields the numbers of a body, as `compute_central_parameters`."""
    same = keep_unchanged(now, was)
    for k, (quantity, unit) in enumerate(zip(QUANTITIES, _UNITS, strict=True)):
        before = None if was is None else float(was[k])
        deviation = None if sigma is None else float(sigma[k])
        changed = before is None or before != float(same[k])
        yield Value(part, quantity, unit, before, float(now[k]), deviation, changed)


def build_drive_values(
    physics: ExportParameters, joint: Joint, part: str, to: str, was: dict[str, float]
) -> Iterator[Value]:
    """Yields damping, friction and the like of a joint."""
    for quantity, terms in physics.collect_drive_terms(joint.name, to).items():
        now, sigma = physics.evaluate_sum(terms)
        unit, before = _DRIVE_UNITS[quantity][0 if joint.is_revolute else 1], was.get(quantity)
        most = THRESHOLDS.max_unchanged_difference * abs(now)
        changed = before is None or abs(now - before) > most
        deviation = sigma if physics.fit else None
        yield Value(part, quantity, unit, before, now, deviation, changed)


def insert_comment(data: bytes, exported: Exported) -> bytes:
    """Returns file with what it holds as one comment at its head, in place of an earlier one."""
    data = _OURS.sub(b"", data, count=1)
    lines = [f"{exported.robot}: value, was, standard deviation"]
    shown = (v for v in exported.values if _is_visible_change(v) or not exported.template)
    lines += map(_format_line, shown)
    name = exported.format.upper()
    lines += [f"not held by {name}: {lost.summary_line}" for lost in exported.lost_effects]
    lines += exported.notes
    text = "\n  ".join(lines).replace("--", "- -")
    head = _DECLARATION.match(data)
    at = head.end() if head else 0
    end = b"\r\n" if b"\r\n" in data[:4096] else b"\n"
    comment = (_HEAD + text.encode() + b"\n-->\n").replace(b"\n", end)
    broken = b"" if not at or data[at - 1 : at] == b"\n" or data[:at] == b"\xef\xbb\xbf" else end
    return data[:at] + broken + comment + data[at:]


def _is_visible_change(value: Value) -> bool:
    """Whether a number differs in the digits that are shown."""
    return value.is_changed and (
        value.before is None or f"{value.before:.6g}" != f"{value.after:.6g}"
    )


def _format_line(value: Value) -> str:
    was = "none" if value.before is None else f"{value.before:.6g}"
    sigma = "" if value.sigma is None else f" +- {value.sigma:.2g}"
    return f"{value.part} {value.quantity}: {value.after:.6g}{sigma} {value.unit}, was {was}"


def _format_title(exported: Exported) -> str:
    titles = {"casadi": "CasADi", "fmu": "FMU", "ros2": "package for ROS 2"}
    return titles.get(exported.format, exported.format.upper())


def _format_summary(exported: Exported) -> str:
    changed = sum(value.is_changed for value in exported.values)
    title, count = _format_title(exported), len(exported.values)
    first = f"{exported.robot} as {title}"
    if exported.template:
        first += f" like {exported.template}: {changed} of {count} numbers changed"
    elif count:
        first += f": {count} numbers"
    if exported.functions:
        first += f"{',' if count else ':'} {len(exported.functions)} functions"
    lost = [f"{title} cannot hold {one.summary_line}" for one in exported.lost_effects]
    return "\n".join([first, *exported.notes, *lost])


def _build_values_table(exported: Exported, values: Iterable[Value]) -> Table:
    rows = [(v.part, v.quantity, v.before, v.after, v.sigma, v.unit) for v in values]
    head = "part, quantity, was, is, sigma, unit"
    return Table.build(f"{exported.robot}: numbers of the file", head, rows)


def _build_lost_table(exported: Exported) -> Table:
    texts = [
        ", ".join(f"{n} = {x:.4g}" for n, x in one.values.items()) for one in exported.lost_effects
    ]
    lost = zip(exported.lost_effects, texts, strict=True)
    rows = [(one.effect, one.joint, text, one.share, one.share_of) for one, text in lost]
    head = "effect, joint, values, share, of"
    return Table.build(f"{exported.robot}: what {_format_title(exported)} cannot hold", head, rows)


def _list_tables(exported: Exported) -> dict[str, Callable[[], Table]]:
    functions = [*exported.functions.items()]
    head = "function, arguments"
    return {
        "values": lambda: _build_values_table(exported, exported.values),
        "changed": lambda: _build_values_table(
            exported, filter(_is_visible_change, exported.values)
        ),
        "lost effects": lambda: _build_lost_table(exported),
        "functions": lambda: Table.build(f"{exported.robot}: functions", head, functions),
    }


register_presentations(
    {
        Exported: Presentation(
            "a file for another program",
            _format_summary,
            _list_tables,
            page=("values", "lost effects"),
        )
    }
)
