/* One law of `law` on the joint `law_joint`, times `law_size`; s: its `law_shape`. */
#include "unnamed.h"

#include <math.h>

enum {
    NONE,
    TWO_DIPS,
    LOAD_SPEED,
    LOADED_COGGING,
    REVERSAL_MEMORY,
    NEIGHBOUR_DRAG,
    THIXOTROPY,
    EDDY_PEAK,
    BUMPER,
    DITHER,
    MAXWELL_HOSE
};

static double bell(double x)
{
    return exp(-x * x);
}

/* What resists the motor at angles q and speeds v of all joints; load: torque into the link. */
double unnamed_torque(const Plant *p, int j, const double *q, const double *v, double load,
                      const Memory *memory)
{
    if (p->law == NONE || j != p->law_joint) return 0;
    const double *s = p->law_shape, a = fabs(v[j]), way = tanh(v[j] / p->coulomb_width[j]);
    switch (p->law) {
    case TWO_DIPS: return p->law_size * way * (bell(a / s[0]) - s[1] * bell((a - s[2]) / s[3]));
    case LOAD_SPEED: return p->law_size * fabs(load) * v[j];
    case LOADED_COGGING: return p->law_size * fabs(load) * sin(s[0] * q[j] + s[1]);
    case REVERSAL_MEMORY: return p->law_size * way * exp(-memory->since / s[0]);
    case NEIGHBOUR_DRAG: return p->law_size * way * bell((q[p->law_with] - s[0]) / s[1]);
    case THIXOTROPY: return p->law_size * way * exp(-memory->lag / s[0]);
    case EDDY_PEAK: return p->law_size * 2 * v[j] * s[0] / (v[j] * v[j] + s[0] * s[0]);
    case BUMPER: return p->law_size * s[1] * pow(fmax(0, s[1] * (q[j] - s[0])), 1.5);
    case DITHER: {
        double shaken = v[p->law_with] / s[0];
        return p->law_size * way / (1 + shaken * shaken);
    }
    case MAXWELL_HOSE: return p->law_size * (q[j] - memory->lag);
    default: return 0;
    }
}

/* The lag is of |v|, or of q. */
void unnamed_memory(const Plant *p, int j, double q, double v, const Memory *memory,
                    Memory *change)
{
    *change = (Memory){.since = 1};
    if (j != p->law_joint) return;
    if (p->law == THIXOTROPY) change->lag = (fabs(v) - memory->lag) / p->law_shape[1];
    if (p->law == MAXWELL_HOSE) change->lag = (q - memory->lag) / p->law_shape[0];
}

/* At rest for a long time. */
void unnamed_start(const Plant *p, int j, double q, Memory *memory)
{
    *memory = (Memory){.since = 1e3, .farthest = q};
    if (j == p->law_joint && p->law == MAXWELL_HOSE) memory->lag = q;
}

/* A joint has turned back when it is `law_turns` from the farthest place on its way. */
void unnamed_turn(const Plant *p, int j, double q, Memory *memory)
{
    double on = q - memory->farthest, most = p->law_turns[j];
    if (p->law == NONE) return;
    if (on * memory->way > 0) memory->farthest = q;
    if (on * memory->way > 0 || fabs(on) < most) return;
    if (memory->way != 0) memory->since = 0;
    memory->way = on > 0 ? 1 : -1;
    memory->farthest = q;
}
