// What is done lane by lane around a step in lanes: finding the contacts, and telling which lanes have the
// same. Compiled for every processor, unlike lane_step.h.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "physics/contact/contact.h"
#include "physics/lanes/lane_stepper.h"

namespace roboss {

class LaneContacts {
  public:
    explicit LaneContacts(std::size_t lanes);
    ~LaneContacts();
    LaneContacts(const LaneContacts&) = delete;
    LaneContacts& operator=(const LaneContacts&) = delete;

    /// A lane's robot. Before find(), its origin, its shapes and the poses, velocities and bias of its
    /// bodies are to be filled in; `box` holds all shapes.
    RobotWork& start(const Model& model, std::size_t lane, const LaneRobot& robot, const Aabb& box);
    /// The contacts of a lane with the scenery, with what the last tick remembers. False if it has near
    /// misses, which lanes do not know.
    bool find(const Model& model, std::size_t lane);
    static constexpr std::uint32_t kNothing = 0xffffffff;
    /// If all the scenery near `box` is one plane: its number; kNothing if there is none.
    std::optional<std::uint32_t> only_plane(const Model& model, const Aabb& box);
    /// Whether lanes know what the materials make of a shape on scenery `i`: no friction axes, torsion,
    /// rolling, no surface that moves.
    static bool is_plain(const Model& model, const BodyShape& shape, std::uint32_t i);
    /// What they make of it, where it is plain.
    static SurfacePair plain_surface(const Model& model, const BodyShape& shape, std::uint32_t i);
    /// Whether no point of a shape on a plane `i` is ever dropped.
    static bool keeps_all_points(const Model& model, const BodyShape& shape, std::uint32_t i);
    /// Room for so many contacts in what a state remembers; the first of them.
    static ContactMemory* memory_for(std::size_t count, RobotState& state);

    /// Contacts found elsewhere.
    void take(std::size_t lane, std::span<Contact> contacts) { spans_[lane] = contacts; }
    /// Those of the lanes `present` that have as many contact points of the same shapes as the first, or as
    /// another if that are more; none if a surface is not plain.
    unsigned alike(const Model& model, const RobotType& type, unsigned present) const;

    std::size_t count(std::size_t lane) const { return spans_[lane].size(); }
    Contact& contact(std::size_t lane, std::size_t i) { return spans_[lane][i]; }
    /// Writes the solved contacts of a lane, found here, into its state and the report.
    void remember(const Model& model, std::size_t lane, StepReport& report);

  private:
    std::vector<RobotWork> works_;
    std::vector<std::vector<Contact>> contacts_;
    std::vector<std::span<Contact>> spans_;  // the same, or those found elsewhere
    ContactFinder finder_;
    std::vector<std::uint32_t> scenery_;
};

}  // namespace roboss
