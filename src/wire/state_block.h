// Packing robots' states into a StateBlock and finding them in it.
#pragma once

#include <optional>
#include <span>

#include "core/result.h"
#include "model/robot_state.h"
#include "wire/message.h"

namespace roboss {

void append(StateBlock& block, RobotId robot, const RobotState& state);

/// Bytes of the i-th state given the sum of the sizes before it.
std::span<const std::uint8_t> state_bytes(const StateBlock& block, std::size_t i, std::size_t offset);

/// A block, its robots ascending, that can be asked for any of them quickly.
class StateShelf {
  public:
    explicit StateShelf(StateBlock block);
    Tick tick() const { return block_.tick; }
    /// Appends the state of `robot`, if it is here, to `out`.
    bool copy_to(StateBlock& out, RobotId robot) const;

  private:
    StateBlock block_;
    std::vector<std::size_t> offsets_;
};

}  // namespace roboss
