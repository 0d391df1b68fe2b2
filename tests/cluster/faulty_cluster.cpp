// Turns and troubles.
#include "faulty_cluster.h"

#include "test_worlds.h"

namespace roboss::test {

FaultyCluster::FaultyCluster(std::shared_ptr<const Model> model, ControllerOptions options,
                             const FaultOptions& faults, const Trouble& trouble, std::size_t simulators)
    : model_(std::move(model)), options_(std::move(options)), trouble_(trouble), bus_(faults) {
    options_.simulators = simulators;
    options_.resend_ms = 20;
    options_.ahead_least = 1;
    options_.loss_ms = 250;
    options_.stealing_least_ns = 0;
    bus_.on_drain = [this] { let_others_go_on(); };
    for (std::size_t i = 0; i < simulators; ++i) add_simulator();
}

void FaultyCluster::add_program(const std::string& name, const ControlOptions& options) {
    add_program(name, std::make_unique<DrivingProgram>(options));
}

void FaultyCluster::add_program(const std::string& name, std::unique_ptr<ControlProgram> program) {
    options_.clients.push_back(name);
    hosts_.push_back(
        std::make_unique<ProgramHost>(model_, Address{Role::kClient, ++instance_}, name, std::move(program)));
}

void FaultyCluster::add_simulator() {
    const Address address{Role::kSimulator, ++instance_};
    SimulatorOptions options;
    options.resend_ms = 20;
    options.heartbeat_ms = 20;
    options.measure_cpu = false;
    options.look_up = 1;
    options.cut_least_ns = 0;
    simulators_.push_back({std::make_unique<Simulator>(model_, address, options, pool_), address});
}

void FaultyCluster::kill(std::size_t i) {
    bus_.cut_off(simulators_[i].address);
    if (trouble_.rumour > 0) bus_.spread_rumour(simulators_[i].address);
    simulators_.erase(simulators_.begin() + static_cast<std::ptrdiff_t>(i));
    ++kills_;
}

void FaultyCluster::kill_all() {
    while (!simulators_.empty()) kill(0);
}

void FaultyCluster::make_trouble() {
    if (!simulators_.empty() && happens(trouble_.kill)) kill(bus_.random(simulators_.size()));
    if (!simulators_.empty() && happens(trouble_.hang))
        simulators_[bus_.random(simulators_.size())].hangs_for = 400;
    if (!simulators_.empty() && happens(trouble_.leave))
        simulators_[bus_.random(simulators_.size())].role->leave();
    if (!simulators_.empty() && happens(trouble_.rumour))
        bus_.spread_rumour(simulators_[bus_.random(simulators_.size())].address);
    if (trouble_.partition > 0) make_partitions();
    if (happens(trouble_.join) && simulators_.size() < 6) add_simulator();
    if (simulators_.empty() && happens(trouble_.rescue)) add_simulator();
}

/// Some are shorter than the time after which a Simulator counts as lost, some longer.
void FaultyCluster::make_partitions() {
    if (!simulators_.empty() && happens(trouble_.partition)) {
        Member& member = simulators_[bus_.random(simulators_.size())];
        member.cut_for = 50 + static_cast<int>(bus_.random(800));
        bus_.cut_off(member.address);
    }
    for (Member& member : simulators_)
        if (member.cut_for > 0 && --member.cut_for == 0) bus_.reconnect(member.address);
}

/// To who has none already.
void FaultyCluster::give_turn(std::size_t role) {
    if (role == 0) {
        if (controller_at_it_) return;
        controller_at_it_ = true;
        controller_->advance(bus_);
        controller_at_it_ = false;
    } else if (role <= hosts_.size()) {
        if (steppers_ == 0) hosts_[role - 1]->advance(bus_);
    } else {
        Member& member = simulators_[role - 1 - hosts_.size()];
        if (member.at_it || member.hangs_for-- > 0) return;
        member.hangs_for = 0;
        member.at_it = true;
        ++steppers_;
        member.role->advance(bus_);
        --steppers_;
        member.at_it = false;
    }
}

/// Somebody looks for messages; if it is a Simulator, others may have gone on since it looked last.
void FaultyCluster::let_others_go_on() {
    constexpr std::size_t kDeep = 5;
    constexpr int kMost = 40;  // in a turn: who watches from outside must not miss too much
    if (steppers_ == 0 || steppers_ > kDeep || controller_at_it_ || others_went_on_ >= kMost) return;
    if (bus_.random(3) > 0) return;
    ++others_went_on_;
    bus_.advance_clock(static_cast<std::int64_t>(bus_.random(2)));
    give_turn(bus_.random(2) == 0 ? 0 : bus_.random(roles()));
}

void FaultyCluster::turn() {
    if (!controller_) controller_ = std::make_unique<Controller>(model_, options_, beginning_of(*model_));
    bus_.advance_clock(1);
    make_trouble();
    others_went_on_ = 0;
    const std::size_t first = bus_.random(roles());
    for (std::size_t k = 0; k < roles(); ++k) give_turn((first + k) % roles());
    std::erase_if(simulators_, [](const Member& m) { return m.role->gone(); });
}

void FaultyCluster::restart_controller(StartingPoint start) {
    options_.before = {};
    options_.before.first_id = static_cast<std::uint32_t>(bus_.random(1u << 20)) << 10;
    controller_ = std::make_unique<Controller>(model_, options_, std::move(start));
}

bool FaultyCluster::run_until(Tick target, int turns_max) {
    if (!controller_) turn();
    controller_->run_until(target);
    for (int turns = 0; turns < turns_max; ++turns) {
        if (controller_->resting() || controller_->stopped()) return controller_->resting();
        turn();
    }
    return false;
}

}  // namespace roboss::test
