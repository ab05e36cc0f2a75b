#include "demo_arm.h"
double tau[DEMO_ARM_JOINTS], beta[DEMO_ARM_BASE_PARAMETERS];
void call(void);
void call(void)
{
    const double q[DEMO_ARM_JOINTS - SHORTER] = {0.0};

    demo_arm_gravity(q, beta, tau);
}
