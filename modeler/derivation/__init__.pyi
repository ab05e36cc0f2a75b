from . import relations as relations
from .assembly_modes import (
    HomeModes as HomeModes,
    complete_home as complete_home,
    express_as_home as express_as_home,
    find_modes_near as find_modes_near,
)
from .base_parameters import derive_base_parameters as derive_base_parameters
from .closure import (
    ALL as ALL,
    LOOP_JOINTS as LOOP_JOINTS,
    Closure as Closure,
    compute_loop_frames as compute_loop_frames,
    draw_nearby_postures as draw_nearby_postures,
)
from .controller_terms import (
    BodyFrame as BodyFrame,
    collect_frames as collect_frames,
    derive_coriolis_matrix as derive_coriolis_matrix,
    derive_coriolis_transpose as derive_coriolis_transpose,
    derive_energy_regressor as derive_energy_regressor,
    derive_frame_pose as derive_frame_pose,
    derive_jacobian as derive_jacobian,
    derive_jacobian_dot_qd as derive_jacobian_dot_qd,
    derive_momentum as derive_momentum,
    derive_momentum_regressor as derive_momentum_regressor,
    derive_momentum_rest_regressor as derive_momentum_rest_regressor,
    derive_power_regressor as derive_power_regressor,
    derive_slotine_li_regressor as derive_slotine_li_regressor,
    derive_twist as derive_twist,
    find_body_frame as find_body_frame,
)
from .derive import derive_model as derive_model
from .field import (
    LinearRelations as LinearRelations,
    SparseVector as SparseVector,
    collect_powers as collect_powers,
    compute_kernel as compute_kernel,
    convert_to_fraction as convert_to_fraction,
    enumerate_places as enumerate_places,
    evaluate_modulo as evaluate_modulo,
    find_linear_relations as find_linear_relations,
    reduce_to_echelon as reduce_to_echelon,
    replace_square as replace_square,
)
from .geometry import (
    Geometry as Geometry,
    GeometryRow as GeometryRow,
    count_quarter_turns as count_quarter_turns,
    create_geometric_symbol as create_geometric_symbol,
)
from .graph import (
    OPERATIONS as OPERATIONS,
    Arithmetic as Arithmetic,
    Expr as Expr,
    Graph as Graph,
    Label as Label,
    Node as Node,
    Plan as Plan,
    Table as Table,
    Vector as Vector,
    combine_linearly as combine_linearly,
    differentiate as differentiate,
)
from .kinematics import (
    Composite as Composite,
    GraphAlgebra as GraphAlgebra,
    Pose as Pose,
    Screw as Screw,
    compute_base_poses as compute_base_poses,
    compute_frame_gravity as compute_frame_gravity,
    compute_free_screws as compute_free_screws,
    compute_pose as compute_pose,
    compute_poses as compute_poses,
    compute_screws as compute_screws,
    cross as cross,
    dot as dot,
    plus as plus,
    project_wrench as project_wrench,
    times as times,
)
from .lagrange import compute_lagrange_torque as compute_lagrange_torque
from .model import (
    MOTOR_MOTION as MOTOR_MOTION,
    Entries as Entries,
    LinkColumn as LinkColumn,
    ShaftColumn as ShaftColumn,
    Signal as Signal,
    StandardColumn as StandardColumn,
    SymbolicModel as SymbolicModel,
    combine_along_shaft as combine_along_shaft,
    derive_effect_entries as derive_effect_entries,
    evaluate_followed as evaluate_followed,
    get_signal_symbol as get_signal_symbol,
    is_in_block as is_in_block,
)
from .numeric_rank import (
    EnclosedState as EnclosedState,
    EnclosureError as EnclosureError,
    Enclosures as Enclosures,
    draw_random_states as draw_random_states,
    evaluate_regressor as evaluate_regressor,
)
from .precise import (
    Ball as Ball,
    build_ball as build_ball,
    build_ball_function as build_ball_function,
    evaluate_precisely as evaluate_precisely,
    load_flint as load_flint,
)
from .relations import (
    BaseParameter as BaseParameter,
    BaseParameters as BaseParameters,
    format_base_parameters as format_base_parameters,
    format_coefficient as format_coefficient,
    format_relation as format_relation,
)
from .walks import Linkage as Linkage
