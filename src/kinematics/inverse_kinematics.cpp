// See inverse_kinematics.h.
#include "kinematics/inverse_kinematics.h"

#include <algorithm>
#include <cmath>

#include "core/noise.h"
#include "kinematics/pose_error.h"
#include "kinematics/posed_robot.h"
#include "math/array_rows.h"
#include "model/coordinates.h"

namespace roboss {
namespace {

constexpr double kFirstDamping = 0.1, kLeastDamping = 1e-12, kMostDamping = 1e8;  // m^2, rad^2
constexpr int kIdleSteps = 3;         // so many in a row with little gain: a local minimum
constexpr double kLittleGain = 0.01;  // of the squared error

double half_square(const SixNumbers& e) {
    double sum = 0;
    for (const double x : e) sum += x * x;
    return 0.5 * sum;
}

/// A degree of freedom that the search moves, and those that move along.
struct Unknown {
    std::size_t column = 0;       // in RobotModel::columns()
    double lower = 0, upper = 0;  // rad or m, its followers' limits included
    SixNumbers reduction{};       // of the error, per unit
    double step = 0;              // of this iteration, rad or m
    bool fixed = false;           // it takes no part in the present solution
};

/// What moves a tool: a degree of freedom on its path, and by which unknown.
struct Lever {
    std::size_t v = 0, unknown = 0, column = 0;
};

/// The search for one target after the other.
class Search {
  public:
    Search(const RobotModel& robot, LinkId link, const InverseKinematicsOptions& options)
        : robot_(robot), link_(link), options_(options), X_LT_(to_transform(options.X_LT)), posed_(robot) {
        ROBOSS_CHECK(options.moving.empty() || options.moving.size() == robot.columns().size(),
                     std::to_string(options.moving.size()));
        posed_.visit_path(link, [&](std::size_t v) { add_lever(v); });
        for (Unknown& unknown : unknowns_) bound(unknown);
        step_.resize(robot.v_columns());
        kept_.resize(posed_.q.size());
    }

    InverseKinematicsResult run(const Pose& target, const double* start, double* q) {
        InverseKinematicsResult result;
        double best = INFINITY;
        PoseError error(target, options_);
        while (result.attempts < options_.attempts && !result.success) {
            begin(start, result.attempts);
            const double left = attempt(error, result.iterations);
            ++result.attempts;
            const bool reached = is_reached(error);
            if (!reached && !(left < best) && result.attempts > 1) continue;
            best = left;
            result.success = reached;
            result.position_error = error.position(), result.orientation_error = error.orientation();
            robot_.to_row(posed_.q, q);
        }
        return result;
    }

  private:
    void add_lever(std::size_t v) {
        const std::size_t column = robot_.column_of(v);
        if (column < robot_.base_v()) return;
        const RobotModel::Column& own = robot_.columns()[column - robot_.base_v()];
        const auto leader = static_cast<std::size_t>(own.leader);
        if (!options_.moving.empty() && options_.moving[leader] == 0) return;
        const auto found = std::ranges::find(unknowns_, leader, &Unknown::column);
        levers_.push_back({v, static_cast<std::size_t>(found - unknowns_.begin()), column - robot_.base_v()});
        if (found == unknowns_.end()) unknowns_.push_back({leader});
    }

    /// The limits of the joint and of those that follow it.
    void bound(Unknown& unknown) const {
        unknown.lower = -INFINITY, unknown.upper = INFINITY;
        for (const RobotModel::Column& column : robot_.columns()) {
            if (static_cast<std::size_t>(column.leader) != unknown.column || column.multiplier == 0) continue;
            if (!column.curved.empty()) continue;  // its own limits are those of a wrong coupling
            const double a = (column.lower - column.leader_offset) / column.multiplier,
                         b = (column.upper - column.leader_offset) / column.multiplier;
            unknown.lower = std::max(unknown.lower, std::min(a, b));
            unknown.upper = std::min(unknown.upper, std::max(a, b));
        }
    }

    double& position(const Unknown& unknown) {
        return posed_.q[static_cast<std::size_t>(robot_.columns()[unknown.column].q)];
    }
    bool is_ball(const Unknown& unknown) const { return robot_.columns()[unknown.column].is_ball; }

    /// Puts the robot where attempt number `attempt` starts.
    void begin(const double* start, int attempt) {
        robot_.to_coordinates(start, posed_.q);
        const NoiseStream stream{options_.seed, 0, 0, attempt};
        for (std::size_t u = 0; u < unknowns_.size(); ++u) {
            Unknown& unknown = unknowns_[u];
            unknown.step = 0;
            if (attempt > 0) {
                const double share = random_uniform(stream, u);
                if (is_ball(unknown))
                    unknown.step = kPi * (2 * share - 1);
                else
                    position(unknown) = random_position(unknown, share);
            }
            if (!is_ball(unknown))
                position(unknown) = std::clamp(position(unknown), unknown.lower, unknown.upper);
        }
        move();
    }

    /// Within the limits; of a joint without, a turn, or a metre to each side of where it is.
    double random_position(const Unknown& unknown, double share) {
        const double reach = robot_.columns()[unknown.column].turns ? kPi : 1.0;
        double low = unknown.lower, high = unknown.upper;
        if (!std::isfinite(low)) low = std::isfinite(high) ? high - 2 * reach : position(unknown) - reach;
        if (!std::isfinite(high)) high = low + 2 * reach;
        return low + share * (high - low);
    }

