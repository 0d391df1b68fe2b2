// Contacts of one tick: found pair by pair, in canonical order; where they are and what they carried.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/collide_surface.h"
#include "physics/robot_work.h"
#include "physics/surface_pair.h"

namespace roboss {

/// One contact point, or the same point of a few robots in lanes; what the materials make of it is asked when
/// it is needed (surface_of). Side A is the robot that owns it (the lower id), side B another robot, itself,
/// or static scenery.
template <class T>
struct ContactT {
    int robot_a = 0;   // index into the island's robots
    int robot_b = -1;  // -1: static scenery
    std::uint32_t shape_a = 0, shape_b = 0, feature = 0;
    int body_a = -1, body_b = -1;
    Vec3T<T> p_W, normal;  // normal from B towards A
    T gap{};
    T impulse{};        // normal, N s: remembered, then solved
    Vec3T<T> friction;  // tangential, N s, world axes: likewise
    T load{};           // normal, N s: the smaller of the impulses of the last two ticks, so not a blow
    Vec3T<T> moment;    // N m s, world axes: torsional and rolling friction, solved
};
using Contact = ContactT<double>;

/// What the materials make of a contact of the island.
SurfacePair surface_of(const Model& model, std::span<const RobotWork> robots, const Contact& contact);

/// Finds all contacts of the island. `robots` ascending by id. Result sorted by (robot_a, other id, shapes,
/// feature).
class ContactFinder {
  public:
    /// Pairs of robots whose interaction bounds overlap, at least one of them awake.
    void find_pairs(std::span<const RobotWork> robots);
    std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs() const { return pairs_; }

    /// Contacts of these pairs, of robots with themselves and with the scenery. Sleepers are left out.
    void find(const Model& model, std::span<RobotWork> robots, std::vector<Contact>& contacts);

    /// Contacts of robots a < b, asleep or not (but placed).
    void with_robot(const Model& model, std::span<const RobotWork> robots, std::size_t a, std::size_t b,
                    std::vector<Contact>& contacts);

  private:
    void sweep(std::span<const RobotWork> robots);
    void with_statics(const Model& model, std::span<RobotWork> robots, std::size_t a,
                      std::vector<Contact>& contacts);
    /// Shape s of robot a with scenery i.
    void with_static(const Model& model, std::span<const RobotWork> robots, std::size_t a, std::size_t s,
                     std::size_t i, std::vector<Contact>& contacts);
    void with_itself(std::span<RobotWork> robots, std::size_t a, std::vector<Contact>& contacts);

    SurfaceContacts surface_contacts_;
    std::vector<std::uint32_t> candidates_;  // scenery near a robot, and its boxes
    std::vector<Aabb> candidate_boxes_;
    std::vector<std::uint32_t> by_x_, awake_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  // sorted
};

/// Takes the remembered impulses of the last tick from the owners' states into the contacts, and writes the
/// solved back.
void recall_impulses(std::span<RobotWork> robots, std::span<Contact> contacts);
void remember_impulses(std::span<RobotWork> robots, std::span<const Contact> contacts);

}  // namespace roboss
