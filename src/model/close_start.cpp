// Settles the start of a robot. First its joints get within their limits and followers to their leaders
// (joint_start.h). Loops that are open then, and couplings that are, close by Newton's method with the
// shortest step (minimum norm) on the joint coordinates, led from the zero configuration, where every loop of
// a file is closed, so that it ends on the branch that the file draws. What would leave its limits is held
// there.
#include <algorithm>
#include <cmath>

#include "model/compile_loops.h"
#include "model/coordinates.h"
#include "model/joint_start.h"
#include "model/loop_closure.h"

namespace roboss {
namespace {

constexpr double kClosed = 1e-10;  // m or rad
constexpr int kLeadSteps = 20;     // from zero to the start that the file asks for

struct Gap {
    double way = 0, angle = 0;  // largest, m and rad
    bool closed() const { return way <= kClosed && angle <= kClosed; }
};

class StartClosure {
  public:
    StartClosure(const RobotType& type, const std::vector<double>& joints)
        : type_(type), base_(static_cast<std::size_t>(type.base_nv())), q_{0, 0, 0, 1, 0, 0, 0} {
        q_.insert(q_.end(), joints.begin(), joints.end());
        held_.assign(static_cast<std::size_t>(type.nv), 0);
    }

    Gap gap() {
        gather();
        return gap_;
    }

    /// Leads the coordinates that the file gives from zero to their values; the others follow.
    Gap lead() {
        const std::vector<double> wanted = q_;
        for (const Body& body : type_.bodies) {
            if (body.nv != 1 || wanted[coordinate(body)] == 0) continue;
            held_[static_cast<std::size_t>(body.v_index)] = 1;
        }
        for (const CoordinateCoupling& c : type_.couplings)
            held_[base_ + static_cast<std::size_t>(c.follower)] = 0;
        Gap left;
        for (int step = 1; step <= kLeadSteps; ++step) {
            for (const Body& body : type_.bodies) {
                if (body.nv == 1 && held_[static_cast<std::size_t>(body.v_index)])
                    q_[coordinate(body)] = wanted[coordinate(body)] * step / kLeadSteps;
                else if (body.nv == 1 && step == 1)
                    q_[coordinate(body)] = 0;
            }
            left = settle();
        }
        return within_limits(left);
    }

    Gap lead_none() {
        std::fill(held_.begin(), held_.end(), 0);
        return within_limits(settle());
    }

    std::vector<double> joint_coordinates() const { return {q_.begin() + 7, q_.end()}; }

    /// Joints that are beyond their limits, in RobotType::dofs.
    std::vector<std::size_t> beyond() const {
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < type_.dofs.size(); ++i)
            if (body_of(i).nv == 1 && !starts_within(type_.dofs[i], value(i))) result.push_back(i);
        return result;
    }

  private:
    static std::size_t coordinate(const Body& body) { return static_cast<std::size_t>(body.q_index); }

    const Body& body_of(std::size_t dof) const {
        return type_.bodies[static_cast<std::size_t>(type_.dofs[dof].body)];
    }

    /// Holds what left its limits there, and closes with the others; as it was if that does not close.
    Gap within_limits(const Gap& closed) {
        const std::vector<double> q = q_;
        const std::vector<char> held = held_;
        Gap left = closed;
        for (std::size_t round = 0; round < type_.dofs.size() && left.closed(); ++round) {
            const std::vector<std::size_t> out = beyond();
            if (out.empty()) return left;
            for (const std::size_t dof : out) {
                double& at = q_[coordinate(body_of(dof))];
                at = std::clamp(at, type_.dofs[dof].lower, type_.dofs[dof].upper);
                held_[base_ + dof] = 1;
            }
            left = settle();
        }
        if (left.closed() || !closed.closed()) return left;
        q_ = q, held_ = held;
        return gap();
    }

    Gap settle() {
        constexpr int kStepsMax = 60;
        for (int i = 0; i < kStepsMax; ++i) {
            gather();
            if (gap_.closed() && i > 0) break;
            step();
        }
        return gap_;
    }

    /// Errors and Jacobian (row-major, over all of v) of loops and couplings.
    void gather() {
        place_tree(type_, q_, placement_);
        errors_.clear(), jacobian_.clear();
        gap_ = {};
        for (const LoopJoint& loop : type_.loops) {
            const BodyKinematics a{placement_.of(loop.body_a), {}, {}}, b{placement_.of(loop.body_b), {}, {}};
            const auto rows = closure_rows(loop, a, b);
            for (const ClosureRow& row : rows.all()) {
                const bool way = norm_squared(row.wrench.linear) > 0;
                double* const j = add_row(row.error, way);
                visit_between(type_, loop.body_a, loop.body_b, [&](std::size_t k, double sign) {
                    j[k] = sign * dot(placement_.axes[k], row.wrench);
                });
            }
        }
        for (const CoordinateCoupling& c : type_.couplings) {
            const auto f = static_cast<std::size_t>(c.follower), l = static_cast<std::size_t>(c.leader);
            double* const j = add_row(c.gap(value(f), value(l)), false);
            j[base_ + f] = 1, j[base_ + l] -= c.slope(value(l));
        }
    }

    double value(std::size_t dof) const { return q_[coordinate(body_of(dof))]; }