    /// Moves the robot by the steps of the unknowns, and its followers along.
    void move() {
        std::fill(step_.begin(), step_.end(), 0.0);
        for (const Unknown& unknown : unknowns_)
            step_[static_cast<std::size_t>(robot_.columns()[unknown.column].v)] = unknown.step;
        advance_coordinates<double>(robot_.type(), step_, 1.0, posed_.q);
        for (const Unknown& unknown : unknowns_)
            if (!is_ball(unknown))
                position(unknown) = std::clamp(position(unknown), unknown.lower, unknown.upper);
        for (const RobotModel::Column& column : robot_.columns()) {
            const RobotModel::Column& leader = robot_.columns()[static_cast<std::size_t>(column.leader)];
            if (&leader != &column)
                posed_.q[static_cast<std::size_t>(column.q)] =
                    column.follow(posed_.q[static_cast<std::size_t>(leader.q)]);
        }
    }

    double measure(PoseError& error) {
        posed_.place();
        error.set(posed_.link_pose(link_) * X_LT_);
        return half_square(error.weighted());
    }

    bool is_reached(const PoseError& error) const {
        return error.position() <= options_.tolerance && error.orientation() <= options_.tolerance;
    }

    void set_reductions(const PoseError& error) {
        for (Unknown& unknown : unknowns_) unknown.reduction = {};
        const Vec3 p = posed_.link_pose(link_) * X_LT_.p;
        for (const Lever& lever : levers_) {
            const SixNumbers each = error.reduction(posed_.point_motion(lever.v, p));
            SixNumbers& sum = unknowns_[lever.unknown].reduction;
            const RobotModel::Column& column = robot_.columns()[lever.column];
            const RobotModel::Column& leader = robot_.columns()[static_cast<std::size_t>(column.leader)];
            const double slope = column.slope(posed_.q[static_cast<std::size_t>(leader.q)]);
            for (std::size_t i = 0; i < 6; ++i) sum[i] += slope * each[i];
        }
    }

    /// Whether the joint stands at a limit and would go beyond.
    bool is_held(const Unknown& unknown, const SixNumbers& e) {
        if (is_ball(unknown)) return false;
        double towards = 0;
        for (std::size_t i = 0; i < 6; ++i) towards += unknown.reduction[i] * e[i];
        return towards > 0 ? position(unknown) >= unknown.upper : position(unknown) <= unknown.lower;
    }

    /// The damped step that reduces the error e. Joints that it would take beyond a limit go to the limit,
    /// and the others make up for it.
    void set_steps(SixNumbers e, double damping) {
        for (Unknown& unknown : unknowns_) unknown.step = 0, unknown.fixed = is_held(unknown, e);
        for (bool again = true; again;) {
            std::array<SixNumbers, 6> A{};
            for (const Unknown& unknown : unknowns_)
                for (std::size_t i = 0; i < 6 && !unknown.fixed; ++i)
                    for (std::size_t j = 0; j <= i; ++j)
                        A[i][j] += unknown.reduction[i] * unknown.reduction[j];
            const SixNumbers y = solve_damped(A, damping, e);
            again = false;
            SixNumbers rest = e;
            for (Unknown& unknown : unknowns_) {
                if (unknown.fixed) continue;
                unknown.step = 0;
                for (std::size_t i = 0; i < 6; ++i) unknown.step += unknown.reduction[i] * y[i];
                if (is_ball(unknown)) continue;
                const double x = position(unknown),
                             within = std::clamp(x + unknown.step, unknown.lower, unknown.upper);
                if (within == x + unknown.step) continue;
                unknown.step = within - x, unknown.fixed = again = true;
                for (std::size_t i = 0; i < 6; ++i) rest[i] -= unknown.reduction[i] * unknown.step;
            }
            e = rest;
        }
    }

    /// Ends within the tolerance, in a local minimum, or after the most iterations; returns the error that is
    /// left.
    double attempt(PoseError& error, int& iterations) {
        double left = measure(error), damping = kFirstDamping;
        int idle = 0;
        for (int i = 0; i < options_.iterations && idle < kIdleSteps && damping < kMostDamping; ++i) {
            if (is_reached(error)) break;
            ++iterations;
            set_reductions(error);
            set_steps(error.weighted(), damping);
            kept_ = posed_.q;
            move();
            const double now = measure(error);
            if (now < left) {
                idle = now > (1 - kLittleGain) * left ? idle + 1 : 0;
                left = now, damping = std::max(0.1 * damping, kLeastDamping);
            } else {
                posed_.q = kept_;
                measure(error);
                damping *= 10;
            }
        }
        return left;
    }

    const RobotModel& robot_;
    LinkId link_;
    const InverseKinematicsOptions& options_;
    Transform X_LT_;
    PosedRobot posed_;
    std::vector<Unknown> unknowns_;
    std::vector<Lever> levers_;
    std::vector<double> step_, kept_;
};

}  // namespace

void inverse_kinematics(const RobotModel& robot, LinkId link, const InverseKinematicsOptions& options,
                        std::span<const double> targets, std::span<const double> start, std::span<double> q,
                        std::span<InverseKinematicsResult> results) {
    const std::size_t rows = RobotModel::rows(targets.size(), 7), columns = robot.q_columns();
    ROBOSS_CHECK(q.size() == rows * columns && results.size() == rows,
                 std::to_string(results.size()) + " results");
    ROBOSS_CHECK(start.empty() || start.size() == q.size(),
                 std::to_string(start.size()) + " numbers to start from");
    const std::vector<double> at_first = robot.start();
    Search search(robot, link, options);
    for (std::size_t i = 0; i < rows; ++i) {
        const Pose target = pose_at(&targets[i * 7]);
        const double* from = start.empty() ? at_first.data() : &start[i * columns];
        if (options.path && i > 0) from = &q[(i - 1) * columns];
        results[i] = search.run(target, from, &q[i * columns]);
    }
}

}  // namespace roboss
