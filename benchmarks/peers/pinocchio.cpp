// Pinocchio's regressor of the joint torques and its other algorithms, behind plain functions: a peer
// to time beside.
//
// The model is read from a text file: gravity, then a line per joint: parent (0 is the world), 1 for
// a turning and 0 for a sliding joint, its placement (rotation row after row, then position), mass,
// centre of mass, inertia there (xx xy yy xz yz zz), rotor inertia. Every joint moves along or about
// the z axis of its placement; the frame "tool" is that of the last joint.
#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/cholesky.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <cstring>
#include <fstream>
#include <memory>
#include <string>

namespace {

struct Peer {
    pinocchio::Model model;
    std::unique_ptr<pinocchio::Data> data;
    Eigen::VectorXd q, v, a;
    pinocchio::FrameIndex tool;
    Eigen::Matrix<double, 6, Eigen::Dynamic> J;
    Eigen::MatrixXd dq, dv, da, solved;
};

/* Writes a matrix row after row; where `out` is null, only the value that keeps the work alive. */
template <typename Matrix> double written(const Matrix &x, double *out)
{
    if (out)
        for (Eigen::Index i = 0; i < x.rows(); i++)
            for (Eigen::Index j = 0; j < x.cols(); j++)
                out[i * x.cols() + j] = x(i, j);
    return x(x.rows() - 1, x.cols() - 1);
}

void set(Peer &peer, const double *q, const double *qd, const double *qdd)
{
    const auto n = peer.model.nv;
    peer.q = Eigen::Map<const Eigen::VectorXd>(q, n);
    peer.v = Eigen::Map<const Eigen::VectorXd>(qd, n);
    peer.a = Eigen::Map<const Eigen::VectorXd>(qdd, n);
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) void *peer_model(const char *path)
{
    std::ifstream file(path);
    auto peer = std::make_unique<Peer>();
    Eigen::Vector3d gravity;

    if (!(file >> gravity[0] >> gravity[1] >> gravity[2]))
        return nullptr;
    peer->model.gravity.linear() = gravity;
    std::size_t parent;
    int turns;
    while (file >> parent >> turns) {
        Eigen::Matrix3d R;
        Eigen::Vector3d p;
        for (int k = 0; k < 9; k++)
            file >> R(k / 3, k % 3);
        for (int k = 0; k < 3; k++)
            file >> p[k];
        const pinocchio::SE3 placement(R, p);
        const auto name = "joint " + std::to_string(peer->model.njoints);
        const auto index = turns
            ? peer->model.addJoint(parent, pinocchio::JointModelRZ(), placement, name)
            : peer->model.addJoint(parent, pinocchio::JointModelPZ(), placement, name);
        double mass, armature;
        Eigen::Vector3d centre;
        double I[6];
        file >> mass >> centre[0] >> centre[1] >> centre[2];
        for (double &each : I)
            file >> each;
        file >> armature;
        const pinocchio::Symmetric3 inertia(I[0], I[1], I[2], I[3], I[4], I[5]);
        peer->model.appendBodyToJoint(index, pinocchio::Inertia(mass, centre, inertia),
                                      pinocchio::SE3::Identity());
        peer->model.armature[peer->model.nv - 1] = armature;
    }
    const auto last = static_cast<pinocchio::JointIndex>(peer->model.njoints - 1);
    peer->tool = peer->model.addFrame(pinocchio::Frame("tool", last, pinocchio::SE3::Identity(),
                                                       pinocchio::OP_FRAME));
    const auto n = peer->model.nv;
    peer->J.setZero(6, n);
    peer->dq.setZero(n, n);
    peer->dv.setZero(n, n);
    peer->da.setZero(n, n);
    peer->data = std::make_unique<pinocchio::Data>(peer->model);
    return peer.release();
}

/* The regressor, row after row, n x 10 n, where `out` is not null; gives one entry of it. */
__attribute__((visibility("default"))) double peer_regressor(void *handle, const double *q,
                                                             const double *qd, const double *qdd,
                                                             double *out)
{
    auto &peer = *static_cast<Peer *>(handle);
    set(peer, q, qd, qdd);
    const auto &Y = pinocchio::computeJointTorqueRegressor(peer.model, *peer.data, peer.q, peer.v,
                                                           peer.a);
    if (out)
        for (Eigen::Index i = 0; i < Y.rows(); i++)
            for (Eigen::Index j = 0; j < Y.cols(); j++)
                out[i * Y.cols() + j] = Y(i, j);
    return Y(0, 0);
}

/* The number of a function, by our name; -1 if Pinocchio has none. */
__attribute__((visibility("default"))) int peer_which(const char *name)
{
    static const char *const names[] = {
        "inverse_dynamics", "inertia_matrix", "gravity", "coriolis_matrix", "coriolis_transpose",
        "pose", "jacobian", "jacobian_dot_qd", "twist", "derivatives", "forward_dynamics",
        "forward_derivatives", "operational_inertia",
    };
    for (int k = 0; k < static_cast<int>(sizeof(names) / sizeof(*names)); k++)
        if (std::strcmp(names[k], name) == 0)
            return k;
    return -1;
}

/* What that function gives, as ours writes it, where `out` is not null; gives one entry of it. `x`
 * are accelerations, of forward functions torques. */
__attribute__((visibility("default"))) double peer_call(void *handle, int which, const double *q,
                                                        const double *qd, const double *x,
                                                        double *out)
{
    using namespace pinocchio;
    auto &peer = *static_cast<Peer *>(handle);
    auto &model = peer.model;
    auto &data = *peer.data;
    set(peer, q, qd, x);
    switch (which) {
    case 0:
        return written(rnea(model, data, peer.q, peer.v, peer.a), out);
    case 1:
        crba(model, data, peer.q);
        if (out)
            data.M.triangularView<Eigen::StrictlyLower>() = data.M.transpose();
        return written(data.M, out);
    case 2:
        return written(computeGeneralizedGravity(model, data, peer.q), out);
    case 3:
        return written(computeCoriolisMatrix(model, data, peer.q, peer.v), out);
    case 4:
        computeCoriolisMatrix(model, data, peer.q, peer.v);
        return written((data.C.transpose() * peer.v).eval(), out);
    case 5: {
        forwardKinematics(model, data, peer.q);
        const auto &T = updateFramePlacement(model, data, peer.tool);
        return written(T.toHomogeneousMatrix().topRows<3>(), out);
    }
    case 6:
        computeFrameJacobian(model, data, peer.q, peer.tool, LOCAL_WORLD_ALIGNED, peer.J);
        return written(peer.J, out);
    case 7: {
        peer.a.setZero();
        forwardKinematics(model, data, peer.q, peer.v, peer.a);
        updateFramePlacement(model, data, peer.tool);
        return written(getFrameClassicalAcceleration(model, data, peer.tool, LOCAL_WORLD_ALIGNED)
                           .toVector(), out);
    }
    case 8:
        forwardKinematics(model, data, peer.q, peer.v);
        return written(getFrameVelocity(model, data, peer.tool, LOCAL).toVector(), out);
    case 9:
        computeRNEADerivatives(model, data, peer.q, peer.v, peer.a, peer.dq, peer.dv, peer.da);
        written(peer.dq, out);
        return written(peer.dv, out ? out + model.nv * model.nv : nullptr);
    case 10:
        return written(aba(model, data, peer.q, peer.v, peer.a), out);
    case 11:
        computeABADerivatives(model, data, peer.q, peer.v, peer.a, peer.dq, peer.dv, peer.da);
        if (out)
            peer.da.triangularView<Eigen::StrictlyLower>() = peer.da.transpose();
        written(peer.dq, out);
        written(peer.dv, out ? out + model.nv * model.nv : nullptr);
        return written(peer.da, out ? out + 2 * model.nv * model.nv : nullptr);
    case 12: {
        computeFrameJacobian(model, data, peer.q, peer.tool, LOCAL_WORLD_ALIGNED, peer.J);
        crba(model, data, peer.q);
        cholesky::decompose(model, data);
        peer.solved = peer.J.transpose();
        cholesky::solve(model, data, peer.solved);
        const Eigen::Matrix<double, 6, 6> L = (peer.J * peer.solved).eval();
        return written(L.llt().solve(Eigen::Matrix<double, 6, 6>::Identity()).eval(), out);
    }
    default:
        return 0.0;
    }
}

__attribute__((visibility("default"))) void peer_free(void *handle)
{
    delete static_cast<Peer *>(handle);
}

}
