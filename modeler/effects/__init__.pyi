from .catalogue import (
    CATALOGUE as CATALOGUE,
    ENCODERS as ENCODERS,
    PASSIVE_FRICTION as PASSIVE_FRICTION,
    PASSIVE_FRICTION_IS as PASSIVE_FRICTION_IS,
    find_effect as find_effect,
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
    Effect as Effect,
    EffectColumn as EffectColumn,
    EffectTarget as EffectTarget,
    EnergyBlock as EnergyBlock,
    Form as Form,
    InternalState as InternalState,
    NonlinearParameter as NonlinearParameter,
    Requirement as Requirement,
    SignatureAxis as SignatureAxis,
)
