#include "two_link.h"
#include <stdio.h>
int main(void)
{
    double q[2], qd[2], qdd[2], tau[2];
    double chi[TWO_LINK_STANDARD_PARAMETERS], beta[TWO_LINK_BASE_PARAMETERS];
    for (int i = 0; i < 2; i++) { q[i] = 0.3 + i; qd[i] = 1.1 - 0.4*i; qdd[i] = 0.2*i - 0.7; }
    for (int i = 0; i < TWO_LINK_STANDARD_PARAMETERS; i++) chi[i] = 1.0 + 0.01*i;
    two_link_base_parameters(chi, beta);
    two_link_inverse_dynamics(q, qd, qdd, beta, tau);
    for (int i = 0; i < 2; i++) printf("%.17g\n", tau[i]);
    return 0;
}
