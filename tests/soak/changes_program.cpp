// A control program that changes its own world: it adds many robots and removes them again, and resets the
// run, again and again. It checks at every tick that the robots of the world file have the states of an
// undisturbed run, and reports times and memory as JSON. Options come by environment variables, see
// changes_soak.py.
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "client/control_program.h"
#include "core/hash.h"

namespace {

using namespace roboss;
using Clock = std::chrono::steady_clock;

int option(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? 0 : std::atoi(text);
}

std::string text_option(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? "" : text;
}

/// CPU time of all threads of this process, s.
double cpu_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Resident memory of this process after free memory has been given back, MiB.
double resident_mib() {
    malloc_trim(0);
    std::ifstream in("/proc/self/statm");
    long all = 0, resident = 0;
    in >> all >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

AddModels crowd(int count) {
    const std::string file = text_option("SOAK_MODEL");
    std::stringstream content;
    content << std::ifstream(file).rdbuf();
    AddModels add{file, content.str(), {}, "", {}};
    for (int i = 0; i < count; ++i)
        add.copies.push_back(
            {"crowd_" + std::to_string(i), {{300 + 2.0 * (i % 40), 2.0 * (i / 40), 0.5}, {}}});
    return add;
}

/// What outlives a program: a change of the world makes a new one.
struct Soak {
    enum class Phase { kRecording, kRounds, kResets, kDone };
    Phase phase = Phase::kRecording;
    const int record_ticks = option("SOAK_TICKS"), rounds = option("SOAK_ROUNDS"),
              robots = option("SOAK_ROBOTS"), resets = option("SOAK_RESETS"),
              ticks_each = option("SOAK_TICKS_EACH");
    std::vector<std::vector<std::uint64_t>> expected;  // hashes of the world's robots, by tick
    std::uint64_t start_model = 0;
    int done = 0;
    bool asked = false;  // and nothing has changed yet
    Tick since = 0;      // the tick at which the last change was seen
    Clock::time_point asked_at;
    double asked_cpu_s = 0;
    std::vector<double> add_s, remove_s, reset_s, add_cpu_s, remove_cpu_s, reset_cpu_s, mib;

    void ask(Client& client, ControlAction action) {
        asked = true;
        asked_at = Clock::now();
        asked_cpu_s = cpu_s();
        client.control(std::move(action));
    }
    void note_times(std::vector<double>& wall, std::vector<double>& cpu) const {
        wall.push_back(std::chrono::duration<double>(Clock::now() - asked_at).count());
        cpu.push_back(cpu_s() - asked_cpu_s);
    }

    void check(const Client& client) const {
        const auto tick = static_cast<std::size_t>(client.tick());
        if (tick >= expected.size()) return;
        for (std::size_t i = 0; i < expected[tick].size(); ++i)
            if (state_hash(RobotId(i), client.tick(), client.state(RobotId(i))) != expected[tick][i])
                throw std::runtime_error("robot " + std::to_string(i) + " is disturbed at tick " +
                                         std::to_string(tick));
        if (tick == 0 && client.model().robots.size() == expected[0].size() &&
            client.model().hash != start_model)
            throw std::runtime_error("the Model is not that of the start");
    }

    /// Asks for the next change `ticks_each` ticks after the last one.
    void advance(Client& client, bool changed) {
        if (changed && asked) take_change(client);
        if (asked || client.tick() < since + ticks_each) return;
        const bool late = client.tick() + 4 * ticks_each > record_ticks;
        if (phase == Phase::kRounds && late) return ask(client, ResetRun{});
        if (phase == Phase::kRounds && client.model().robots.size() == expected[0].size())
            return ask(client, crowd(robots));
        if (phase == Phase::kRounds) return ask(client, RemoveRobots{{"crowd_*"}});
        if (phase == Phase::kResets) return ask(client, ResetRun{});
        client.control(QuitRun{});
    }

    void take_change(Client& client) {
        asked = false;
        since = client.tick();
        const bool is_reset = client.tick() == 0;
        if (phase == Phase::kResets) {
            note_times(reset_s, reset_cpu_s);
            if (done % 100 == 0) mib.push_back(resident_mib());
            if (++done >= resets) finish();
        } else if (phase == Phase::kRounds && !is_reset) {
            const bool added = client.model().robots.size() > expected[0].size();
            note_times(added ? add_s : remove_s, added ? add_cpu_s : remove_cpu_s);
            if (added) return;
            mib.push_back(resident_mib());
            if (++done >= rounds) phase = resets > 0 ? Phase::kResets : Phase::kDone, done = 0;
            if (phase == Phase::kDone) finish();
        }
    }

    void finish() {
        phase = Phase::kDone;
        std::ofstream out(text_option("SOAK_REPORT"));
        const auto list = [&](const char* name, const std::vector<double>& values, const char* end) {
            out << '"' << name << "\": [";
            for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? ", " : "") << values[i];
            out << ']' << end;
        };
        out << '{';
        list("add_s", add_s, ",\n"), list("remove_s", remove_s, ",\n"), list("reset_s", reset_s, ",\n");
        list("add_cpu_s", add_cpu_s, ",\n"), list("remove_cpu_s", remove_cpu_s, ",\n");
        list("reset_cpu_s", reset_cpu_s, ",\n"), list("mib", mib, "}\n");
    }
};

Soak& soak() {
    static Soak the;
    return the;
}

class ChangingProgram : public ControlProgram {
  public:
    ControlOptions options() const override { return {0.001, -1, true}; }
    void control(Client& client) override {
        Soak& s = soak();
        const bool changed = std::exchange(is_new_, false);
        if (s.phase == Soak::Phase::kRecording) return record(client);
        s.check(client);
        s.advance(client, changed);
    }

  private:
    static void record(Client& client) {
        Soak& s = soak();
        s.start_model = client.model().hash;
        std::vector<std::uint64_t> hashes;
        for (std::size_t i = 0; i < client.model().robots.size(); ++i)
            hashes.push_back(state_hash(RobotId(i), client.tick(), client.state(RobotId(i))));
        s.expected.push_back(std::move(hashes));
        if (client.tick() < s.record_ticks) return;
        s.phase = s.rounds > 0 ? Soak::Phase::kRounds : Soak::Phase::kResets;
        s.ask(client, ResetRun{});
    }

    bool is_new_ = true;  // made by the last change
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(ChangingProgram)
