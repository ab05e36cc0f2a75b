/* Friction, gears, springs, contact and drives of an arm: Runge-Kutta of order 4 at 4 kHz, under a
   cascade of position and speed control at 1 kHz. */
#include <math.h>

#include "held_out_effects.h"
#include "unnamed.h"

#define STEPS 4 /* of a tick */
static const double TICK = 1e-3, STEP = 1e-3 / STEPS;

typedef struct {
    double link, link_speed, motor, motor_speed, bristle, cable, temperature, torque;
    Memory memory;
} Joint;
typedef struct {
    Joint joint[MAX_JOINTS];
    Slosh slosh;
} State;

enum { OF_JOINT = sizeof(Joint) / sizeof(double), OF_SLOSH = sizeof(Slosh) / sizeof(double) };

size_t plant_size(void)
{
    return sizeof(Plant);
}

/* Torque of the gear from its wind-up and the speed of that. A gap only pushes. */
static double gear(const Plant *p, int j, double wound, double speed)
{
    if (p->flexible[j] < 1.5) return p->gear_stiffness[j] * wound + p->gear_damping[j] * speed;
    double half = 0.5 * p->gap[j];
    double pressed = wound > half ? wound - half : (wound < -half ? wound + half : 0);
    if (pressed == 0) return 0;
    double torque = p->gear_stiffness[j] * pressed + p->gear_damping[j] * speed;
    return torque * pressed < 0 ? 0 : torque;
}

/* Torque of what is Coulomb's part at high speed; the bristle's change.
   LuGre: z' = v - |v| z / (d level), torque Fc z / d + damping z'.
   Dahl: z' = v (1 - sign(v) z / d), torque Fc z / d. */
static double rubbing(const Plant *p, int j, double v, double level, double z, double *change)
{
    double d = p->bristle_length[j];
    *change = 0;
    if (p->bristle_law[j] < 0.5) return level * tanh(v / p->coulomb_width[j]);
    if (p->bristle_law[j] < 1.5) {
        double relative = p->coulomb[j] > 0 ? level / p->coulomb[j] : 1;
        *change = v - fabs(v) * z / (d * relative);
        return p->coulomb[j] * z / d + p->bristle_damping[j] * *change / (1 + fabs(v) / 0.05);
    }
    double free_share = 1 - (v > 0 ? 1 : -1) * z / d;
    *change = free_share > 0 ? v * free_share : 0;
    return level * z / d;
}

/* Friction of a motor at angle q and speed v, under a load. */
static double friction(const Plant *p, int j, double q, double v, const Joint *x, double load,
                       double *bristle_change)
{
    double way = tanh(v / p->coulomb_width[j]), a = fabs(v);
    double thicker = 1, rougher = 1;
    if (p->warms[j] > 0) {
        double warmer = x->temperature - p->reference_temperature[j];
        thicker = exp(-p->viscous_per_kelvin[j] * warmer);
        rougher = 1 - p->coulomb_per_kelvin[j] * warmer;
    }
    double level = p->coulomb[j] * rougher;
    if (p->stribeck_torque[j] != 0)
        level += p->stribeck_torque[j] *
                 exp(-pow(a / p->stribeck_speed[j], p->stribeck_exponent[j]));
    double torque = p->viscous[j] * thicker * v + p->asymmetry[j] * a;
    torque += rubbing(p, j, v, level, x->bristle, bristle_change);
    if (p->power_torque[j] != 0) /* a root would be too steep at rest */
        torque += p->power_torque[j] * pow(a + 1e-9, p->power_exponent[j]) * (v > 0 ? 1 : -1) *
                  (p->power_exponent[j] < 1 ? fabs(way) : 1);
    torque += p->load_share[j] * fabs(load) * way;
    if (p->position_order[j] > 0)
        torque += way * (p->position_cos[j] * cos(p->position_order[j] * q) +
                         p->position_sin[j] * sin(p->position_order[j] * q));
    return torque;
}

/* k b h (1 - l0 / l) sin a, with l^2 = b^2 + h^2 - 2 b h cos a. */
static double counterbalance(const Plant *p, int j, double q)
{
    double b = p->counter_lever[j], h = p->counter_height[j], a = q - p->counter_angle[j];
    if (p->counter_stiffness[j] == 0) return 0;
    double length = sqrt(b * b + h * h - 2 * b * h * cos(a));
    return p->counter_stiffness[j] * b * h * (1 - p->counter_length[j] / length) * sin(a);
}

/* Bouc-Wen: z' = (v - |v| |z|^(n-1) z / 2 - v |z|^n / 2) / d. */
static double cable_change(const Plant *p, int j, double v, double z)
{
    if (p->cable_torque[j] == 0) return 0;
    double size = fabs(z) + 1e-12, n = p->cable_exponent[j];
    double loss = 0.5 * fabs(v) * pow(size, n - 1) * z + 0.5 * v * pow(size, n);
    return (v - loss) / p->cable_length[j];
}

