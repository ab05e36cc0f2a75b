"""The robot as the user states it: data, no derivation."""

import enum
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from modeler.core.expression import Expression
from modeler.core.json import ShortRepr
from modeler.core.manifest import DriveSpec
from modeler.core.result import Result
from modeler.core.toml_cells import (
    TomlCell as TomlCell,
    join_names as join_names,
    suggest_name as suggest_name,
)
from modeler.effects import CATALOGUE, Effect, EffectColumn, Form, find_effect

# One row of a modified Denavit-Hartenberg table.


class JointKind(enum.IntEnum):
    """The kind of a joint, which is sigma of the table."""

    REVOLUTE = 0
    PRISMATIC = 1
    FIXED = 2


@dataclass(frozen=True)
class Joint(ShortRepr):
    """Frame j on link j, placed from its antecedent frame a(j).

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) (Khalil and Kleinfinger 1986);
    the joint axis is z_j. Lengths in m, angles in rad.

    Attributes:
        name: row name; q<name> is its variable, in `theta` (revolute) or `r` (prismatic).
        antecedent: name of the antecedent row, "0" for the base.
        actuated: mu = 1.
    """

    name: str
    antecedent: str
    actuated: bool
    kind: JointKind
    gamma: Expression
    b: Expression
    alpha: Expression
    d: Expression
    theta: Expression
    r: Expression

    @property
    def variable(self) -> str:
        """Returns name of the joint variable."""
        return f"q{self.name}"

    @property
    def is_moving(self) -> bool:
        """Returns False for a frame fixed on its antecedent (sigma = 2), which carries no link."""
        return self.kind is not JointKind.FIXED

    @property
    def is_revolute(self) -> bool:
        """Returns True for a revolute joint."""
        return self.kind is JointKind.REVOLUTE

    @property
    def unit(self) -> str:
        """Returns unit of the joint variable."""
        return "rad" if self.is_revolute else "m"

    @property
    def effort_unit(self) -> str:
        """Returns unit of the joint torque or force."""
        return "N m" if self.is_revolute else "N"


