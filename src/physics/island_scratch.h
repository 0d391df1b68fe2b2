// The buffers of a contact island while it is stepped (ContactIsland); kept from island to island.
#pragma once

#include <span>
#include <vector>

#include "core/team.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/bonds/bond_projection.h"
#include "physics/contact/contact_rows.h"
#include "physics/contact/island_guard.h"
#include "physics/contact/island_parts.h"
#include "physics/contact/second_look.h"
#include "physics/dynamics/free_course.h"
#include "physics/dynamics/integrate.h"
#include "physics/dynamics/joint_rows.h"
#include "physics/soft/soft_guard.h"
#include "physics/solver/row_split.h"
#include "physics/step.h"

namespace roboss {

/// What an island sees of its group (GroupScratch).
struct GroupView {
    std::span<Contact> contacts;            // sorted by robots
    std::span<const NearMiss> near_misses;  // likewise
    std::span<const HeldBond> bonds;        // likewise, by holders
    FreeCourses* free_courses = nullptr;    // of the group's robots
    bool keep_reactions = false;
    bool profiles_solver = false;  // StepProfile::solver is wanted
};

struct IslandScratch {
    GroupView group;
    Team team;  // that may share the work of an island
    std::vector<LoopReaction> reactions;
    std::vector<Contact*> contacts;
    std::vector<SurfacePair> surfaces;  // of these
    std::vector<HeldBond> bonds;
    std::vector<const Mechanics<double>*> robots;
    std::vector<int> offsets,
        offsets_of_group;  // by robot: first degree of freedom; of the island, the group
    IslandRows rows;
    std::vector<double> v, v_before;
    std::vector<double> displacement;  // of the tick, over dt
    std::vector<char> drifts;          // by member of the island: takes the kick-drift step
    std::vector<char> large_turns;     // by member: a lone body that turns far in the tick
    std::vector<char> touched;         // by robot of the group: pushed by another or by scenery
    bool anchored = false;             // pushed by something that does not move freely
    RowSplit split;                    // if anyone drifts
    Vec3 gained_moment;                // returned by advance_kick_drift
    IslandGuard guard;
    BondProjection bond_projection;
    SecondLook look;
    IslandParts solver;
    soft::Solver soft;
    soft::Guard soft_guard;
    RowBuffer buffer;
    FreeBuffer free_buffer;
    FreeCourses free_courses;  // for an island that is stepped beside others
};

}  // namespace roboss
