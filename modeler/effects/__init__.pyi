from .catalogue import (
    CATALOGUE as CATALOGUE,
    ENCODERS as ENCODERS,
    EXAMPLE as EXAMPLE,
    PASSIVE_FRICTION as PASSIVE_FRICTION,
    PASSIVE_FRICTION_IS as PASSIVE_FRICTION_IS,
    check_finite as check_finite,
    find_effect as find_effect,
    read_definition as read_definition,
)
from .effect import (
    MOTION as MOTION,
    NOISE as NOISE,
    TURN as TURN,
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
