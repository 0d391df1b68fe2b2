// What solving has made of a tick: impulses bend the motion that contacts were found for, and bodies turn on
// while a contact row knows the velocity of its point at one moment only. Here the solved displacement of a
// contact island is swept against what it may come to hit (near misses), and looked at at its end where
// bodies in contact turn far. What sinks in gets rows for the displacement alone; the velocities stay, so
// that the blow itself is that of the next tick, which begins at the place of the hit.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "physics/contact/contact_rows.h"
#include "physics/contact/swept_contact.h"
#include "physics/contact/turns_far.h"
#include "physics/dynamics/free_course.h"

namespace roboss {

/// A contact island whose displacement is solved.
struct SolvedIsland {
    const Model& model;
    std::span<const RobotWork> robots;         // of the group
    std::span<const std::uint32_t> members;    // of the island
    std::span<const int> offsets;              // by robot: first degree of freedom in the island
    std::span<const NearMiss> near_misses;     // of the group
    std::span<const Contact* const> contacts;  // of the island, with the solved velocities' impulses
    std::span<const double> velocity;          // solved
    std::span<const double> displacement;      // displacement over dt
    std::span<const char> drifts;              // by member: takes the kick-drift step
    std::span<const char> large_turns;         // by member: a lone body that turns far in the tick
    bool anchored = false;                     // something pushes it that does not move freely
    FreeCourses& free_courses;                 // of the group
    // Only shapes that may go through each other are looked at: what sinks in a little is pushed out later.
    bool passing_only = false;
};

class SecondLook {
  public:
    /// Looks for hits; false if there are none. A new island starts with `first`.
    bool find(const SolvedIsland& island, bool first);
    /// Forgets the last island.
    void clear() { hits_.clear(), turned_.clear(); }
    /// Adds the rows of what was found last to the island's. Contacts stay until the next island.
    void add_rows(const SolvedIsland& island, IslandRows& rows, std::vector<SurfacePair>& surfaces);
    /// Once the island has moved: bodies that turned far and sank in by that are put back, as far as their
    /// robots are free to be moved.
    void push_out(std::span<RobotWork> robots, const Model& model);
    /// False if push_out would look at nothing.
    bool may_push_out() const { return !turned_.empty(); }
    /// All hits of the island, in the order of their rows.
    std::span<Contact> hits() { return hits_; }
    /// When the first of those found last happens, s.
    double first_time() const;

  private:
    /// A pair in contact of which one turns far, or that hits.
    struct Turned {
        ShapePair pair;
        double least = 0;  // m: its least gap at the beginning of the tick, at most 0
        Vec3 normal;       // of a contact
    };
    bool push_out(std::span<RobotWork> robots, const Model& model, const Turned& turned);
    void move_apart(const Model& model, std::span<RobotWork> robots, const ShapePair& pair,
                    const Vec3& move_a, const Vec3& move_b);
    Transform placed(const RobotWork& robot, std::uint32_t shape);
    void find_missed(const SolvedIsland& island, const NearMiss& pair);
    bool add_first_hit(const SolvedIsland& island, const ShapePair& pair, const Vec3& normal, const Course& a,
                       const Course& b);
    void find_struck(const SolvedIsland& island, std::uint32_t robot);
    void find_struck(const SolvedIsland& island, std::uint32_t robot, std::uint32_t shape);
    bool may_strike_scenery(const Model& model, const Mechanics<double>& moved, const ShapeCrowd& crowd);
    void find_turned(const SolvedIsland& island, std::span<const Contact* const> contacts);
    double gap_at(const Course& a, const Course& b, double t);
    std::optional<double> time_of_sinking(const Course& a, const Course& b, double dt, double least);
    void hold_planes(const SolvedIsland& island, const ShapePair& pair);
    bool start(const SolvedIsland& island);
    void watch_hits();
    bool is_pushed(const SolvedIsland& island, int robot) const;
    bool is_bent(const SolvedIsland& island, int robot) const;
    const Mechanics<double>& moved(const SolvedIsland& island, int robot);
    Course course(const SolvedIsland& island, int robot, std::uint32_t shape);
    Vec3 turning(const SolvedIsland& island, int robot, std::uint32_t shape, const Course& course);
    void add(const SolvedIsland& island, const ShapePair& pair, const Course& a, const Course& b, double t,
             const Vec3& normal, const Vec3& p_W, double gap);

    std::vector<Mechanics<double>> moved_;  // by robot: with the velocities of the displacement
    std::vector<char> is_moved_, turns_;    // by robot
    std::vector<char> drifts_;              // by robot: takes the kick-drift step
    std::vector<char> large_turns_;         // by robot
    std::vector<char> struck_;              // by robot: it may move further than contacts were searched for
    std::vector<Contact> hits_;
    std::size_t known_ = 0;  // hits that have rows
    bool first_ = false;     // round
    bool anchored_ = false;  // by what is known so far
    std::vector<Turned> turned_;
    std::vector<std::uint32_t> scenery_;
    PlacedShapes shapes_;  // of the robot that was struck
    RobotWork placed_;     // where a robot is after the tick
    SweepBuffers buffers_;
};

}  // namespace roboss
