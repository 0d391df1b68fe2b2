// Forks, asks and kills.
#include "crew.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <stdexcept>

#include "centre.h"

namespace roboss::bench {
namespace {

/// CPU time that another process has spent so far, all its threads.
double cpu_ms(pid_t process) {
    clockid_t clock{};
    timespec t{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &t) != 0)
        throw std::runtime_error("a process has ended");
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

void end(pid_t process) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
}

}  // namespace

Crew::Crew(int members) {
    static int crews = 0;
    const std::string run = "bus-" + std::to_string(getpid()) + "-" + std::to_string(++crews);
    int questions[2], answers[2];
    if (pipe(questions) != 0 || pipe(answers) != 0) throw std::runtime_error("no pipes");
    if ((centre_ = fork()) == 0) {
        close(questions[1]);
        run_centre(run, members, questions[0], answers[1]);
    }
    close(questions[0]);
    close(answers[1]);
    to_centre_ = questions[1];
    from_centre_ = answers[0];
    ask("");
    const long long begin = shared_clock_ns();
    for (int i = 0; i < members; ++i) {
        members_.push_back(fork());
        if (members_.back() == 0) run_member(run, i);
    }
    joined_s_ = 1e-9 * (ask("joined 0") - static_cast<double>(begin));
}

Crew::~Crew() {
    for (const pid_t member : members_) end(member);
    end(centre_);
    close(to_centre_);
    close(from_centre_);
}

double Crew::ask(const std::string& question) {
    if (!question.empty()) dprintf(to_centre_, "%s\n", question.c_str());
    std::string line;
    for (char c = 0; read(from_centre_, &c, 1) == 1 && c != '\n';) line += c;
    if (line.empty()) throw std::runtime_error("the centre has ended");
    return std::stod(line);
}

double Crew::round_trip_us(std::size_t bytes) {
    return ask("round-trip " + std::to_string(bytes));
}

double Crew::barrier_ms(std::size_t bytes) {
    return ask("barrier " + std::to_string(bytes));
}

Crew::Idle Crew::idle(double seconds) const {
    const auto all = [this] {
        double sum = 0;
        for (const pid_t member : members_) sum += cpu_ms(member);
        return sum;
    };
    usleep(1'000'000);
    const double centre = cpu_ms(centre_), members = all();
    usleep(static_cast<useconds_t>(1e6 * seconds));
    return {(cpu_ms(centre_) - centre) / seconds,
            (all() - members) / seconds / static_cast<double>(members_.size())};
}

double Crew::kill_seen_ms() {
    dprintf(to_centre_, "vanished 0\n");
    usleep(100'000);
    const long long begin = shared_clock_ns();
    end(members_.back());
    members_.pop_back();
    return 1e-6 * (ask("") - static_cast<double>(begin));
}

}  // namespace roboss::bench