INERTIAL = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""The ten standard inertial parameters of a link at the origin of its frame, in that frame
(Khalil and Dombre 2002, section 9.2): inertia [kg m2], first moments [kg m], mass [kg]."""


@dataclass(frozen=True)
class EffectInstance:
    """An effect on one joint.

    Attributes:
        joint: name.
        form: place among the forms of the effect.
        shapes: values of its shape parameters, SI.
        label: after the names of its parameters; "" but for a second instance on the same joint.
    """

    joint: str
    form: int = 0
    nonlinear_parameters: Mapping[str, float] = field(default_factory=dict)
    label: str = ""


@dataclass(frozen=True)
class EffectUse:
    """An effect of the catalogue or of the robot file, and where the robot has it.

    Attributes:
        effect: id.
        joints: that have it, each once.
        shaped: with their shapes; empty for an effect without.
    """

    effect: str
    joints: tuple[str, ...]
    stated_instances: tuple[EffectInstance, ...] = ()

    @property
    def instances(self) -> tuple[EffectInstance, ...]:
        """Returns the effect on every joint, as often as it stands there."""
        return self.stated_instances or tuple(EffectInstance(joint) for joint in self.joints)


@dataclass(frozen=True)
class PhysicalLink(ShortRepr):
    """How a paper writes a link: mass, mass centre, inertia about the mass centre.

    Attributes:
        mass: [kg].
        centre: mass centre in frame j, m.
        inertia: XX XY XZ YY YZ ZZ about the mass centre, along the axes of frame j, kg m2.
    """

    mass: Expression
    centre: tuple[Expression, Expression, Expression]
    inertia: tuple[Expression, ...]


@dataclass(frozen=True)
class Limits:
    """Range of a joint for simulated motion: position [rad, m], speed and acceleration."""

    lower: float
    upper: float
    speed: float
    acceleration: float


@dataclass(frozen=True)
class LinkFrame(ShortRepr):
    """The frame of a link in another program's file: where it is on a row of the table.

    Its pose in the frame of the row is Trans(x, y, z) Rz(yaw) Ry(pitch) Rx(roll), as URDF has it.

    Attributes:
        row: name of the row whose frame it moves with; "0" for the base.
        joint: name in that file of the joint of the row, for the link that this joint moves; ""
            for a link that is held by a fixed joint, and for the base.
        position: x, y, z, m.
        angles: roll, pitch, yaw, rad.
        on: the frame that it is placed in; None for that of the row.
    """

    row: str
    joint: str
    position: tuple[Expression, Expression, Expression]
    angles: tuple[Expression, Expression, Expression]
    on: "LinkFrame | None" = None


@dataclass(frozen=True)
class LinkCapsule:
    """What a link fills: all that is no farther than `radius` from the way between two points.

    Attributes:
        row: name of the row whose frame it moves with; "0" for the base.
        radius: m.
        ends: of the way, in that frame, m; None: from its origin to the frames after it.
    """

    row: str
    radius: float
    ends: tuple[tuple[float, ...], tuple[float, ...]] | None = None


LOOP_KINDS = (
    "rigid",
    "revolute",
    "prismatic",
    "cylindrical",
    "universal",
    "spherical",
    "position",
    "planar",
)
"""What the joint that closes a loop lets free; see `Loop`."""


@dataclass(frozen=True)
class Loop:
    """A joint that closes a kinematic chain: frame `frame` and frame `meets` meet there.

    rigid: the frames coincide; revolute: origins and z axes coincide; prismatic: they coincide but
    for a travel along z; cylindrical: the z axes coincide as lines; universal: origins coincide
    and the z axes (the two axes of the cross) are perpendicular; spherical, position: origins
    coincide; planar: their xy planes coincide.

    Attributes:
        name: of the loop, for messages.
        frame: row of one frame.
        meets: row of the other; "0" for the base.
        kind: one of `LOOP_KINDS`.
    """

    name: str
    frame: str
    meets: str
    kind: str


@dataclass(frozen=True)
class SharedParameter:
    """One parameter that several links have in common: "XX2" for XX21, XX22, XX23."""

    name: str
    members: tuple[str, ...]


@dataclass(frozen=True)
class Robot(Result):
    """A robot: serial, tree-structured, or with closed loops.

    Attributes:
        gravity: acceleration of gravity in frame 0, m/s2.
        symbols: declared geometric symbols and their values, in file order; a value is a number
            or an expression without joint variables.
        joints: rows of the table; each stands after its antecedent.
        own_effects: effects that the file defines itself.
        effects: physical effects beyond rigid links, in catalogue order.
        coupling: motor rows that turn with several joints: name of the joint whose motor it is ->
            {joint: coefficient}; motor speed = sum of coefficient * qd (gear ratio taken out).
        motors: rows of motors that drive the joints through a coupling, in table order: motor ->
            {joint: coefficient}, q_m = G q_a (see `modeler.robot.mechanism`); empty where each
            joint has its own.
        priority: names or patterns (`ZZ*`, `Ia?`) of parameters that are kept first when
            parameters group; the others follow in table order.
        parameters: nominal values of standard parameters, SI units.
        uncertainty: their standard deviations by name, 0 of those that are held; "inertial": of
            every body, over its scale. Empty: they are nominal values only.
        drive_gains: joint torque per unit of the logged drive current, by joint.
        drives: what makes a current of a logged duty, by joint.
        limits: range of motion for simulation, by joint.
        physical: the letters of a paper for the links, by joint.
        terms: how a paper prints its coefficients (see `modeler.formulas`).
        log: which columns of logs are ours, and in which units (see `modeler.logs`).
        fit, diagnose: options of these commands, by their names, for this robot.
        relations: variables of joints that follow others: row -> its variable as a linear
            expression of the variables of other rows (`q4 = "-q3"`).
        loops: joints that close kinematic chains.
        platform: rows that move the platform, the last of which carries it; empty without one.
        home: posture from which loops are closed, by row; rows left out stand at 0. It says which
            assembly mode is meant.
        links: inertial parameters of rows that have not all ten: row -> prefixes.
        shared: parameters that similar legs have in common.
        reference: standard parameters at which effects that depend on the load are linearised.
        frames: links of the file that the robot was read from, by name, so that values find their
            way back.
        tool: the frame whose motion a controller commands; None if the file states none.
        capsules: what links fill, so that they do not run into each other.
        planes: of the surroundings: name -> normal and offset, free is `normal x > offset`, m.
        notes: source of the table and remarks, for people.
        convention: in whose letters the table was given; `joints` are rows of Khalil's.
        readings: what reading the file decided or left out, for people.
        text: the TOML text it was read from.
    """

    name: str
    title: str
    gravity: tuple[Expression, Expression, Expression]
    symbols: Mapping[str, Expression]
    joints: tuple[Joint, ...]
    own_effects: tuple[Effect, ...] = ()
    effects: tuple[EffectUse, ...] = ()
    coupling: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    motors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    priority: tuple[str, ...] = ()
    parameters: Mapping[str, float] = field(default_factory=dict)
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    drive_gains: Mapping[str, float] = field(default_factory=dict)
    drives: Mapping[str, DriveSpec] = field(default_factory=dict)
    limits: Mapping[str, Limits] = field(default_factory=dict)
    physical: Mapping[str, PhysicalLink] = field(default_factory=dict)
    terms: Mapping[str, object] = field(default_factory=dict)
    log: Mapping[str, object] = field(default_factory=dict)
    fit: Mapping[str, Any] = field(default_factory=dict)
    diagnose: Mapping[str, Any] = field(default_factory=dict)
    relations: Mapping[str, Expression] = field(default_factory=dict)
    loops: tuple[Loop, ...] = ()
    platform: tuple[str, ...] = ()
    home: Mapping[str, float] = field(default_factory=dict)
    links: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    shared: tuple[SharedParameter, ...] = ()
    reference: Mapping[str, float] = field(default_factory=dict)
    frames: Mapping[str, LinkFrame] = field(default_factory=dict)
    tool: LinkFrame | None = None
    capsules: tuple[LinkCapsule, ...] = ()
    planes: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    notes: str = ""
    convention: str = "khalil"
    readings: tuple[str, ...] = ()
    text: str = ""

    @property
    def heading(self) -> str:
        """Returns name and title as a line."""
        return self.name if self.title == self.name else f"{self.name}: {self.title}"

    def open_loops(self) -> "Robot":
        """Returns the virtual tree: no loops, no relations, every joint of the table actuated."""
        joints = tuple(replace(joint, actuated=joint.is_moving) for joint in self.joints)
        return replace(self, joints=joints, loops=(), relations={})

    @property
    def moving_joints(self) -> tuple[Joint, ...]:
        """Returns rows with a joint variable, in table order."""
        return tuple(joint for joint in self.joints if joint.is_moving)

    @property
    def free_joints(self) -> tuple[Joint, ...]:
        """Returns moving rows whose variable does not follow others, in table order."""
        return tuple(joint for joint in self.moving_joints if joint.name not in self.relations)

    @property
    def coordinates(self) -> tuple[Joint, ...]:
        """Returns rows whose variables are q, qd, qdd, tau, in that order.

        The free rows of a tree; the actuated ones among them once loops tie the others to them.
        """
        return tuple(joint for joint in self.free_joints if joint.actuated or not self.loops)

    @property
    def log_mapping(self) -> Mapping[str, object]:
        """Returns [log]; without names there, columns are named as the source file's joints."""
        names = {frame.row: frame.joint for frame in self.frames.values() if frame.joint}
        return {"names": names, **self.log} if names else self.log

    @property
    def has_binary_fractions(self) -> bool:
        """Returns True if lengths and angles of the file hold decimals such as 0.5 or 0.75."""
        columns = ("gamma", "b", "alpha", "d", "theta", "r")
        cells = [getattr(joint, column) for joint in self.joints for column in columns]
        constant_symbols = (e for e in self.symbols.values() if e.names or e.uses_pi)
        expressions = (*cells, *self.gravity, *constant_symbols)
        parts = (x.denominator for expression in expressions for x in expression.decimals)
        return any(n > 1 and n & (n - 1) == 0 for n in parts)

    @property
    def priority_parameters(self) -> tuple[str, ...]:
        """Returns `priority`; where none is stated, the platform's parameters.

        What moves the platform is what people look for, and legs group into it more simply than
        it into legs.
        """
        if self.priority or not self.platform:
            return self.priority
        name = self.platform[-1]
        return tuple(f"{prefix}{name}" for prefix in self.get_inertial_prefixes(name))

    @property
    def catalogue(self) -> tuple[Effect, ...]:
        """Returns the effects that the robot may have: those of the catalogue, then its own."""
        return (*CATALOGUE, *self.own_effects)

    def get_inertial_prefixes(self, name: str) -> tuple[str, ...]:
        """Returns prefixes of the inertial parameters of the link of that row."""
        return self.links.get(name, INERTIAL)

    def get_joint(self, name: str) -> Joint:
        """Returns the joint in the row of that name."""
        return next(joint for joint in self.joints if joint.name == name)

    def find_joint_effects(self, joint: str) -> list[tuple[Effect, Form, EffectInstance]]:
        """Returns the effects of a joint, in catalogue order."""
        joint_effects = []
        for use in self.effects:
            effect = find_effect(use.effect, self.catalogue)
            if effect is None:  # one that only the simulator would refuse
                continue
            for instance in use.instances:
                if instance.joint == joint:
                    joint_effects.append((effect, effect.forms[instance.form], instance))
        return joint_effects

    def find_windup(self, joint: str) -> tuple[float, float] | None:
        """Returns stiffness and damping of an elastic joint; None of another."""
        for _, form, instance in self.find_joint_effects(joint):
            if form.is_windup and form.internal_state is not None:
                values, state = instance.nonlinear_parameters, form.internal_state
                return values[state.parameter], values[state.damping]
        return None

    @property
    def rigid(self) -> "Robot":
        """Returns the robot without its elastic joints."""
        elastic = {effect.id for effect in self.catalogue if effect.usual_form.is_windup}
        uses = (use for use in self.effects if use.effect not in elastic)
        return replace(self, effects=tuple(uses))

    def set_windups(self, sizes: Sequence[float]) -> "Robot":
        """Returns the robot with these stiffnesses, then dampings, of its elastic joints."""
        joints = [j.name for j in self.moving_joints if self.find_windup(j.name) is not None]
        K, D = sizes[: len(joints)], sizes[len(joints) :]
        values = {joint: {"K": k, "D": d} for joint, k, d in zip(joints, K, D, strict=True)}
        uses = []
        for use in self.effects:
            effect = find_effect(use.effect, self.catalogue)
            if effect is not None and effect.usual_form.is_windup:
                changed = (
                    replace(at, nonlinear_parameters=values[at.joint]) for at in use.instances
                )
                use = replace(use, stated_instances=tuple(changed))
            uses.append(use)
        return replace(self, effects=tuple(uses))

    def has_effect(self, effect: str, joint: str) -> bool:
        """Returns True if that joint carries that effect."""
        return any(use.effect == effect and joint in use.joints for use in self.effects)

    def evaluate_symbols(self) -> dict[str, float]:
        """Returns numbers of all declared symbols."""
        values: dict[str, float] = {}
        for name, expression in self.symbols.items():
            values[name] = expression.evaluate(values)
        return values


