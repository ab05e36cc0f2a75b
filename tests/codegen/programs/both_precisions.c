#include <stdio.h>
#include "wrist.h"
#include "wrist_batch.h"
#include "two_link.h"
#include "two_link_batch.h"
#include "emps.h"
#include "emps_batch.h"
int main(void)
{
    const double q[3] = {0.1, 0.2, 0.3}, qd[3] = {1.0, 1.0, 1.0}, qdd[3] = {2.0, 2.0, 2.0};
    const float p[2] = {0.1f, 0.2f}, pd[2] = {1.0f, 1.0f}, pdd[2] = {2.0f, 2.0f};
    double W[3 * WRIST_BASE_PARAMETERS];
    float V[2 * TWO_LINK_BASE_PARAMETERS];
    wrist_observation(1, q, qd, qdd, W);
    two_link_observation(1, p, pd, pdd, V);
    emps_observation(1, q, qd, qdd, W + 1);
    printf("%.3f %.3f %.3f\n", W[0], (double)V[0], W[1]);
    return 0;
}
