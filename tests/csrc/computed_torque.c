/* One step of computed-torque control with an emitted module: reads numbers, prints torques.
 *
 * stdin: chi, then q, qd, q desired, qd desired, qdd desired, one after the other
 */
#include "wrist.h"

#include <stdio.h>

static int read_numbers(double *numbers, int count)
{
    for (int i = 0; i < count; i++)
        if (scanf("%lf", &numbers[i]) != 1) return 0;
    return 1;
}

int main(void)
{
    const double Kp = 400, Kd = 40; /* 1/s2, 1/s */
    double chi[WRIST_STANDARD_PARAMETERS], beta[WRIST_BASE_PARAMETERS];
    double q[WRIST_JOINTS], qd[WRIST_JOINTS];
    double q_d[WRIST_JOINTS], qd_d[WRIST_JOINTS], qdd_d[WRIST_JOINTS];
    double v[WRIST_JOINTS], tau[WRIST_JOINTS];

    if (!read_numbers(chi, WRIST_STANDARD_PARAMETERS) || !read_numbers(q, WRIST_JOINTS) ||
        !read_numbers(qd, WRIST_JOINTS) || !read_numbers(q_d, WRIST_JOINTS) ||
        !read_numbers(qd_d, WRIST_JOINTS) || !read_numbers(qdd_d, WRIST_JOINTS))
        return 1;

    wrist_base_parameters(chi, beta);
    for (int j = 0; j < WRIST_JOINTS; j++)
        v[j] = qdd_d[j] + Kd*(qd_d[j] - qd[j]) + Kp*(q_d[j] - q[j]);
    wrist_inverse_dynamics(q, qd, v, beta, tau);

    for (int j = 0; j < WRIST_JOINTS; j++)
        printf("%.17g\n", tau[j]);
    return 0;
}
