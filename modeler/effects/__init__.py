"""The catalogue of physical effects, each defined once."""

from modeler.effects.catalogue import CATALOGUE as CATALOGUE
from modeler.effects.catalogue import ENCODERS as ENCODERS
from modeler.effects.catalogue import PASSIVE_FRICTION as PASSIVE_FRICTION
from modeler.effects.catalogue import PASSIVE_FRICTION_IS as PASSIVE_FRICTION_IS
from modeler.effects.catalogue import effect_named as effect_named
from modeler.effects.effect import VARIABLES as VARIABLES
from modeler.effects.effect import Acts as Acts
from modeler.effects.effect import Effect as Effect
from modeler.effects.effect import EffectColumn as EffectColumn
from modeler.effects.effect import EnergyBlock as EnergyBlock
from modeler.effects.effect import Form as Form
from modeler.effects.effect import Memory as Memory
from modeler.effects.effect import Needs as Needs
from modeler.effects.effect import Shape as Shape
from modeler.effects.effect import Shows as Shows
