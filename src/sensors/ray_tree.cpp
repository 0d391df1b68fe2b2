// One user geometry holds all boxes as primitives. Rounding: coordinates are taken relative to the middle of
// all boxes and the ray starts where it enters their common box, so every number that Embree sees is at most
// a few `extent_` and its error a few units of 2^-24 of that; `margin_` (2^-19 extent) covers it with room to
// spare.
#include "sensors/ray_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/check.h"
#include "sensors/infinity.h"

namespace roboss {
namespace {

const char* device_settings() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return "threads=1,set_affinity=0,isa=avx2";
    if (__builtin_cpu_supports("sse4.2")) return "threads=1,set_affinity=0,isa=sse4.2";
    return "threads=1,set_affinity=0,isa=sse2";
#else
    return "threads=1,set_affinity=0";
#endif
}

void check_device(RTCDevice device, const char* doing) {
    const RTCError error = rtcGetDeviceError(device);
    ROBOSS_CHECK(error == RTC_ERROR_NONE, "Embree error " + std::to_string(error) + " while " + doing);
}

/// What one ray carries through Embree to the callback. The Embree part comes first, so its address is the
/// query's.
struct Query {
    RTCIntersectContext embree{};
    const RayTree::Target* target = nullptr;
    double nearest = kInfinity;  // m from the true origin
    double start = 0;            // m from the true origin to where Embree's ray starts
    double margin = 0;
};

void visit_item(const RTCIntersectFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    auto* query = reinterpret_cast<Query*>(args->context);
    const double distance = query->target->distance(args->primID);
    if (!(distance < query->nearest)) return;
    query->nearest = distance;
    RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
    RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, args->N);
    RTCRayN_tfar(ray, args->N, 0) = static_cast<float>(distance - query->start + query->margin);
    RTCHitN_geomID(hit, args->N, 0) = args->geomID;
}

/// Where the ray enters the cube |x|, |y|, |z| <= half, at least 0; +infinity if it misses it.
double enter_cube(const Vec3& o, const Vec3& d, double half) {
    double enter = 0, leave = kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::fabs(d[i]) < 1e-300) {
            if (std::fabs(o[i]) > half) return kInfinity;
            continue;
        }
        const double a = (-half - o[i]) / d[i], b = (half - o[i]) / d[i];
        enter = std::fmax(enter, std::fmin(a, b));
        leave = std::fmin(leave, std::fmax(a, b));
    }
    return enter <= leave ? enter : kInfinity;
}

}  // namespace

RayDevice::RayDevice() : handle_(rtcNewDevice(device_settings())) {
    ROBOSS_CHECK(handle_ != nullptr,
                 "Embree gives no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
}

RayDevice::~RayDevice() {
    rtcReleaseDevice(static_cast<RTCDevice>(handle_));
}

struct RayTree::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    RTCGeometry geometry = nullptr;
    std::vector<RTCBounds> bounds;  // relative to centre, widened
    Vec3 centre;
    double extent = 0;
    double margin = 0;

    static void give_bounds(const RTCBoundsFunctionArguments* args) {
        const auto* self = static_cast<const Impl*>(args->geometryUserPtr);
        *args->bounds_o = self->bounds[args->primID];
    }
};

RayTree::RayTree(const RayDevice& device, Use use) : impl_(std::make_unique<Impl>()) {
    impl_->device = static_cast<RTCDevice>(device.handle());
    impl_->scene = rtcNewScene(impl_->device);
    const bool once = use == Use::kBuildOnce;
    rtcSetSceneFlags(impl_->scene,
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                (once ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_DYNAMIC)));
    rtcSetSceneBuildQuality(impl_->scene, once ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_LOW);
    impl_->geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(impl_->geometry, once ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryUserData(impl_->geometry, impl_.get());
    rtcSetGeometryBoundsFunction(impl_->geometry, &Impl::give_bounds, nullptr);
    rtcSetGeometryIntersectFunction(impl_->geometry, &visit_item);
    rtcAttachGeometry(impl_->scene, impl_->geometry);
    check_device(impl_->device, "making a scene");
}

RayTree::~RayTree() {
    rtcReleaseGeometry(impl_->geometry);
    rtcReleaseScene(impl_->scene);
}

void RayTree::build(std::span<const Aabb> boxes) {
    Aabb all;
    for (const Aabb& box : boxes) all.include(box);
    impl_->bounds.resize(boxes.size());
    if (boxes.empty()) return;
    const Vec3 size = all.max - all.min;
    impl_->centre = all.centre();
    impl_->margin = 0x1p-19 * (std::fmax(size.x, std::fmax(size.y, size.z)) + 1.0);
    impl_->extent = 0.5 * std::fmax(size.x, std::fmax(size.y, size.z)) + 2.0 * impl_->margin;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Aabb box = boxes[i].inflated(impl_->margin);
        const Vec3 lower = box.min - impl_->centre, upper = box.max - impl_->centre;
        impl_->bounds[i] = {
            static_cast<float>(lower.x), static_cast<float>(lower.y), static_cast<float>(lower.z), 0,
            static_cast<float>(upper.x), static_cast<float>(upper.y), static_cast<float>(upper.z), 0};
    }
    rtcSetGeometryUserPrimitiveCount(impl_->geometry, static_cast<unsigned>(boxes.size()));
    rtcCommitGeometry(impl_->geometry);
    rtcCommitScene(impl_->scene);
    check_device(impl_->device, "building the tree of a ray scene");
}

double RayTree::nearest(const Vec3& origin, const Vec3& direction, double limit, const Target& target) const {
    if (impl_->bounds.empty()) return limit;
    const Vec3 o = origin - impl_->centre;
    const double start = enter_cube(o, direction, impl_->extent);
    if (!(start < limit)) return limit;
    Query query;
    rtcInitIntersectContext(&query.embree);
    query.target = &target;
    query.nearest = limit;
    query.start = start;
    query.margin = impl_->margin;
    const Vec3 p = o + direction * start;
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(p.x);
    ray.ray.org_y = static_cast<float>(p.y);
    ray.ray.org_z = static_cast<float>(p.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    // no ray needs to go further than across the cube
    ray.ray.tfar = static_cast<float>(std::fmin(limit - start, 4.0 * impl_->extent) + impl_->margin);
    ray.ray.mask = 0xFFFFFFFFu;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene, &query.embree, &ray);
    return query.nearest;
}

}  // namespace roboss
