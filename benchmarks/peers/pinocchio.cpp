// Pinocchio's regressor of the joint torques, behind three plain functions: a peer to time beside.
//
// The model is read from a text file: gravity, then a line per joint: parent (0 is the world), 1 for
// a turning and 0 for a sliding joint, its placement (rotation row after row, then position). Every
// joint moves along or about the z axis of its placement.
#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/regressor.hpp>

#include <fstream>
#include <memory>
#include <string>

namespace {

struct Peer {
    pinocchio::Model model;
    std::unique_ptr<pinocchio::Data> data;
    Eigen::VectorXd q, v, a;
};

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
        peer->model.appendBodyToJoint(index, pinocchio::Inertia::Zero(), pinocchio::SE3::Identity());
    }
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

__attribute__((visibility("default"))) void peer_free(void *handle)
{
    delete static_cast<Peer *>(handle);
}

}
