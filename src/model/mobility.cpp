// How easily each body and joint of a type moves at its zero pose: the diagonal of J M^-1 J^T. Only scales
// the solver's regularisation. The mass matrix is packed by paths and factored without fill-in, as in the
// step (physics/dynamics/tree_factor.h): a chain of n links costs n^3 / 6 operations there, a bush O(n).
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/compile_type.h"
#include "model/coordinates.h"
#include "model/loop_closure.h"

namespace roboss {
namespace {

class Mobility {
  public:
    explicit Mobility(RobotType& type) : type_(type), n_(static_cast<std::size_t>(type.nv)), row_(n_, 0.0) {}

    void run() {
        place(0);
        if (!factor()) return;
        for (std::size_t b = 0; b < type_.bodies.size(); ++b) {
            Body& body = type_.bodies[b];
            const Vec3 centre = placement_.X_OB[b] * body.p_BC;
            double linear = 0, angular = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3 u;
                u[k] = 1;
                linear += between(-1, static_cast<int>(b), {cross(centre, u), u});
                angular += between(-1, static_cast<int>(b), {u, {}});
            }
            body.inverse_mass_linear = surface_mobility(body, linear / 3, angular / 3);
            body.inverse_inertia_angular = angular / 3;
        }
        for (std::size_t d = 0; d < type_.dofs.size(); ++d) {
            const std::size_t i = d + static_cast<std::size_t>(type_.base_nv());
            row_[i] = 1;
            type_.dofs[d].inverse_inertia = take_inverse_norm(i);
        }
        for (LoopJoint& loop : type_.loops) measure(loop);
        for (CoordinateCoupling& coupling : type_.couplings) measure(coupling);
    }

    /// True if the joint of a body meets, with the joints behind it free, a share of what it would meet with
    /// them locked: in the poses with all joints at 0, 45 and 90 degrees, where axes fall into line.
    bool carries(const Body& body) {
        constexpr double kLeastShare = 1e-3;
        for (const double angle : {0.0, kPi / 4, -kPi / 4, kPi / 2, -kPi / 2}) {
            place(angle);
            std::vector<double> locked;
            for (int k = 0; k < body.nv; ++k) locked.push_back(diagonal(body.v_index + k));
            factor();
            for (int k = 0; k < body.nv; ++k)
                if (!(diagonal(body.v_index + k) > kLeastShare * locked[static_cast<std::size_t>(k)]))
                    return false;
        }
        return true;
    }

  private:
    double diagonal(int v) const { return m_[type_.paths.diagonal(static_cast<std::size_t>(v))]; }

    /// The mass matrix with all joints at an angle (rad or m), or as near to it as their limits allow.
    void place(double angle) {
        std::vector<double> q(static_cast<std::size_t>(type_.nq), 0.0);
        q[3] = 1;
        for (const Body& body : type_.bodies) {
            if (joint_traits(body.joint).is_quaternion) q[static_cast<std::size_t>(body.q_index)] = 1;
            if (body.nv != 1 || angle == 0) continue;
            const Dof& dof = type_.dofs[static_cast<std::size_t>(body.v_index - type_.base_nv())];
            q[static_cast<std::size_t>(body.q_index)] = std::max(std::min(angle, dof.upper), dof.lower);
        }
        place_tree(type_, q, placement_);
        fill_mass_matrix();
    }

    /// A body on a hub at its centre of mass (a fan, a turntable) is pushed at its surface all the same: what
    /// turning gives there then stands for the mobility of the centre, which is none.
    static double surface_mobility(const Body& body, double linear, double angular) {
        constexpr double kLeast = 1e-2;
        if (!(body.mass > 0)) return linear;
        const Mat3& I = body.inertia_C;
        const double turning = angular * (I.r0.x + I.r1.y + I.r2.z) / (2 * body.mass);
        return linear < kLeast * turning ? turning : linear;
    }

    /// Mobility of B against A under a wrench on B and its opposite on A, about O.
    double between(int body_a, int body_b, const Spatial& wrench) {
        std::size_t last = 0;
        visit_between(type_, body_a, body_b, [&](std::size_t k, double sign) {
            row_[k] = sign * dot(placement_.axes[k], wrench);
            last = std::max(last, k);
        });
        return n_ == 0 ? 0 : take_inverse_norm(last);
    }

