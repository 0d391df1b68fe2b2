// The buffers of a group of robots that may meet (RobotGroup).
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/team.h"
#include "core/union_find.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/contact/contact.h"
#include "physics/island_scratch.h"
#include "physics/lanes/lane_stepper.h"
#include "physics/sleep.h"
#include "physics/step.h"

namespace roboss {

/// A robot of a group that goes in lanes with those of its kind: of one type, with contacts of the same
/// shapes.
struct LaneMember {
    std::uint64_t kind = 0;
    std::uint32_t robot = 0;
    friend auto operator<=>(const LaneMember&, const LaneMember&) = default;
};

/// Decides if lanes are worth a try: how many robots got through lately. On hills each takes other turns in
/// the solver than its neighbours, on a flat mesh all take the same. No bit depends on it.
class LaneLuck {
  public:
    void note(bool stepped) { share_ += ((stepped ? 1.0 : 0.0) - share_) / kLately; }
    bool is_good(Tick tick) const { return share_ > kEnough || tick % kAgain == 0; }

  private:
    static constexpr double kLately = 128, kEnough = 0.6;
    static constexpr Tick kAgain = 32;
    double share_ = 1;
};

/// Kept from tick to tick; the contacts stay until the next group.
struct GroupScratch {
    bool keep_reactions =
        false;  // then robots with loops do not move freely, for then nothing knows their loads
    bool profiles_solver = false;  // StepProfile::solver is wanted
    std::vector<ContactReport> contact_reports;
    LaneSteppers lanes;        // for robots that touch nobody
    bool tried_alone = false;  // the group is one robot that lanes and floats did not step
    bool rough = false;        // a group of robots that meet nobody, on rough ground
    LaneLuck rough_luck;
    std::vector<LaneMember> lane_members;
    std::vector<std::uint32_t> batch;
    Team team;  // that may share the work of a large group
    ContactFinder finder;
    std::vector<Contact> contacts;
    BondKeeper bonds;
    UnionFind islands;  // of robots in contact, or bonded
    std::vector<std::uint32_t> members;
    std::vector<std::span<const std::uint32_t>> waiting;  // islands that are stepped side by side
    std::vector<IslandScratch> island = std::vector<IslandScratch>(1);  // one a thread of the team
    std::vector<StepReport> reports;                                    // likewise
    WakeBuffers wake;
};

}  // namespace roboss
