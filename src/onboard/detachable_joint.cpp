// See onboard_kinds/detachable_joint.h; how bonds form and let go: physics/bonds.
#include <algorithm>
#include <limits>
#include <string_view>

#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr double kReach = 1.0;    // m: bounds that are nearer are always in reach
constexpr Tick kLookAgain = 100;  // ticks between two searches for a child that is not there

/// What a bond may hold.
struct Child {
    bool found = false;
    RobotId robot;  // not valid: the scenery
    LinkId link;
};

/// A link "link" of the robot `index`, if it is there, and the robot is another one.
bool take_link(const Model& model, std::size_t index, RobotId own, const std::string& link, Child& child) {
    if (index == own.index()) return false;
    const auto id = model.type_of(RobotId(index)).find_link(link);
    if (!id) return false;
    child = {true, RobotId(index), *id};
    return true;
}

/// Prefix of the names of links of the (nested) model that a link is of: "inner::" or "".
std::string scope_of(const std::string& link) {
    const std::size_t at = link.rfind("::");
    return at == std::string::npos ? "" : link.substr(0, at + 2);
}

/// Another part of this model: of a nested one, or of the plugin's own.
bool find_in_family(const DetachableJointSpec& spec, const OnboardContext& c, Child& child) {
    const Model& model = c.model();
    const std::string scope = scope_of(spec.parent_link.front());
    const std::string link =
        spec.child_model == "__model__" ? spec.child_link : spec.child_model + "::" + spec.child_link;
    const std::uint32_t family = model.robots[c.robot().index()].family;
    for (std::size_t i = 0; i < model.robots.size(); ++i)
        if (model.robots[i].family == family && (take_link(model, i, c.robot(), scope + link, child) ||
                                                 take_link(model, i, c.robot(), link, child)))
            return true;
    return false;
}

/// A model of the world; "outer::inner" is a part of one.
bool find_in_world(const DetachableJointSpec& spec, const OnboardContext& c, Child& child) {
    const Model& model = c.model();
    const std::size_t split = spec.child_model.find("::");
    const std::string_view outer = std::string_view(spec.child_model).substr(0, split);
    const std::string link = split == std::string::npos
                                 ? spec.child_link
                                 : spec.child_model.substr(split + 2) + "::" + spec.child_link;
    const auto is_of = [&](std::string_view name) {
        return name.starts_with(outer) &&
               (name.size() == outer.size() || name.substr(outer.size()).starts_with("::"));
    };
    for (std::size_t i = 0; i < model.robots.size(); ++i)
        if (is_of(model.robots[i].name) && take_link(model, i, c.robot(), link, child)) return true;
    for (const StaticShape& scenery : model.statics)
        if (is_of(scenery.name)) return child.found = true;
    return false;
}

/// The bond of this joint, whatever its child; nullptr: it has none.
Bond* own_bond(const OnboardContext& c, std::vector<Bond>& bonds, const Child& child) {
    const auto found = std::ranges::find_if(bonds, [&](const Bond& bond) {
        return bond.link == c.link(0) && bond.other == child.robot.value && bond.other_link == child.link;
    });
    return found == bonds.end() ? nullptr : &*found;
}

/// How far the child may be: as far as it was at the start.
double reach_of(const OnboardContext& c, RobotId child) {
    const Model& model = c.model();
    const Vec3 apart = model.robots[child.index()].X_WR.p - model.robots[c.robot().index()].X_WR.p;
    return std::max(kReach, norm(apart));
}

Bond new_bond(OnboardContext& c, const Child& child) {
    Bond bond;
    bond.link = c.link(0), bond.other = child.robot.value, bond.other_link = child.link;
    bond.max_force = bond.max_torque = std::numeric_limits<double>::infinity();
    if (child.robot.valid()) {
        bond.reach = reach_of(c, child.robot);
    } else {
        bond.phase = BondPhase::kHolds;
        bond.X_LO = to_pose(inverse(c.pose(bond.link)));
    }
    return bond;
}

/// Whether a command came that was not obeyed yet.
bool hears_order(const OnboardContext& c, std::size_t command, double& heard) {
    const auto at = static_cast<double>(c.commanded_at(command));
    if (at <= heard) return false;
    heard = at;
    return true;
}

}  // namespace

void run(const DetachableJointSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    double& phase = memory[DetachableJointSpec::kPhase];
    const bool detach = hears_order(c, 0, memory[DetachableJointSpec::kDetached]);
    const bool attach = hears_order(c, 1, memory[DetachableJointSpec::kAttached]);
    if (!attach && !detach) {
        if (phase == DetachableJointSpec::kLoose || phase == DetachableJointSpec::kHolds) return;
        if (phase == DetachableJointSpec::kWanted && c.tick() % kLookAgain != 0) return;
    }
    std::vector<Bond>& bonds = c.state().bonds;
    Child child;
    if (!find_in_family(spec, c, child)) find_in_world(spec, c, child);
    Bond* bond = child.found ? own_bond(c, bonds, child) : nullptr;
    if (detach) {
        if (bond != nullptr) bond->phase = BondPhase::kLoosed;
        phase = DetachableJointSpec::kLoose;
    } else if (bond != nullptr) {
        phase = DetachableJointSpec::kHolds;
    } else if (phase == DetachableJointSpec::kAttaches && !attach) {
        phase = DetachableJointSpec::kLoose;  // out of reach
    } else if (!child.found) {
        phase = DetachableJointSpec::kWanted;
    } else {
        phase = DetachableJointSpec::kAttaches;
        bonds.push_back(new_bond(c, child));
    }
}

}  // namespace roboss
