// The buffers of a group of robots that may meet (RobotGroup).
#pragma once

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

/// Kept from tick to tick; the contacts stay until the next group.
struct GroupScratch {
    bool keep_reactions =
        false;  // then robots with loops do not move freely, for then nothing knows their loads
    bool profiles_solver = false;  // StepProfile::solver is wanted
    std::vector<ContactReport> contact_reports;
    LaneSteppers lanes;        // for robots that touch nobody
    bool tried_alone = false;  // the group is one robot that lanes and floats did not step
    LaneQueue queue;
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
