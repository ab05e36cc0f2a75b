/* What nobody's catalogue of effects holds. */
#include "rigid_body.h"

/* A mass in springs: place and speed in the world frame. */
typedef struct {
    Vector place, speed;
} Slosh;

double held_out_friction(const Plant *plant, int j, double time, const double *q, double v,
                        double load, const Dynamics *now);
double delivered(const Plant *plant, int j, const double *torque);
void held_out_push(const Plant *plant, const double *q, const Dynamics *now, double *pushed);
void slosh_rest(const Plant *plant, const Dynamics *now, Slosh *slosh);
void slosh_push(const Plant *plant, const double *v, const Dynamics *now, const Slosh *slosh,
                Slosh *change, double *pushed);
