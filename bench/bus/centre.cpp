// The centre sends messages of the asked size and counts the answers.
#include "centre.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <set>
#include <stdexcept>
#include <vector>

#include "median.h"
#include "net/stream_bus.h"

namespace roboss::bench {
namespace {

constexpr std::int64_t kPatience_ms = 60'000, kTurn_ms = 50;
constexpr double kMeasure_s = 1.5;
constexpr std::size_t kFewest = 20;

NetOptions options_of(const std::string& run) {
    NetOptions options;
    options.simulation = run;
    return options;
}

std::unique_ptr<StreamBus> checked(Result<std::unique_ptr<StreamBus>> bus) {
    if (!bus) throw std::runtime_error(bus.error().text());
    return std::move(bus).value();
}

Address member(int number) {
    return {Role::kSimulator, static_cast<std::uint64_t>(number) + 1};
}

StateReply letter(std::size_t bytes) {
    StateReply reply;
    reply.states.robots = {RobotId(0u)};
    reply.states.sizes = {static_cast<std::uint32_t>(bytes)};
    reply.states.bytes.assign(bytes, 42);
    return reply;
}

class Centre {
  public:
    Centre(const std::string& run, int members)
        : bus_(checked(StreamBus::listen(options_of(run)))), members_(members) {
        bus_->drain(kControllerAddress, inbox_);
    }

    double answer(const std::string& question, std::size_t bytes) {
        if (question == "joined") return joined();
        if (question == "round-trip") return 1e-3 * timed(1, bytes);
        if (question == "barrier") return 1e-6 * timed(members_, bytes);
        if (question == "vanished") return vanished();
        throw std::runtime_error("unknown question '" + question + "'");
    }

  private:
    /// Time at which every member has sent its first message and got an answer.
    double joined() {
        std::set<Address> there;
        while (there.size() < static_cast<std::size_t>(members_)) {
            take_some();
            for (const Envelope& e : inbox_)
                if (there.insert(e.from).second) bus_->send(kControllerAddress, e.from, Welcome{});
        }
        return static_cast<double>(shared_clock_ns());
    }

    /// Median, ns, of a message to each of the first `members` and an answer from each.
    double timed(int members, std::size_t bytes) {
        const StateReply sent = letter(bytes);
        std::vector<double> spent_ns;
        const long long end = shared_clock_ns() + static_cast<long long>(1e9 * kMeasure_s);
        while (shared_clock_ns() < end || spent_ns.size() < kFewest) {
            const long long begin = shared_clock_ns();
            for (int i = 0; i < members; ++i) bus_->send(kControllerAddress, member(i), sent);
            for (std::size_t got = 0; got < static_cast<std::size_t>(members); got += inbox_.size())
                take_some();
            spent_ns.push_back(static_cast<double>(shared_clock_ns() - begin));
        }
        return median(spent_ns);
    }

    double vanished() {
        const std::int64_t end_ms = bus_->now_ms() + kPatience_ms;
        while (bus_->take_vanished(kControllerAddress).empty()) {
            if (bus_->now_ms() > end_ms)
                throw std::runtime_error("the loss of a killed member is not reported");
            bus_->wait(kTurn_ms);
            bus_->drain(kControllerAddress, inbox_);
        }
        return static_cast<double>(shared_clock_ns());
    }

    void take_some() {
        const std::int64_t end_ms = bus_->now_ms() + kPatience_ms;
        for (bus_->drain(kControllerAddress, inbox_); inbox_.empty();
             bus_->drain(kControllerAddress, inbox_)) {
            if (bus_->now_ms() > end_ms) throw std::runtime_error("a message does not arrive");
            bus_->wait(kTurn_ms);
        }
    }

    std::unique_ptr<StreamBus> bus_;
    int members_;
    std::vector<Envelope> inbox_;
};

}  // namespace

long long shared_clock_ns() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1'000'000'000LL * t.tv_sec + t.tv_nsec;
}

void run_centre(const std::string& run, int members, int questions, int answers) {
    try {
        Centre centre(run, members);
        FILE* in = fdopen(questions, "r");
        dprintf(answers, "0\n");
        char question[32];
        std::size_t bytes = 0;
        while (in && std::fscanf(in, "%31s %zu", question, &bytes) == 2)
            dprintf(answers, "%.1f\n", centre.answer(question, bytes));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "roboss-bus, the centre: %s\n", e.what());
    }
    _exit(0);
}

void run_member(const std::string& run, int number) {
    auto connection = StreamBus::join(options_of(run), "simulator", "member-" + std::to_string(number));
    if (!connection) {
        std::fprintf(stderr, "roboss-bus, a member: %s\n", connection.error().text().c_str());
        _exit(1);
    }
    StreamBus& bus = *connection.value();
    const Address self = member(number);
    std::vector<Envelope> inbox;
    bool joined = false, asked = false;
    for (;; bus.wait(kTurn_ms)) {
        bus.drain(self, inbox);
        if (!asked && bus.present(kControllerAddress)) {
            bus.send(self, kControllerAddress, Hello{});
            asked = true;
        }
        for (Envelope& e : inbox) {
            if (joined) bus.send(self, e.from, std::move(e.message));
            joined = true;
        }
    }
}

}  // namespace roboss::bench
