// StateBlock: one flat buffer of encoded states.
#include "wire/state_block.h"

#include <algorithm>

namespace roboss {

void append(StateBlock& block, RobotId robot, const RobotState& state) {
    const std::size_t before = block.bytes.size();
    encode(state, block.bytes);
    block.robots.push_back(robot);
    block.sizes.push_back(static_cast<std::uint32_t>(block.bytes.size() - before));
}

std::span<const std::uint8_t> state_bytes(const StateBlock& block, std::size_t i, std::size_t offset) {
    return std::span(block.bytes).subspan(offset, block.sizes[i]);
}

StateShelf::StateShelf(StateBlock block) : block_(std::move(block)) {
    std::size_t offset = 0;
    for (const std::uint32_t size : block_.sizes) {
        offsets_.push_back(offset);
        offset += size;
    }
}

bool StateShelf::copy_to(StateBlock& out, RobotId robot) const {
    const auto found = std::lower_bound(block_.robots.begin(), block_.robots.end(), robot);
    if (found == block_.robots.end() || *found != robot) return false;
    const auto i = static_cast<std::size_t>(found - block_.robots.begin());
    const auto bytes = state_bytes(block_, i, offsets_[i]);
    out.robots.push_back(robot);
    out.sizes.push_back(block_.sizes[i]);
    out.bytes.insert(out.bytes.end(), bytes.begin(), bytes.end());
    return true;
}

}  // namespace roboss
