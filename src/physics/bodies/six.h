// Six numbers of a body, and blocks of six by six, whose rows fit into one to three vector registers.
#pragma once

namespace roboss {

/// Six numbers of a body, and padding that no sum reads.
struct alignas(64) Six {
    double x[8] = {};
};

/// The same in single precision.
struct alignas(32) SixFloats {
    float x[8] = {};
};

struct SixBlock {
    Six row[6];
};

}  // namespace roboss
