// How easily each body and joint of a type moves at its zero pose: the diagonal of J M^-1 J^T, with a dense
// mass matrix. Only scales the solver's regularisation, computed once a type, so clarity goes before speed.
#include <cmath>
#include <vector>

#include "model/compile_type.h"
#include "model/coordinates.h"
#include "model/loop_closure.h"

namespace roboss {
namespace {

struct Column {
    Vec3 angular, linear;  // of a body's centre of mass per unit of one degree of freedom, world axes
};

class Mobility {
  public:
    explicit Mobility(RobotType& type) : type_(type), n_(static_cast<std::size_t>(type.nv)) {}

    void run() {
        forward_kinematics();
        fill_mass_matrix();
        if (!factor()) return;
        for (std::size_t b = 0; b < type_.bodies.size(); ++b) {
            Body& body = type_.bodies[b];
            double linear = 0, angular = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                linear += quadratic(b, axis, true);
                angular += quadratic(b, axis, false);
            }
            body.inverse_mass_linear = surface_mobility(body, linear / 3, angular / 3);
            body.inverse_inertia_angular = angular / 3;
        }
        for (std::size_t d = 0; d < type_.dofs.size(); ++d) {
            std::vector<double> unit(n_, 0.0);
            unit[d + static_cast<std::size_t>(type_.base_nv())] = 1;
            type_.dofs[d].inverse_inertia = inverse_norm(unit);
        }
        if (!type_.has_equalities()) return;
        std::vector<double> q(static_cast<std::size_t>(type_.nq), 0.0);
        for (const Body& body : type_.bodies)
            if (joint_traits(body.joint).is_quaternion) q[static_cast<std::size_t>(body.q_index)] = 1;
        q[3] = 1;
        place_tree(type_, q, placement_);
        for (LoopJoint& loop : type_.loops) measure(loop);
        for (CoordinateCoupling& coupling : type_.couplings) measure(coupling);
    }

  private:
    /// A body on a hub at its centre of mass (a fan, a turntable) is pushed at its surface all the same: what
    /// turning gives there then stands for the mobility of the centre, which is none.
    static double surface_mobility(const Body& body, double linear, double angular) {
        constexpr double kLeast = 1e-2;
        if (!(body.mass > 0)) return linear;
        const Mat3& I = body.inertia_C;
        const double turning = angular * (I.r0.x + I.r1.y + I.r2.z) / (2 * body.mass);
        return linear < kLeast * turning ? turning : linear;
    }

    /// Mobility of B against A under a wrench on B and its opposite on A.
    double between(const LoopJoint& loop, const Spatial& wrench) const {
        std::vector<double> row(n_, 0.0);
        visit_between(type_, loop.body_a, loop.body_b,
                      [&](std::size_t k, double sign) { row[k] = sign * dot(placement_.axes[k], wrench); });
        return inverse_norm(row);
    }

    void measure(LoopJoint& loop) const {
        const Transform A = placement_.of(loop.body_a), B = placement_.of(loop.body_b);
        const Vec3 p = B * loop.X_BJ.p;
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 u;
            u[k] = 1;
            loop.inverse_mass += between(loop, {cross(p, u), u}) / 3;
            loop.inverse_inertia += between(loop, {u, {}}) / 3;
        }
        const FreeDirections free = free_directions(loop, A, B);
        for (std::size_t k = 0; k < free.count; ++k)
            loop.dofs[k].inverse_inertia = between(loop, free.directions[k].wrench);
    }

    void measure(CoordinateCoupling& coupling) const {
        std::vector<double> row(n_, 0.0);
        row[static_cast<std::size_t>(coupling.follower + type_.base_nv())] = 1;
        row[static_cast<std::size_t>(coupling.leader + type_.base_nv())] = -coupling.multiplier;
        coupling.inverse_inertia = inverse_norm(row);
    }

    void forward_kinematics() {
        X_WB_.resize(type_.bodies.size());
        for (std::size_t b = 0; b < type_.bodies.size(); ++b) {
            const Body& body = type_.bodies[b];
            X_WB_[b] = body.parent < 0 ? body.X_PJ : X_WB_[static_cast<std::size_t>(body.parent)] * body.X_PJ;
        }
    }

    /// Motion of body b's centre of mass by each degree of freedom on its path.
    std::vector<Column> jacobian(std::size_t b) const {
        std::vector<Column> columns(n_);
        const Vec3 centre = X_WB_[b] * type_.bodies[b].p_BC;
        for (int i = static_cast<int>(b); i >= 0; i = type_.bodies[static_cast<std::size_t>(i)].parent) {
            const Body& body = type_.bodies[static_cast<std::size_t>(i)];
            const Transform& X = X_WB_[static_cast<std::size_t>(i)];
            const Vec3 arm = centre - X.p;
            const auto first = static_cast<std::size_t>(body.v_index);
            if (body.nv == 1) {
                Spatial motion;
                joint_axes(body, X.R, {X.R, X.p - centre}, &motion);
                columns[first] = {motion.angular, motion.linear};
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3 axis;
                axis[k] = 1;
                columns[first + k] = {axis, cross(axis, arm)};
                if (body.nv == 6) columns[first + 3 + k].linear = axis;
            }
        }
        return columns;
    }

    void fill_mass_matrix() {
        m_.assign(n_ * n_, 0.0);
        for (std::size_t b = 0; b < type_.bodies.size(); ++b) {
            const Body& body = type_.bodies[b];
            const std::vector<Column> J = jacobian(b);
            const Mat3 inertia = X_WB_[b].R * body.inertia_C * transpose(X_WB_[b].R);
            for (std::size_t i = 0; i < n_; ++i)
                for (std::size_t j = 0; j < n_; ++j)
                    m_[i * n_ + j] +=
                        body.mass * dot(J[i].linear, J[j].linear) + dot(J[i].angular, inertia * J[j].angular);
        }
        for (std::size_t d = 0; d < type_.dofs.size(); ++d) {
            const std::size_t i = d + static_cast<std::size_t>(type_.base_nv());
            m_[i * n_ + i] += type_.dofs[d].armature;
        }
    }

    /// Cholesky in place; false if the matrix is not positive definite (validate() has reported such masses).
    bool factor() {
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = m_[i * n_ + j];
                for (std::size_t k = 0; k < j; ++k) sum -= m_[i * n_ + k] * m_[j * n_ + k];
                if (i != j) {
                    m_[i * n_ + j] = sum / m_[j * n_ + j];
                } else if (sum <= 0) {
                    return false;
                } else {
                    m_[i * n_ + i] = std::sqrt(sum);
                }
            }
        }
        return true;
    }

    /// x^T M^-1 x
    double inverse_norm(std::vector<double> x) const {
        double sum = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= m_[i * n_ + k] * x[k];
            x[i] /= m_[i * n_ + i];
            sum += x[i] * x[i];
        }
        return sum;
    }

    double quadratic(std::size_t b, std::size_t axis, bool linear) const {
        const std::vector<Column> J = jacobian(b);
        std::vector<double> row(n_);
        for (std::size_t i = 0; i < n_; ++i) row[i] = linear ? J[i].linear[axis] : J[i].angular[axis];
        return inverse_norm(row);
    }

    RobotType& type_;
    std::size_t n_;
    std::vector<Transform> X_WB_;
    TreePlacement placement_;
    std::vector<double> m_;
};

}  // namespace

void compute_mobility(RobotType& type) {
    Mobility(type).run();
}

}  // namespace roboss
