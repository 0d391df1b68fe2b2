// Which boxes does a ray meet? Embree 3 behind a narrow door. Embree works in single precision, so here it
// only culls: the boxes are widened by more than its rounding, and the distance to an item is measured by the
// caller, in double.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "math/aabb.h"

namespace roboss {

/// One Embree device, without threads of its own, pinned to one instruction set.
class RayDevice {
  public:
    RayDevice();
    ~RayDevice();
    RayDevice(const RayDevice&) = delete;
    RayDevice& operator=(const RayDevice&) = delete;
    void* handle() const { return handle_; }

  private:
    void* handle_ = nullptr;  // RTCDevice
};

class RayTree {
  public:
    enum class Use { kBuildOnce, kRebuildOften };

    /// Distance in m along the ray to item number `item`, or +infinity.
    struct Target {
        virtual ~Target() = default;
        virtual double distance(std::uint32_t item) const = 0;
    };

    RayTree(const RayDevice& device, Use use);
    ~RayTree();
    RayTree(const RayTree&) = delete;
    RayTree& operator=(const RayTree&) = delete;

    /// (Re)builds the tree over these finite boxes; items are numbered as in `boxes`.
    void build(std::span<const Aabb> boxes);

    /// The smallest distance that `target` gives over all items, or `limit` if none is smaller; items whose
    /// box the ray misses or meets beyond the limit are not asked.
    double nearest(const Vec3& origin, const Vec3& direction, double limit, const Target& target) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace roboss
