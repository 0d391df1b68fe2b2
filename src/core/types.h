// Typed ids and the tick. An id is an index into the Model's arrays (for Clients the order of joining, for
// Simulators too, counted from a number taken by chance); two kinds of id never convert into each other, so a
// robot cannot be taken for a link by mistake.
#pragma once

#include <compare>
#include <cstdint>

namespace roboss {

template <class Tag>
struct Id {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::uint32_t value = kNone;

    constexpr Id() = default;
    constexpr explicit Id(std::uint32_t v) : value(v) {}
    constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
    constexpr bool valid() const { return value != kNone; }
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

using RobotId = Id<struct RobotTag>;          // dense, 0 .. Model::robots.size()-1
using TypeId = Id<struct TypeTag>;            // RobotType in Model::types
using LinkId = Id<struct LinkTag>;            // link of a RobotType
using JointId = Id<struct JointTag>;          // joint of a RobotType
using SimulatorId = Id<struct SimulatorTag>;  // given by the Controller on joining, never used twice
using ClientId = Id<struct ClientTag>;        // given by the Controller on joining

/// Simulation time, counted in steps of Model::dt_s since the start of the world.
using Tick = std::int64_t;

}  // namespace roboss
