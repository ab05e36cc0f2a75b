#include "emps.h"
#include <cstdio>
#include <cstring>

int main()
{
    const double zero[EMPS_JOINTS] = {0.0}, one[EMPS_JOINTS] = {1.0};
    const double beta[EMPS_BASE_PARAMETERS] = {100.0, 0.0};
    double tau[EMPS_JOINTS];

    emps_inverse_dynamics(zero, zero, one, beta, tau);
    std::printf("%s %g", emps_signature(), tau[0]);
    return std::strcmp(emps_signature(), EMPS_SIGNATURE);
}
