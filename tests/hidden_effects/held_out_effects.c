/* Friction, springs, drives and a load that nobody's catalogue holds. */
#include "held_out_effects.h"

#include <math.h>

/* 1 in a window that comes again after every period, with edges of 30 ms. */
static double on(double time, double start, double lasts, double period)
{
    double since = time - start;
    if (since < 0) return 0;
    since = fmod(since, period);
    return since < lasts ? fmin(1, fmin(since, lasts - since) / 0.03) : 0;
}

/* Of a motor at speed v; q: of all joints; load: torque that goes into the link. All take energy.
   Pinched dress: F / (1 + exp(-(q_k - q0) / w)) sign(v).
   Seal that lifts off: F / (1 + exp((|v| - v1) / w)) sign(v).
   Bearing: c |moment across the axis| sign(v).
   Back-driven gear: F sign(v) where the load drives the motor.
   Brake: F sign(v) now and then.
   Pocket of grease: Fv (1 + cos(q - q0)) / 2 v. */
double held_out_friction(const Plant *p, int j, double time, const double *q, double v,
                        double load, const Dynamics *now)
{
    double dry = p->bearing_share[j] * now->tilting[j], way = tanh(v / p->coulomb_width[j]);
    if (p->pinch_torque[j] != 0) {
        double beyond = (q[(int)p->pinched_by[j]] - p->pinch_angle[j]) / p->pinch_width[j];
        dry += p->pinch_torque[j] / (1 + exp(-beyond));
    }
    if (p->seal_torque[j] != 0)
        dry += p->seal_torque[j] / (1 + exp((fabs(v) - p->seal_speed[j]) / p->seal_width[j]));
    if (p->back_driven_torque[j] != 0)
        dry += p->back_driven_torque[j] * (1 - way * tanh(load / p->back_driven_load[j])) / 2;
    if (p->brake_torque[j] != 0)
        dry += p->brake_torque[j] *
               on(time, p->brake_start[j], p->brake_lasts[j], p->brake_period[j]);
    return dry * way + p->pocket_viscous[j] * (1 + cos(q[j] - p->pocket_angle[j])) / 2 * v;
}

/* What a drive gives for its torque as logged: less at high current, less of what is small, and
   less of what its sensor reads of another drive's current. */
double delivered(const Plant *p, int j, const double *torque)
{
    double given = torque[j];
    if (p->crosstalk[j] != 0) given -= p->crosstalk[j] * torque[(int)p->crosstalk_from[j]];
    if (p->dead_torque[j] != 0) given -= p->dead_torque[j] * tanh(given / p->dead_torque[j]);
    if (p->saturation[j] != 0) given = p->saturation[j] * tanh(given / p->saturation[j]);
    return given;
}

static void place_of(const Dynamics *now, int link, const double *point, double *place)
{
    rotate(now->rotation[link], point, place);
    for (int i = 0; i < 3; i++) place[i] += now->origin[link][i];
}

/* Torque of a force on a link. */
static void pull(const Dynamics *now, int link, const double *place, const double *force,
                 double *pushed)
{
    for (int j = 0; j <= link; j++) {
        Vector arm, moment;
        for (int i = 0; i < 3; i++) arm[i] = place[i] - now->origin[j][i];
        cross(arm, force, moment);
        pushed[j] += dot(now->axis[j], moment);
    }
}

/* A hose, energy k (q_i + c q_j - s)^2 / 2, and a strap, energy k (length - free)^2 / 2 if taut. */
void held_out_push(const Plant *p, const double *q, const Dynamics *now, double *pushed)
{
    if (p->hose_stiffness != 0) {
        double stretched = q[p->hose_joint] + p->hose_ratio * q[p->hose_with] - p->hose_rest;
        pushed[p->hose_joint] -= p->hose_stiffness * stretched;
        pushed[p->hose_with] -= p->hose_ratio * p->hose_stiffness * stretched;
    }
    if (p->strap_stiffness != 0) {
        Vector place, force;
        place_of(now, p->strap_link, p->strap_point, place);
        for (int i = 0; i < 3; i++) force[i] = p->strap_base[i] - place[i];
        double length = sqrt(dot(force, force)), tight = fmax(0, length - p->strap_length);
        for (int i = 0; i < 3; i++) force[i] *= p->strap_stiffness * tight / length;
        pull(now, p->strap_link, place, force, pushed);
    }
}

/* Hanging still. */
void slosh_rest(const Plant *p, const Dynamics *now, Slosh *slosh)
{
    *slosh = (Slosh){{0}, {0}};
    if (p->slosh_mass == 0) return;
    place_of(now, p->joints - 1, p->slosh_point, slosh->place);
    for (int i = 0; i < 3; i++)
        slosh->place[i] += p->slosh_mass * p->gravity[i] / p->slosh_stiffness;
}

/* m x'' = m g - f, and f on the last link: f = k (x - p) + d (x' - p'), p where it is held. */
void slosh_push(const Plant *p, const double *v, const Dynamics *now, const Slosh *slosh,
                Slosh *change, double *pushed)
{
    *change = (Slosh){{0}, {0}};
    if (p->slosh_mass == 0) return;
    int last = p->joints - 1;
    Vector held, speed = {0, 0, 0}, force;
    place_of(now, last, p->slosh_point, held);
    for (int j = 0; j <= last; j++) {
        Vector arm, turning;
        for (int i = 0; i < 3; i++) arm[i] = held[i] - now->origin[j][i];
        cross(now->axis[j], arm, turning);
        for (int i = 0; i < 3; i++) speed[i] += v[j] * turning[i];
    }
    for (int i = 0; i < 3; i++) {
        force[i] = p->slosh_stiffness * (slosh->place[i] - held[i]) +
                   p->slosh_damping * (slosh->speed[i] - speed[i]);
        change->place[i] = slosh->speed[i];
        change->speed[i] = p->gravity[i] - force[i] / p->slosh_mass;
    }
    pull(now, last, held, force, pushed);
}