static double ripple(double size, double order, double phase, double q)
{
    return size == 0 ? 0 : size * sin(order * q + phase);
}

/* Torque that a motor has left for rotor and gear. */
static double left_of_drive(const Plant *p, int j, double time, double given, double q,
                            double rubbed, double noise)
{
    double rippled =
        ripple(p->motor_ripple[j], p->motor_ripple_order[j], p->motor_ripple_phase[j], q) +
        ripple(p->joint_ripple[j], p->joint_ripple_order[j], p->joint_ripple_phase[j], q);
    return (1 + p->gain_error[j]) * given - rubbed - p->offset[j] -
           p->drift[j] * (time + p->clock) - rippled - noise;
}

static void coupled_friction(const Plant *p, const double *v, double *left)
{
    int j = p->coupled_joint, k = p->coupled_with;
    double speed = v[j] + p->coupled_ratio * v[k];
    double torque =
        p->coupled_coulomb * tanh(speed / p->coulomb_width[j]) + p->coupled_viscous * speed;
    left[j] -= torque;
    left[k] -= p->coupled_ratio * torque;
}

static void contact(const Plant *p, double time, const Dynamics *now, double *pushed)
{
    if (time < p->contact_start || time >= p->contact_end) return;
    int n = p->joints;
    double rise = fmin(1, fmin(time - p->contact_start, p->contact_end - time) / 0.03);
    Vector point;
    rotate(now->rotation[n - 1], p->contact_point, point);
    for (int j = 0; j < n; j++) {
        Vector arm, moment;
        for (int i = 0; i < 3; i++) arm[i] = point[i] + now->origin[n - 1][i] - now->origin[j][i];
        cross(arm, p->contact_force, moment);
        pushed[j] += rise * dot(now->axis[j], moment);
    }
}

/* What enters a step besides the state. */
typedef struct {
    const double *command, *noise, *load;
} Input;

/* States that only follow: bristle, cable, temperature, torque. left: torque for rotor and gear;
   pushed: torque on the link. */
static void follow(const Plant *p, double time, const Joint *x, Input in, const Dynamics *now,
                   Joint *change, double *left, double *pushed)
{
    double torque[MAX_JOINTS], angle[MAX_JOINTS], speed[MAX_JOINTS];
    for (int j = 0; j < p->joints; j++) {
        torque[j] = x[j].torque;
        angle[j] = x[j].link;
        speed[j] = x[j].link_speed;
    }
    for (int j = 0; j < p->joints; j++) {
        int soft = p->flexible[j] > 0.5;
        double q = soft ? x[j].motor : x[j].link, v = soft ? x[j].motor_speed : x[j].link_speed;
        double load = p->load_static[j] > 0.5 ? now->gravity[j] : in.load[j];
        double rubbed = friction(p, j, q, v, &x[j], load, &change[j].bristle);
        rubbed += held_out_friction(p, j, time + p->clock, angle, v, load, now);
        rubbed += unnamed_torque(p, j, angle, speed, load, &x[j].memory);
        unnamed_memory(p, j, angle[j], speed[j], &x[j].memory, &change[j].memory);
        left[j] = left_of_drive(p, j, time, delivered(p, j, torque), q, rubbed, in.noise[j]);
        change[j].cable = cable_change(p, j, x[j].link_speed, x[j].cable);
        double stretched = x[j].link - p->spring_rest[j];
        pushed[j] = -(p->cable_torque[j] * x[j].cable + p->spring_stiffness[j] * stretched +
                      p->spring_cubic[j] * stretched * stretched * stretched +
                      counterbalance(p, j, x[j].link));
        double hot = p->idle_temperature[j] + p->heating[j] * fabs(rubbed * v);
        change[j].temperature =
            p->warms[j] > 0 ? (hot - x[j].temperature) / p->warming_time[j] : 0;
        change[j].torque = (in.command[j] - x[j].torque) / p->current_lag;
    }
}

