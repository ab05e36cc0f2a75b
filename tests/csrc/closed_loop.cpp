// A controller in C++ with the installed model of a fitted robot: computed torque, and an observer
// of what pushes from outside. Reads encoder positions, commanded q, qd, qdd; answers tau and r.
// Usage: closed_loop MODE, "model", or for comparison "gravity" (PD and gravity) or "pd" alone.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "ur10e_fitted.h"

namespace {

constexpr int n = UR10E_JOINTS;
constexpr double dt = 0.001, turn = 6.283185307179586;
constexpr double omega = 3.0 * turn, kp = omega * omega, kd = 2.0 * omega; // 3 Hz
constexpr double rate = 30.0;                                            // 1/s, of the observer
const double share = 1.0 - std::exp(-150.0 * turn * dt);                // 150 Hz, of speeds

using Vector = std::array<double, n>;

struct Sample {
    Vector q, q_d, qd_d, qdd_d;

    bool read()
    {
        for (Vector *part : {&q, &q_d, &qd_d, &qdd_d})
            for (double &x : *part)
                if (std::scanf("%lf", &x) != 1)
                    return false;
        return true;
    }
};

// Speeds from encoder positions.
class Differences {
public:
    const Vector &operator()(const Vector &q)
    {
        for (int i = 0; i < n; i++)
            speed[i] += share * ((started ? (q[i] - last[i]) / dt : 0.0) - speed[i]);
        last = q;
        started = true;
        return speed;
    }

private:
    Vector last{}, speed{};
    bool started = false;
};

// r follows the external torque: dr/dt = rate (tau_ext - r).
class Observer {
public:
    const Vector &operator()(const Vector &q, const Vector &qd, const Vector &tau)
    {
        double M[n * n], g[n], f[n];
        Vector p{}, known{};

        ur10e_fitted_inertia_matrix(q.data(), M);
        ur10e_fitted_gravity(q.data(), g);
        ur10e_fitted_friction(qd.data(), f);
        for (int i = 0; i < n; i++) {
            for (int k = 0; k < n; k++)
                p[i] += M[i * n + k] * qd[k];
            known[i] = transposed(q, qd, i) - g[i] - f[i];
            if (started)
                sum[i] += dt * (tau[i] + (known[i] + before[i]) / 2.0 + r[i]);
            else
                sum[i] = p[i];
            r[i] = rate * (p[i] - sum[i]);
        }
        before = known;
        started = true;
        return r;
    }

private:
    // Row i of C' qd.
    static double transposed(const Vector &q, const Vector &qd, int i)
    {
        Vector ahead = qd, behind = qd, more, less;
        double row = 0.0;

        ahead[i] += 1.0;
        behind[i] -= 1.0;
        ur10e_fitted_coriolis(q.data(), ahead.data(), more.data());
        ur10e_fitted_coriolis(q.data(), behind.data(), less.data());
        for (int k = 0; k < n; k++)
            row += qd[k] * (more[k] - less[k]) / 4.0;
        return row;
    }

    Vector sum{}, before{}, r{};
    bool started = false;
};

Vector controlled(const std::string &mode, const Sample &now, const Vector &qd, const Vector &steady)
{
    Vector v{}, tau{}, f{}, f_d{};

    for (int i = 0; i < n; i++)
        v[i] = kd * (now.qd_d[i] - qd[i]) + kp * (now.q_d[i] - now.q[i]);
    if (mode != "model") {
        if (mode == "gravity")
            ur10e_fitted_gravity(now.q.data(), tau.data());
        for (int i = 0; i < n; i++)
            tau[i] += steady[i] * v[i];
        return tau;
    }
    for (int i = 0; i < n; i++)
        v[i] += now.qdd_d[i];
    ur10e_fitted_inverse_dynamics(now.q.data(), qd.data(), v.data(), tau.data());
    ur10e_fitted_friction(qd.data(), f.data());
    ur10e_fitted_friction(now.qd_d.data(), f_d.data());
    for (int i = 0; i < n; i++)
        tau[i] += f_d[i] - f[i];
    return tau;
}

} // namespace

int main(int argc, char **argv)
{
    if (argc != 2 || std::strcmp(ur10e_fitted_signature(), UR10E_FITTED_SIGNATURE) != 0)
        return 2;
    Sample now;
    Differences speed;
    Observer observe;
    Vector tau{}, steady{};
    bool started = false;

    while (now.read()) {
        const Vector qd = speed(now.q);
        const Vector r = observe(now.q, qd, tau);

        if (!started) {
            double M[n * n];

            ur10e_fitted_inertia_matrix(now.q.data(), M);
            for (int i = 0; i < n; i++)
                steady[i] = M[i * n + i];
            started = true;
        }
        tau = controlled(argv[1], now, qd, steady);
        for (double x : tau)
            std::printf("%.17g ", x);
        for (double x : r)
            std::printf("%.17g ", x);
        std::printf("\n");
        std::fflush(stdout);
    }
    return 0;
}
