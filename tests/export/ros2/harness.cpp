#include <cmath>
#include <cstdio>
#include <cstdlib>
#include "computed_torque.hpp"
using namespace PACKAGE;

static Vector accelerations(const Vector &q, const Vector &qd, const Vector &tau)
{
    double M[joints * joints];
    Vector still{}, x{};
    PREFIX_inverse_dynamics(q.data(), qd.data(), still.data(), beta_at_export.data(), x.data());
    Vector rest{};
    PREFIX_inverse_dynamics(q.data(), still.data(), still.data(), beta_at_export.data(),
                            rest.data());
    for (std::size_t j = 0; j < joints; j++) {
        Vector unit{}, column{};
        unit[j] = 1.0;
        PREFIX_inverse_dynamics(q.data(), still.data(), unit.data(), beta_at_export.data(),
                                column.data());
        for (std::size_t i = 0; i < joints; i++)
            M[i * joints + j] = column[i] - rest[i];
    }
    for (std::size_t i = 0; i < joints; i++)
        x[i] = tau[i] - x[i];
    for (std::size_t k = 0; k < joints; k++)
        for (std::size_t i = k + 1; i < joints; i++) {
            const double share = M[i * joints + k] / M[k * joints + k];
            for (std::size_t j = k; j < joints; j++)
                M[i * joints + j] -= share * M[k * joints + j];
            x[i] -= share * x[k];
        }
    for (std::size_t i = joints; i-- > 0;) {
        for (std::size_t j = i + 1; j < joints; j++)
            x[i] -= M[i * joints + j] * x[j];
        x[i] /= M[i * joints + i];
    }
    return x;
}

int main(int, char **argv)
{
    ComputedTorque control;
    const double factor = std::atof(argv[1]), limit = std::atof(argv[2]), h = 1e-4;
    for (auto &x : control.beta)
        x *= factor;
    control.kp.fill(400.0);
    control.kd.fill(40.0);
    if (limit > 0.0)
        control.limit.fill(limit);
    Vector q{}, qd{}, tau{};
    q.fill(0.1);
    double worst = 0.0, largest = 0.0;
    for (int k = 0; k < 20000; k++) {
        Reference wanted{};
        for (std::size_t i = 0; i < joints; i++) {
            const double w = 2.0 + static_cast<double>(i), t = k * h;
            wanted.q[i] = 0.5 * std::sin(w * t);
            wanted.qd[i] = 0.5 * w * std::cos(w * t);
            wanted.qdd[i] = -0.5 * w * w * std::sin(w * t);
            if (k > 10000)
                worst = std::fmax(worst, std::fabs(q[i] - wanted.q[i]));
        }
        if (k % 10 == 0 && control.update(q, qd, wanted, tau) != 0)
            return 1;
        for (double x : tau)
            largest = std::fmax(largest, std::fabs(x));
        const Vector a = accelerations(q, qd, tau);
        for (std::size_t i = 0; i < joints; i++) {
            qd[i] += h * a[i];
            q[i] += h * qd[i];
        }
    }
    q[0] = NAN;
    const int status = control.update(q, qd, Reference{}, tau);
    const double left = tau[0];
    q[0] = 0.1;
    control.limit[0] = NAN;
    const int unlimited = control.update(q, qd, Reference{}, tau);
    std::printf("%.17g %.17g %d %g %d %g\n", worst, largest, status, left, unlimited, tau[0]);
}
