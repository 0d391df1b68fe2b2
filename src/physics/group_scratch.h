// The buffers of a group of robots that may meet (RobotGroup) and of its contact islands (ContactIsland).
#pragma once

#include <span>
#include <vector>

#include "core/union_find.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/bonds/bond_projection.h"
#include "physics/contact/contact_rows.h"
#include "physics/contact/island_guard.h"
#include "physics/contact/island_parts.h"
#include "physics/contact/second_look.h"
#include "physics/dynamics/integrate.h"
#include "physics/dynamics/joint_rows.h"
#include "physics/lanes/lane_stepper.h"
#include "physics/sleep.h"
#include "physics/solver/row_split.h"
#include "physics/step.h"

namespace roboss {

/// Kept from tick to tick; the contacts stay until the next group.
struct GroupScratch {
    bool keep_reactions =
        false;  // then robots with loops do not move freely, for then nothing knows their loads
    bool profiles_solver = false;  // StepProfile::solver is wanted
    std::vector<LoopReaction> reactions;
    std::vector<ContactReport> contact_reports;
    LaneSteppers lanes;        // for robots that touch nobody
    bool tried_alone = false;  // the group is one robot that lanes and floats did not step
    LaneQueue queue;
    ContactFinder finder;
    std::vector<Contact> contacts;
    BondKeeper bonds;
    UnionFind islands;  // of robots in contact, or bonded
    std::vector<std::uint32_t> members;
    std::vector<Contact*> island_contacts;
    std::vector<SurfacePair> island_surfaces;  // of these
    std::vector<HeldBond> island_bonds;
    std::vector<const Mechanics<double>*> island_robots;
    std::vector<int> offsets, island_offsets;
    IslandRows rows;
    std::vector<double> v, v_before;
    std::vector<double> displacement;  // of the tick, over dt
    std::vector<char> drifts;          // by member of the island: takes the kick-drift step
    std::vector<char> touched;         // by robot: pushed by another or by scenery
    bool anchored = false;             // the island: pushed by something that does not move freely
    RowSplit split;                    // if anyone drifts
    Vec3 gained_moment;                // of the island: returned by advance_kick_drift
    IslandGuard guard;
    BondProjection bond_projection;
    SecondLook look;
    IslandParts solver;
    RowBuffer buffer;
    FreeBuffer free_buffer;
    WakeBuffers wake;
};

}  // namespace roboss
