#define MAX_JOINTS 8

/* An arm with motors, its faults, its controller and its sensors. SI units; angles in rad.
   Arrays are by joint. Whatever is zero is absent. */
typedef struct {
    int joints;
    /* modified Denavit-Hartenberg: x rotation alpha, x shift d, z rotation q + theta0, z shift r */
    double alpha[8], d[8], theta0[8], r[8];
    double mass[8], centre[8][3];
    double inertia[8][9]; /* about the centre of mass, axes of the link, row by row */
    double gravity[3];    /* acceleration, base frame */
    double rotor_inertia[8];
    double viscous[8], coulomb[8], offset[8];
    double coulomb_width[8]; /* speed: friction is coulomb tanh(v / width) */
    double asymmetry[8];     /* asymmetry |v| */
    /* stribeck_torque exp(-(|v| / speed)^exponent) is added to coulomb */
    double stribeck_torque[8], stribeck_speed[8], stribeck_exponent[8];
    double power_torque[8], power_exponent[8]; /* torque sign(v) |v|^exponent */
    double load_share[8], load_static[8]; /* share |load| sign(v); 1: the load is gravity's */
    double position_cos[8], position_sin[8], position_order[8]; /* friction over the angle */
    double bristle_law[8]; /* 0: tanh; 1: LuGre; 2: Dahl */
    double bristle_length[8], bristle_damping[8];
    double cable_torque[8], cable_length[8], cable_exponent[8]; /* Bouc-Wen */
    /* viscous exp(-a (T - reference)), coulomb (1 - b (T - reference)) */
    double warms[8], viscous_per_kelvin[8], coulomb_per_kelvin[8], reference_temperature[8];
    double warming_time[8], idle_temperature[8], heating[8]; /* heating: kelvin per watt */
    /* friction of a shaft that turns with v_j + ratio v_k */
    int coupled, coupled_joint, coupled_with;
    double coupled_ratio, coupled_coulomb, coupled_viscous;
    double spring_stiffness[8], spring_cubic[8], spring_rest[8];
    /* a spring of free length between a lever's end and a point at a height above the axis */
    double counter_stiffness[8], counter_lever[8], counter_height[8], counter_length[8];
    double counter_angle[8];
    double flexible[8]; /* 0: stiff; 1: elastic; 2: elastic with a gap */
    double gear_stiffness[8], gear_damping[8], gap[8];
    double motor_ripple[8], motor_ripple_order[8], motor_ripple_phase[8];
    double joint_ripple[8], joint_ripple_order[8], joint_ripple_phase[8];
    double encoder_offset[8];
    double eccentricity[8], eccentricity_order[8], eccentricity_phase[8];
    double gain_error[8]; /* the joint gets (1 + error) of the logged torque */
    double drift[8];      /* N m/s */
    /* a force of the base frame on a point of the last link, from start to end */
    double contact_start, contact_end, contact_force[3], contact_point[3];
    /* held-out effects: torque, of what no catalogue holds; see held_out_effects.c */
    double pinch_torque[8], pinched_by[8], pinch_angle[8], pinch_width[8];
    double pocket_viscous[8], pocket_angle[8];
    double seal_torque[8], seal_speed[8], seal_width[8];
    double bearing_share[8];
    double back_driven_torque[8], back_driven_load[8];
    double brake_torque[8], brake_start[8], brake_lasts[8], brake_period[8];
    double saturation[8], dead_torque[8], crosstalk[8], crosstalk_from[8];
    int hose_joint, hose_with;
    double hose_stiffness, hose_ratio, hose_rest;
    int strap_link; /* from a point of the base frame to one of this link */
    double strap_stiffness, strap_length, strap_base[3], strap_point[3];
    double slosh_mass, slosh_stiffness, slosh_damping, slosh_point[3]; /* on the last link */
    /* a law without a name; see unnamed.c */
    int law, law_joint, law_with;
    double law_size, law_shape[4], law_turns[8];
    /* controller: speed reference = speed + position_gain error; PI on the speed */
    double position_gain[8], speed_gain[8], integral_gain[8], torque_limit[8];
    double encoder_step[8], speed_filter; /* rad; rad/s */
    double noise_torque[8], noise_time;   /* Ornstein-Uhlenbeck torque: deviation, correlation */
    double current_lag;                   /* s */
    double clock;                         /* s, when the motion begins: drift and contact */
} Plant;

size_t plant_size(void);

/* Of samples x joints states: torque of the rigid links without rotors, the diagonal of their
   inertia matrix, and gravity's torque. */
void inverse_dynamics(const Plant *plant, int samples, const double *q, const double *v,
                      const double *a, double *torque, double *diagonal, double *gravity);

/* A motion that follows wanted angles and speeds (ticks x joints, 1 kHz), from rest.
   encoder, temperature, link: ticks x joints; torque of the motors: 4 ticks x joints (4 kHz).
   Nonzero if it ran away. */
int simulate(const Plant *plant, int ticks, const double *wanted, const double *wanted_speed,
             const double *temperature_at_start, uint64_t seed, double *encoder, double *torque,
             double *temperature, double *link);
