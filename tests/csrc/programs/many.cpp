#include "emps_batch.h"
#include <cstdio>

int main()
{
    const double zero[2 * EMPS_JOINTS] = {0.0, 0.0}, qdd[2 * EMPS_JOINTS] = {1.0, 2.0};
    double W[2 * EMPS_JOINTS * EMPS_BASE_PARAMETERS];

    emps_observation(2, zero, zero, qdd, W);
    std::printf("%g", W[EMPS_BASE_PARAMETERS]);
}
