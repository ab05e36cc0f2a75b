from . import relations as relations
from .base_parameters import base_parameters as base_parameters
from .certificate import kernel_modulo as kernel_modulo, row_echelon as row_echelon
from .closure import (
    ALL as ALL,
    LOOP_JOINTS as LOOP_JOINTS,
    Closure as Closure,
    meeting as meeting,
    moved_postures as moved_postures,
)
from .columns import (
    LinkColumn as LinkColumn,
    ShaftColumn as ShaftColumn,
    Signal as Signal,
    StandardColumn as StandardColumn,
    in_block as in_block,
)
from .derive import (
    HomeModes as HomeModes,
    derive_model as derive_model,
    modes_near as modes_near,
    with_home as with_home,
    written as written,
)
from .differentiation import derivatives as derivatives
from .enclosed import (
    EnclosedState as EnclosedState,
    Enclosures as Enclosures,
    NotEnclosed as NotEnclosed,
)
from .field import (
    Relations as Relations,
    SparseVector as SparseVector,
    as_fraction as as_fraction,
    by_powers as by_powers,
    linear_relations as linear_relations,
    places_of as places_of,
    value_modulo as value_modulo,
    with_square as with_square,
)
from .frame_motion import (
    BodyFrame as BodyFrame,
    body_frame as body_frame,
    frame_pose as frame_pose,
    jacobian as jacobian,
    jacobian_dot_qd as jacobian_dot_qd,
    known_frames as known_frames,
    twist as twist,
)
from .geometry import (
    Geometry as Geometry,
    GeometryRow as GeometryRow,
    geometric_symbol as geometric_symbol,
    quarter_turns as quarter_turns,
)
from .graph import (
    OPERATIONS as OPERATIONS,
    Arithmetic as Arithmetic,
    Expr as Expr,
    Graph as Graph,
    GraphAlgebra as GraphAlgebra,
    Node as Node,
    Plan as Plan,
    Table as Table,
    Vector as Vector,
    combination as combination,
)
from .kinematics import (
    Composite as Composite,
    Pose as Pose,
    Screw as Screw,
    base_poses as base_poses,
    cross as cross,
    dot as dot,
    free_screws as free_screws,
    gravity_in_frames as gravity_in_frames,
    plus as plus,
    pose as pose,
    poses as poses,
    project as project,
    screws as screws,
    times as times,
)
from .labels import Label as Label
from .lagrange import lagrange_torque as lagrange_torque
from .model import (
    Entries as Entries,
    SymbolicModel as SymbolicModel,
    along as along,
    effect_entries as effect_entries,
    followed as followed,
    signal_symbol as signal_symbol,
)
from .momenta import (
    coriolis_matrix as coriolis_matrix,
    coriolis_transpose as coriolis_transpose,
    energy_regressor as energy_regressor,
    momentum as momentum,
    momentum_regressor as momentum_regressor,
    momentum_rest_regressor as momentum_rest_regressor,
    power_regressor as power_regressor,
    slotine_li_regressor as slotine_li_regressor,
)
from .numeric_rank import random_states as random_states, regressor_values as regressor_values
from .precise import (
    Ball as Ball,
    ball_function as ball_function,
    exact_ball as exact_ball,
    flint as flint,
    precise_values as precise_values,
)
from .relations import (
    as_latex as as_latex,
    as_markdown as as_markdown,
    as_text as as_text,
    coefficient_text as coefficient_text,
    relation_text as relation_text,
)
from .result import BaseParameter as BaseParameter, BaseParameters as BaseParameters
from .walks import Linkage as Linkage
