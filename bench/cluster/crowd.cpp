// Robots are spheres on a grid that drive to and fro a little; none ever touches another.
#include "cluster/crowd.h"

#include <algorithm>
#include <cmath>

#include "cluster/virtual_network.h"
#include "physics/step.h"
#include "roles/controller/controller.h"

namespace roboss::bench {
namespace {

constexpr double kSpacing = 1.5, kSpeed = 0.5;  // m, m/s
constexpr float kReach = 0.25f;

std::shared_ptr<const Model> field(std::size_t robots) {
    World world;
    world.name = "crowd";
    world.dt_s = 0.002;
    ModelSpec ball;
    ball.name = "ball";
    LinkSpec link;
    link.name = "link";
    CollisionSpec shape;
    shape.name = "shape";
    shape.geometry.kind = GeometryKind::kSphere;
    shape.geometry.radius = 0.2;
    link.collisions.push_back(shape);
    ball.links.push_back(link);
    ball.canonical_link = "link";
    world.prototypes.push_back(ball);
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(robots))));
    for (std::size_t i = 0; i < robots; ++i) {
        const Vec3 p{kSpacing * static_cast<double>(i % side), kSpacing * static_cast<double>(i / side), 0.2};
        world.instances.push_back({"ball_" + std::to_string(i), 0, {p, {}}, {}});
    }
    Diagnostics found;
    const auto model = compile(world, {}, found);
    if (!model) throw std::runtime_error("the field has errors");
    return model;
}

/// Answers assignments as a Simulator would whose stepping takes no time.
class Answerer {
  public:
    Answerer(const Model& model, const Address& self) : model_(model), self_(self) {}

    void advance(Bus& bus) {
        bus.drain(self_, inbox_);
        if (!joined_ && bus.now_ms() >= asked_ms_ + 100) {
            asked_ms_ = bus.now_ms();
            bus.send(self_, kControllerAddress, Hello{model_.hash, 1, "answerer"});
        }
        for (const Envelope& envelope : inbox_) {
            joined_ = joined_ || std::holds_alternative<Welcome>(envelope.message);
            if (const auto* assignment = std::get_if<Assignment>(&envelope.message))
                bus.send(self_, kControllerAddress, answer(*assignment));
        }
    }

  private:
    WindowResult answer(const Assignment& assignment) const {
        WindowResult result{assignment.epoch, assignment.window, assignment.attempt, 0, {}, {}, {}};
        for (const RobotId robot : assignment.robots) result.robots.push_back(result_of(robot, assignment));
        IslandResult island;
        island.cost_ns = 5'000u * static_cast<std::uint64_t>(assignment.until - assignment.from);
        island.contacts = island.static_contacts = 4;
        const std::size_t offsets = assignment.island_offsets.size();
        if (offsets > 0) result.islands.assign(offsets - 1, island);
        return result;
    }

    RobotResult result_of(RobotId robot, const Assignment& assignment) const {
        const double dt = model_.dt_s, phase = 0.7 * static_cast<double>(robot.value);
        const Vec3 home = model_.robots[robot.index()].X_WR.p;
        Aabb swept;
        Vec3 centre;
        for (const Tick tick : {assignment.from, assignment.until}) {
            centre = home + Vec3{0.2 * std::sin(phase + kSpeed / 0.2 * dt * static_cast<double>(tick)), 0, 0};
            swept.include(Aabb{centre - Vec3{kReach, kReach, kReach}, centre + Vec3{kReach, kReach, kReach}});
        }
        RobotResult f;
        f.robot = robot;
        f.swept = outward(swept);
        f.position = pack_position({centre.x, centre.y, centre.z}, f.swept);
        f.velocity = pack_velocity({kSpeed, 0, 0});
        f.hash = 0x9E3779B97F4A7C15ull * (robot.value + 1u) ^ static_cast<std::uint64_t>(assignment.until);
        return f;
    }

    const Model& model_;
    Address self_;
    bool joined_ = false;
    std::int64_t asked_ms_ = -1'000;
    std::vector<Envelope> inbox_;
};

}  // namespace

CrowdCosts measure_crowd(std::size_t robots, std::size_t simulators, std::size_t windows) {
    const auto model = field(robots);
    ControllerOptions options;
    options.simulators = simulators;
    options.window = 16;
    Controller controller(model, options, beginning_of(*model));
    VirtualNetwork network({0, 1, 1e9}, false);
    network.add(kControllerAddress);
    std::vector<Answerer> answerers;
    for (std::size_t i = 1; i <= simulators; ++i) {
        answerers.emplace_back(*model, Address{Role::kSimulator, i});
        network.add({Role::kSimulator, i});
    }
    const auto turn = [&](std::size_t i, std::int64_t start_ns) {
        network.work(i, start_ns, [&](Bus& bus) {
            if (i == 0) return controller.advance(bus);
            answerers[i - 1].advance(bus);
        });
    };
    CrowdCosts costs;
    std::int64_t begin_ns = 0;
    constexpr std::uint64_t kSettle = 5;
    controller.run_until(options.window * static_cast<Tick>(windows + kSettle));
    while (!controller.resting()) {
        const std::uint64_t before = controller.counters().windows;
        const std::size_t next = network.next();
        const std::int64_t spent_ns = network.spent_ns(0);
        if (next < network.size())
            turn(next, network.ready_ns(next));
        else
            for (std::size_t i = 0; i < network.size(); ++i) turn(i, network.latest_ns() + 1'000'000);
        if (controller.counters().windows == before) continue;
        if (controller.counters().windows == kSettle)
            begin_ns = network.spent_ns(0), network.received.clear();
        if (controller.counters().windows > kSettle)
            costs.last_result_us += 1e-3 * static_cast<double>(network.spent_ns(0) - spent_ns);
    }
    const auto counted = static_cast<double>(windows);
    costs.windows = windows;
    costs.window_us = 1e-3 * static_cast<double>(network.spent_ns(0) - begin_ns) / counted;
    costs.last_result_us /= counted;
    for (const auto& [name, traffic] : network.received)
        costs.bytes_to_controller += static_cast<double>(traffic.bytes) / counted;
    return costs;
}

}  // namespace roboss::bench
