// The gait for other languages: search.py calls it through ctypes, so that it searches with the gait that the
// control program walks with. A gait is an array of numbers: those of gait_fields(), then the phases.
#include <cstdint>

#include "gait_file.h"

namespace {

spider::Gait gait_of(const double* numbers) {
    spider::Gait gait;
    for (const spider::GaitField& field : spider::gait_fields()) gait.*field.member = *numbers++;
    for (double& phase : gait.phases) phase = *numbers++;
    return gait;
}

}  // namespace

/// Name of a number of a gait, or null behind the last; the phases are "phase_0" to "phase_5".
extern "C" const char* roboss_spider_name(std::size_t index) {
    static constexpr const char* kPhases[] = {"phase_0", "phase_1", "phase_2",
                                              "phase_3", "phase_4", "phase_5"};
    const auto fields = spider::gait_fields();
    if (index < fields.size()) return fields[index].name;
    return index < fields.size() + spider::kLegs ? kPhases[index - fields.size()] : nullptr;
}

extern "C" void roboss_spider_default(double* numbers) {
    const spider::Gait gait;
    for (const spider::GaitField& field : spider::gait_fields()) *numbers++ = gait.*field.member;
    for (const double phase : gait.phases) *numbers++ = phase;
}

/// Targets of all joints, rad: gaits (count, numbers), turns (count) in rad per stride, out (count, 18).
extern "C" void roboss_spider_targets(std::size_t count, const double* gaits, double time_s,
                                      const double* turns, double* out) {
    const std::size_t numbers = spider::gait_fields().size() + spider::kLegs;
    for (std::size_t i = 0; i < count; ++i)
        for (const double target : spider::targets(gait_of(gaits + i * numbers), time_s, turns[i]))
            *out++ = target;
}

/// Where the foot of a leg is in the trunk's frame, m, at the angles of its three joints.
extern "C" void roboss_spider_foot(std::size_t leg, const double* angles, double* xyz) {
    const spider::Point p = spider::foot_of_angles(leg, {angles[0], angles[1], angles[2]});
    xyz[0] = p.x, xyz[1] = p.y, xyz[2] = p.z;
}
