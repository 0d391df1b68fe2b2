// roboss-bus: the Bus over TLS by itself, with real processes on the loopback interface: round trips, joins,
// barriers, idle CPU time, and how soon a killed member is missed. Decision 0042 compares these rows with
// other transports.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "crew.h"

namespace roboss::bench {
namespace {

struct Question {
    std::vector<std::size_t> bytes{1'000, 60'000, 1'000'000};
    std::vector<int> members{8, 64, 128};
    double idle_s = 3;
    std::string json;
};

Question read(int argc, char** argv) {
    Question question;
    CLI::App app{"roboss-bus: what the Bus over TLS costs, measured with processes of this computer"};
    app.add_option("--bytes", question.bytes, "sizes of messages that go to a member and back")
        ->check(CLI::Range(1, 60'000'000));
    app.add_option("--members", question.members, "numbers of member processes that join")
        ->check(CLI::Range(1, 1'000));
    app.add_option("--idle", question.idle_s, "seconds for which the idle CPU time is taken")
        ->check(CLI::Range(.1, 60.));
    app.add_option("--json", question.json, "also write the rows here");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        std::exit(app.exit(e));
    }
    return question;
}

nlohmann::json measure(const Question& question) {
    nlohmann::json rows = nlohmann::json::array();
    const auto say = [&](const std::string& what, const std::string& unit, double value) {
        std::printf("%-32s %10.2f %s\n", what.c_str(), value, unit.c_str());
        std::fflush(stdout);
        rows.push_back({{"row", what}, {"unit", unit}, {"value", value}});
    };
    Crew pair(1);
    for (const std::size_t bytes : question.bytes)
        say("round trip of " + std::to_string(bytes) + " B", "us", pair.round_trip_us(bytes));
    for (const int members : question.members) {
        const std::string many = std::to_string(members) + " members: ";
        Crew crew(members);
        say(many + "joined after", "s", crew.joined_s());
        say(many + "barrier of 1 kB", "ms", crew.barrier_ms(1'000));
        const Crew::Idle idle = crew.idle(question.idle_s);
        say(many + "idle, the centre", "ms/s", idle.centre_ms_per_s);
        say(many + "idle, a member", "ms/s", idle.member_ms_per_s);
        say(many + "kill -9 seen after", "ms", crew.kill_seen_ms());
    }
    return rows;
}

}  // namespace
}  // namespace roboss::bench

int main(int argc, char** argv) {
    try {
        const auto question = roboss::bench::read(argc, argv);
        const nlohmann::json rows = roboss::bench::measure(question);
        if (!question.json.empty()) std::ofstream(question.json) << rows.dump(1) << "\n";
    } catch (const std::exception& e) {
        std::fprintf(stderr, "roboss-bus: %s\n", e.what());
        return 1;
    }
    return 0;
}
