// Contacts of one tick: found pair by pair, in canonical order; where they are and what they carried.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/team.h"
#include "physics/contact/box_strips.h"
#include "physics/contact/shape_search.h"
#include "physics/contact/surface_pair.h"
#include "physics/dynamics/robot_work.h"

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
    Vec3T<T> shift_b;   // from p_W to where side B is pushed: met in the tick, both move until then
    double time = 0;    // s, of the impact if they meet in the tick, else 0
};
using Contact = ContactT<double>;

struct ShapePair {
    int robot_a = 0, robot_b = -1;
    std::uint32_t shape_a = 0, shape_b = 0;
    friend auto operator<=>(const ShapePair&, const ShapePair&) = default;
};

/// Two shapes that may come together within the tick, but not by the motion known before solving: see
/// swept_contact.h. Compared as pairs of shapes.
struct NearMiss : ShapePair {
    Vec3 normal;  // from B to A, a hint: of the beginning of the tick or of an impact; zero: not known
};

/// Those of which the robot is the first, of sorted ones.
inline std::span<const NearMiss> misses_of(std::uint32_t robot, std::span<const NearMiss> sorted) {
    const int own = static_cast<int>(robot);
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), own,
                                        [](const NearMiss& miss, int r) { return miss.robot_a < r; });
    auto last = first;
    while (last != sorted.end() && last->robot_a == own) ++last;
    return {first, last};
}

/// Likewise of sorted contacts.
inline std::span<Contact> contacts_of(std::uint32_t robot, std::span<Contact> sorted) {
    const int own = static_cast<int>(robot);
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), own,
                                        [](const Contact& c, int r) { return c.robot_a < r; });
    auto last = first;
    while (last != sorted.end() && last->robot_a == own) ++last;
    return {first, last};
}

class BondKeeper;
struct Course;
struct Manifold;
struct SweepBuffers;
class FreeCourses;

/// What the materials make of a contact of the island.
SurfacePair surface_of(const Model& model, std::span<const RobotWork> robots, const Contact& contact);

/// Finds all contacts of the island. `robots` ascending by id. Result sorted by (robot_a, other id, shapes,
/// feature).
class ContactFinder {
  public:
    ContactFinder();
    ~ContactFinder();
    ContactFinder(ContactFinder&&) noexcept;
    ContactFinder& operator=(ContactFinder&&) noexcept;

    /// Pairs of robots whose interaction bounds overlap, at least one of them awake.
    void find_pairs(std::span<const RobotWork> robots);
    std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs() const { return pairs_; }

    /// Contacts of these pairs, of robots with themselves and with the scenery. Sleepers are left out, and
    /// bodies that `bonds` (may be none) join. `keep_reactions`: see FreeCourses. The robots are shared by
    /// the threads of the team.
    void find(const Model& model, std::span<RobotWork> robots, const BondKeeper* bonds, bool keep_reactions,
              std::vector<Contact>& contacts, const Team& team = {});
    /// What find() left out of the contacts, sorted.
    std::span<const NearMiss> near_misses() const { return near_misses_; }
    /// Of the robots of find().
    FreeCourses& free_courses() { return *free_courses_; }

    /// Contacts of robots a < b, asleep or not (but placed), as if the planes of the beginning were walls.
    void with_robot(const Model& model, std::span<const RobotWork> robots, std::size_t a, std::size_t b,
                    std::vector<Contact>& contacts);

  private:
    using RobotPair = std::pair<std::uint32_t, std::uint32_t>;
    struct Pair;
    void start(std::size_t robots, const BondKeeper* bonds, bool keep_reactions);
    void find_of(const Model& model, std::span<RobotWork> robots, std::span<const RobotPair> pairs,
                 std::size_t begin, std::size_t end, std::vector<Contact>& contacts);
    void find_together(const Model& model, std::span<RobotWork> robots, bool keep_reactions,
                       std::vector<Contact>& contacts, const Team& team);
    void find_pairs_by_strips(std::span<const RobotWork> robots);
    void sort_pairs(std::size_t robots);
    Course course(const Model& model, std::span<const RobotWork> robots, int robot, std::size_t shape);
    void meet_robot(const Model& model, std::span<const RobotWork> robots, std::size_t a, std::size_t b,
                    bool sweeps, std::vector<Contact>& contacts);
    /// `shapes_b`: of the second robot; those of the first are own_.
    void collide_shapes(const Model& model, std::span<const RobotWork> robots, Pair pair,
                        PlacedShapes& shapes_b, bool sweeps, std::vector<Contact>& contacts);
    void add_judged(const Pair& pair, const Course& a, const Course& b, double dt, double margin,
                    std::uint32_t keep, Manifold& manifold, std::vector<Contact>& contacts);
    void with_surface(const Model& model, std::span<const RobotWork> robots, const Pair& pair,
                      std::uint32_t keep, std::vector<Contact>& contacts);
    void miss(const Pair& pair, const Vec3& normal);
    void defer_later(const Model& model, std::span<const RobotWork> robots, std::vector<Contact>& contacts);
    void with_statics(const Model& model, std::span<RobotWork> robots, std::size_t a,
                      std::vector<Contact>& contacts);
    /// Shape s of robot a with scenery i.
    void with_static(const Model& model, std::span<const RobotWork> robots, std::size_t a, std::size_t s,
                     std::size_t i, std::vector<Contact>& contacts);
    void with_itself(const Model& model, std::span<const RobotWork> robots, std::size_t a,
                     std::vector<Contact>& contacts);

    const BondKeeper* bonds_ = nullptr;  // during find()
    std::unique_ptr<SweepBuffers> buffers_;
    std::unique_ptr<FreeCourses> free_courses_;
    std::vector<NearMiss> near_misses_;
    std::vector<double> first_hits_;  // by robot, s
    ShapeSearch search_;
    PlacedShapes own_, other_;  // of the robot that is looked at, and of the one that it meets
    std::vector<std::uint32_t> awake_;
    std::vector<RobotPair> pairs_;  // sorted
    std::vector<Aabb> boxes_;       // of the robots
    BoxStrips strips_;
    std::vector<std::uint32_t> places_;  // by robot: of its pairs, as they are sorted
    std::vector<RobotPair> sorted_;
    // with a team: what each thread finds with, and what was found of each block of robots
    std::vector<ContactFinder> helpers_;
    std::vector<std::vector<Contact>> blocks_;
};

/// Takes the remembered impulses of the last tick from the owners' states into the contacts, and writes the
/// solved back, for the robots first .. last-1.
void recall_impulses(std::span<RobotWork> robots, std::size_t first, std::size_t last,
                     std::span<Contact> contacts);
void remember_impulses(std::span<RobotWork> robots, std::size_t first, std::size_t last,
                       std::span<const Contact> contacts);

}  // namespace roboss