# What the standard parameters of a robot are, in plain words, and which rows they belong to.


@dataclass(frozen=True)
class ParameterDescription:
    """A standard parameter.

    Attributes:
        words: what it is.
        unit: SI.
        rows: of the table, that it belongs to.
    """

    words: str
    unit: str
    rows: tuple[str, ...]


def describe_parameters(robot: Robot) -> dict[str, ParameterDescription]:
    """Describes every standard parameter of the robot, by name; shared ones too."""
    descriptions = dict(_iterate_descriptions(robot))
    for shared in robot.shared:
        members = [descriptions[name] for name in shared.members if name in descriptions]
        if members:
            rows = tuple(row for member in members for row in member.rows)
            same = f"of the links {', '.join(rows)} alike"
            words = members[0].words.replace(f"of link {rows[0]}", same)
            descriptions[shared.name] = ParameterDescription(words, members[0].unit, rows)
    return descriptions


def _iterate_descriptions(robot: Robot) -> Iterator[tuple[str, ParameterDescription]]:
    for joint in robot.moving_joints:
        for prefix in robot.get_inertial_prefixes(joint.name):
            yield prefix + joint.name, _describe_inertial(prefix, joint.name)
        for effect, form, instance in robot.find_joint_effects(joint.name):
            for column in form.columns:
                name = f"{column.prefix}{joint.name}{instance.label}"
                yield name, _describe_effect_parameter(effect, column, joint)


def _describe_inertial(prefix: str, link: str) -> ParameterDescription:
    where = f"of link {link}"
    if prefix == "M":
        return ParameterDescription(f"mass {where}", "kg", (link,))
    axes = [letter.lower() + link for letter in prefix.removeprefix("M")]
    if prefix.startswith("M"):
        words = f"first moment {where} along {axes[0]}: mass times centre"
        return ParameterDescription(words, "kg m", (link,))
    if axes[0] == axes[1]:
        words = f"moment of inertia {where} about {axes[0]}, at the origin of frame {link}"
    else:
        words = f"product of inertia {where}, of {axes[0]} and {axes[1]}"
    return ParameterDescription(words, "kg m\u00b2", (link,))


def _describe_effect_parameter(
    effect: Effect, column: EffectColumn, joint: Joint
) -> ParameterDescription:
    unit = column.unit_revolute if joint.is_revolute else column.unit_prismatic
    unit = unit.replace("^2", "\u00b2").replace("*", " ")
    return ParameterDescription(f"{effect.title}, joint {joint.name}", unit, (joint.name,))
