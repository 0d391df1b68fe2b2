// Body by body from the base: the joints between a body whose pose is known and the nearest one before it are
// fitted to that pose by Gauss-Newton steps, velocities by linear least squares.
#include "model/start_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/compile_loops.h"
#include "model/coordinates.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

/// A body as the world says it.
struct KnownBody {
    std::optional<Transform> X_WB;
    std::optional<Spatial> velocity;  // at the link's origin, world axes
    Vec3 p_BL;                        // m, that origin in the body
};

/// Solves a x = b for symmetric positive definite a of n rows (row-major), in place; n is at most 6.
void solve_small(std::vector<double>& a, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
}

/// x that makes the sum of columns[k] * x[k] come closest to `wanted` (m counts as rad).
std::vector<double> least_squares(const std::vector<Spatial>& columns, const Spatial& wanted) {
    constexpr double kRegularisation = 1e-12;
    const std::size_t n = columns.size();
    std::vector<double> a(n * n), x(n);
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) a[i * n + j] = dot(columns[i], columns[j]);
        x[i] = dot(columns[i], wanted);
        trace += a[i * n + i];
    }
    if (trace == 0) return x;
    for (std::size_t i = 0; i < n; ++i) a[i * n + i] += kRegularisation * trace;
    solve_small(a, x);
    return x;
}

/// A motion about O as seen at a point p from O.
Spatial seen_at(const Spatial& motion, const Vec3& p) {
    return {motion.angular, motion.linear + cross(motion.angular, p)};
}

class StartFit {
  public:
    StartFit(const RobotType& type, const Robot& robot) : type_(type), known_(type.bodies.size()) {
        const Pose X_RB{type.X_RB.p, to_quat(type.X_RB.R)};
        set_base(type.free_base ? robot.X_WR * X_RB : robot.X_WR);
        q_.insert(q_.end(), type.initial_q.begin(), type.initial_q.end());
        v_.assign(static_cast<std::size_t>(type.nv), 0.0);
        held_.assign(v_.size(), 0);
    }

    /// Whether it says anything of this robot.
    bool take(const ModelInstance& instance) {
        bool any = false;
        for (const LinkStart& start : instance.links) {
            const auto id = type_.find_link(start.link);
            if (!id) continue;
            const Link& link = type_.links[id->index()];
            if (link.body < 0) continue;
            KnownBody& body = known_[static_cast<std::size_t>(link.body)];
            if (body.velocity) continue;  // by another link that is welded to this one
            any = true;
            if (start.X_WL) body.X_WB = to_transform(*start.X_WL) * inverse(link.X_BL);
            body.velocity = Spatial{start.angular, start.linear};
            body.p_BL = link.X_BL.p;
        }
        for (const AxisStart& start : instance.axes) any = take(start) || any;
        return any;
    }

    void fit() {
        if (type_.free_base && known_[0].X_WB) set_base(to_pose(*known_[0].X_WB));
        for (std::size_t b = first_joint_body(); b < known_.size(); ++b)
            if (known_[b].X_WB) fit_position(b);
        place_tree(type_, q_, placement_);
        std::fill(held_.begin(), held_.end(), 0);
        for (std::size_t b = 0; b < known_.size(); ++b)
            if (known_[b].velocity) fit_velocity(b);
    }

    /// The largest distance between where a body is and where it should be: m or rad.
    double gap() {
        place_tree(type_, q_, placement_);
        double largest = 0;
        for (std::size_t b = 0; b < known_.size(); ++b)
            if (known_[b].X_WB) largest = std::max(largest, size_of(error(b)));
        return largest;
    }

