// The bonds of a group of robots in one tick: which form, which let go, which hold. What is decided of a bond
// hangs on the states of its two robots alone. A robot that is missing from the group is out of reach, for
// while a bond is whole the bounds of its robots overlap (bond_cover.h).
#pragma once

#include <span>
#include <vector>

#include "geometry/collide_surface.h"
#include "physics/bonds/bond_cover.h"
#include "physics/contact/shape_search.h"
#include "physics/sleep.h"

namespace roboss {

/// A bond that holds in this tick; indices of the group's robots.
struct HeldBond {
    static constexpr std::uint32_t kScenery = 0xFFFFFFFF;

    std::uint32_t holder = 0, other = kScenery;
    int body = -1, other_body = -1;  // of the two links; -1: the fixed base
    Bond* bond = nullptr;            // in the holder's state
};

/// Where the other link is to be by a bond, as placed robots stand, and where it is. The point is that at
/// which the bond's force is counted, as part of the holder and as part of the other one.
struct BondFrames {
    Vec3 p_W, p_other_W;
    Vec3 twist;  // rad, world axes: from where the other link is to be, about that point, to where it is
    Vec3 slip() const { return p_other_W - p_W; }
};
BondFrames frames_of(std::span<const RobotWork> robots, const HeldBond& held);

/// Marks bonds that bore more than they can in the last tick. The blow of the tick in which a bond takes hold
/// does not count.
void let_go_of_overloads(double dt, RobotState& state);

class BondKeeper {
  public:
    /// Lets bonds form that are to form in this tick, drops those that were told to let go, and wakes whoever
    /// sleeps at the other end. `robots`, ascending by id, are placed where they are awake.
    void form(const Model& model, std::span<RobotWork> robots, WakeBuffers& wake);
    /// Drops torn bonds, and finds those that hold.
    void hold(std::span<RobotWork> robots);
    /// Those that hold, by holder.
    std::span<const HeldBond> held() const { return held_; }
    /// Whether bonds hold the two bodies of different robots (b < 0: the scenery) to each other: then they do
    /// not collide.
    bool joins(int robot_a, int body_a, int robot_b, int body_b) const;

  private:
    static bool is_torn(std::span<const RobotWork> robots, const HeldBond& held);
    void form_one(const Model& model, std::span<RobotWork> robots, std::uint32_t holder, Bond& bond);
    void form_at_cup(const Model& model, std::span<RobotWork> robots, std::uint32_t holder, Bond& bond);
    double nearest_scenery(const Model& model, const Vec3& cup, double reach);

    std::vector<HeldBond> held_;
    std::vector<std::uint32_t> woken_;
    std::vector<std::uint32_t> scenery_;
    ShapeSearch search_;
    SurfaceContacts surface_;
};

}  // namespace roboss