/* x' and the torque that goes into the links. */
static void derivative(const Plant *p, double time, const State *state, Input in,
                       State *state_change, double *load)
{
    int n = p->joints;
    const Joint *x = state->joint;
    Joint *change = state_change->joint;
    double q[MAX_JOINTS], v[MAX_JOINTS], motor_speed[MAX_JOINTS];
    double left[MAX_JOINTS], pushed[MAX_JOINTS], a[MAX_JOINTS];
    double matrix[MAX_JOINTS][MAX_JOINTS];
    Dynamics now;
    for (int j = 0; j < n; j++) {
        q[j] = x[j].link;
        v[j] = x[j].link_speed;
        motor_speed[j] = p->flexible[j] > 0.5 ? x[j].motor_speed : v[j];
    }
    links_dynamics(p, q, v, &now);
    follow(p, time, x, in, &now, change, left, pushed);
    if (p->coupled) coupled_friction(p, motor_speed, left);
    contact(p, time + p->clock, &now, pushed);
    held_out_push(p, q, &now, pushed);
    slosh_push(p, v, &now, &state->slosh, &state_change->slosh, pushed);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) matrix[j][k] = now.inertia[j][k];
        change[j].motor = change[j].motor_speed = 0;
        double passed = left[j];
        if (p->flexible[j] > 0.5) {
            passed = gear(p, j, x[j].motor - q[j], x[j].motor_speed - v[j]);
            change[j].motor = x[j].motor_speed;
            change[j].motor_speed = (left[j] - passed) / p->rotor_inertia[j];
        } else
            matrix[j][j] += p->rotor_inertia[j];
        a[j] = passed + pushed[j] - now.bias[j];
    }
    solve(n, matrix, a);
    for (int j = 0; j < n; j++) {
        change[j].link = v[j];
        change[j].link_speed = a[j];
        load[j] = now.bias[j];
        for (int k = 0; k < n; k++) load[j] += now.inertia[j][k] * a[k];
    }
}

static void move(int count, const double *from, double step, const double *change, double *to)
{
    for (int k = 0; k < count; k++) to[k] = from[k] + step * change[k];
}

static void moved(int n, const State *from, double step, const State *change, State *to)
{
    move(n * OF_JOINT, (const double *)from->joint, step, (const double *)change->joint,
         (double *)to->joint);
    move(OF_SLOSH, (const double *)&from->slosh, step, (const double *)&change->slosh,
         (double *)&to->slosh);
}

/* One step; load: the torque that went into the links when it began. */
static void runge_kutta(const Plant *p, double time, State *x, Input in, double *load)
{
    int n = p->joints;
    State k1, k2, k3, k4, y;
    double unused[MAX_JOINTS];
    derivative(p, time, x, in, &k1, load);
    moved(n, x, STEP / 2, &k1, &y);
    derivative(p, time + STEP / 2, &y, in, &k2, unused);
    moved(n, x, STEP / 2, &k2, &y);
    derivative(p, time + STEP / 2, &y, in, &k3, unused);
    moved(n, x, STEP, &k3, &y);
    derivative(p, time + STEP, &y, in, &k4, unused);
    moved(n, x, STEP / 6, &k1, x);
    moved(n, x, STEP / 3, &k2, x);
    moved(n, x, STEP / 3, &k3, x);
    moved(n, x, STEP / 6, &k4, x);
}

/* xorshift128+, and normal numbers by Box and Muller. */
typedef struct {
    uint64_t a, b;
    double spare;
    int has_spare;
} Random;

static double uniform(Random *random)
{
    uint64_t a = random->a, b = random->b;
    random->a = b;
    a ^= a << 23;
    random->b = a ^ b ^ (a >> 17) ^ (b >> 26);
    return ((double)((random->b + b) >> 11) + 0.5) * (1.0 / 9007199254740992.0);
}

static Random seeded(uint64_t seed)
{
    Random random = {seed * 0x9E3779B97F4A7C15ULL + 1, seed ^ 0xD1B54A32D192ED03ULL, 0, 0};
    for (int i = 0; i < 50; i++) uniform(&random);
    return random;
}

static double normal(Random *random)
{
    if (random->has_spare) {
        random->has_spare = 0;
        return random->spare;
    }
    double size = sqrt(-2 * log(uniform(random))), angle = 6.283185307179586 * uniform(random);
    random->spare = size * sin(angle);
    random->has_spare = 1;
    return size * cos(angle);
}

/* Steps of an encoder on q: offset, eccentricity, rounding. */
static double encoder_reads(const Plant *p, int j, double q)
{
    double angle = q + p->encoder_offset[j];
    if (p->eccentricity[j] != 0)
        angle -= p->eccentricity[j] * sin(p->eccentricity_order[j] * q + p->eccentricity_phase[j]);
    return floor(angle / p->encoder_step[j] + 0.5) * p->encoder_step[j];
}

typedef struct {
    double last[MAX_JOINTS], speed[MAX_JOINTS]; /* read, and its filtered change */
    double integral[MAX_JOINTS], command[MAX_JOINTS], next[MAX_JOINTS];
} Controller;

