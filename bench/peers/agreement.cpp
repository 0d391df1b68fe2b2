// See agreement.h.
#include "peers/agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>

#include <support/robots.h>

#include "engines/engine.h"

namespace roboss::bench {
namespace {

constexpr double kDt = 2e-4;  // so short that first-order integrators are near each other
constexpr int kTicks = 500;
constexpr double kNear = 2e-3;  // m, and m/s times .1: first-order errors of the peers are below

/// A mechanism and how it is set going.
struct Mechanism {
    const char* name;
    ModelSpec model;
    std::function<void(Engine&)> start;
};

std::vector<Mechanism> mechanisms() {
    const auto bend = [](std::size_t joints) {
        return [joints](Engine& engine) {
            for (std::size_t j = 0; j < joints; ++j)
                engine.set_joint({0, j, 0}, {0.3 - 0.2 * static_cast<double>(j), 0.5});
        };
    };
    std::vector<Mechanism> all;
    all.push_back({"arm of hinges, bent", test::arm(), bend(4)});
    all.push_back({"free chain of slides, pushed", test::prismatic_chain(), bend(3)});
    all.push_back({"chain of balls", test::ball_chain(), [](Engine&) {}});
    all.push_back({"box, thrown", test::solid_box(2.0, {0.1, 0.2, 0.3}, test::surface(0.5)), [](Engine& e) {
                       e.set_base(0, {{1, 2, 3}, from_rpy(0.3, 0.2, 0.1)}, {1, 2, 3}, {0.5, -1, 2});
                   }});
    all.push_back({"arm, a motor", test::arm(), [](Engine& e) { e.drive_velocity({0, 0, 0}, 2, 5); }});
    all.push_back({"arm, a torque", test::arm(), [](Engine& e) { e.drive_effort({0, 1, 0}, 3); }});
    return all;
}

struct End {
    LinkState last;
    JointState first;
};

End run(Engine& engine, const Mechanism& mechanism) {
    mechanism.start(engine);
    engine.step(kTicks);
    End end{engine.link({0, mechanism.model.links.size() - 1}), {}};
    const bool has_axis = !mechanism.model.joints.empty() && !mechanism.model.joints[0].axes.empty();
    if (has_axis) end.first = engine.joint({0, 0, 0});
    return end;
}

/// The worst of place, speed and joint angle, m or rad.
double apart(const End& a, const End& b) {
    return std::max({norm(a.last.X_WL.p - b.last.X_WL.p), 0.1 * norm(a.last.v_WC - b.last.v_WC),
                     0.1 * norm(a.last.angular - b.last.angular),
                     std::fabs(a.first.position - b.first.position),
                     0.1 * std::fabs(a.first.velocity - b.first.velocity)});
}

bool agrees(const EngineKind& kind, const Mechanism& mechanism) {
    World world = test::empty_world(kDt);
    test::place(world, mechanism.model, "it");
    const EngineOptions options{.dt_s = kDt};
    const auto ours = engines()[0].make(world, options), theirs = kind.make(world, options);
    if (!theirs) return std::printf("%-8s %-30s not expressed\n", kind.name.c_str(), mechanism.name), true;
    const double off = apart(run(*ours, mechanism), run(*theirs, mechanism));
    std::printf("%-8s %-30s %.2e %s\n", kind.name.c_str(), mechanism.name, off, off < kNear ? "" : "APART");
    return off < kNear;
}

}  // namespace

bool engines_agree() {
    bool all = true;
    for (const EngineKind& kind : engines().subspan(1))
        for (const Mechanism& mechanism : mechanisms()) all &= agrees(kind, mechanism);
    return all;
}

}  // namespace roboss::bench