    void measure(LoopJoint& loop) {
        const Transform A = placement_.of(loop.body_a), B = placement_.of(loop.body_b);
        const Vec3 p = B * loop.X_BJ.p;
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 u;
            u[k] = 1;
            loop.inverse_mass += between(loop.body_a, loop.body_b, {cross(p, u), u}) / 3;
            loop.inverse_inertia += between(loop.body_a, loop.body_b, {u, {}}) / 3;
        }
        const FreeDirections free = free_directions(loop, A, B);
        for (std::size_t k = 0; k < free.count; ++k)
            loop.dofs[k].inverse_inertia = between(loop.body_a, loop.body_b, free.directions[k].wrench);
    }

    void measure(CoordinateCoupling& coupling) {
        const auto follower = static_cast<std::size_t>(coupling.follower + type_.base_nv());
        const auto leader = static_cast<std::size_t>(coupling.leader + type_.base_nv());
        row_[follower] = 1, row_[leader] = -coupling.slope(0);
        coupling.inverse_inertia = take_inverse_norm(std::max(follower, leader));
    }

    /// Composite rigid bodies (Featherstone 2008, section 6.2).
    void fill_mass_matrix() {
        m_.assign(type_.paths.entries(), 0.0);
        std::vector<SpatialInertia> subtree(type_.bodies.size());
        for (std::size_t b = type_.bodies.size(); b-- > 0;) {
            const Body& body = type_.bodies[b];
            const Transform& X = placement_.X_OB[b];
            subtree[b] += spatial_inertia(body.mass, X * body.p_BC, rotated(X.R, body.inertia_C));
            if (body.parent >= 0) subtree[static_cast<std::size_t>(body.parent)] += subtree[b];
            for (int k = 0; k < body.nv; ++k) {
                const auto i = static_cast<std::size_t>(body.v_index + k);
                const Spatial momentum = subtree[b] * placement_.axes[i];
                for (std::size_t j = 0; j < type_.paths.length(i); ++j)
                    m_[type_.paths.row(i) + j] =
                        dot(placement_.axes[static_cast<std::size_t>(type_.paths.path(i)[j])], momentum);
            }
        }
        for (std::size_t d = 0; d < type_.dofs.size(); ++d)
            m_[type_.paths.diagonal(d + static_cast<std::size_t>(type_.base_nv()))] += type_.dofs[d].armature;
    }

    /// M = L^T D L in place, D on the diagonal; false if the matrix is not positive definite (validate() has
    /// reported such masses).
    bool factor() {
        const DofPaths& paths = type_.paths;
        for (std::size_t k = n_; k-- > 0;) {
            double* row = m_.data() + paths.row(k);
            const std::size_t above = paths.length(k) - 1;
            if (!(row[above] > 0)) return false;
            for (std::size_t i = above; i-- > 0;) {
                const double l = row[i] / row[above];
                double* to = m_.data() + paths.row(static_cast<std::size_t>(paths.path(k)[i]));
                for (std::size_t j = 0; j <= i; ++j) to[j] -= l * row[j];
                row[i] = l;
            }
        }
        return true;
    }

    /// row_ M^-1 row_^T, where row_ ends at `last`; leaves zeros in it. A chain counts as held kFarthest
    /// degrees of freedom above `last`, where its inertia hardly lets it give way: else n links would cost
    /// O(n^3) here.
    double take_inverse_norm(std::size_t last) {
        constexpr std::size_t kFarthest = 256;
        const DofPaths& paths = type_.paths;
        const std::size_t length = paths.length(last);
        const int first = length <= kFarthest ? 0 : paths.path(last)[length - kFarthest];
        double sum = 0;
        for (std::size_t i = last + 1; i-- > static_cast<std::size_t>(first);) {
            const double x = row_[i];
            if (x == 0) continue;
            row_[i] = 0;
            const double* row = m_.data() + paths.row(i);
            const int* path = paths.path(i);
            const std::size_t above = paths.length(i) - 1;
            sum += x * x / row[above];
            const auto from = static_cast<std::size_t>(std::lower_bound(path, path + above, first) - path);
            for (std::size_t k = from; k < above; ++k) row_[static_cast<std::size_t>(path[k])] -= row[k] * x;
        }
        std::fill(row_.begin(), row_.begin() + first, 0.0);
        return sum;
    }

    RobotType& type_;
    std::size_t n_;
    TreePlacement placement_;
    std::vector<double> m_;    // packed by the type's paths
    std::vector<double> row_;  // a row of J; zeros between uses
};

}  // namespace

void compute_mobility(RobotType& type) {
    Mobility(type).run();
}

bool is_carried_by_what_follows(RobotType& type, std::size_t body) {
    return Mobility(type).carries(type.bodies[body]);
}

}  // namespace roboss
