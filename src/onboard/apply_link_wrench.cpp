// See onboard_kinds/apply_link_wrench.h.
#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr std::size_t kOnce = 0, kStays = 1, kClear = 2;  // its commands

/// A commanded wrench: force, torque, offset of its point from the link's origin in link axes.
void apply(LinkId link, std::span<const double> w, OnboardContext& c) {
    const Transform X_WL = c.pose(link);
    c.push_at(link, {w[0], w[1], w[2]}, X_WL * Vec3{w[6], w[7], w[8]});
    c.push(link, {}, {w[3], w[4], w[5]});
}

}  // namespace

void run(const ApplyLinkWrenchSpec& spec, OnboardContext& c) {
    const LinkId link = spec.link.empty() ? c.info().base : c.link(0);
    const std::span<double> memory = c.memory();
    const auto once = static_cast<double>(c.commanded_at(kOnce));
    if (once > memory[0]) apply(link, c.command(kOnce), c);
    memory[0] = once;
    if (c.is_commanded(kStays) && c.commanded_at(kStays) >= c.commanded_at(kClear))
        apply(link, c.command(kStays), c);
    if (c.is_commanded(kClear)) return;
    for (const PersistentWrench& wrench : spec.persistent) {
        c.push_at(link, wrench.force, c.pose(link).p);
        c.push(link, {}, wrench.torque);
    }
}

}  // namespace roboss
