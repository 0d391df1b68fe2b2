// Typed ids and the tick. An id is an index into the Model's arrays (for Clients the order of joining, for
// Simulators too, counted from a number taken by chance); two kinds of id never convert into each other, so a
// robot cannot be taken for a link by mistake.
#pragma once

#include <compare>
#include <cstdint>

namespace roboss {

/// An index of one kind; `Tag` names the kind. The default is no index.
template <class Tag>
struct Id {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;  ///< the value of no index
    std::uint32_t value = kNone;                         ///< the index

    constexpr Id() = default;
    /// The index as a number.
    constexpr explicit Id(std::uint32_t v) : value(v) {}
    /// The index in an array; must be below kNone.
    constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
    /// Whether it is an index.
    constexpr bool valid() const { return value != kNone; }
    /// For arrays; only if valid().
    constexpr std::size_t index() const { return value; }
    /// By index; no index comes last.
    friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

using RobotId = Id<struct RobotTag>;          ///< dense, 0 .. Model::robots.size()-1
using TypeId = Id<struct TypeTag>;            ///< RobotType in Model::types
using LinkId = Id<struct LinkTag>;            ///< link of a RobotType
using JointId = Id<struct JointTag>;          ///< joint of a RobotType
using SimulatorId = Id<struct SimulatorTag>;  ///< given by the Controller on joining, never used twice
using ClientId = Id<struct ClientTag>;        ///< given by the Controller on joining

/// Simulation time, counted in steps of Model::dt_s since the start of the world.
using Tick = std::int64_t;

}  // namespace roboss
