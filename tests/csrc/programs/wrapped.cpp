#include "demo_arm.hpp"
#include <cstdio>

int main()
{
    namespace arm = demo_arm_model;
    std::array<double, arm::joints> q{}, qd{}, tau{};
    double beta[DEMO_ARM_BASE_PARAMETERS], plain[DEMO_ARM_JOINTS];

    for (std::size_t i = 0; i < arm::joints; i++)
        q[i] = 0.3 * static_cast<double>(i + 1), qd[i] = 0.5;
    for (double &x : beta)
        x = 0.7;
    const auto g = arm::gravity(q, beta);
    demo_arm_gravity(q.data(), beta, plain);
    arm::gravity(q, arm::view<const double, DEMO_ARM_BASE_PARAMETERS>(&beta[0]), tau);
    int wrong = 0;
    for (std::size_t i = 0; i < arm::joints; i++)
        wrong += g[i] != plain[i] || tau[i] != plain[i];
    q[0] = 1.0 / 0.0 * 0.0;
    const auto told = arm::forward_dynamics(q, qd, g, beta);
    const arm::status again = arm::forward_dynamics(q, qd, g, beta, tau);
    wrong += told || told.told != arm::status::not_finite || again != told.told;
    SPOIL;
    std::printf("%d", wrong);
    return wrong;
}