    double* add_row(double error, bool way) {
        double& largest = way ? gap_.way : gap_.angle;
        largest = std::max(largest, std::fabs(error));
        errors_.push_back(error);
        jacobian_.resize(jacobian_.size() + held_.size(), 0.0);
        return jacobian_.data() + jacobian_.size() - held_.size();
    }

    /// q := q - J^T (J J^T + a little)^-1 errors, on the coordinates that are not held; at most 0.2 rad or m.
    void step() {
        constexpr double kRegularisation = 1e-10, kStepMax = 0.2;
        const std::size_t m = errors_.size(), n = held_.size();
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t k = 0; k < n; ++k)
                if (k < base_ || held_[k]) jacobian_[i * n + k] = 0;
        std::vector<double> a(m * m), x = errors_;
        double trace = 0;
        for (std::size_t i = 0; i < m; ++i) {
            for (std::size_t j = 0; j <= i; ++j)
                for (std::size_t k = 0; k < n; ++k)
                    a[i * m + j] += jacobian_[i * n + k] * jacobian_[j * n + k];
            trace += a[i * m + i];
        }
        if (trace == 0) return;
        for (std::size_t i = 0; i < m; ++i) a[i * m + i] += kRegularisation * trace;
        solve_cholesky(a, x);
        std::vector<double> change(n);
        double largest = 0;
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t i = 0; i < m; ++i) change[k] -= jacobian_[i * n + k] * x[i];
            largest = std::max(largest, std::fabs(change[k]));
        }
        advance_coordinates<double>(type_, change, largest > kStepMax ? kStepMax / largest : 1.0, q_);
    }

    /// x := a^-1 x; lower triangle, row-major.
    static void solve_cholesky(std::vector<double>& a, std::vector<double>& x) {
        const std::size_t m = x.size();
        for (std::size_t i = 0; i < m; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = a[i * m + j];
                for (std::size_t k = 0; k < j; ++k) sum -= a[i * m + k] * a[j * m + k];
                a[i * m + j] = i == j ? std::sqrt(sum) : sum / a[j * m + j];
            }
            for (std::size_t k = 0; k < i; ++k) x[i] -= a[i * m + k] * x[k];
            x[i] /= a[i * m + i];
        }
        for (std::size_t i = m; i-- > 0;) {
            for (std::size_t k = i + 1; k < m; ++k) x[i] -= a[k * m + i] * x[k];
            x[i] /= a[i * m + i];
        }
    }

    const RobotType& type_;
    std::size_t base_;
    std::vector<double> q_;
    std::vector<char> held_;  // one an entry of v
    TreePlacement placement_;
    std::vector<double> errors_, jacobian_;
    Gap gap_;
};

struct Closing {
    Gap gap;
    bool moved_given = false;  // not as the file says: nothing was held
};

/// Closes loops and couplings, within limits if that is possible.
Closing close_loops(const RobotType& type, std::vector<double>& joints, JointStart& start) {
    if (!type.has_equalities()) return {};
    StartClosure closure(type, joints);
    Closing result{closure.gap()};
    if (result.gap.closed()) return result;
    result.gap = closure.lead();
    const bool as_given = result.gap.closed();
    const std::vector<double> led = closure.joint_coordinates();
    start.beyond = closure.beyond();
    if (!as_given || !start.beyond.empty()) {
        const Gap gap = closure.lead_none();
        result.moved_given = gap.closed() && (!as_given || closure.beyond().empty());
        if (!as_given) result.gap = gap;
    }
    if (!result.gap.closed()) return result;
    joints = led;
    if (!result.moved_given) return result;
    joints = closure.joint_coordinates();
    start.beyond = closure.beyond();
    return result;
}

}  // namespace

void close_start(const ModelSpec& spec, RobotType& type, Diagnostics& diagnostics) {
    JointStart start = settle_joints(type, type.initial_q);
    const Closing closing = close_loops(type, type.initial_q, start);
    if (!closing.gap.closed()) {
        diagnostics.error(spec.where, "open-loop",
                          "the loops of model '" + spec.name + "' cannot be closed at its start: a gap of " +
                              std::to_string(closing.gap.way) + " m or " + std::to_string(closing.gap.angle) +
                              " rad is left",
                          "Correct <initial_position>, the joints' poses, or the offsets of mimic joints.");
        return;
    }
    if (closing.moved_given)
        diagnostics.warning(spec.where, "start-moved",
                            "the loops of model '" + spec.name +
                                "' do not close, within the limits of its joints, at the "
                                "<initial_position>s given; the joints start elsewhere",
                            "Give the start of as many joints as the mechanism is free to move.");
    else
        report(start.moved, type, spec.name, spec.where, diagnostics);
    report_beyond(start.beyond, type, type.initial_q, spec.name, spec.where, diagnostics);
}

void settle_robot(const RobotType& type, Robot& robot, const SourceLocation& where,
                  Diagnostics& diagnostics) {
    if (robot.start_q.empty()) return;
    std::vector<double> joints = robot.start_q;
    JointStart start = settle_joints(type, joints);
    if (joints == robot.start_q) return;
    if (!type.loops.empty()) close_loops(type, joints, start);
    robot.start_q = joints;
    report(start.moved, type, robot.name, where, diagnostics);
    report_beyond(start.beyond, type, joints, robot.name, where, diagnostics);
}

}  // namespace roboss
