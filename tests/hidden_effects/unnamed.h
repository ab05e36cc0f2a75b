/* Laws of joint torque that have no name, with what they remember. */
#include "rigid_body.h"

/* What a law follows: a first order lag, s since the joint turned back, its way (1, -1, or 0 as
   long as it has not moved) and the farthest place on it. */
typedef struct {
    double lag, since, way, farthest;
} Memory;

double unnamed_torque(const Plant *plant, int j, const double *q, const double *v, double load,
                      const Memory *memory);
void unnamed_memory(const Plant *plant, int j, double q, double v, const Memory *memory,
                    Memory *change);
void unnamed_start(const Plant *plant, int j, double q, Memory *memory);
void unnamed_turn(const Plant *plant, int j, double q, Memory *memory);
