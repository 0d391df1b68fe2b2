// View states: what a viewer needs of a robot, in a few bytes, as sent to its page
// (docs/viewer-protocol.md, entries of the State message). Nothing is ever computed from them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/robot_state.h"

namespace roboss {

/// By joint coordinate: what the largest value of the encoding stands for. Angles wrap at pi; slides and
/// screws end at their range, rad or m; quaternions of balls at 1.
std::vector<double> view_ranges(const RobotType& type);

/// What all robots of a Model look like in bytes; made once.
class ViewLayout {
  public:
    explicit ViewLayout(const Model& model);

    std::size_t robots() const { return bytes_.size(); }
    /// Of the robot's entry.
    std::size_t bytes_of(RobotId robot) const { return bytes_[robot.index()]; }
    void append(const Model& model, RobotId robot, const RobotState& state,
                std::vector<std::uint8_t>& out) const;
    /// The robot of the entry that begins there, if there is one, whole.
    std::optional<RobotId> entry_at(std::span<const std::uint8_t> bytes, std::size_t offset) const;

  private:
    struct Coordinate {
        enum class Kind : std::uint8_t { kAngle, kLinear, kConjugate };
        Kind kind = Kind::kLinear;
        double scale = 1;
    };
    std::vector<std::vector<Coordinate>> types_;  // by TypeId
    std::vector<std::uint32_t> bytes_;            // by RobotId
};

}  // namespace roboss
