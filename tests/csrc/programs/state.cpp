#include "five_bar.hpp"

int main()
{
    namespace robot = five_bar_model;
    static struct five_bar_state now;
    const std::array<float, 2> q{1.9f, 1.1f}, qd{1.0f, -1.0f}, qdd{0.5f, 0.2f};
    std::array<float, FIVE_BAR_BASE_PARAMETERS> beta{};

    beta.fill(1.0f);
    if (robot::close_at(now, q, qd, false) != robot::status::done)
        return 1;
    const auto at = robot::inverse_dynamics_at(now, qdd, beta);
    const auto whole = robot::inverse_dynamics(q, qd, qdd, beta);
    return at && whole && at.value == whole.value ? 0 : 2;
}
