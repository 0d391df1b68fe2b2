// See dense_dynamics.h.
#include "dense_dynamics.h"

#include <Eigen/Dense>

#include "model/coordinates.h"
#include "physics/dynamics/kinematics.h"
#include "world/joint_type.h"

namespace roboss::test {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kStep = 4e-3;  // of the differences, s: errors of 1e-12 beside accelerations of 100

/// Sixth-order central differences over samples at -3 .. 3 steps.
template <class Value>
Value first_derivative(const std::vector<Value>& f, double h) {
    return ((f[6] - f[0]) / 60.0 - (f[5] - f[1]) * (3.0 / 20.0) + (f[4] - f[2]) * 0.75) * (1 / h);
}
template <class Value>
Value second_derivative(const std::vector<Value>& f, double h) {
    return ((f[0] + f[6]) / 90.0 - (f[1] + f[5]) * (3.0 / 20.0) + (f[2] + f[4]) * 1.5 -
            f[3] * (49.0 / 18.0)) *
           (1 / (h * h));
}

template <class Function>
auto sampled(Function f) {
    std::vector<std::decay_t<decltype(f(0.0))>> values;
    for (int i = -3; i <= 3; ++i) values.push_back(f(i * kStep));
    return values;
}

Vector to_eigen(const Vec3& v) {
    return Eigen::Vector3d(v.x, v.y, v.z);
}

class Dense {
  public:
    Dense(const Model& model, const ModelSpec& spec, const RobotState& state)
        : model_(model),
          spec_(spec),
          type_(model.types[0]),
          state_(state),
          n_(static_cast<Eigen::Index>(type_.nv)) {}

    Vector acceleration(const std::vector<double>& joint_force) {
        Matrix mass = Matrix::Zero(n_, n_);
        Vector force = Vector::Zero(n_);
        for (const LinkSpec& l : spec_.links) add_link(l, mass, force);
        add_joints(joint_force, mass, force);
        const auto along = [&](double t) { return conditions(moved(state_.v, t)); };
        const Vector curvature = second_derivative(sampled(along), kStep);
        const Eigen::Index m = curvature.size();
        Matrix system = Matrix::Zero(n_ + m, n_ + m);
        system.topLeftCorner(n_, n_) = mass;
        for (Eigen::Index k = 0; k < n_; ++k) {
            std::vector<double> unit(static_cast<std::size_t>(n_), 0.0);
            unit[static_cast<std::size_t>(k)] = 1;
            const auto by_k = [&](double t) { return conditions(moved(unit, t)); };
            system.block(n_, k, m, 1) = first_derivative(sampled(by_k), kStep);
        }
        system.topRightCorner(n_, m) = system.bottomLeftCorner(m, n_).transpose();
        Vector right(n_ + m);
        right << force, -curvature;
        // More conditions than needed are consistent: the solution of least norm is one.
        Eigen::CompleteOrthogonalDecomposition<Matrix> solver;
        solver.setThreshold(1e-9);
        return solver.compute(system).solve(right).head(n_);
    }

  private:
    RobotState moved(const std::vector<double>& v, double t) const {
        RobotState s = state_;
        advance_coordinates<double>(type_, v, t, s.q);
        return s;
    }

    /// Velocity of the link's centre of mass and its angular velocity, stacked.
    Vector link_velocity(const LinkSpec& l, const RobotState& s) const {
        const LinkId id = *type_.find_link(l.name);
        const Twist twist = link_twist(type_, s, id);
        const Transform X = link_pose(type_, s, id);
        Vector v(6);
        v << to_eigen(twist.linear + cross(twist.angular, X.R * l.p_LC)), to_eigen(twist.angular);
        return v;
    }

