// The elements that joint types consist of (joint_type.h).
#pragma once

#include <cstdint>

namespace roboss {

/// How a joint moves one body on its parent. Each has a file in src/model/joints. kFree is the base of a
/// robot that nothing fixes; no file names it.
enum class JointKind : std::uint8_t { kFree, kRevolute, kPrismatic, kBall, kScrew };
inline constexpr JointKind kLastJointKind = JointKind::kScrew;

}  // namespace roboss