    void put(Robot& robot) const {
        const Pose X_WB{{q_[0], q_[1], q_[2]}, {q_[3], q_[4], q_[5], q_[6]}};
        if (type_.free_base && known_[0].X_WB) robot.X_WR = X_WB * inverse(to_pose(type_.X_RB));
        if (!std::equal(type_.initial_q.begin(), type_.initial_q.end(), q_.begin() + 7))
            robot.start_q.assign(q_.begin() + 7, q_.end());
        if (std::any_of(v_.begin(), v_.end(), [](double v) { return v != 0; })) robot.start_v = v_;
    }

  private:
    std::size_t first_joint_body() const { return type_.free_base ? 1 : 0; }
    static double size_of(const Spatial& e) { return std::max(norm(e.angular), norm(e.linear)); }

    void set_base(const Pose& X) {
        const Quat q = normalized(X.q);
        const std::array<double, 7> base{X.p.x, X.p.y, X.p.z, q.w, q.x, q.y, q.z};
        q_.resize(std::max<std::size_t>(q_.size(), 7));
        std::copy(base.begin(), base.end(), q_.begin());
    }

    /// A given position of an axis counts more than the poses of links.
    bool take(const AxisStart& start) {
        const auto id = type_.find_joint(start.joint);
        if (!id) return false;
        const Joint& joint = type_.joints[id->index()];
        if (joint.v_index < 0 || start.axis < 0 || start.axis >= joint.nv) return false;
        if (joint_type(joint.kind).is_isotropic()) return false;
        const int offset = joint.axis_offset(start.axis);
        q_[static_cast<std::size_t>(joint.q_index + offset)] = start.position;
        held_[static_cast<std::size_t>(joint.v_index + offset)] = 1;
        return true;
    }

    /// The nearest body before this one that `known` holds for; -1: the base of a fixed one.
    template <class Known>
    int anchor_of(std::size_t b, Known known) const {
        int a = static_cast<int>(b);
        do {
            a = type_.bodies[static_cast<std::size_t>(a)].parent;
        } while (a >= 0 && !known(static_cast<std::size_t>(a)));
        return a;
    }

    /// Places in v of the joints between the body and its anchor that are still free.
    std::vector<std::size_t> free_between(int anchor, std::size_t b) const {
        std::vector<std::size_t> places;
        visit_between(type_, anchor, static_cast<int>(b), [&](std::size_t k, double) {
            if (!held_[k]) places.push_back(k);
        });
        std::reverse(places.begin(), places.end());
        return places;
    }
    void hold(const std::vector<std::size_t>& places) {
        for (const std::size_t k : places) held_[k] = 1;
    }

    /// From where body b is to where it should be, at its origin.
    Spatial error(std::size_t b) const {
        const Transform& X_OB = placement_.X_OB[b];
        const Transform& X_WB = *known_[b].X_WB;
        return {logarithm(to_quat(X_WB.R * transpose(X_OB.R))), X_WB.p - placement_.origin - X_OB.p};
    }

    std::vector<Spatial> columns(const std::vector<std::size_t>& places, const Vec3& p) const {
        std::vector<Spatial> result;
        for (const std::size_t k : places) result.push_back(seen_at(placement_.axes[k], p));
        return result;
    }

    void fit_position(std::size_t b) {
        const auto known = [this](std::size_t a) {
            return known_[a].X_WB || type_.bodies[a].joint == JointKind::kFree;
        };
        const std::vector<std::size_t> places = free_between(anchor_of(b, known), b);
        if (places.empty()) return;
        hold(places);
        const std::vector<double> start = q_;
        std::vector<double> best = q_;
        double least = std::numeric_limits<double>::infinity();
        // Several hinges in a row may turn to the wrong solution from zero: try others, the smallest gap
        // wins.
        constexpr double kStarts[] = {0, 2, -2};
        const std::size_t tries = places.size() > 1 && places.size() <= 3 ? places.size() == 2 ? 9 : 27 : 1;
        for (std::size_t t = 0; t < tries && least > 1e-6; ++t) {
            q_ = start;
            std::vector<double> turn(v_.size(), 0.0);
            for (std::size_t i = 0, digits = t; i < places.size(); ++i, digits /= 3)
                turn[places[i]] = kStarts[digits % 3];
            advance_coordinates<double>(type_, turn, 1.0, q_);
            if (const double gap = settle(b, places); gap < least) least = gap, best = q_;
        }
        q_ = best;
    }

