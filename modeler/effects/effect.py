"""What an effect is: everything that any stage needs to know of it."""

import enum
from dataclasses import dataclass

from modeler.core.expression import Expression


class EnergyBlock(enum.Enum):
    """Where a column stands in the energy rows that decide grouping (see `modeler.base`).

    With v the speed of the shaft (the joint's, or the motor's where motors are coupled), the column
    is the derivative of that function; columns of different blocks never group.
    """

    KINETIC = "v**2: twice the kinetic energy"
    POWER = "v: power of a constant force"
    RAYLEIGH = "v**2: Rayleigh dissipation function"
    COULOMB = "|v|: dissipated power of dry friction"


@dataclass(frozen=True)
class EffectColumn:
    """One column: torque of the joint = equation * parameter.

    Attributes:
        prefix: parameter name without the joint, e.g. "Fv".
        equation: in v and a, speed and acceleration of the shaft.
        unit_revolute: unit of the parameter on a revolute joint.
        unit_prismatic: the same on a prismatic joint.
        kind: rotor_inertia | friction | offset: how base parameters are counted.
        block: its energy function, for grouping.
        nonnegative: physics allows no negative value.
    """

    prefix: str
    equation: Expression
    unit_revolute: str
    unit_prismatic: str
    kind: str
    block: EnergyBlock
    nonnegative: bool


@dataclass(frozen=True)
class Effect:
    """A physical effect, defined once.

    Attributes:
        id: as in robot files.
        aliases: other names of the same column, by algebra.
        title: plain language.
        equation: for people.
        columns: what it adds to the regressor.
        coupled: True if it acts on the shaft of a motor that turns with several joints
            (`[coupling]` in the robot file), False if on the joint itself.
        signature: how it shows itself in the residual.
        look_alikes: what it is mistaken for, and which motion tells them apart.
        range: sign and range that physics allows.
        source: where it is described.
    """

    id: str
    aliases: tuple[str, ...]
    title: str
    equation: str
    columns: tuple[EffectColumn, ...]
    coupled: bool
    signature: str
    look_alikes: str
    range: str
    source: str
