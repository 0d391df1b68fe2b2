// What is done lane by lane around a step in lanes: finding the contacts, and telling which lanes have which
// of them. Compiled for every processor, unlike lane_step.h.
#pragma once

#include <array>
#include <bit>
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
    /// Finds the slots of the lanes `present`: contact points of a pair of shapes, as many as one of the
    /// lanes has. Returns the lanes that share them: of robots with joints those whose surfaces are plain and
    /// that touch something, as most do, or nothing; of free bodies those that have as many points of each
    /// pair as most.
    unsigned share(const Model& model, const RobotType& type, unsigned present);

    std::size_t slots() const { return slots_.size(); }
    /// Bit i: lane i has a contact there.
    unsigned in_slot(std::size_t slot) const { return slots_[slot].lanes; }
    /// A lane's contact there; one of another lane's if it has none.
    Contact& contact(std::size_t lane, std::size_t slot) {
        const std::size_t own = (slots_[slot].lanes >> lane & 1u) != 0 ? lane : first_of(slots_[slot].lanes);
        return spans_[own][slots_[slot].at[own]];
    }
    /// Writes the solved contacts of a lane, found here, into its state and the report.
    void remember(const Model& model, std::size_t lane, StepReport& report);

  private:
    struct Slot {
        unsigned lanes = 0;
        std::array<std::uint32_t, kMostLanes> at{};  // by lane, among its contacts
    };

    static std::size_t first_of(unsigned lanes) { return static_cast<std::size_t>(std::countr_zero(lanes)); }
    unsigned alike(unsigned present) const;
    void find_slots(unsigned present);

    std::vector<RobotWork> works_;
    std::vector<std::vector<Contact>> contacts_;
    std::vector<std::span<Contact>> spans_;  // the same, or those found elsewhere
    std::vector<Slot> slots_;
    ContactFinder finder_;
    std::vector<std::uint32_t> scenery_;
};

}  // namespace roboss