/* One tick; the command acts a tick later. */
static void control(const Plant *p, const double *read, const double *wanted,
                    const double *wanted_speed, Controller *c)
{
    double share = 1 - exp(-p->speed_filter * TICK);
    for (int j = 0; j < p->joints; j++) {
        c->speed[j] += share * ((read[j] - c->last[j]) / TICK - c->speed[j]);
        c->last[j] = read[j];
        double error = wanted_speed[j] + p->position_gain[j] * (wanted[j] - read[j]) - c->speed[j];
        double torque = c->integral[j] + p->speed_gain[j] * error, most = p->torque_limit[j];
        if (fabs(torque) < most) c->integral[j] += p->integral_gain[j] * error * TICK;
        c->command[j] = c->next[j];
        c->next[j] = fmax(-most, fmin(most, torque));
    }
}

/* The torques as logged with which the drives give what is wanted of them. */
static void ask_drives(const Plant *p, const double *wanted, double *torque)
{
    for (int j = 0; j < p->joints; j++) torque[j] = wanted[j];
    for (int round = 0; round < 200; round++) {
        double given[MAX_JOINTS];
        for (int j = 0; j < p->joints; j++) given[j] = delivered(p, j, torque);
        for (int j = 0; j < p->joints; j++) torque[j] += wanted[j] - given[j];
    }
}

/* At rest where it is wanted first, held by the motors. */
static void begin(const Plant *p, const double *wanted, const double *temperature, State *state,
                  Controller *c, double *load)
{
    double q[MAX_JOINTS], still[MAX_JOINTS] = {0}, pushed[MAX_JOINTS] = {0}, held[MAX_JOINTS];
    Dynamics now;
    Slosh unchanged;
    for (int j = 0; j < p->joints; j++) q[j] = wanted[j] - p->encoder_offset[j];
    links_dynamics(p, q, still, &now);
    held_out_push(p, q, &now, pushed);
    slosh_rest(p, &now, &state->slosh);
    slosh_push(p, still, &now, &state->slosh, &unchanged, pushed);
    for (int j = 0; j < p->joints; j++) {
        held[j] = now.bias[j] + p->offset[j] + p->drift[j] * p->clock +
                  p->spring_stiffness[j] * (q[j] - p->spring_rest[j]) + counterbalance(p, j, q[j]);
        held[j] = (held[j] - pushed[j]) / (1 + p->gain_error[j]);
    }
    ask_drives(p, held, c->command);
    for (int j = 0; j < p->joints; j++) {
        Joint *x = &state->joint[j];
        *x = (Joint){.link = q[j], .motor = q[j], .temperature = temperature[j]};
        x->torque = c->command[j];
        unnamed_start(p, j, q[j], &x->memory);
        if (p->flexible[j] > 0.5) x->link -= now.bias[j] / p->gear_stiffness[j];
        if (p->flexible[j] > 1.5) x->link -= 0.5 * p->gap[j] * (now.bias[j] > 0 ? 1 : -1);
        c->integral[j] = c->next[j] = c->command[j];
        c->speed[j] = 0;
        c->last[j] = encoder_reads(p, j, x->motor);
        load[j] = now.bias[j];
    }
}

int simulate(const Plant *p, int ticks, const double *wanted, const double *wanted_speed,
             const double *temperature_at_start, uint64_t seed, double *encoder, double *torque,
             double *temperature, double *link)
{
    int n = p->joints;
    double noise[MAX_JOINTS], load[MAX_JOINTS], next_load[MAX_JOINTS];
    double keeps = exp(-STEP / p->noise_time), fresh = sqrt(1 - keeps * keeps);
    State state;
    const Joint *x = state.joint;
    Controller controller;
    Random random = seeded(seed);
    begin(p, wanted, temperature_at_start, &state, &controller, load);
    for (int j = 0; j < n; j++) noise[j] = p->noise_torque[j] * normal(&random);
    for (int i = 0; i < ticks; i++) {
        for (int j = 0; j < n; j++) {
            encoder[i * n + j] =
                encoder_reads(p, j, p->flexible[j] > 0.5 ? x[j].motor : x[j].link);
            temperature[i * n + j] = x[j].temperature;
            link[i * n + j] = x[j].link;
        }
        control(p, encoder + i * n, wanted + i * n, wanted_speed + i * n, &controller);
        for (int s = 0; s < STEPS; s++) {
            for (int j = 0; j < n; j++) torque[(STEPS * i + s) * n + j] = x[j].torque;
            Input input = {controller.command, noise, load};
            runge_kutta(p, i * TICK + s * STEP, &state, input, next_load);
            for (int j = 0; j < n; j++) {
                unnamed_turn(p, j, x[j].link, &state.joint[j].memory);
                load[j] = next_load[j];
                noise[j] = keeps * noise[j] + fresh * p->noise_torque[j] * normal(&random);
            }
            if (!(fabs(x[0].link) < 1e3)) return 1;
        }
    }
    return 0;
}
