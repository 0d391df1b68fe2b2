// Clocks, the way of messages, and who is next.
#include "cluster/virtual_cluster.h"

#include <ctime>
#include <queue>
#include <stdexcept>

#include "wire/codec.h"

namespace roboss::bench {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kIdle_ns = 1'000'000;  // nothing is under way: clocks go on by so much

}  // namespace

std::int64_t thread_cpu_ns() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return std::int64_t{1'000'000'000} * t.tv_sec + t.tv_nsec;
}

/// Member 0 is the Controller.
class VirtualCluster::Network : public Bus {
  public:
    explicit Network(const NetworkCosts& costs) : costs_(costs) {}

    void add(const Address& address, std::int64_t clock_ns) {
        places_[address] = members_.size();
        members_.emplace_back();
        members_.back().clock_ns = clock_ns;
    }

    void send(const Address& from, const Address& to, Message message) override {
        const auto place = places_.find(to);
        if (place == places_.end()) return;
        Member& sender = members_[at_work_];
        Letter letter{0, serial_++, encode({from, to, std::move(message)})};
        sender.toll_ns += static_cast<std::int64_t>(1e3 * costs_.send_us);
        const double way_us = costs_.way_us + static_cast<double>(letter.bytes.size()) / costs_.bytes_per_us;
        letter.arrival_ns = now_ns() + static_cast<std::int64_t>(1e3 * way_us);
        members_[place->second].inbox.push(std::move(letter));
    }

    void drain(const Address&, std::vector<Envelope>& inbox) override {
        inbox.clear();
        Member& member = members_[at_work_];
        while (!member.inbox.empty() && member.inbox.top().arrival_ns <= now_ns()) {
            Result<Envelope> envelope = decode_envelope(member.inbox.top().bytes);
            if (!envelope) throw std::runtime_error(envelope.error().text());
            if (at_work_ == 0) count(envelope.value().message, member.inbox.top().bytes.size());
            inbox.push_back(std::move(envelope).value());
            member.inbox.pop();
        }
    }

    std::int64_t now_ms() override { return now_ns() / 1'000'000; }

    /// When this member can go on: it has been idle since its clock.
    std::int64_t ready_ns(std::size_t i) const {
        const Member& m = members_[i];
        return m.inbox.empty() ? kNever : std::max(m.clock_ns, m.inbox.top().arrival_ns);
    }
    std::int64_t clock_ns(std::size_t i) const { return members_[i].clock_ns; }
    std::int64_t spent_ns(std::size_t i) const { return members_[i].spent_ns; }
    std::size_t size() const { return members_.size(); }

    template <class Work>
    void work(std::size_t i, std::int64_t start_ns, Work&& role) {
        Member& member = members_[i];
        at_work_ = i;
        member.clock_ns = start_ns;
        member.toll_ns = 0;
        began_ns_ = thread_cpu_ns();
        role(*this);
        const std::int64_t spent = thread_cpu_ns() - began_ns_ + member.toll_ns;
        member.clock_ns += spent;
        member.spent_ns += spent;
    }

    std::map<std::string, Traffic> received;  // by the Controller

  private:
    struct Letter {
        std::int64_t arrival_ns = 0;
        std::uint64_t serial = 0;
        std::vector<std::uint8_t> bytes;
        bool operator<(const Letter& other) const {  // for a queue whose top is the earliest
            return std::pair(arrival_ns, serial) > std::pair(other.arrival_ns, other.serial);
        }
    };
    struct Member {
        std::int64_t clock_ns = 0, spent_ns = 0;
        std::int64_t toll_ns = 0;  // of what was sent in this turn
        std::priority_queue<Letter> inbox;
    };

    std::int64_t now_ns() const {
        const Member& m = members_[at_work_];
        return m.clock_ns + m.toll_ns + thread_cpu_ns() - began_ns_;
    }
    void count(const Message& message, std::size_t bytes) {
        Traffic& traffic = received[message_name(message)];
        ++traffic.messages;
        traffic.bytes += bytes;
    }

    NetworkCosts costs_;
    std::map<Address, std::size_t> places_;
    std::vector<Member> members_;
    std::size_t at_work_ = 0;
    std::int64_t began_ns_ = 0;
    std::uint64_t serial_ = 0;
};

VirtualCluster::VirtualCluster(std::shared_ptr<const Model> model, const Options& options, StartingPoint start)
    : model_(std::move(model)), network_(std::make_unique<Network>(options.network)) {
    ControllerOptions controller = options.controller;
    controller.simulators = options.simulators;
    controller_ = std::make_unique<Controller>(model_, controller, std::move(start));
    network_->add(kControllerAddress, 0);
    SimulatorOptions role;
    role.lanes = options.lanes;
    for (std::size_t i = 1; i <= options.simulators; ++i) {
        const Address address{Role::kSimulator, i};
        simulators_.push_back(std::make_unique<Simulator>(model_, address, role, pool_));
        network_->add(address, 0);
    }
}

VirtualCluster::~VirtualCluster() = default;

void VirtualCluster::turn(std::size_t member) {
    const std::int64_t start = std::max(network_->clock_ns(member), std::min(network_->ready_ns(member), kNever));
    network_->work(member, start, [&](Bus& bus) {
        if (member == 0) return controller_->advance(bus);
        if (simulators_[member - 1]) simulators_[member - 1]->advance(bus);
    });
    if (member > 0 && simulators_[member - 1] && simulators_[member - 1]->gone()) simulators_[member - 1].reset();
}

/// Gives the one that can go on first its turn. False: nobody can, for nothing is under way.
bool VirtualCluster::go_on() {
    std::size_t first = 0;
    for (std::size_t i = 1; i < network_->size(); ++i)
        if (network_->ready_ns(i) < network_->ready_ns(first)) first = i;
    if (network_->ready_ns(first) == kNever) return false;
    turn(first);
    return true;
}

void VirtualCluster::run_until(Tick target, const std::function<void(double)>& committed) {
    controller_->run_until(target);
    Tick seen = controller_->tick();
    while (!controller_->resting()) {
        if (controller_->stopped()) throw std::runtime_error(controller_->failure()->text());
        if (!go_on()) {  // by the clock: who joins, who says a thing again
            std::int64_t latest = 0;
            for (std::size_t i = 0; i < network_->size(); ++i) latest = std::max(latest, network_->clock_ns(i));
            for (std::size_t i = 0; i < network_->size(); ++i)
                network_->work(i, latest + kIdle_ns, [&](Bus& bus) {
                    if (i == 0) return controller_->advance(bus);
                    if (simulators_[i - 1]) simulators_[i - 1]->advance(bus);
                });
        }
        if (controller_->tick() == seen) continue;
        seen = controller_->tick();
        if (committed) committed(time_s());
    }
}

void VirtualCluster::send_one_home() {
    controller_->send_one_home();
}

double VirtualCluster::time_s() const {
    return 1e-9 * static_cast<double>(network_->clock_ns(0));
}

double VirtualCluster::controller_cpu_s() const {
    return 1e-9 * static_cast<double>(network_->spent_ns(0));
}

std::size_t VirtualCluster::simulators() const {
    return controller_->counters().simulators;
}

const std::map<std::string, Traffic>& VirtualCluster::to_controller() const {
    return network_->received;
}

}  // namespace roboss::bench
