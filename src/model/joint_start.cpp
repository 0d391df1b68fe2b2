// See joint_start.h. Behind linear couplings each follower is an affine function of the joint that leads its
// chain, so the limits of the whole chain are one interval of that joint's coordinate. Followers behind a
// curved coupling (MJCF `polycoef`) are placed, too, but do not narrow that interval.
#include "model/joint_start.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace roboss {
namespace {

constexpr double kToldFrom = 1e-3;    // rad or m: less is not worth a line
constexpr double kLimitSlack = 1e-9;  // rad or m, of rounding
constexpr std::size_t kNamedJoints = 12;

/// position = multiplier * position of `root` + offset.
struct ChainLink {
    std::size_t root = 0;
    double multiplier = 1, offset = 0;
    bool settled = true;  // false: it follows two leaders, or itself
    bool curved = false;  // a coupling of the chain is: `multiplier` and `offset` do not count
};

class JointChains {
  public:
    explicit JointChains(const RobotType& type) : type_(type), follows_(type.dofs.size(), nullptr) {
        std::vector<char> twice(type.dofs.size(), 0);
        for (const CoordinateCoupling& c : type.couplings) {
            const CoordinateCoupling*& known = follows_[static_cast<std::size_t>(c.follower)];
            if (known != nullptr) twice[static_cast<std::size_t>(c.follower)] = 1;
            known = &c;
        }
        for (std::size_t i = 0; i < type.dofs.size(); ++i) links_.push_back(resolve(i, twice));
    }

    const ChainLink& operator[](std::size_t dof) const { return links_[dof]; }
    const CoordinateCoupling* coupling(std::size_t dof) const { return follows_[dof]; }
    /// Where the coordinate stands when the root of its chain, which is settled, stands at `lead`.
    double follow(std::size_t dof, double lead) const {
        const ChainLink& link = links_[dof];
        if (!link.curved) return link.multiplier * lead + link.offset;
        const CoordinateCoupling& c = *follows_[dof];
        return c.follow(follow(static_cast<std::size_t>(c.leader), lead));
    }

  private:
    ChainLink resolve(std::size_t dof, const std::vector<char>& twice) const {
        ChainLink link;
        link.root = dof;
        for (std::size_t steps = 0; follows_[link.root] != nullptr; ++steps) {
            if (twice[link.root] != 0 || steps == type_.dofs.size()) return {dof, 1, 0, false, false};
            const CoordinateCoupling& c = *follows_[link.root];
            link.curved = link.curved || c.is_curved();
            link.offset += link.multiplier * c.offset;
            link.multiplier *= c.multiplier;
            link.root = static_cast<std::size_t>(c.leader);
        }
        return link;
    }

    const RobotType& type_;
    std::vector<const CoordinateCoupling*> follows_;
    std::vector<ChainLink> links_;
};

struct Interval {
    double lower = 0, upper = 0;

    /// Keeps the positions of the root that put the follower within its limits.
    void cut(const ChainLink& link, const Dof& dof) {
        if (link.multiplier == 0 || link.curved) return;
        double low = (dof.lower - link.offset) / link.multiplier,
               high = (dof.upper - link.offset) / link.multiplier;
        if (link.multiplier < 0) std::swap(low, high);
        lower = std::max(lower, low), upper = std::min(upper, high);
    }
};

/// A coordinate that is one number.
bool is_scalar(const RobotType& type, std::size_t dof) {
    return type.bodies[static_cast<std::size_t>(type.dofs[dof].body)].nv == 1;
}

/// Its place behind the 7 base coordinates.
std::size_t coordinate_of(const RobotType& type, std::size_t dof) {
    return static_cast<std::size_t>(type.bodies[static_cast<std::size_t>(type.dofs[dof].body)].q_index - 7);
}

std::string short_number(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string limits_text(const Dof& dof) {
    return short_number(dof.lower) + " to " + short_number(dof.upper);
}

const std::string& joint_of(const RobotType& type, std::size_t dof) {
    return type.joints[type.dofs[dof].joint.index()].name;
}

/// "'a' at 0.4 instead of 0 (it follows 'b')"
std::string text_of(const JointMove& move, const RobotType& type, const JointChains& chains) {
    std::string text = "'" + joint_of(type, move.dof) + "' at " + short_number(move.to) + " instead of " +
                       short_number(move.from);
    if (const CoordinateCoupling* c = chains.coupling(move.dof); c != nullptr)
        return text + " (it follows '" + joint_of(type, static_cast<std::size_t>(c->leader)) + "')";
    return text + " (limits " + limits_text(type.dofs[move.dof]) + ")";
}

}  // namespace

bool starts_within(const Dof& dof, double position) {
    return position >= dof.lower - kLimitSlack && position <= dof.upper + kLimitSlack;
}

JointStart settle_joints(const RobotType& type, std::vector<double>& joints) {
    const JointChains chains(type);
    std::vector<Interval> allowed(type.dofs.size());
    for (std::size_t i = 0; i < type.dofs.size(); ++i) allowed[i] = {type.dofs[i].lower, type.dofs[i].upper};
    for (std::size_t i = 0; i < type.dofs.size(); ++i)
        if (chains[i].settled && chains[i].root != i) allowed[chains[i].root].cut(chains[i], type.dofs[i]);
    JointStart result;
    const std::vector<double> wanted = joints;
    for (std::size_t i = 0; i < type.dofs.size(); ++i) {
        const ChainLink& link = chains[i];
        if (!is_scalar(type, i) || !link.settled || !is_scalar(type, link.root)) continue;
        const Dof& root = type.dofs[link.root];
        Interval place = allowed[link.root];
        if (place.lower > place.upper + kLimitSlack) place = {root.lower, root.upper};
        const double lead = wanted[coordinate_of(type, link.root)];
        const double kept = std::max(std::min(lead, place.upper), place.lower);
        double& position = joints[coordinate_of(type, i)];
        const double before = position;
        position = link.root == i ? kept : chains.follow(i, kept);
        if (std::fabs(position - before) > kToldFrom) result.moved.push_back({i, before, position});
        if (!starts_within(type.dofs[i], position)) result.beyond.push_back(i);
    }
    return result;
}

void report(std::span<const JointMove> moved, const RobotType& type, const std::string& robot,
            const SourceLocation& where, Diagnostics& diagnostics) {
    if (moved.empty()) return;
    const JointChains chains(type);
    std::string text;
    for (std::size_t i = 0; i < std::min(moved.size(), kNamedJoints); ++i)
        text += (i > 0 ? ", " : "") + text_of(moved[i], type, chains);
    if (moved.size() > kNamedJoints) text += " and " + std::to_string(moved.size() - kNamedJoints) + " more";
    diagnostics.note(where, "start-moved",
                     "joints of '" + robot + "' start within their limits, and behind their leaders: " + text,
                     "Give another start within the limits, of joints that lead.");
}

void report_beyond(std::span<const std::size_t> beyond, const RobotType& type,
                   const std::vector<double>& joints, const std::string& robot, const SourceLocation& where,
                   Diagnostics& diagnostics) {
    for (const std::size_t dof : beyond)
        diagnostics.warning(where, "start-beyond-limits",
                            "joint '" + joint_of(type, dof) + "' of '" + robot + "' starts at " +
                                short_number(joints[coordinate_of(type, dof)]) + ", beyond its limits " +
                                limits_text(type.dofs[dof]) +
                                ": no start of the joints that it is coupled to keeps all within theirs",
                            "Correct multiplier and offset of its mimic, or the limits.");
}

}  // namespace roboss