    void add_link(const LinkSpec& l, Matrix& mass, Vector& force) const {
        const LinkId id = *type_.find_link(l.name);
        Matrix J(6, n_);
        RobotState s = state_;
        for (Eigen::Index k = 0; k < n_; ++k) {
            std::fill(s.v.begin(), s.v.end(), 0.0);
            s.v[static_cast<std::size_t>(k)] = 1;
            J.col(k) = link_velocity(l, s);
        }
        const Vector bias = first_derivative(sampled([&](double t) {
                                                 RobotState there = moved(state_.v, t);
                                                 return link_velocity(l, there);
                                             }),
                                             kStep);
        const Mat3 R = link_pose(type_, state_, id).R;
        const Mat3 I = R * l.inertia_C * transpose(R);
        Matrix M = Matrix::Zero(6, 6);
        for (int i = 0; i < 3; ++i) {
            M(i, i) = l.mass;
            for (int j = 0; j < 3; ++j)
                M(3 + i, 3 + j) = I(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
        }
        const Vec3 w = link_twist(type_, state_, id).angular;
        Vector wrench(6);
        wrench << to_eigen(model_.gravity * l.mass), to_eigen(-cross(w, I * w));
        for (const TimedWrench& applied : state_.wrenches) {
            if (applied.link != id) continue;
            wrench.head(3) += to_eigen(applied.force);
            wrench.tail(3) += to_eigen(applied.torque);
        }
        mass += J.transpose() * M * J;
        force += J.transpose() * (wrench - M * bias);
    }

    void add_joints(const std::vector<double>& joint_force, Matrix& mass, Vector& force) const {
        for (std::size_t d = 0; d < type_.dofs.size(); ++d) {
            const Dof& dof = type_.dofs[d];
            const auto i = static_cast<Eigen::Index>(d) + type_.base_nv();
            const Body& body = type_.bodies[static_cast<std::size_t>(dof.body)];
            mass(i, i) += dof.armature;
            force(i) += joint_force[d] - dof.damping * state_.v[static_cast<std::size_t>(i)];
            if (dof.spring_stiffness != 0)
                force(i) -= dof.spring_stiffness *
                            (state_.q[static_cast<std::size_t>(body.q_index)] - dof.spring_reference);
        }
    }

    Transform joint_frame(const JointSpec& j, const std::string& end, const RobotState& s) const {
        if (end == "world") return to_transform(model_.robots[0].X_WR * j.X_MJ);
        for (const LinkSpec& l : spec_.links)
            if (l.name == end)
                return link_pose(type_, s, *type_.find_link(end)) * to_transform(inverse(l.X_ML) * j.X_MJ);
        return {};
    }

    /// Zero where all loops are closed; more conditions than needed.
    Vector conditions(const RobotState& s) const {
        std::vector<double> c;
        const auto add = [&](const Vec3& v) { c.insert(c.end(), {v.x, v.y, v.z}); };
        for (const LoopJoint& loop : type_.loops) {
            const std::string& name = type_.joints[loop.joint.index()].name;
            for (const JointSpec& j : spec_.joints) {
                if (j.name != name) continue;
                const Transform A = joint_frame(j, j.parent, s), B = joint_frame(j, j.child, s);
                const Vec3 d = transpose_times(A.R, B.p - A.p);
                const Mat3 R = transpose(A.R) * B.R;
                const Vec3 a = j.axes.empty() ? Vec3{} : j.axes[0].xyz;
                const bool slides = j.kind == JointSpecKind::kPrismatic || j.kind == JointSpecKind::kScrew;
                add(slides ? cross(a, d) : d);
                if (j.kind == JointSpecKind::kUniversal) {
                    c.push_back(dot(a, R * j.axes[1].xyz) - dot(a, j.axes[1].xyz));
                } else if (j.kind == JointSpecKind::kPrismatic) {
                    add({R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)});
                } else if (j.kind != JointSpecKind::kBall) {
                    add(cross(a, R * a));
                }
                if (j.kind == JointSpecKind::kScrew) {
                    const Vec3 x = normalized(cross(a, std::fabs(a.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
                    const double angle = std::atan2(dot(cross(a, x), R * x), dot(x, R * x));
                    c.push_back(dot(a, d) - j.screw_pitch * angle);
                }
            }
        }
        for (const CoordinateCoupling& coupling : type_.couplings) {
            const auto value = [&](int d) {
                const int body = type_.dofs[static_cast<std::size_t>(d)].body;
                return s.q[static_cast<std::size_t>(type_.bodies[static_cast<std::size_t>(body)].q_index)];
            };
            c.push_back(value(coupling.follower) - coupling.multiplier * value(coupling.leader));
        }
        return Eigen::Map<const Vector>(c.data(), static_cast<Eigen::Index>(c.size()));
    }

    const Model& model_;
    const ModelSpec& spec_;
    const RobotType& type_;
    const RobotState& state_;
    Eigen::Index n_;
};

}  // namespace

std::vector<double> dense_acceleration(const Model& model, const ModelSpec& spec, const RobotState& state,
                                       const std::vector<double>& joint_force) {
    const Vector a = Dense(model, spec, state).acceleration(joint_force);
    return {a.data(), a.data() + a.size()};
}

}  // namespace roboss::test
