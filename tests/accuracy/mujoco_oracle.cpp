// See mujoco_oracle.h.
#include "mujoco_oracle.h"

#include "core/check.h"
#include "mjcf.h"
#include "mujoco_load.h"
#include "world/joint_kind.h"

namespace roboss::test {
namespace {

Mat3 ball_rotation(const Body& body, const RobotState& state) {
    const auto i = static_cast<std::size_t>(body.q_index);
    return to_matrix(Quat{state.q[i], state.q[i + 1], state.q[i + 2], state.q[i + 3]});
}

Vec3 vec(const mjtNum* p) {
    return {p[0], p[1], p[2]};
}

void put(mjtNum* to, const Vec3& v) {
    to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

mjModel* load(const std::string& xml) {
    std::string error;
    mjModel* model = load_mjcf(xml, error);
    ROBOSS_CHECK(model != nullptr, error + "\n" + xml);
    return model;
}

}  // namespace

MujocoOracle::MujocoOracle(const ModelSpec& spec, const Pose& X_WM, const Vec3& gravity,
                           const RobotType& type)
    : type_(type), model_(load(to_mjcf(spec, X_WM, gravity))), data_(mj_makeData(model_.get())) {
    ROBOSS_CHECK(model_->nv == type.nv,
                 std::to_string(model_->nv) + " degrees of freedom against " + std::to_string(type.nv));
    pair_up(spec);
}

int MujocoOracle::id(int kind, const std::string& name) const {
    const int found = mj_name2id(model_.get(), kind, name.c_str());
    ROBOSS_CHECK(found >= 0, name);
    return found;
}

void MujocoOracle::pair_up(const ModelSpec& spec) {
    const Joint* last = nullptr;
    for (const Body& body : type_.bodies) {
        if (body.joint == JointKind::kFree) continue;
        const Dof& dof = type_.dofs[static_cast<std::size_t>(body.v_index - type_.base_nv())];
        const Joint& joint = type_.joints[dof.joint.index()];
        Pair pair{&body, id(mjOBJ_JOINT, joint.name + (&joint == last ? "_1" : "")), Mat3::identity()};
        last = &joint;
        for (const JointSpec& j : spec.joints) {
            if (j.name != joint.name) continue;
            for (const LinkSpec& l : spec.links)
                if (l.name == j.child) pair.R_LJ = to_matrix((inverse(l.X_ML) * j.X_MJ).q);
        }
        pairs_.push_back(pair);
    }
}

void MujocoOracle::set_ball(const Pair& pair, const RobotState& state,
                            const std::vector<double>& joint_force) {
    const auto i = static_cast<std::size_t>(pair.body->q_index),
               k = static_cast<std::size_t>(pair.body->v_index);
    const std::size_t d = k - static_cast<std::size_t>(type_.base_nv());
    const Mat3 R = ball_rotation(*pair.body, state);
    mjtNum* q = data_->qpos + model_->jnt_qposadr[pair.joint];
    q[0] = state.q[i];
    put(q + 1, pair.R_LJ * Vec3{state.q[i + 1], state.q[i + 2], state.q[i + 3]});
    const int at = model_->jnt_dofadr[pair.joint];
    put(data_->qvel + at, pair.R_LJ * transpose_times(R, Vec3{state.v[k], state.v[k + 1], state.v[k + 2]}));
    put(data_->qfrc_applied + at,
        pair.R_LJ * transpose_times(R, Vec3{joint_force[d], joint_force[d + 1], joint_force[d + 2]}));
}

void MujocoOracle::set(const RobotState& state, const std::vector<double>& joint_force) {
    mj_resetData(model_.get(), data_.get());
    state_ = state;
    if (type_.free_base) {
        for (std::size_t i = 0; i < 7; ++i) data_->qpos[i] = state.q[i];
        const Mat3 R = to_matrix(base_pose(state).q);
        put(data_->qvel, {state.v[3], state.v[4], state.v[5]});
        put(data_->qvel + 3, transpose_times(R, Vec3{state.v[0], state.v[1], state.v[2]}));
    }
    for (const Pair& pair : pairs_) {
        if (pair.body->joint == JointKind::kBall) {
            set_ball(pair, state, joint_force);
            continue;
        }
        const auto k = static_cast<std::size_t>(pair.body->v_index);
        const int at = model_->jnt_dofadr[pair.joint];
        data_->qpos[model_->jnt_qposadr[pair.joint]] = state.q[static_cast<std::size_t>(pair.body->q_index)];
        data_->qvel[at] = state.v[k];
        data_->qfrc_applied[at] = joint_force[k - static_cast<std::size_t>(type_.base_nv())];
    }
    for (const TimedWrench& w : state.wrenches) {
        mjtNum* xfrc = data_->xfrc_applied + 6 * id(mjOBJ_BODY, type_.links[w.link.index()].name);
        put(xfrc, vec(xfrc) + w.force);
        put(xfrc + 3, vec(xfrc + 3) + w.torque);
    }
    mj_forward(model_.get(), data_.get());
}

std::vector<double> MujocoOracle::acceleration() const {
    std::vector<double> a(static_cast<std::size_t>(type_.nv));
    const auto write = [&](std::size_t i, const Vec3& x) { a[i] = x.x, a[i + 1] = x.y, a[i + 2] = x.z; };
    if (type_.free_base) {
        write(0, to_matrix(base_pose(state_).q) * vec(data_->qacc + 3));
        write(3, vec(data_->qacc));
    }
    for (const Pair& pair : pairs_) {
        const auto k = static_cast<std::size_t>(pair.body->v_index);
        const mjtNum* qacc = data_->qacc + model_->jnt_dofadr[pair.joint];
        if (pair.body->joint == JointKind::kBall) {
            write(k, ball_rotation(*pair.body, state_) * transpose_times(pair.R_LJ, vec(qacc)));
        } else {
            a[k] = qacc[0];
        }
    }
    return a;
}

Transform MujocoOracle::link_pose(const std::string& link) const {
    const int body = id(mjOBJ_BODY, link);
    const mjtNum* R = data_->xmat + 9 * body;
    return {{vec(R), vec(R + 3), vec(R + 6)}, vec(data_->xpos + 3 * body)};
}

Twist MujocoOracle::link_twist(const std::string& link) const {
    mjtNum v[6];
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, id(mjOBJ_BODY, link), v, 0);
    return {vec(v), vec(v + 3)};
}

}  // namespace roboss::test
