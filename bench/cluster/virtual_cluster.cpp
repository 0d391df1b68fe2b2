// Who is next.
#include "cluster/virtual_cluster.h"

namespace roboss::bench {
namespace {

constexpr std::int64_t kIdle_ns = 1'000'000;  // nothing is under way: clocks go on by so much

}  // namespace

VirtualCluster::VirtualCluster(std::shared_ptr<const Model> model, const Options& options,
                               StartingPoint start)
    : model_(std::move(model)), network_(options.network, !options.measure_cpu) {
    ControllerOptions controller = options.controller;
    controller.simulators = options.simulators;
    controller_ = std::make_unique<Controller>(model_, controller, std::move(start));
    network_.add(kControllerAddress);
    SimulatorOptions role;
    role.lanes = options.lanes;
    role.measure_cpu = options.measure_cpu;
    role.counted = [this](double work_ns) { network_.count(work_ns); };
    role.cpu_clock = [this] { return network_.work_ns(); };
    for (std::size_t i = 1; i <= options.simulators; ++i) {
        const Address address{Role::kSimulator, i};
        simulators_.push_back(std::make_unique<Simulator>(model_, address, role, pool_));
        network_.add(address);
    }
}

void VirtualCluster::turn(std::size_t member, std::int64_t start_ns) {
    network_.work(member, start_ns, [&](Bus& bus) {
        if (member == 0) return controller_->advance(bus);
        if (simulators_[member - 1]) simulators_[member - 1]->advance(bus);
    });
    if (member > 0 && simulators_[member - 1] && simulators_[member - 1]->gone())
        simulators_[member - 1].reset();
}

void VirtualCluster::run_until(Tick target, const std::function<void(double)>& committed) {
    controller_->run_until(target);
    Tick seen = controller_->tick();
    while (!controller_->resting()) {
        if (controller_->stopped()) throw std::runtime_error(controller_->failure()->text());
        if (const std::size_t next = network_.next(); next < network_.size()) {
            turn(next, network_.ready_ns(next));
        } else {  // by the clock: who joins, who says a thing again
            const std::int64_t now = network_.latest_ns() + kIdle_ns;
            for (std::size_t i = 0; i < network_.size(); ++i) turn(i, now);
        }
        if (controller_->tick() == seen) continue;
        seen = controller_->tick();
        if (committed) committed(time_s());
    }
}

}  // namespace roboss::bench
