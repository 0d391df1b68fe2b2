// RobotType::self_pairs by the two bodies that the shapes are on: where the boxes of two bodies are apart,
// none of their pairs needs a look.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace roboss {

struct BodyShape;

struct SelfBlocks {
    struct Block {
        int body_a = -1, body_b = -1;        // of the first and of the second shape of each pair
        std::uint32_t first = 0, count = 0;  // of `pairs`
    };
    std::vector<Block> blocks;
    std::vector<std::uint32_t> pairs;  // numbers in RobotType::self_pairs, ascending within a block

    SelfBlocks() = default;
    SelfBlocks(std::span<const BodyShape> shapes, std::span<const std::pair<int, int>> self_pairs);
};

}  // namespace roboss
