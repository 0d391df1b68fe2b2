// See self_blocks.h.
#include "model/self_blocks.h"

#include <map>

#include "model/model.h"

namespace roboss {

SelfBlocks::SelfBlocks(std::span<const BodyShape> shapes, std::span<const std::pair<int, int>> self_pairs) {
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> by_bodies;
    for (std::uint32_t i = 0; i < self_pairs.size(); ++i) {
        const auto [a, b] = self_pairs[i];
        by_bodies[{shapes[static_cast<std::size_t>(a)].body, shapes[static_cast<std::size_t>(b)].body}]
            .push_back(i);
    }
    for (const auto& [bodies, numbers] : by_bodies) {
        blocks.push_back({bodies.first, bodies.second, static_cast<std::uint32_t>(pairs.size()),
                          static_cast<std::uint32_t>(numbers.size())});
        pairs.insert(pairs.end(), numbers.begin(), numbers.end());
    }
}

}  // namespace roboss