    /// Gauss-Newton; returns the gap that is left.
    double settle(std::size_t b, const std::vector<std::size_t>& places) {
        constexpr int kStepsMax = 30;
        constexpr double kSmallest = 1e-15;
        begin_screws(b, places);
        for (int i = 0;; ++i) {
            place_tree(type_, q_, placement_);
            const Spatial e = error(b);
            if (i == kStepsMax) return size_of(e);
            const std::vector<double> x = least_squares(columns(places, placement_.X_OB[b].p), e);
            std::vector<double> change(v_.size(), 0.0);
            double largest = 0;
            for (std::size_t k = 0; k < places.size(); ++k) {
                change[places[k]] = x[k];
                largest = std::max(largest, std::fabs(x[k]));
            }
            if (largest < kSmallest) return size_of(e);
            advance_coordinates<double>(type_, change, 1.0, q_);
        }
    }

    /// A screw's turns are counted by how far it has come, which its angle does not tell.
    void begin_screws(std::size_t b, const std::vector<std::size_t>& places) {
        const Body& body = type_.bodies[b];
        if (body.joint != JointKind::kScrew || places.size() != 1 || body.pitch == 0) return;
        place_tree(type_, q_, placement_);
        const Spatial& axis = placement_.axes[places.front()];
        q_[static_cast<std::size_t>(body.q_index)] += dot(error(b).linear, axis.angular) / body.pitch;
    }

    /// The motion of a body about O.
    Spatial motion_of(int b) const {
        Spatial motion;
        const Body& body = type_.bodies[static_cast<std::size_t>(b)];
        for (int k = body.v_index + body.nv - 1; k >= 0; k = type_.dof_parent[static_cast<std::size_t>(k)])
            motion += placement_.axes[static_cast<std::size_t>(k)] * v_[static_cast<std::size_t>(k)];
        return motion;
    }

    void fit_velocity(std::size_t b) {
        const Transform& X_OB = placement_.X_OB[b];
        const Vec3 p_OL = X_OB * known_[b].p_BL;
        const Spatial& at_link = *known_[b].velocity;
        const Spatial wanted = seen_at(at_link, X_OB.p - p_OL);
        const auto known = [this](std::size_t a) { return known_[a].velocity.has_value(); };
        const std::vector<std::size_t> places = free_between(anchor_of(b, known), b);
        hold(places);
        const Spatial left = wanted - seen_at(motion_of(static_cast<int>(b)), X_OB.p);
        const std::vector<double> x = least_squares(columns(places, X_OB.p), left);
        for (std::size_t k = 0; k < places.size(); ++k) v_[places[k]] = x[k];
    }

    const RobotType& type_;
    std::vector<KnownBody> known_;
    std::vector<double> q_, v_;
    std::vector<char> held_;  // one an entry of v: it is given or fitted already
    TreePlacement placement_;
};

}  // namespace

void set_start(const ModelInstance& instance, const RobotType& type, Robot& robot, Diagnostics& diagnostics) {
    if (instance.links.empty() && instance.axes.empty()) return;
    StartFit fit(type, robot);
    if (!fit.take(instance)) return;
    fit.fit();
    fit.put(robot);
    settle_robot(type, robot, instance.where, diagnostics);
    constexpr double kFits = 1e-3;  // saved poses have six digits, and Gazebo's joints give a little
    if (const double gap = fit.gap(); gap > kFits)
        diagnostics.note(instance.where, "start-does-not-fit",
                         "the joints of '" + robot.name +
                             "' cannot put its links where the world says that they start: " +
                             std::to_string(gap) + " m or rad are left");
}

}  // namespace roboss
