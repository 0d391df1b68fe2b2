// Buffers that grow by a quarter instead of twofold: where one is most of what a crowd takes, half of it
// would lie empty.
#pragma once

#include <cstddef>
#include <vector>

namespace roboss {

/// Room for `count` elements in all, and for a quarter more where there was not.
template <class T>
void make_room(std::vector<T>& buffer, std::size_t count) {
    if (count > buffer.capacity()) buffer.reserve(count + count / 4);
}

}  // namespace roboss
