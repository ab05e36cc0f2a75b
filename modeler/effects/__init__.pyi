from .catalogue import (
    CATALOGUE as CATALOGUE,
    ENCODERS as ENCODERS,
    PASSIVE_FRICTION as PASSIVE_FRICTION,
    PASSIVE_FRICTION_IS as PASSIVE_FRICTION_IS,
    effect_named as effect_named,
)
from .definition import (
    EXAMPLE as EXAMPLE,
    check_finite as check_finite,
    read_definition as read_definition,
)
from .effect import (
    MOTION as MOTION,
    NOISE as NOISE,
    TURN as TURN,
    VARIABLES as VARIABLES,
    Acts as Acts,
    Effect as Effect,
    EffectColumn as EffectColumn,
    EnergyBlock as EnergyBlock,
    Form as Form,
    Memory as Memory,
    Needs as Needs,
    Shape as Shape,
    Shows as Shows,
)
